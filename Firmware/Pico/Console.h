// SPDX-License-Identifier: MIT
// Commands by text on the serial port, one per line: "info", "counters", "silence on", "silence off". As
// everywhere in PhysVib, a line that begins with "silence" silences, except "silence off".
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib::pico {

/// Collects a line and answers it. Main loop only.
class Console {
public:
    struct Status {
        int channels;
        const char* serialNumber;
        bool isPlaying;
        std::int32_t ceiling;
        std::uint32_t underruns, overruns, missingPackets, sizeErrors, restarts, limitedTiles, levelFrames,
            worstTileCycles;
    };

    /// Adds a received character. True: a command is complete, and answer() must be called.
    bool receive(char c) noexcept {
        if (c == '\n' || c == '\r') return lineLength_ > 0;
        if (lineLength_ < line_.size()) line_[lineLength_] = c;
        if (lineLength_ <= line_.size()) ++lineLength_; // lineLength_ marks a line as too long
        return false;
    }

    /// Executes the command. The text is valid until the next call.
    std::string_view answer(const Status& status) noexcept {
        const std::string_view line(line_.data(), lineLength_ < line_.size() ? lineLength_ : line_.size());
        const bool isComplete = lineLength_ <= line_.size();
        answerLength_ = 0;
        lineLength_ = 0;
        if (isComplete && line == "info") {
            add("physvib pico");
            add(static_cast<std::uint32_t>(status.channels));
            add(" version " PHYSVIB_VERSION " serial ");
            add(status.serialNumber);
        } else if (isComplete && line == "counters") {
            addCounters(status);
        } else if (line.substr(0, 7) == "silence") {
            isSilenced_ = !(isComplete && line == "silence off");
            add(isSilenced_ ? "silence on" : "silence off");
        } else {
            add("expected: info, counters, silence on, or silence off");
        }
        add("\r\n");
        return {answer_.data(), answerLength_};
    }

    bool isSilenced() const noexcept { return isSilenced_; }
    void silence() noexcept { isSilenced_ = true; } ///< restores the silence from before a restart

private:
    void addCounters(const Status& status) noexcept {
        const auto addCounter = [this](std::string_view name, std::uint32_t number) {
            add(name);
            add(number);
        };
        add(isSilenced_ ? "silenced" : status.isPlaying ? "playing" : "waiting");
        addCounter(" underruns ", status.underruns);
        addCounter(" overruns ", status.overruns);
        addCounter(" missing_packets ", status.missingPackets);
        addCounter(" wrong_sizes ", status.sizeErrors);
        addCounter(" restarts ", status.restarts);
        addCounter(" limited_tiles ", status.limitedTiles);
        addCounter(" level_frames ", status.levelFrames);
        addCounter(" ceiling ", static_cast<std::uint32_t>(status.ceiling));
        addCounter(" worst_tile_cycles ", status.worstTileCycles);
    }
    void add(std::string_view text) noexcept {
        for (const char c : text)
            if (answerLength_ < answer_.size()) answer_[answerLength_++] = c;
    }
    void add(std::uint32_t number) noexcept {
        std::array<char, 10> digits{};
        std::size_t start = digits.size();
        do digits[--start] = static_cast<char>('0' + number % 10);
        while ((number /= 10) > 0);
        add(std::string_view(digits.data() + start, digits.size() - start));
    }

    std::array<char, 24> line_{};
    std::array<char, 288> answer_{};
    std::size_t lineLength_ = 0, answerLength_ = 0;
    bool isSilenced_ = false;
};

} // namespace physvib::pico
