// SPDX-License-Identifier: GPL-3.0-or-later
// Extracts the low frequencies of the side-chain input for the actuators.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include "Core/Nonblocking.h"
#include "Host/Music/BandPass.h"
#include "MusicDelay.h"
#include <array>
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>
#include <vector>

namespace physvib {

/// What a take feels of music depends on the samples since its beginning alone: the filters begin anew with
/// it, and the level rises from 0.
class MusicInput {
public:
    static constexpr FrequencyBand band{20.0, 400.0}; ///< what vibration modules render and skin feels

    /// `channels` of the process block, from its first one on, are the side chain; 0: it is off. M, while
    /// nobody renders.
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
    /// `areApart` (left and right on their own sides; else both summed) are reached in ramps of 10 ms. R,
    /// wait-free.
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

} // namespace physvib
