// SPDX-License-Identifier: GPL-3.0-or-later
// Messages by OSC at the desk: from nobody, from this computer, or from any that reaches it.
#pragma once
#include "Files/Text/InputLine.h"
#include "Host/Devices/AudioOutput.h"
#include "Host/Osc/OscPort.h"
#include <functional>
#include <juce_events/juce_events.h>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

enum class OscUse { off, thisComputer, anyComputer };

/// Listens while it lives. What strikes goes to the session at once; what the desk shows, its strips and its world, is set by the desk
/// itself. M only.
class DeskOsc final : private juce::AsyncUpdater {
public:
    /// All outlive it; `act` is called on M, and says what is wrong.
    DeskOsc(OscUse use, Session& session, AudioOutput& output, std::function<std::string(const LineInput&)> act);
    ~DeskOsc() override;

    OscUse use() const noexcept { return use_; }
    const std::string& error() const noexcept { return port_->error(); }
    OscStatus status() const;

private:
    std::string take(const LineInput& input);
    void handleAsyncUpdate() override;

    OscUse use_;
    AudioOutput& output_;
    std::function<std::string(const LineInput&)> act_;
    std::mutex mutex_; // guards what follows
    std::vector<LineInput> waiting_;
    // M
    std::string fault_; // the last of what the desk was to do
    std::uint64_t refused_ = 0;
    MessageRouter messages_;
    std::unique_ptr<OscPort> port_; // its thread uses the others
};

} // namespace physvib
