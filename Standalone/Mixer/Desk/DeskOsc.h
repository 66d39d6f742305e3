// SPDX-License-Identifier: GPL-3.0-or-later
// Messages by OSC at the desk: from nobody, from this computer, or from any that reaches it; and what is
// felt, to whom it is wanted.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Host/Osc/OscPort.h"
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
    OscUse use = OscUse::off; ///< who is listened to
    std::string receiver{};   ///< HOST:PORT that hears of hits and status; empty: nobody
    double turnDegrees = 0.0; ///< by which a phone is held counter-clockwise of upright
    bool operator==(const OscChoice&) const = default;
};

/// Listens and tells while it lives. What strikes goes to the session at once; what the desk shows, its
/// strips and its world, is set by the desk itself. M only.
class DeskOsc final : private juce::AsyncUpdater, private juce::Timer {
public:
    static constexpr int tellMilliseconds = 10;

    /// All outlive it; `act` is called on M, and says what is wrong; `takePlayed` often, if there is a
    /// receiver: it tells what has been played.
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
    std::mutex mutex_; // guards what follows
    std::vector<Waiting> waiting_;
    // M
    std::string fault_; // the last of what the desk was to do
    std::uint64_t refused_ = 0;
    MessageRouter messages_;
    std::unique_ptr<OscPort> port_; // its thread uses the others
};

} // namespace physvib
