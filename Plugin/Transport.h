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

    /// Before each block. A host without a transport (`isPlaying` always empty) plays from its first block on; one that
    /// says nothing for a block goes on as before (LV2 hosts tell changes only); one that does not tell where it is makes no
    /// jumps. A place within the block is no jump: LV2 hosts tell a change of tempo there, and JUCE does not say when.
    Change follow(std::optional<bool> isPlaying, std::optional<std::int64_t> frame, int frames) noexcept {
        const bool plays = isPlaying.value_or(!isThere_ || wasPlaying_);
        const bool wasPlaying = wasPlaying_ && (isThere_ || !isPlaying); // what was assumed counts until the host tells
        isThere_ = isThere_ || isPlaying;
        const bool jumped = plays && wasPlaying && frame && expected_ && (*frame < *expected_ || *frame >= *expected_ + frames);
        const auto change = plays && (!wasPlaying || jumped) ? Change::started : !plays && wasPlaying ? Change::stopped : Change::none;
        const auto now = frame && (change == Change::started || !expected_) ? frame : expected_;
        expected_ = now && plays ? std::optional{*now + frames} : std::nullopt;
        wasPlaying_ = plays;
        return change;
    }

    bool isPlaying() const noexcept { return wasPlaying_; }

private:
    bool isThere_ = false, wasPlaying_ = false;
    std::optional<std::int64_t> expected_;
};

} // namespace physvib
