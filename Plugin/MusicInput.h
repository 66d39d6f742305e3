// SPDX-License-Identifier: GPL-3.0-or-later
// Music from the host's side chain: MusicInput filters its low frequencies, MusicDelay plays them on the
// actuators after the output latency L, and BeatInput finds its onsets, which strike. R: the audio thread.
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

/// Delays the music of one run by L, so that it reaches the renderer together with the events of its time.
/// An actuator at the layout's left edge plays the left channel, one at the right edge the right channel,
/// and those between mix both in proportion to their distances.
class MusicDelay final : public SampleSource {
public:
    /// Has `channels` outputs and memory for `maxDelayFrames` frames. Any thread but R.
    MusicDelay(const ActuatorLayout& layout, int channels, int sampleRateHz, std::int64_t maxDelayFrames);

    /// Clears all music and pauses. Any thread but R, while nobody renders.
    void reset() noexcept;

    /// Stores music from the renderer's frame `startFrame` on; a gap before it is silence. R, wait-free.
    void write(std::int64_t startFrame, const float* left, const float* right, int frames) noexcept;

    /// Mutes the renderer's frames [from, until), at least `minPauseSeconds`, with ramps. R, wait-free.
    void silence(std::int64_t from, std::int64_t until) noexcept;
    static constexpr double minPauseSeconds = 0.05; // longer than both ramps, so that the pause is felt

    /// The samples of `frames` frames from `frame` on for each channel; null if all are 0. R, wait-free.
    const float* const* samplesFrom(std::int64_t frame, int frames) noexcept override;

private:
    struct StereoSample {
        float left = 0.0f, right = 0.0f;
    };
    StereoSample& pairAt(std::int64_t frame) noexcept {
        return ring_[static_cast<std::size_t>(frame % static_cast<std::int64_t>(ring_.size()))];
    }
    bool read(std::int64_t frame, int frames) noexcept;

    const int sampleRateHz_;
    std::vector<StereoSample> ring_;
    std::vector<float> rightShare_, samples_; // per channel; [channel][frame of a tile]
    std::vector<const float*> channels_;
    std::array<StereoSample, static_cast<std::size_t>(limits::tileFrames)> tile_{};
    StereoSample lastPair_;
    GainRamp playGain_;
    std::int64_t endFrame_ = 0, silenceStartFrame_ = 0, silenceEndFrame_ = 0;
};

/// Filters the side chain and writes it to a run's MusicDelay. The result depends only on the samples since
/// the run's beginning, at which the filters are reset and the level rises from 0.
class MusicInput {
public:
    static constexpr FrequencyBand band{20.0, 400.0}; ///< in Hz: what vibration modules render and skin feels

    /// The first `channels` of the process block are the side chain; 0: it is off. M, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        for (auto& side : sides_) side.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        reset();
    }

    /// Called when a run begins. R, wait-free.
    void reset() noexcept {
        filters_.fill(BandPass{band, rateHz_});
        gain_.prepare(rateHz_, limits::channelRampSeconds, 0.0f);
        separation_.prepare(rateHz_, limits::channelRampSeconds, 0.0f);
        isReset_ = true;
    }

    /// Filters the buffer's frames from `first` on, at most a block, into `delay` from frame `startFrame` on.
    /// `gain` and `isStereo` (false: both sides summed) change in ramps of 10 ms. R, wait-free.
    void process(const juce::AudioBuffer<float>& buffer, int first, int frames, double gain, bool isStereo,
                 MusicDelay& delay, std::int64_t startFrame) noexcept {
        if (channels_ == 0 || frames <= 0 || buffer.getNumChannels() < channels_) return;
        const DenormalGuard guard;
        const float targetSeparation = isStereo ? 1.0f : 0.0f;
        if (isReset_) separation_.jumpTo(targetSeparation); // without a ramp: the level is still 0
        isReset_ = false;
        gain_.moveTo(static_cast<float>(gain));
        separation_.moveTo(targetSeparation);
        for (int c = 0; c < 2; ++c)
            filter(buffer.getReadPointer(std::min(c, channels_ - 1)) + first, c, frames);
        for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i) {
            const float mid = 0.5f * (sides_[0][i] + sides_[1][i]), separation = separation_.next(),
                        g = gain_.next();
            for (auto& side : sides_) side[i] = g * (mid + separation * (side[i] - mid));
        }
        delay.write(startFrame, sides_[0].data(), sides_[1].data(), frames);
    }

private:
    void filter(const float* in, int side, int frames) noexcept {
        const auto s = static_cast<std::size_t>(side);
        std::transform(in, in + frames, sides_[s].begin(),
                       [](float x) { return std::isfinite(x) ? x : 0.0f; });
        filters_[s].process(std::span{sides_[s]}.first(static_cast<std::size_t>(frames)));
    }

    int channels_ = 0, rateHz_ = 48000;
    bool isReset_ = true;
    std::array<BandPass, 2> filters_{BandPass{band, 48000}, BandPass{band, 48000}};
    std::array<std::vector<float>, 2> sides_;
    GainRamp gain_, separation_;
};

/// Finds onsets in the side chain, which trigger strikes. It runs also while the parameter of beats is 0, so
/// that the onsets of a run depend only on its samples.
class BeatInput {
public:
    /// The first `channels` of the process block are the side chain; 0: it is off. M, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        mono_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        detector_ = channels > 0 ? std::make_unique<BeatDetector>(sampleRateHz) : nullptr;
        isReset_ = true;
        processedSamples_ = 0;
    }

    /// The longest time from an onset to its detection; 0: the side chain is off. Any thread after prepare().
    int delayFrames() const noexcept { return detector_ ? static_cast<int>(detector_->delayFrames()) : 0; }
    double delaySeconds() const noexcept { return static_cast<double>(delayFrames()) / rateHz_; }

    /// Called when a run begins. R, wait-free.
    void reset() noexcept {
        if (detector_ && !isReset_) detector_->reset();
        isReset_ = true;
        processedSamples_ = 0;
    }

    /// Analyses the buffer's frames from `first` on, at most a block, and calls `onOnset(const BandOnset&,
    /// int frame)`; `frame` counts as `first` does and may be up to delayFrames() in the past. R, wait-free.
    template <class OnOnset>
    void process(const juce::AudioBuffer<float>& buffer, int first, int frames, double sensitivity,
                 OnOnset onOnset) noexcept {
        if (!detector_ || frames <= 0 || buffer.getNumChannels() < channels_) return;
        const DenormalGuard guard; // for a song's fade-out; and results do not depend on the host's mode
        mix(buffer, first, frames);
        detector_->setSensitivity(sensitivity);
        const std::int64_t samplesBefore = processedSamples_ - first;
        detector_->process(
            std::span{mono_}.first(static_cast<std::size_t>(frames)),
            [&](const BandOnset& onset) { onOnset(onset, static_cast<int>(onset.frame - samplesBefore)); });
        processedSamples_ += frames;
        isReset_ = false;
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
    bool isReset_ = true;
    std::int64_t processedSamples_ = 0; // since reset()
};

} // namespace physvib
