// SPDX-License-Identifier: MIT
// Converts MPEG effects to waves and transients, and waves to keyframes.
#include "Formats/MpegEffects.h"
#include <numbers>

namespace physvib::mpeg {
namespace {

/// Approximates cubics with slope 0 at every keyframe by lines.
std::vector<ClipPoint> smoothed(const std::vector<ClipPoint>& keyframes) {
    constexpr int lines = 8;
    std::vector<ClipPoint> out;
    for (std::size_t i = 0; i + 1 < keyframes.size(); ++i)
        for (int k = 0; k < lines; ++k) {
            const double s = static_cast<double>(k) / lines;
            const ClipPoint &from = keyframes[i], &to = keyframes[i + 1];
            out.push_back({from.seconds + s * (to.seconds - from.seconds),
                           from.value + s * s * (3.0 - 2.0 * s) * (to.value - from.value)});
        }
    out.push_back(keyframes.back());
    return out;
}

/// The curve itself is the signal: a sine of 0 Hz at its maximum.
void asCurve(ClipWave& wave, bool isCubic) {
    wave.phaseRadians = 0.5 * std::numbers::pi;
    wave.waveform = ClipWaveform::sine;
    wave.frequencyHz = {{0.0, 0.0}};
    if (isCubic) wave.amplitude = smoothed(wave.amplitude);
}

} // namespace

void takeEffect(const Effect& effect, double startSeconds, const BandKind& kind, ClipBand& band,
                ClipChannel& channel) {
    ClipWave wave{startSeconds, effect.phaseRadians, effect.waveform, {}, {}};
    for (const Keyframe& frame : effect.keyframes) {
        if (frame.amplitude) wave.amplitude.push_back({frame.seconds, kind.gain * *frame.amplitude});
        if (frame.frequencyHz) wave.frequencyHz.push_back({frame.seconds, *frame.frequencyHz});
        if (kind.type == BandType::transient && frame.amplitude)
            channel.transients.push_back(
                {startSeconds + frame.seconds, wave.amplitude.back().value, frame.frequencyHz.value_or(0.0)});
    }
    if (kind.type == BandType::transient) return;
    const double end = effect.keyframes.empty() ? 0.0 : effect.keyframes.back().seconds;
    if (wave.amplitude.empty()) wave.amplitude.push_back({0.0, kind.gain});
    if (wave.amplitude.back().seconds < end) wave.amplitude.push_back({end, wave.amplitude.back().value});
    if (kind.type == BandType::curve) asCurve(wave, kind.isCubic);
    if (!wave.frequencyHz.empty()) band.waves.push_back(std::move(wave));
}

std::vector<TickFrame> tickFrames(const ClipWave& wave) {
    const std::int64_t start = tickOf(wave.startSeconds);
    const auto relative = [&](const ClipPoint& p) { return tickOf(wave.startSeconds + p.seconds) - start; };
    std::vector<TickFrame> frames;
    auto frequency = wave.frequencyHz.begin();
    for (const ClipPoint& p : wave.amplitude) {
        for (; frequency != wave.frequencyHz.end() && relative(*frequency) < relative(p); ++frequency)
            frames.push_back({relative(*frequency), {}, frequency->value});
        TickFrame& frame = frames.emplace_back(TickFrame{relative(p), p.value, {}});
        if (frequency != wave.frequencyHz.end() && relative(*frequency) == relative(p))
            frame.frequencyHz = (frequency++)->value;
    }
    return frames;
}

} // namespace physvib::mpeg
