// SPDX-License-Identifier: GPL-3.0-or-later
// What the desk records: its enchanters as WAV, and the events beside it.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Host/Recordings/Recording.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include <functional>
#include <memory>
#include <string>

namespace physvib {

/// One recording after the other. M only.
class DeskRecording {
public:
    /// All outlive it. `onChange` is called when a recording begins, is to end, and has ended.
    DeskRecording(Session& session, AudioOutput& output, const Mix& mix, std::function<void()> onChange);

    ~DeskRecording() { keep(); }

    /// What is there of a recording that runs is in its place. After the output was stopped.
    void keep();

    /// WAV of the enchanters that are attached now, and the events beside it; empty, or why not.
    std::string start(const juce::File& file);
    void stop(); ///< the files are in their places a moment later: onEnd says so
    bool isRunning() const noexcept { return recording_ != nullptr && !isEnding_; }
    double seconds() const noexcept;
    std::int64_t from() const noexcept { return from_; } ///< session frame of the last recording's first one
    std::function<void(const juce::File&, const juce::String& error)> onEnd;

    /// An event that was played.
    void take(const PlayedEvent& played);

    /// To be called often, with the newest of the device.
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
