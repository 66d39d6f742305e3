// SPDX-License-Identifier: GPL-3.0-or-later
// A board that is late, gone or silent, in words.
#include "Mixer/Desk/DeskBoard.h"
#include "Mixer/Desk/DeskWords.h"

namespace physvib {
namespace {

constexpr double patienceMs = 3000.0; // greeting and clock take half a second

} // namespace

DeskBoard::DeskBoard(const std::string& port, const PhantomPanner& panner)
    : port_{port}
    , output_{port, panner, leadSeconds}
    , wantedAtMs_{nowMs()} {}

// Without a port of its own the link tries one after the other: what it says of each would only flicker.
juce::String DeskBoard::trouble() {
    const auto now = status();
    if (now.state == BoardLinkStatus::State::ready) {
        wasReady_ = true;
        if (now.playOutMs <= 1e3 * leadSeconds) return {};
        return "The board needs its strikes more than " + juce::String{1e3 * leadSeconds, 0} +
               " ms before they are felt: some come late there";
    }
    if (!wasReady_ && nowMs() - wantedAtMs_ < patienceMs) return {};
    if (port_ == anyBoard)
        return wasReady_ ? "The board is gone; it is looked for on every serial port"
                         : "No board answers on any serial port";
    return "The board at " + utf8(port_) + (wasReady_ ? " is gone" : " does not answer") +
           "; it is looked for twice a second";
}

} // namespace physvib
