// SPDX-License-Identifier: GPL-3.0-or-later
// When a recording begins, and when all of it has come.
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
    if (recording_) close(); // whoever closes the window while it runs wants what is there
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

// R has let go of it when a block has come since; events of the last frames have been played by then.
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

// R has let go, or does not run. Both files in their places; empty, or one line with the reason.
juce::String DeskRecording::close() {
    const Provenance provenance{PHYSVIB_VERSION,
                                {{"scene", mix_.scene->name}, {"seed", std::to_string(mix_.seed)}}};
    const FieldSize field{mix_.scene->fieldWidthMetres, mix_.scene->fieldHeightMetres};
    session_.sinks().detach(recording_->recorder());
    for (PlayedEvent played; session_.played().pop(played);) recording_->take(played);
    const auto error = utf8(recording_->finish(session_.timeline().playOutFrames(), field, provenance,
                                               SoundNames{mix_.scene->materials}));
    recording_.reset();
    return error;
}

} // namespace physvib
