// SPDX-License-Identifier: GPL-3.0-or-later
// Falling peak meters and peak holds.
#include "Mixer/Desk/DeskSignals.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {
namespace {

constexpr double holdMs = 1500.0;

} // namespace

void DeskSignals::setRate(int sampleRateHz) {
    scope_.setRate(sampleRateHz);
    spectrum_.setRate(sampleRateHz);
    sampleRateHz_ = std::max(1, sampleRateHz);
}

// Time advances by frames; differences from lost frames are corrected.
void DeskSignals::follow(std::size_t take, double feltSeconds, int slowness) {
    constexpr double mostOffSeconds = 0.1;
    if (take != takeTrace_.take()) takeTrace_.begin(take);
    scenePerFrame_ = slowness > 0 && feltSeconds >= 0.0 ? 1.0 / slowness / sampleRateHz_ : 0.0;
    if (std::abs(feltSeconds - takeTrace_.seconds()) > mostOffSeconds) takeTrace_.moveTo(feltSeconds);
}

float DeskSignals::read(DeskMoment& moment, int enchanters, bool isSilent) {
    const double now = nowMs(), passed = std::min(1000.0, now - readAtMs_);
    readAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (auto& peak : moment.meters.peaks) peak = isSilent || peak * fall < 1e-4f ? 0.0f : peak * fall;
    if (isSilent) moment.holds.fill(0.0f);
    tap_.read([&](const float* const* block, int frames) {
        isSilent ? measureSilence(frames, moment, enchanters) : measure(block, frames, moment, enchanters);
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
void DeskSignals::measureSilence(int frames, DeskMoment& moment, int enchanters) {
    if (zeros_.size() < static_cast<std::size_t>(frames)) zeros_.resize(static_cast<std::size_t>(frames));
    std::array<const float*, limits::maxEnchanters> block{};
    block.fill(zeros_.data());
    measure(block.data(), frames, moment, enchanters);
}

void DeskSignals::measure(const float* const* block, int frames, DeskMoment& moment, int enchanters) {
    scope_.add(block, enchanters, frames);
    spectrum_.add(block, enchanters, frames);
    if (scenePerFrame_ > 0.0) takeTrace_.add(block, enchanters, frames, frames * scenePerFrame_);
    for (int j = 0; j < enchanters; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        auto& peak = moment.meters.peaks[static_cast<std::size_t>(j)];
        peak = std::max({peak, -range.getStart(), range.getEnd()});
    }
}

} // namespace physvib
