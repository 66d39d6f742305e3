// SPDX-License-Identifier: GPL-3.0-or-later
// Cut, normalised, resampled.
#include "Host/ContactSounds.h"
#include "Host/HitExcerpt.h"
#include "Host/RecordingFaults.h"
#include "Host/StimulusRender.h"
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {
namespace {

float peakOf(const std::vector<float>& x) {
    float peak = 0.0f;
    for (const float s : x) peak = std::max(peak, std::isfinite(s) ? std::abs(s) : HUGE_VALF);
    return peak;
}

void normalise(std::vector<float>& samples) {
    const float peak = peakOf(samples);
    for (float& x : samples) x /= peak;
}

std::vector<float> resampled(const ContactRecording& recording, int rateHz) {
    if (recording.sampleRateHz == rateHz) return recording.samples;
    const double ratio = static_cast<double>(recording.sampleRateHz) / rateHz;
    std::vector<float> in(recording.samples), out(static_cast<std::size_t>(static_cast<double>(in.size()) / ratio));
    in.resize(in.size() + 1024); // what the interpolator reads ahead
    juce::WindowedSincInterpolator interpolator;
    const auto late = static_cast<std::size_t>(interpolator.getBaseLatency() / ratio);
    out.resize(out.size() + late);
    interpolator.process(ratio, in.data(), out.data(), static_cast<int>(out.size()), static_cast<int>(in.size()), 0);
    out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(late));
    if (peakOf(out) > 0.0f) normalise(out);
    return out;
}

} // namespace

Result<ContactRecording> loadContact(const std::string& path, double frequencyHz) {
    constexpr double shortestSeconds = 0.001;
    const auto read = readRecording(path);
    if (!read) return Failure{read.error};
    const std::vector<float>& heard = *std::ranges::max_element(read.value.channels, {}, peakOf);
    const double rateHz = read.value.sampleRateHz;
    std::string fault = recordingFault(heard, rateHz, shortestSeconds);
    if (fault.empty() && isSilent(heard)) fault = "expected a hit, found silence";
    if (fault.empty()) fault = clippingFault(heard, rateHz);
    if (!fault.empty()) return Failure{path + ": " + fault};
    const HitExcerpt hit = strongestHit(heard, rateHz);
    ContactRecording contact{frequencyHz, read.value.sampleRateHz, {heard.begin() + static_cast<std::ptrdiff_t>(hit.begin), heard.begin() + static_cast<std::ptrdiff_t>(hit.end)}};
    for (float& x : contact.samples) x -= static_cast<float>(hit.offset);
    if (!(peakOf(contact.samples) > 0.0f)) return Failure{path + ": expected a hit, found silence"};
    normalise(contact.samples);
    return contact;
}

ContactSounds::ContactSounds(const std::vector<ContactRecording>& recordings, int sampleRateHz) {
    for (const ContactRecording& recording : recordings) samples_.push_back(resampled(recording, sampleRateHz));
    for (std::size_t i = 0; i < recordings.size(); ++i) contacts_.push_back({recordings[i].frequencyHz, samples_[i]});
}

} // namespace physvib
