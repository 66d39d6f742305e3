// SPDX-License-Identifier: GPL-3.0-or-later
// Music that comes in: its low frequencies for the actuators, delayed by L, and its onsets, which strike.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/EnchanterLayout.h"
#include "Core/Limits.h"
#include "Core/Nonblocking.h"
#include "Host/Music/BeatDetector.h"
#include "Live/Session/Scheduler.h"
#include <array>
#include <cmath>
#include <cstdint>
#include <juce_audio_basics/juce_audio_basics.h>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

/// Delays incoming music by the play-out latency, so that it reaches the renderer together with the events.
/// Of one take: left and right by the renderer's frames, and what each actuator gets of them by its place:
/// all of the left at the layout's left edge, all of the right at its right edge, a line between.
class MusicDelay final : public AddedSamples {
public:
    /// At least the layout's `channels`; nothing older than `longestFrames` is read. Any thread but R.
    MusicDelay(const EnchanterLayout& layout, int channels, int sampleRateHz, std::int64_t longestFrames);

    /// Forgets all samples and pauses. Any thread but R, while nobody renders.
    void reset() noexcept;

    /// What is heard from the renderer's frame `at` on, after silence since the last. R, wait-free.
    void write(std::int64_t at, const float* left, const float* right, int frames) noexcept;

    /// Not played, with ramps of 10 ms: `from` to `until`, at least `shortestPauseSeconds`. R, wait-free.
    void silence(std::int64_t from, std::int64_t until) noexcept;
    static constexpr double shortestPauseSeconds = 0.05; // longer than both ramps, so that the pause is felt

    /// Where a take has ended, the last sample falls to zero within 10 ms. R, wait-free.
    const float* const* at(std::int64_t frame, int frames) noexcept override;

private:
    struct Pair {
        float left = 0.0f, right = 0.0f;
    };
    Pair& of(std::int64_t frame) noexcept {
        return ring_[static_cast<std::size_t>(frame % static_cast<std::int64_t>(ring_.size()))];
    }
    bool read(std::int64_t frame, int frames) noexcept;

    const int sampleRateHz_;
    std::vector<Pair> ring_;
    std::vector<float> rightShare_, samples_; // per channel; [channel][frame of a tile]
    std::vector<const float*> channels_;
    std::array<Pair, static_cast<std::size_t>(limits::tileFrames)> tile_{};
    Pair last_;
    GainRamp open_;
    std::int64_t end_ = 0, silentFrom_ = 0, silentUntil_ = 0;
};

/// Depends on the samples since a take's beginning alone: with it filters begin anew, and the level at 0.
class MusicInput {
public:
    static constexpr FrequencyBand band{20.0, 400.0}; ///< what vibration modules render and skin feels

    /// The first `channels` of the process block are the side chain; 0: it is off. M, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        for (auto& side : sides_) side.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        forget();
    }

    /// From the beginning again. R, wait-free.
    void forget() noexcept {
        filters_.fill(BandPass{band, rateHz_});
        gain_.prepare(rateHz_, limits::channelRampSeconds, 0.0f);
        apart_.prepare(rateHz_, limits::channelRampSeconds, 0.0f);
        isFresh_ = true;
    }

    /// The next frames, at most a block, from `first` on, into `delay` from its frame `at` on. `gain` and
    /// `areApart` (each side for itself; else both summed) are reached in ramps of 10 ms. R, wait-free.
    void hear(const juce::AudioBuffer<float>& buffer, int first, int frames, double gain, bool areApart,
              MusicDelay& delay, std::int64_t at) noexcept {
        if (channels_ == 0 || frames <= 0 || buffer.getNumChannels() < channels_) return;
        const DenormalGuard guard;
        const float wanted = areApart ? 1.0f : 0.0f;
        if (isFresh_) apart_.jumpTo(wanted); // nobody hears it yet
        isFresh_ = false;
        gain_.moveTo(static_cast<float>(gain));
        apart_.moveTo(wanted);
        for (int c = 0; c < 2; ++c)
            filter(buffer.getReadPointer(std::min(c, channels_ - 1)) + first, c, frames);
        for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i) {
            const float middle = 0.5f * (sides_[0][i] + sides_[1][i]), apart = apart_.next(),
                        g = gain_.next();
            for (auto& side : sides_) side[i] = g * (middle + apart * (side[i] - middle));
        }
        delay.write(at, sides_[0].data(), sides_[1].data(), frames);
    }

private:
    void filter(const float* in, int side, int frames) noexcept {
        const auto s = static_cast<std::size_t>(side);
        std::transform(in, in + frames, sides_[s].begin(),
                       [](float x) { return std::isfinite(x) ? x : 0.0f; });
        filters_[s].process(std::span{sides_[s]}.first(static_cast<std::size_t>(frames)));
    }

    int channels_ = 0, rateHz_ = 48000;
    bool isFresh_ = true;
    std::array<BandPass, 2> filters_{BandPass{band, 48000}, BandPass{band, 48000}};
    std::array<std::vector<float>, 2> sides_;
    GainRamp gain_, apart_;
};

/// Onsets in incoming music, which trigger strikes. Hops are counted from the first sample after forget(),
/// whether anybody wants beats or not: what a take hears depends on its samples alone.
class BeatInput {
public:
    /// The first `channels` of the process block are the side chain; 0: it is off. M, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        mono_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        detector_ = channels > 0 ? std::make_unique<BeatDetector>(sampleRateHz) : nullptr;
        isFresh_ = true;
        heard_ = 0;
    }

    /// How long after an onset it is known at most; 0: the side chain is off. Any thread after prepare.
    int delayFrames() const noexcept { return detector_ ? static_cast<int>(detector_->delayFrames()) : 0; }
    double delaySeconds() const noexcept { return static_cast<double>(delayFrames()) / rateHz_; }

    /// From the beginning again. R, wait-free.
    void forget() noexcept {
        if (detector_ && !isFresh_) detector_->reset();
        isFresh_ = true;
        heard_ = 0;
    }

    /// The next frames, at most a block, from `first` on. Calls `use(const BandOnset&, int frame)`; the
    /// frame counts as `first` does, and is delayFrames() before the last of these at most. R, wait-free.
    template <class Use>
    void hear(const juce::AudioBuffer<float>& buffer, int first, int frames, double sensitivity,
              Use use) noexcept {
        if (!detector_ || frames <= 0 || buffer.getNumChannels() < channels_) return;
        const DenormalGuard guard; // a song that fades out; and the host's own mode makes no difference
        mix(buffer, first, frames);
        detector_->setSensitivity(sensitivity);
        const std::int64_t before = heard_ - first;
        detector_->take(std::span{mono_}.first(static_cast<std::size_t>(frames)),
                        [&](const BandOnset& onset) { use(onset, static_cast<int>(onset.frame - before)); });
        heard_ += frames;
        isFresh_ = false;
    }

private:
    void mix(const juce::AudioBuffer<float>& buffer, int first, int frames) noexcept {
        for (int i = 0; i < frames; ++i) {
            float sum = 0.0f;
            for (int c = 0; c < channels_; ++c) sum += buffer.getReadPointer(c)[first + i];
            mono_[static_cast<std::size_t>(i)] =
                std::isfinite(sum) ? sum / static_cast<float>(channels_) : 0.0f;
        }
    }

    std::unique_ptr<BeatDetector> detector_;
    std::vector<float> mono_;
    int channels_ = 0, rateHz_ = 48000;
    bool isFresh_ = true;
    std::int64_t heard_ = 0; // samples since the beginning
};

} // namespace physvib
