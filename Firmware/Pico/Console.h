// SPDX-License-Identifier: MIT
// Commands by text on the serial port, one per line: "info", "counters", "silence on", "silence off". As
// everywhere in PhysVib, a line that begins with "silence" silences, except "silence off".
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib::pico {

/// Main loop only.
class Console {
public:
    struct Facts {
        int channels;
        const char* serialNumber;
        bool isPlaying;
        std::int32_t ceiling;
        std::uint32_t underruns, overruns, missingPackets, wrongSizes, restarts, limitedTiles, levelFrames,
            worstTileCycles;
    };

    /// Adds a received character. True: a command is complete, and answer() is to be called.
    bool take(char c) noexcept {
        if (c == '\n' || c == '\r') return count_ > 0;
        if (count_ < line_.size()) line_[count_] = c;
        if (count_ <= line_.size()) ++count_; // count_ marks a line as too long
        return false;
    }

    /// Executes the command. The text is valid until the next call.
    std::string_view answer(const Facts& f) noexcept {
        const std::string_view line(line_.data(), count_ < line_.size() ? count_ : line_.size());
        const bool isWhole = count_ <= line_.size();
        length_ = 0;
        count_ = 0;
        if (isWhole && line == "info") {
            add("physvib pico");
            add(static_cast<std::uint32_t>(f.channels));
            add(" version " PHYSVIB_VERSION " serial ");
            add(f.serialNumber);
        } else if (isWhole && line == "counters") {
            counters(f);
        } else if (line.substr(0, 7) == "silence") {
            silenced_ = !(isWhole && line == "silence off");
            add(silenced_ ? "silence on" : "silence off");
        } else {
            add("expected: info, counters, silence on, or silence off");
        }
        add("\r\n");
        return {text_.data(), length_};
    }

    bool isSilenced() const noexcept { return silenced_; }
    void silence() noexcept { silenced_ = true; } ///< restores the silence from before a restart

private:
    void counters(const Facts& f) noexcept {
        const auto value = [this](std::string_view name, std::uint32_t number) {
            add(name);
            add(number);
        };
        add(silenced_ ? "silenced" : f.isPlaying ? "playing" : "waiting");
        value(" underruns ", f.underruns);
        value(" overruns ", f.overruns);
        value(" missing_packets ", f.missingPackets);
        value(" wrong_sizes ", f.wrongSizes);
        value(" restarts ", f.restarts);
        value(" limited_tiles ", f.limitedTiles);
        value(" level_frames ", f.levelFrames);
        value(" ceiling ", static_cast<std::uint32_t>(f.ceiling));
        value(" worst_tile_cycles ", f.worstTileCycles);
    }
    void add(std::string_view text) noexcept {
        for (const char c : text)
            if (length_ < text_.size()) text_[length_++] = c;
    }
    void add(std::uint32_t number) noexcept {
        std::array<char, 10> digits{};
        std::size_t at = digits.size();
        do digits[--at] = static_cast<char>('0' + number % 10);
        while ((number /= 10) > 0);
        add(std::string_view(digits.data() + at, digits.size() - at));
    }

    std::array<char, 24> line_{};
    std::array<char, 288> text_{};
    std::size_t count_ = 0, length_ = 0;
    bool silenced_ = false;
};

} // namespace physvib::pico
