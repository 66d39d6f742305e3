// SPDX-License-Identifier: GPL-3.0-or-later
// What the host's transport did since the last block: a start, a stop, or a jump (which is both).
#pragma once
#include <cstdint>
#include <optional>

namespace physvib {

/// R only.
class Transport {
public:
    enum class Change { none, started, stopped };

    void reset() noexcept { *this = {}; }

    /// Before each block. A host without a transport (`isPlaying` empty) plays from its first block on; one that does not
    /// tell where it is makes no jumps.
    Change follow(std::optional<bool> isPlaying, std::optional<std::int64_t> frame, int frames) noexcept {
        const bool plays = isPlaying.value_or(true);
        const bool jumped = plays && wasPlaying_ && frame && expected_ && *frame != *expected_;
        const auto change = plays && (!wasPlaying_ || jumped) ? Change::started : !plays && wasPlaying_ ? Change::stopped : Change::none;
        wasPlaying_ = plays;
        expected_ = frame && plays ? std::optional{*frame + frames} : std::nullopt;
        return change;
    }

    bool isPlaying() const noexcept { return wasPlaying_; }

private:
    bool wasPlaying_ = false;
    std::optional<std::int64_t> expected_;
};

} // namespace physvib
