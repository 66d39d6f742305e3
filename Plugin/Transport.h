// SPDX-License-Identifier: GPL-3.0-or-later
// Detects starts, stops and jumps (a stop and a start) of the host's transport since the last block.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace physvib {

/// R only.
class Transport {
public:
    enum class Change { none, started, stopped };

    void reset() noexcept { *this = {}; }

    /// Before each block. A host without a transport (`isPlaying` always empty) plays from its first block
    /// on; one that says nothing for a block goes on as before (LV2 hosts tell changes only); one that does
    /// not tell where it is makes no jumps. A place up to two blocks beside the one expected is no jump, and
    /// what follows is expected from there: tapes run at half and at twice the speed, clocks jitter by a
    /// block, LV2 hosts tell a change of tempo within one. Where every block jumps, a hand is on the
    /// transport: that is one start, and another when it has let go.
    Change follow(std::optional<bool> isPlaying, std::optional<std::int64_t> frame, int frames) noexcept {
        const bool plays = isPlaying.value_or(!isThere_ || wasPlaying_);
        // what was assumed counts until the host tells
        const bool wasPlaying = wasPlaying_ && (isThere_ || !isPlaying);
        isThere_ = isThere_ || isPlaying;
        const bool jumped = plays && wasPlaying && frame && expected_ &&
                            std::abs(*frame - *expected_) >= 2 * std::max(frames, lastFrames_);
        const auto change = plays ? follow(!wasPlaying, jumped) : wasPlaying ? Change::stopped : Change::none;
        if (frame) expected_ = frame;
        if (expected_) *expected_ += plays ? frames : 0;
        lastFrames_ = frames;
        wasPlaying_ = plays;
        return change;
    }

    bool isPlaying() const noexcept { return wasPlaying_; }

private:
    Change follow(bool begins, bool jumped) noexcept {
        const bool starts = begins || (jumped && !justMoved_) || (!jumped && owesStart_);
        owesStart_ = !begins && jumped && justMoved_;
        justMoved_ = begins || jumped;
        return starts ? Change::started : Change::none;
    }

    bool isThere_ = false, wasPlaying_ = false;
    bool justMoved_ = false, owesStart_ = false;
    int lastFrames_ = 0;
    std::optional<std::int64_t> expected_;
};

} // namespace physvib
