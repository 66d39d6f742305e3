// SPDX-License-Identifier: MIT
// Validity checks that apply to clips of every file format.
#include "Formats/Clip.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

bool isWithin(std::span<const ClipPoint> curve, double least, double most) {
    double last = 0.0;
    for (const ClipPoint& p : curve) {
        if (!(p.seconds >= last && p.seconds <= limits::maxClipSeconds && p.value >= least &&
              p.value <= most))
            return false;
        last = p.seconds;
    }
    return true;
}

std::string faultOf(const ClipWave& wave) {
    if (!(wave.startSeconds >= 0.0 && std::isfinite(wave.phaseRadians)))
        return "expected a wave that begins at 0 s or later, at a finite phase";
    if (!isWithin(wave.amplitude, -limits::maxClipAmplitude, limits::maxClipAmplitude))
        return "expected amplitudes within " + plainNumber(limits::maxClipAmplitude) + ", in time order";
    if (wave.frequencyHz.empty() || !isWithin(wave.frequencyHz, 0.0, limits::maxClipFrequencyHz))
        return "expected frequencies from 0 to " + plainNumber(limits::maxClipFrequencyHz) +
               " Hz, in time order";
    return {};
}

std::string atMost(double most, const std::string& what) {
    return "expected at most " + plainNumber(most) + " " + what + ", found more";
}

} // namespace

std::string clipFault(const Clip& clip) {
    if (clip.channels.size() > static_cast<std::size_t>(limits::maxEnchanters))
        return atMost(limits::maxEnchanters, "channels");
    if (clip.points() > limits::maxClipPoints)
        return atMost(static_cast<double>(limits::maxClipPoints), "points of curves");
    std::size_t bands = 0;
    double sounding = 0.0;
    for (const ClipChannel& channel : clip.channels) {
        bands += channel.bands.size();
        for (const ClipBand& band : channel.bands)
            for (const ClipWave& wave : band.waves) {
                if (auto fault = faultOf(wave); !fault.empty()) return fault;
                sounding += wave.seconds();
            }
        for (const ClipTransient& t : channel.transients)
            if (auto fault = faultOf(t.wave()); !fault.empty()) return fault;
    }
    if (bands > limits::maxClipBands) return atMost(static_cast<double>(limits::maxClipBands), "bands");
    if (!(sounding <= limits::maxClipSounding))
        return atMost(limits::maxClipSounding, "seconds of all waves together");
    if (!(clip.seconds() <= limits::maxClipSeconds)) return atMost(limits::maxClipSeconds, "seconds");
    return clip.seconds() > 0.0 ? "" : "expected something to feel, found silence";
}

double peakOf(const ClipChannel& channel) noexcept {
    double peak = 0.0;
    for (const ClipTransient& transient : channel.transients)
        peak = std::max(peak, std::abs(transient.amplitude));
    for (const ClipBand& band : channel.bands)
        for (const ClipWave& wave : band.waves)
            for (const ClipPoint& p : wave.amplitude) peak = std::max(peak, std::abs(p.value));
    return peak;
}

void keepOneAtATime(ClipBand& band) {
    sortByTime(band.waves, &ClipWave::startSeconds);
    for (std::size_t i = 0; i + 1 < band.waves.size(); ++i) {
        ClipWave& wave = band.waves[i];
        const double left = band.waves[i + 1].startSeconds - wave.startSeconds;
        if (left >= wave.seconds() - sameMomentSeconds) continue;
        const ClipPoint end{left, valueAt(wave.amplitude, left)};
        std::erase_if(wave.amplitude, [=](const ClipPoint& p) { return p.seconds >= left; });
        wave.amplitude.push_back(end);
    }
    std::erase_if(band.waves, [](const ClipWave& wave) { return !(wave.seconds() > 0.0); });
}

} // namespace physvib
