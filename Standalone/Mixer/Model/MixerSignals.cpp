// SPDX-License-Identifier: GPL-3.0-or-later
// Peak meters that fall, held peaks, and the decimated samples.
#include "Mixer/Model/MixerSignals.h"
#include "Mixer/Model/MixerMessages.h"
#include <algorithm>
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {
namespace {

constexpr double holdMs = 1500.0;

} // namespace

void MixerSignals::setRate(int sampleRateHz) {
    scope_.setRate(sampleRateHz);
    spectrum_.setRate(sampleRateHz);
    sampleRateHz_ = std::max(1, sampleRateHz);
}

// Time advances by frames; differences from lost frames are corrected.
void MixerSignals::follow(std::size_t run, double seconds, int slowness) {
    constexpr double maxOffSeconds = 0.1;
    if (run != run_.run()) run_.begin(run);
    scenePerFrame_ = slowness > 0 && seconds >= 0.0 ? 1.0 / slowness / sampleRateHz_ : 0.0;
    if (std::abs(seconds - run_.seconds()) > maxOffSeconds) run_.moveTo(seconds);
}

float MixerSignals::read(MixerMoment& moment, int enchanters, const Played& played) {
    const double now = nowMs(), passed = std::min(1000.0, now - readAtMs_);
    readAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (std::size_t j = 0; j < played.size(); ++j) {
        float& peak = moment.meters.peaks[j];
        peak = !played[j] || peak * fall < 1e-4f ? 0.0f : peak * fall;
        if (!played[j]) moment.holds[j] = 0.0f;
    }
    tap_.read([&](const float* const* block, int frames) {
        zeros_.resize(std::max(zeros_.size(), static_cast<std::size_t>(frames)));
        std::array<const float*, limits::maxEnchanters> shown{};
        for (std::size_t j = 0; j < static_cast<std::size_t>(enchanters); ++j)
            shown[j] = played[j] ? block[j] : zeros_.data();
        measure(shown.data(), frames, moment, enchanters);
    });
    float loudest = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(enchanters); ++j) {
        const float peak = moment.meters.peaks[j];
        if (peak >= moment.holds[j] || now - heldAtMs_[j] > holdMs)
            moment.holds[j] = peak, heldAtMs_[j] = now;
        loudest = std::max(loudest, peak);
    }
    return loudest;
}

// The tap lies before the master, which mutes.
void MixerSignals::measure(const float* const* block, int frames, MixerMoment& moment, int enchanters) {
    scope_.add(block, enchanters, frames);
    spectrum_.add(block, enchanters, frames);
    if (scenePerFrame_ > 0.0) run_.add(block, enchanters, frames, frames * scenePerFrame_);
    for (int j = 0; j < enchanters; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        auto& peak = moment.meters.peaks[static_cast<std::size_t>(j)];
        peak = std::max({peak, -range.getStart(), range.getEnd()});
    }
}

void SpectrumTrace::setRate(int sampleRateHz) {
    framesPerSample_ = std::max(1, sampleRateHz / keptRateHz);
    keptRateHz_ = static_cast<double>(std::max(1, sampleRateHz)) / framesPerSample_;
    lanes_.assign(limits::maxEnchanters, {std::vector<float>(window), 0.0f});
    newest_ = summed_ = 0;
}

// Decimates by averaging consecutive frames.
void SpectrumTrace::add(const float* const* channels, int count, int frames) {
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, framesPerSample_ - summed_);
        const bool isFull = summed_ + part == framesPerSample_;
        for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
            Lane& lane = lanes_[j];
            for (int k = done; k < done + part; ++k) lane.sum += channels[j][k];
            if (isFull)
                lane.kept[static_cast<std::size_t>(newest_)] =
                    std::exchange(lane.sum, 0.0f) / static_cast<float>(framesPerSample_);
        }
        done += part;
        summed_ = isFull ? 0 : summed_ + part;
        if (isFull) newest_ = (newest_ + 1) % window;
    }
}

std::vector<double> SpectrumTrace::recent(int channel) const {
    const auto& kept = lanes_[static_cast<std::size_t>(channel)].kept;
    if (std::ranges::all_of(kept, [](float x) { return std::abs(x) < 1e-4f; })) return {};
    std::vector<double> samples(kept.begin() + newest_, kept.end());
    samples.insert(samples.end(), kept.begin(), kept.begin() + newest_);
    return samples;
}

} // namespace physvib
