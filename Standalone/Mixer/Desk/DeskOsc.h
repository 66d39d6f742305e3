// SPDX-License-Identifier: GPL-3.0-or-later
// OSC of the mixer: input from no computer, this computer or any computer, and reports of played events to a
// receiver.
#pragma once
#include "Host/Osc/OscPort.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/InputLine.h"
#include <functional>
#include <juce_events/juce_events.h>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

enum class OscUse { off, thisComputer, anyComputer };

struct OscChoice {
    OscUse use = OscUse::off; ///< accepted senders
    std::string receiver{};   ///< HOST:PORT that receives impacts and status; empty: none
    double turnDegrees = 0.0; ///< counter-clockwise rotation of a phone from upright
    bool operator==(const OscChoice&) const = default;
};

/// Receives and sends while it exists. Events go to the session at once; changes of strips and world are
/// applied by the mixer itself. Message thread only.
class DeskOsc final : private juce::AsyncUpdater, private juce::Timer {
public:
    static constexpr int tellMilliseconds = 10;

    /// All references outlive it. `act` is called on the message thread and returns an error or an empty
    /// string. With a receiver, `takePlayed` is called often to report played events.
    DeskOsc(const OscChoice& choice, Session& session, AudioOutput& output,
            std::function<std::string(const LineInput&)> act, std::function<void()> takePlayed);
    ~DeskOsc() override;

    const std::string& error() const noexcept { return port_->error(); }
    OscStatus status() const;

private:
    struct Waiting {
        LineInput input;
        OscOrigin origin;
    };
    std::string take(const LineInput& input, const OscOrigin& origin);
    void handleAsyncUpdate() override;
    void timerCallback() override { takePlayed_(); }

    AudioOutput& output_;
    std::function<std::string(const LineInput&)> act_;
    std::function<void()> takePlayed_;
    std::mutex mutex_; // guards the members below
    std::vector<Waiting> waiting_;
    // message thread:
    std::string fault_; // last error of the mixer
    std::uint64_t refused_ = 0;
    MessageRouter messages_;
    std::unique_ptr<OscPort> port_; // destroyed first, because its thread uses the other members
};

} // namespace physvib
