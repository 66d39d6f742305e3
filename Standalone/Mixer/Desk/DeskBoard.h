// SPDX-License-Identifier: GPL-3.0-or-later
// The four-channel board beside the desk's device, and what is wrong with it.
#pragma once
#include "Live/Session/BoardOutput.h"
#include <juce_core/juce_core.h>
#include <string>

namespace physvib {

/// Plays the first four enchanters while it lives. M only.
class DeskBoard {
public:
    /// The link needs 20 to 40 ms; more than that is told as trouble.
    static constexpr double leadSeconds = 0.05;

    /// The board at `port`, or anyBoard, for a session with that panner.
    DeskBoard(const std::string& port, const PhantomPanner& panner);

    Sink& sink() noexcept { return output_; }
    BoardLinkStatus status() const { return output_.status(); }

    /// One line; empty while all is well, and before it had time to answer.
    juce::String trouble();

private:
    std::string port_;
    BoardOutput output_;
    double wantedAtMs_ = 0.0;
    bool wasReady_ = false;
};

} // namespace physvib
