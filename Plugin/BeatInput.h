// SPDX-License-Identifier: GPL-3.0-or-later
// Side-chain input: detects onsets in incoming music, which trigger strikes.
#pragma once
#include "Core/Nonblocking.h"
#include "Host/Music/BeatDetector.h"
#include "Host/Music/BeatStrikes.h"
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

/// Hops are counted from the first sample after forget(), whether anybody wants beats or not: what a take
/// hears depends on its samples alone.
class BeatInput {
public:
    /// `channels` of the process block, from its first one on, are the side chain; 0: it is off. M, while
    /// nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        mono_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        detector_ = channels > 0 ? std::make_unique<BeatDetector>(sampleRateHz) : nullptr;
        isFresh_ = true;
        heard_ = 0;
    }

    /// How long after an onset it is known at the latest; 0 while the side chain is off. Any thread after
    /// prepare.
    int delayFrames() const noexcept { return detector_ ? static_cast<int>(detector_->delayFrames()) : 0; }
    double delaySeconds() const noexcept { return static_cast<double>(delayFrames()) / rateHz_; }

    /// From the beginning again. R, wait-free.
    void forget() noexcept {
        if (detector_ && !isFresh_) detector_->reset();
        isFresh_ = true;
        heard_ = 0;
    }

    /// The next frames, at most a block, from `first` on. Calls `tell(const BandOnset&, int frame)`; the
    /// frame counts as `first` does, and is delayFrames() before the last of these at most. R, wait-free.
    template <class Tell>
    void hear(const juce::AudioBuffer<float>& buffer, int first, int frames, double sensitivity,
              Tell tell) noexcept {
        if (!detector_ || frames <= 0 || buffer.getNumChannels() < channels_) return;
        const DenormalGuard guard; // a song that fades out; and the host's own mode makes no difference
        mix(buffer, first, frames);
        detector_->setSensitivity(sensitivity);
        const std::int64_t before = heard_ - first;
        detector_->take(std::span{mono_}.first(static_cast<std::size_t>(frames)),
                        [&](const BandOnset& onset) { tell(onset, static_cast<int>(onset.frame - before)); });
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
