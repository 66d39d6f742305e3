// SPDX-License-Identifier: MIT
// Resamples recordings of contacts to the renderer's sample rate.
#include "Live/Session/ContactSounds.h"
#include "Core/Samples.h"
#include <samplerate.h>

namespace physvib {
namespace {

/// Resamples by `ratio`; empty if there is no memory.
std::vector<float> resampleByRatio(const std::vector<float>& in, double ratio) {
    constexpr double maxRatio = 256.0; // limit of the converter per pass; a recording may have 100 Hz
    if (ratio > maxRatio) return resampleByRatio(resampleByRatio(in, maxRatio), ratio / maxRatio);
    if (1.0 / ratio > maxRatio) return resampleByRatio(resampleByRatio(in, 1.0 / maxRatio), ratio * maxRatio);
    std::vector<float> out(
        std::max<std::size_t>(1, static_cast<std::size_t>(ratio * static_cast<double>(in.size()))));
    SRC_DATA data{};
    data.data_in = in.data();
    data.input_frames = static_cast<long>(in.size());
    data.data_out = out.data();
    data.output_frames = static_cast<long>(out.size());
    data.src_ratio = ratio;
    return src_simple(&data, SRC_SINC_BEST_QUALITY, 1) == 0 ? out : std::vector<float>{};
}

/// The recording at that rate, with the same peak.
std::vector<float> resampleToRate(const ContactRecording& recording, int rateHz) {
    if (recording.sampleRateHz == rateHz) return recording.samples;
    auto out = resampleByRatio(recording.samples, static_cast<double>(rateHz) / recording.sampleRateHz);
    if (const float oldPeak = peakOf(recording.samples), newPeak = peakOf(out); newPeak > 0.0f)
        for (float& x : out) x *= oldPeak / newPeak;
    return out;
}

} // namespace

std::vector<RecordingFile> recordingFiles(const std::vector<ContactRecording>& recordings) {
    std::vector<RecordingFile> files;
    for (const ContactRecording& recording : recordings) files.push_back(recording.file);
    return files;
}

std::vector<std::string> recordingNotes(const std::vector<ContactRecording>& recordings) {
    std::vector<std::string> notes;
    for (const ContactRecording& recording : recordings)
        if (!recording.note.empty() && std::ranges::find(notes, recording.note) == notes.end())
            notes.push_back(recording.note);
    return notes;
}

ContactSounds::ContactSounds(const std::vector<ContactRecording>& recordings, int sampleRateHz) {
    for (const auto& recording : recordings) samples_.push_back(resampleToRate(recording, sampleRateHz));
    for (std::size_t i = 0; i < recordings.size(); ++i)
        contacts_.push_back({recordings[i].frequencyHz, samples_[i], recordings[i].file.sound()});
}

} // namespace physvib
