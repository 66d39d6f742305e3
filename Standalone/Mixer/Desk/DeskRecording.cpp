// SPDX-License-Identifier: GPL-3.0-or-later
// Starts a recording, and closes it after its last block.
#include "Mixer/Desk/DeskRecording.h"
#include "Mixer/Desk/DeskWords.h"
#include <utility>

namespace physvib {

DeskRecording::DeskRecording(Session& session, AudioOutput& output, const Mix& mix,
                             std::function<void()> onChange)
    : session_{session}
    , output_{output}
    , mix_{mix}
    , onChange_{std::move(onChange)} {}

void DeskRecording::keep() {
    if (recording_) close(); // closing the window keeps the recording so far
}

std::string DeskRecording::start(const juce::File& file) {
    if (recording_) return {};
    if (output_.sampleRateHz() == 0) return "nothing to record: no device runs";
    auto recording = std::make_unique<Recording>(file.getFullPathName().toStdString(), mix_.count(),
                                                 output_.sampleRateHz());
    if (!recording->error().empty()) return recording->error();
    recording_ = std::move(recording);
    file_ = file;
    isEnding_ = false;
    session_.sinks().attach(recording_->recorder());
    onChange_();
    return {};
}

void DeskRecording::stop() {
    if (!isRunning()) return;
    letGo();
    onChange_();
}

void DeskRecording::letGo() {
    session_.sinks().detach(recording_->recorder());
    isEnding_ = true;
    endsAfterBlock_ = output_.status().blocks + 1;
}

double DeskRecording::seconds() const noexcept {
    return recording_
               ? static_cast<double>(recording_->recorder().frames()) / recording_->recorder().sampleRateHz()
               : 0.0;
}

void DeskRecording::take(const PlayedEvent& played) {
    if (recording_) recording_->take(played);
}

// The audio thread has released the recorder after one more block; by then the events of the last frames have
// been played too.
void DeskRecording::look(const AudioOutputStatus& device) {
    if (!recording_) return;
    if (!isEnding_ && recording_->recorder().isWhole() && recording_->error().empty()) return;
    if (!isEnding_) letGo();
    if (device.isRunning && device.blocks <= endsAfterBlock_) return;
    from_ = recording_->recorder().firstFrame();
    const auto lost = recording_->recorder().framesLost();
    const bool isWhole = recording_->recorder().isWhole();
    auto error = close();
    if (error.isEmpty() && lost > 0)
        error = "frames missing in the recording: " + juce::String{static_cast<juce::int64>(lost)};
    if (error.isEmpty() && !isWhole) error = "the recording ends where the device changed its rate";
    if (onEnd) onEnd(file_, error);
    onChange_();
}

// Precondition: the audio thread released the recorder or does not run. Moves both files to their places;
// returns an empty string or one error line.
juce::String DeskRecording::close() {
    const Provenance provenance{PHYSVIB_VERSION,
                                {{"scene", mix_.scene->name}, {"seed", std::to_string(mix_.seed)}}};
    const FieldSize field{mix_.scene->fieldWidthMetres, mix_.scene->fieldHeightMetres};
    session_.sinks().detach(recording_->recorder());
    for (PlayedEvent played; session_.played().pop(played);) recording_->take(played);
    SoundNames names;
    names.addScene(*mix_.scene);
    const auto error =
        utf8(recording_->finish(session_.timeline().outputLatencyFrames(), field, provenance, names));
    recording_.reset();
    return error;
}

} // namespace physvib
