// SPDX-License-Identifier: GPL-3.0-or-later
// What was played: seen, and recorded.
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr double holdMs = 1500.0;

} // namespace

void Desk::measure(const float* const* block, int frames) {
    const int heard = mix_.count();
    scope_.add(block, heard, frames);
    spectrum_.add(block, heard, frames);
    for (int j = 0; j < heard; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        const float peak = std::max(-range.getStart(), range.getEnd());
        auto& shown = now_.meters.peaks[static_cast<std::size_t>(j)];
        shown = std::max(shown, peak);
    }
}

DeskMoment Desk::look() {
    const double now = nowMs(), passed = std::min(1000.0, now - lookedAtMs_);
    lookedAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (auto& peak : now_.meters.peaks) peak = peak * fall < 1e-4f ? 0.0f : peak * fall;
    tap_.read([this](const float* const* block, int frames) { measure(block, frames); });
    now_.session = session_.status();
    now_.device = output_.status();
    now_.hits.clear();
    for (PlayedEvent played; session_.played().pop(played);) {
        now_.hits.push_back(played.event);
        recent_.push_front(played.event);
        if (recording_) recording_->take(played);
    }
    if (recent_.size() > mostRecent) recent_.resize(mostRecent);
    if (recording_) finishRecording();
    now_.meters.limiterGain = now_.session.render.limiterGain;
    now_.meters.enchanters = mix_.count();
    float loudest = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j) {
        const float peak = now_.meters.peaks[j];
        now_.meters.isConnected[j] = mix_.strips[j].output >= 0;
        if (peak >= now_.holds[j] || now - heldAtMs_[j] > holdMs) now_.holds[j] = peak, heldAtMs_[j] = now;
        loudest = std::max(loudest, peak);
    }
    now_.masterPeak = isSilent_ ? 0.0f : loudest * masterGain(mix_);
    now_.sessionNs = session_.readPoses(now_.poses);
    now_.aheadNs = static_cast<std::int64_t>(1e9 * playOutSeconds());
    watchOutput();
    return now_;
}

std::string Desk::startRecording(const juce::File& file) {
    if (recording_) return {};
    if (output_.sampleRateHz() == 0) return "nothing to record: no device runs";
    auto recording = std::make_unique<Recording>(file.getFullPathName().toStdString(), mix_.count(), output_.sampleRateHz());
    if (!recording->error().empty()) return recording->error();
    recording_ = std::move(recording);
    recordingFile_ = file;
    isEnding_ = false;
    output_.record(&recording_->recorder());
    sendChangeMessage();
    return {};
}

void Desk::stopRecording() {
    if (!isRecording()) return;
    output_.record(nullptr);
    isEnding_ = true;
    endsAfterBlock_ = output_.status().blocks + 1;
    sendChangeMessage();
}

double Desk::recordedSeconds() const noexcept {
    return recording_ ? static_cast<double>(recording_->recorder().frames()) / recording_->recorder().sampleRateHz() : 0.0;
}

// R has let go of it when a block has come since; events of the last frames have been played by then.
void Desk::finishRecording() {
    recording_->drain();
    if (!isEnding_ && output_.isRecording()) return;
    if (isEnding_ && now_.device.isRunning && now_.device.blocks <= endsAfterBlock_) return;
    recordedFrom_ = recording_->recorder().firstFrame();
    const auto lost = recording_->recorder().framesLost();
    auto error = closeRecording();
    if (error.isEmpty() && lost > 0) error = "frames missing in the recording: " + juce::String{static_cast<juce::int64>(lost)};
    if (error.isEmpty() && !isEnding_) error = "the recording ends where the device changed its rate";
    if (onRecorded) onRecorded(recordingFile_, error);
    sendChangeMessage();
}

/// Both files in their places; empty, or one line with the reason.
juce::String Desk::closeRecording() {
    const Provenance provenance{PHYSVIB_VERSION, {{"scene", mix_.scene->name}, {"seed", std::to_string(mix_.seed)}}};
    for (PlayedEvent played; session_.played().pop(played);) recording_->take(played);
    const auto error = utf8(recording_->finish(session_.playOutFrames(), provenance));
    recording_.reset();
    return error;
}

} // namespace physvib
