// SPDX-License-Identifier: GPL-3.0-or-later
// The side chain: music whose onsets strike.
#pragma once
#include "Host/Music/BeatDetector.h"
#include "Host/Music/BeatStrikes.h"
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

/// The detector's hops are counted from the first sample after forget(), so that a take hears the same in blocks of any size.
class BeatInput {
public:
    /// `channels` of the process block, from its first one on, are the side chain; 0: it is off. M, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames, int channels) {
        channels_ = channels;
        rateHz_ = sampleRateHz;
        mono_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        detector_ = channels > 0 ? std::make_unique<BeatDetector>(sampleRateHz) : nullptr;
        isFresh_ = true;
        heard_ = 0;
    }

    /// How long after an onset it is known; 0 while the side chain is off. M.
    double delaySeconds() const noexcept { return detector_ ? static_cast<double>(detector_->delayFrames()) / rateHz_ : 0.0; }

    /// From the beginning again. R, wait-free.
    void forget() noexcept {
        if (detector_ && !isFresh_) detector_->reset();
        isFresh_ = true;
        heard_ = 0;
    }

    /// The next frames, at most a block. Calls `tell(const BandOnset&, int frame)`; the frame counts from the first of these, and is before it as
    /// a rule. R, wait-free.
    template <class Tell>
    void hear(const juce::AudioBuffer<float>& buffer, int first, int frames, double sensitivity, Tell tell) noexcept {
        if (!detector_ || buffer.getNumChannels() < channels_) return;
        mix(buffer, first, frames);
        detector_->setSensitivity(sensitivity);
        const std::int64_t before = heard_;
        detector_->take(std::span{mono_}.first(static_cast<std::size_t>(frames)), [&](const BandOnset& onset) { tell(onset, static_cast<int>(onset.frame - before)); });
        heard_ += frames;
        isFresh_ = false;
    }

private:
    void mix(const juce::AudioBuffer<float>& buffer, int first, int frames) noexcept {
        for (int i = 0; i < frames; ++i) {
            float sum = 0.0f;
            for (int c = 0; c < channels_; ++c) sum += buffer.getReadPointer(c)[first + i];
            mono_[static_cast<std::size_t>(i)] = std::isfinite(sum) ? sum / static_cast<float>(channels_) : 0.0f;
        }
    }

    std::unique_ptr<BeatDetector> detector_;
    std::vector<float> mono_;
    int channels_ = 0, rateHz_ = 48000;
    bool isFresh_ = true;
    std::int64_t heard_ = 0; // samples since the beginning
};

} // namespace physvib
