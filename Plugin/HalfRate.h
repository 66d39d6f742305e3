// SPDX-License-Identifier: GPL-3.0-or-later
// For hosts above the fastest rate of the renderer: it renders every second frame, and what lies between is
// the mean of its neighbours. Vibrations end below 1 kHz: the difference is below -100 dB.
#pragma once
#include "Core/Limits.h"
#include "HostParameter.h"
#include <algorithm>
#include <array>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

/// What is played comes one frame of the host later. M prepares it, R does the rest.
class HalfRate {
public:
    static constexpr int fastestHz = 2 * limits::maxSampleRateHz;
    static constexpr int lagFrames = 1; ///< of the host
    static constexpr bool isNeeded(int hz) noexcept {
        return hz > limits::maxSampleRateHz && hz <= fastestHz && hz % 2 == 0;
    }

    void prepare(int channels, int hostsBlockFrames) {
        capacity_ = std::max(hostsBlockFrames, limits::maxBlockFrames) / 2 + 1;
        buffer_.setSize(channels, capacity_);
        midi_.ensureSize(1 << 16);
        midi_.clear();
        lastIn_.fill(0.0f);
        lastOut_.fill(0.0f);
        isOdd_ = false;
    }

    /// A block of the host, whose first channels are inputs: `render(buffer, midi, source)` makes it at half
    /// the rate.
    template <class Render>
    void process(juce::AudioBuffer<float>& host, int inputs, const juce::MidiBuffer& midi,
                 PointSource* source, Render render) noexcept {
        const int frames = host.getNumSamples(), channels = std::min(host.getNumChannels(), mostChannels),
                  first = isOdd_ ? 1 : 0, ours = (frames - first + 1) / 2;
        if (ours > capacity_) return host.clear();
        for (const auto message : midi)
            midi_.addEvent(message.data, message.numBytes,
                           std::clamp((message.samplePosition - first) / 2, 0, std::max(0, ours - 1)));
        buffer_.setSize(channels, ours, false, false, true);
        for (int c = 0; c < std::min(inputs, channels); ++c) takeIn(host.getReadPointer(c), c, first, frames);
        if (ours > 0) {
            Halved halved{source, first, frames, ours};
            render(buffer_, midi_, source != nullptr ? &halved : nullptr);
            midi_.clear();
        }
        for (int c = 0; c < channels; ++c) giveOut(host.getWritePointer(c), c, first, frames);
        isOdd_ = (first + frames) % 2 != 0;
    }

private:
    static constexpr int mostChannels = limits::maxEnchanters;

    class Halved final : public PointSource {
    public:
        Halved(PointSource* source, int first, int frames, int ours) noexcept
            : source_{source}
            , first_{first}
            , frames_{frames}
            , ours_{ours} {}
        bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
            if (!source_->next(parameter, point)) return false;
            point.frame = half(point.frame);
            return true;
        }
        int lastOfLine(std::size_t parameter) noexcept override {
            const int last = source_->lastOfLine(parameter);
            return last < 0 ? last : half(last);
        }

    private:
        int half(int frame) const noexcept {
            if (frame >= frames_) return ours_ + (frame - frames_) / 2;
            return std::clamp((frame - first_) / 2, 0, std::max(0, ours_ - 1));
        }
        PointSource* const source_;
        const int first_, frames_, ours_;
    };

    void takeIn(const float* in, int channel, int first, int frames) noexcept {
        float* const out = buffer_.getWritePointer(channel);
        float& last = lastIn_[static_cast<std::size_t>(channel)];
        for (int i = first; i < frames; i += 2)
            out[(i - first) / 2] = 0.5f * ((i > 0 ? in[i - 1] : last) + in[i]);
        last = in[frames - 1];
    }
    void giveOut(float* out, int channel, int first, int frames) noexcept {
        const float* const in = buffer_.getReadPointer(channel);
        float& last = lastOut_[static_cast<std::size_t>(channel)];
        for (int i = 0; i < frames; ++i) {
            const float now = (i - first) % 2 == 0 ? in[(i - first) / 2] : last;
            out[i] = 0.5f * (last + now);
            last = now;
        }
    }

    juce::AudioBuffer<float> buffer_;
    juce::MidiBuffer midi_;
    std::array<float, mostChannels> lastIn_{}, lastOut_{};
    int capacity_ = 0;
    bool isOdd_ = false; // the host's next frame lies between two of ours
};

} // namespace physvib
