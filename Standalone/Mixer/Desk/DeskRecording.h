// SPDX-License-Identifier: GPL-3.0-or-later
// Records the mixer's actuator channels as WAV, with their events.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/Mix.h"
#include "Live/Recordings/Recording.h"
#include "Live/Session/Session.h"
#include <functional>
#include <juce_core/juce_core.h>
#include <memory>
#include <string>

namespace physvib {

/// One recording at a time. Message thread only.
class DeskRecording {
public:
    /// All references outlive it. `onChange` is called when a recording starts, stops and is complete.
    DeskRecording(Session& session, AudioOutput& output, const Mix& mix, std::function<void()> onChange);

    ~DeskRecording() { keep(); }

    /// Completes a running recording. Precondition: the output was stopped.
    void keep();

    /// Records the attached actuators as WAV, and the events beside it. Empty, or an error.
    std::string start(const juce::File& file);
    void stop(); ///< the files are complete a moment later, when onEnd is called
    bool isRunning() const noexcept { return recording_ != nullptr && !isEnding_; }
    double seconds() const noexcept;
    std::int64_t from() const noexcept { return from_; } ///< session frame of the last recording's start
    std::function<void(const juce::File&, const juce::String& error)> onEnd;

    /// Records an event that was played.
    void take(const PlayedEvent& played);

    /// To be called often, with the newest device status.
    void look(const AudioOutputStatus& device);

private:
    void letGo();
    juce::String close();

    Session& session_;
    AudioOutput& output_;
    const Mix& mix_;
    std::function<void()> onChange_;
    std::unique_ptr<Recording> recording_;
    juce::File file_;
    bool isEnding_ = false;
    std::int64_t from_ = 0;
    std::uint64_t endsAfterBlock_ = 0;
};

} // namespace physvib
