// SPDX-License-Identifier: GPL-3.0-or-later
// A recording beside the render it should be: runs of bit-equal blocks, and what happened between them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace physvib::test {

/// Interleaved samples.
struct Recording {
    std::vector<float> samples;
    int channels = 1;
    std::int64_t frames() const { return static_cast<std::int64_t>(samples.size()) / channels; }
    const float* at(std::int64_t frame) const { return samples.data() + frame * channels; }
};

/// A place where the recording does not go on as the render does.
struct Break {
    std::int64_t frame = 0; ///< of the recording: the first block that differs
    int foreign = 0;        ///< blocks from there on that are nowhere near in the render (blank, or torn)
    int skipped = 0;        ///< blocks of the render that are missing; negative: too many
};

struct Comparison {
    std::int64_t offset = 0; ///< frame of the recording at which the render's first one lies
    std::int64_t blocks = 0, equal = 0;
    std::vector<Break> breaks;
    bool isAligned = false;
};

class RecordingRuns {
public:
    /// Blocks of `block` frames, cut as the recorder was given them; the render is silent before.
    RecordingRuns(const Recording& recording, const Recording& render, int block)
        : recording_{recording}
        , render_{render}
        , block_{block} {}

    Comparison compare() {
        Comparison result;
        result.isAligned = align();
        if (!result.isAligned) return result;
        result.offset = -shift_;
        bool isBroken = false;
        for (std::int64_t at = 0;
             at + block_ <= recording_.frames() && at + shift_ + block_ <= render_.frames(); at += block_) {
            ++result.blocks;
            const int skipped = blocksToSkip(at);
            if (!isBroken && skipped != 0) result.breaks.push_back({at});
            if (skipped == nowhere)
                ++result.breaks.back().foreign;
            else if (skipped != 0)
                result.breaks.back().skipped += skipped;
            isBroken = skipped == nowhere;
            if (isBroken) continue;
            shift_ += static_cast<std::int64_t>(skipped) * block_;
            ++result.equal;
        }
        return result;
    }

private:
    static constexpr int nowhere = 1 << 20, farthest = 4096; // blocks

    bool isSilent(std::int64_t at) const {
        return std::all_of(recording_.at(at), recording_.at(at + block_), [](float x) { return x == 0.0f; });
    }
    // The block of the recording at `at` is the render's at `there`.
    bool isEqual(std::int64_t at, std::int64_t there) const {
        if (there + block_ > render_.frames()) return false;
        // frames before the render begins
        const auto before = static_cast<int>(std::clamp<std::int64_t>(-there, 0, block_));
        const float* recorded = recording_.at(at);
        if (!std::all_of(recorded, recording_.at(at + before), [](float x) { return x == 0.0f; }))
            return false;
        const auto bytes = static_cast<std::size_t>((block_ - before) * render_.channels) * sizeof(float);
        return bytes == 0 || std::memcmp(recording_.at(at + before), render_.at(there + before), bytes) == 0;
    }
    // The first block with sound that is found in the render tells how they lie.
    bool align() {
        for (std::int64_t at = 0; at + block_ <= recording_.frames(); at += block_) {
            if (isSilent(at)) continue;
            for (std::int64_t there = 1 - block_; there + block_ <= render_.frames(); ++there)
                if (isEqual(at, there)) {
                    shift_ = there - at;
                    return true;
                }
        }
        return false;
    }
    // 0: it goes on; how many blocks of the render are missing before it; or `nowhere`. Silence: nothing.
    int blocksToSkip(std::int64_t at) const {
        if (isEqual(at, at + shift_)) return 0;
        if (isSilent(at)) return nowhere;
        for (int k = 1; k <= farthest; ++k)
            for (const int skipped : {k, -k})
                if (isEqual(at, at + shift_ + static_cast<std::int64_t>(skipped) * block_)) return skipped;
        return nowhere;
    }

    const Recording& recording_;
    const Recording& render_;
    int block_;
    std::int64_t shift_ = 0; // render frame = recording frame + shift
};

} // namespace physvib::test
