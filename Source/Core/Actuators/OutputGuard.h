// SPDX-License-Identifier: MIT
// Protection before the actuators: LinkedLimiter (below), then OutputGuard. The guard is a gain per channel
// that keeps the mean over 250 ms, and the content below 5 Hz, within limits::guardShare of full scale.
// Neither is felt, and both only warm a coil.
//
// It decides at the ends of tiles of a third of a millisecond on an absolute grid of whole frames, so samples
// do not depend on block sizes. While the gain is 1, samples stay unchanged. Rule: GuardLaw.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Actuators/GuardLaw.h"
#include "Core/Limits.h"
#include "Core/Modes/TileKernels.h"
#include "Core/Storage.h"
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace physvib {
/// The guard of a computer's output. Render thread (R) only; prepare: message thread (M).
class OutputGuard {
public:
    /// Resets the sums. The bits do not depend on the instruction set. M, not while rendering.
    void prepare(int sampleRateHz, int channels, GuardPlace place,
                 InstructionSet set = InstructionSet::best) noexcept {
        const TileKernel* const kernels = tileKernel(set);
        sumTiles_ = kernels != nullptr ? kernels->limiter.sumTiles : nullptr;
        channels_ = static_cast<std::size_t>(channels);
        law_.prepare(channels, place);
        sums_.fill(0);
        isActing_ = hasSums_ = false;
        changeRate(sampleRateHz);
    }
    /// Changes the sample rate and keeps the sums. M, not while rendering.
    void changeRate(int sampleRateHz) noexcept {
        if (hasSums_) endTile();
        tile_ = std::max(1, static_cast<int>(std::lround(sampleRateHz * tileSeconds)));
        law_.setTile(static_cast<float>(tile_) / static_cast<float>(sampleRateHz));
        perUnit_ = 1.0f / (GuardUnits::perFullScale * static_cast<float>(sampleRateHz));
        filled_ = 0;
        frame_ = unknownFrame;
    }

    /// The state of a channel, for restore(). M, not while rendering.
    GuardSums sums(std::size_t channel) noexcept {
        if (hasSums_) endTile();
        frame_ = unknownFrame;
        return law_.sums(channel);
    }
    /// Restores these sums, one per channel. M, after prepare().
    void restore(const GuardSums* sums) noexcept {
        for (std::size_t j = 0; j < channels_; ++j) law_.restore(j, sums[j]);
        for (int k = 0; k < 2; ++k) isActing_ = law_.update({}); // both ends of the next tile's ramp
    }
    std::size_t channels() const noexcept { return channels_; }
    float load(std::size_t channel) const noexcept { return law_.sums(channel).load; } ///< see GuardLaw. R.
    /// Adds a channel, at rest. R.
    void addChannel() noexcept { law_.addChannel(), ++channels_; }

    /// Sets the absolute number of the next frame. Tiles lie on the grid of these numbers, so that samples do
    /// not depend on the output latency. Without it the grid starts at prepare. R.
    void moveTo(std::int64_t frame) noexcept {
        if (frame == frame_) return; // the usual case needs no division
        const auto position = static_cast<int>((frame % tile_ + tile_) % tile_);
        if (position != filled_ && hasSums_) endTile();
        filled_ = position;
        frame_ = frame;
    }

    /// In place: io[channel][0..frames), finite, up to 8 times full scale; null: a channel without output.
    /// `isSilent`: all of it is 0.
    void process(float* const* io, int frames, bool isSilent = false) noexcept {
        frame_ += frames;
        if (isSilent && !hasSums_ && law_.isAtRest()) {
            filled_ = (filled_ + frames) % tile_;
            return;
        }
        for (int first = 0, count; first < frames; first += count) {
            if (!isSilent && !isActing_ && filled_ == 0 && frames - first >= tile_ * tilesTogether) {
                count = processTiles(io, first);
                continue;
            }
            count = std::min(frames - first, tile_ - filled_);
            if (!isSilent) processPart(io, first, count);
            filled_ += count;
            if (filled_ == tile_) endTile();
        }
    }

    float gain() const noexcept { return law_.gain(); } ///< lowest of all channels; 1: no reduction
    /// How often it began to act, since prepare.
    std::uint32_t episodes() const noexcept { return law_.episodes(); }

private:
    static constexpr double tileSeconds = 1.0 / 3000.0;
    static constexpr auto width = static_cast<std::size_t>(limits::maxActuators);
    static_assert(GuardUnits::stride >= width);
    static constexpr int tilesTogether = static_cast<int>(GuardUnits::tiles);
    using Sums = std::array<std::int32_t, GuardUnits::stride * GuardUnits::tiles>;

    // Passes on whole tiles, up to the first that is to be attenuated. Returns how many frames they have.
    int processTiles(float* const* io, int first) noexcept {
        Sums sums;
        sumTiles(io, first, tile_, GuardUnits::tiles, sums);
        int processed = 0;
        for (std::size_t t = 0; t < GuardUnits::tiles && !isActing_; ++t, processed += tile_)
            endTile(sums.data() + t * GuardUnits::stride);
        return processed;
    }
    void sumTiles(float* const* io, int first, int frames, std::size_t tiles, Sums& sums) const noexcept {
        const auto from = static_cast<std::size_t>(first), count = static_cast<std::size_t>(frames);
        if (sumTiles_ != nullptr) return sumTiles_(io, channels_, from, count, tiles, sums.data());
        for (std::size_t j = 0; j < channels_; ++j)
            for (std::size_t t = 0; t < tiles; ++t) {
                const auto at = io[j] == nullptr ? nullptr : io[j] + from + t * count;
                auto& sum = sums[t * GuardUnits::stride + j] = 0;
                for (std::size_t k = 0; at != nullptr && k < count; ++k) sum += GuardUnits::fromSample(at[k]);
            }
    }
    void processPart(float* const* io, int first, int count) noexcept {
        hasSums_ = true;
        for (std::size_t j = 0; isActing_ && j < channels_; ++j)
            if (io[j] != nullptr && (law_.startGain(j) != 1.0f || law_.endGain(j) != 1.0f))
                attenuate(j, io[j] + first, count);
        Sums sums;
        sumTiles(io, first, count, 1, sums);
        for (std::size_t j = 0; j < channels_; ++j) sums_[j] += sums[j];
    }
    void attenuate(std::size_t j, float* samples, int count) noexcept {
        const float step = (law_.endGain(j) - law_.startGain(j)) / static_cast<float>(tile_);
        for (int k = 0; k < count; ++k) {
            const float y = samples[k] * (law_.startGain(j) + step * static_cast<float>(filled_ + k + 1));
            samples[k] = std::abs(y) < std::numeric_limits<float>::min() ? 0.0f : y;
        }
    }
    void endTile() noexcept {
        endTile(sums_.data());
        sums_.fill(0);
        filled_ = 0;
        hasSums_ = false;
    }
    void endTile(const std::int32_t* sums) noexcept {
        GuardLaw<limits::maxActuators>::Row areas;
        for (std::size_t j = 0; j < channels_; ++j) areas[j] = static_cast<float>(sums[j]) * perUnit_;
        isActing_ = law_.update(areas);
    }

    decltype(LimiterKernel::sumTiles) sumTiles_ = nullptr; // null: a plain loop
    GuardLaw<limits::maxActuators> law_;
    std::array<std::int32_t, width> sums_{};
    std::size_t channels_ = 0;
    static constexpr std::int64_t unknownFrame = std::numeric_limits<std::int64_t>::min();
    std::int64_t frame_ = unknownFrame; // number of the next frame; near `unknownFrame`: not known
    int tile_ = 1, filled_ = 0;
    float perUnit_ = 1.0f;
    bool isActing_ = false, hasSums_ = false;
};

/// Linked look-ahead limiter: one gain for all channels, so that a phantom stays in place while no channel
/// exceeds its ceiling.
///
/// Window of W frames (limits::limiterLookAheadSeconds): the lowest gain that any of the last W frames needs
/// (sliding minimum), released linearly, averaged over W frames, applied to the input of W - 1 frames ago.
/// Each averaged value is at most what the delayed frame needs, so the ceiling holds. The average limits the
/// attack's slope to 1/W per frame, the release to 1/(limits::limiterReleaseSeconds * rate). Gains are
/// integers (2^30 = 1): their running sum neither drifts nor differs between machines, and the gain returns
/// to exactly 1. A change of ceiling is a ramp of at most limits::channelRampSeconds: each frame is limited
/// by the ceiling of its own time. R only, but for prepare: M.
class LinkedLimiter {
public:
    /// Resets everything; ceilings 1. If disabled, it only delays and replaces invalid samples. The bits do
    /// not depend on the instruction set. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels, bool isEnabled,
                 InstructionSet set = InstructionSet::best) noexcept;

    /// Largest absolute sample of that channel, > 0 and finite. After the first frame it changes in a ramp.
    void setCeiling(int channel, float ceiling) noexcept;

    /// In place: io[channel][0..frames) becomes the limited input of latencyFrames() earlier. NaN, infinite
    /// and denormal samples become 0 (those that are not finite are counted). `isSilent`: all input is +0; if
    /// the delayed frames are 0 too, nothing is computed. True if the output is silent.
    bool process(float* const* io, int frames, bool isSilent = false) noexcept;

    /// process() from `in` to `out`; `in` is also copied to `copy`. Only if hasKernel.
    void processInto(const float* const* in, float* const* out, int frames, float* const* copy) noexcept;
    bool hasKernel() const noexcept { return kernel_ != nullptr; }

    int latencyFrames() const noexcept { return window_ - 1; }
    static int latencyFramesAt(int sampleRateHz) noexcept { return windowAt(sampleRateHz) - 1; }
    double maxAttackPerFrame() const noexcept { return 1.0 / window_; }
    double maxReleasePerFrame() const noexcept { return static_cast<double>(releaseStep_) / unit; }
    float gain() const noexcept { return gain_; } ///< the last one applied
    std::uint64_t nonFiniteSamples() const noexcept { return nonFinite_; }

private:
    static constexpr std::int64_t unit = std::int64_t{1} << 30;
    static constexpr auto maxWindowFrames = static_cast<std::size_t>(limits::maxLookAheadFrames);
    static constexpr auto width = static_cast<std::size_t>(limits::maxActuators);

    static constexpr auto maxPartFrames = static_cast<std::size_t>(limits::tileFrames);
    using Gains = std::array<float, maxPartFrames>;

    static int windowAt(int sampleRateHz) noexcept;
    void processAll(const float* const* in, float* const* out, int frames, float* const* copy) noexcept;
    void processPart(const LimiterLines& lines) noexcept;
    bool storeInputs(const LimiterLines& lines) noexcept;
    void writeOutputs(const LimiterLines& lines, const float* gains) noexcept;
    bool cleanAndCompare(const float* samples, std::size_t frames, std::int32_t maxBits,
                         float* line) noexcept;
    void followGains(const LimiterLines& lines, Gains& gains) noexcept;
    void delayAndLimit(float* line, float* samples, std::size_t frames, const float* gains,
                       float ceiling) const noexcept;
    bool isResting() const noexcept { return releasedGain_ == unit && sum_ == unit * window_; }
    void skipFrames(std::size_t frames) noexcept;
    void setBound(std::size_t channel, float ceiling) noexcept;
    void settle() noexcept;
    std::int64_t slidingMinimum(std::int64_t neededGain) noexcept;
    float advanceGain(std::int64_t neededGain) noexcept;

    int channels_ = 1;
    int window_ = 1;
    bool isEnabled_ = true;
    std::int64_t releaseStep_ = unit;
    static constexpr std::size_t step = 16, // floats of the widest vector
        floatsPerLine = (maxWindowFrames + maxPartFrames + 2 * step - 2) / step * step;
    // of latencyFrames(), whole vectors
    std::size_t frontFloats() const noexcept {
        return (static_cast<std::size_t>(window_) + step - 2) / step * step;
    }
    const LimiterKernel* kernel_ = nullptr;
    std::array<GainRamp, width> ceilings_{}; // of the input
    std::array<float, width> bounds_{};      // ceiling, in a ramp the highest; infinite: the limiter is off
    std::array<std::int32_t, width> maxBits_{}; // magnitudes up to this need no reduction, even at the
                                                // lowest ceiling of a ramp, and are finite
    std::int64_t settledFrame_ = 0; // from here on no delayed frame is subject to a ramp's ceiling
    int rampFrames_ = 1;
    bool isSettled_ = true;
    Storage<float, width * floatsPerLine, true> lines_; // per channel the last latencyFrames() inputs
    std::int64_t silentFrames_ = 0;                     // trailing silent inputs
    int position_ = 0;                                  // in the ring of `window_` gains
    std::int64_t frame_ = 0;
    struct Candidate {
        std::int64_t neededGain = unit;
        std::int64_t frame = 0;
    };
    std::array<Candidate, maxWindowFrames + 1> candidates_{}; // rising gains: the front is the window's
                                                              // minimum
    std::size_t firstCandidate_ = 0;
    std::size_t candidateCount_ = 0;
    std::int64_t releasedGain_ = unit;
    std::array<std::int64_t, maxWindowFrames> averagedGains_{};
    std::int64_t sum_ = 0;
    float gain_ = 1.0f;
    std::uint64_t nonFinite_ = 0;
};

} // namespace physvib
