// SPDX-License-Identifier: MIT
// Validity checks that apply to clips of every file format.
#include "Formats/Clip.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

bool isWithin(std::span<const ClipPoint> curve, double minValue, double maxValue) {
    double last = 0.0;
    for (const ClipPoint& p : curve) {
        if (!(p.seconds >= last && p.seconds <= limits::maxClipSeconds && p.value >= minValue &&
              p.value <= maxValue))
            return false;
        last = p.seconds;
    }
    return true;
}

std::string waveError(const ClipWave& wave) {
    if (!(wave.startSeconds >= 0.0 && std::isfinite(wave.phaseRadians)))
        return "expected a wave that begins at 0 s or later, at a finite phase";
    if (!isWithin(wave.amplitude, -limits::maxClipAmplitude, limits::maxClipAmplitude))
        return "expected amplitudes within " + plainNumber(limits::maxClipAmplitude) + ", in time order";
    if (wave.frequencyHz.empty() || !isWithin(wave.frequencyHz, 0.0, limits::maxClipFrequencyHz))
        return "expected frequencies from 0 to " + plainNumber(limits::maxClipFrequencyHz) +
               " Hz, in time order";
    return {};
}

std::string limitError(double maximum, const std::string& unit) {
    return "expected at most " + plainNumber(maximum) + " " + unit + ", found more";
}

} // namespace

std::string clipError(const Clip& clip) {
    if (clip.channels.size() > static_cast<std::size_t>(limits::maxActuators))
        return limitError(limits::maxActuators, "channels");
    if (clip.points() > limits::maxClipPoints)
        return limitError(static_cast<double>(limits::maxClipPoints), "points of curves");
    std::size_t bands = 0;
    double soundingSeconds = 0.0;
    for (const ClipChannel& channel : clip.channels) {
        bands += channel.bands.size();
        for (const ClipBand& band : channel.bands)
            for (const ClipWave& wave : band.waves) {
                if (auto error = waveError(wave); !error.empty()) return error;
                soundingSeconds += wave.seconds();
            }
        for (const ClipTransient& t : channel.transients)
            if (auto error = waveError(t.wave()); !error.empty()) return error;
    }
    if (bands > limits::maxClipBands) return limitError(static_cast<double>(limits::maxClipBands), "bands");
    if (!(soundingSeconds <= limits::maxClipSoundingSeconds))
        return limitError(limits::maxClipSoundingSeconds, "seconds of all waves together");
    if (!(clip.seconds() <= limits::maxClipSeconds)) return limitError(limits::maxClipSeconds, "seconds");
    return clip.seconds() > 0.0 ? "" : "expected something to feel, found silence";
}

double peakAmplitude(const ClipChannel& channel) noexcept {
    double peak = 0.0;
    for (const ClipTransient& transient : channel.transients)
        peak = std::max(peak, std::abs(transient.amplitude));
    for (const ClipBand& band : channel.bands)
        for (const ClipWave& wave : band.waves)
            for (const ClipPoint& p : wave.amplitude) peak = std::max(peak, std::abs(p.value));
    return peak;
}

void makeSequential(ClipBand& band) {
    sortByTime(band.waves, &ClipWave::startSeconds);
    for (std::size_t i = 0; i + 1 < band.waves.size(); ++i) {
        ClipWave& wave = band.waves[i];
        const double secondsToNext = band.waves[i + 1].startSeconds - wave.startSeconds;
        if (secondsToNext >= wave.seconds() - sameMomentSeconds) continue;
        const ClipPoint end{secondsToNext, valueAt(wave.amplitude, secondsToNext)};
        std::erase_if(wave.amplitude, [=](const ClipPoint& p) { return p.seconds >= secondsToNext; });
        wave.amplitude.push_back(end);
    }
    std::erase_if(band.waves, [](const ClipWave& wave) { return !(wave.seconds() > 0.0); });
}

} // namespace physvib
