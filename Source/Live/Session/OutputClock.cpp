// SPDX-License-Identifier: MIT
// Executes a request for silence or its withdrawal, and reports which other inputs still request it.
#include "Live/Session/OutputClock.h"
#include "Live/Documents/InputLine.h"
#include <utility>

namespace physvib {
std::string takeSilence(MuteRequests& silence, const SilenceControl& control, MuteRequester holder) {
    if (control.isOn) {
        if (control.number == SilenceControl::unnumbered)
            silence.request(holder);
        else
            silence.request(holder, control.number);
        return {};
    }
    silence.lift(holder, control.number);
    std::string others;
    for (const auto& [other, words] : {std::pair{MuteRequester::machine, "at the machine"},
                                       {MuteRequester::standardInput, "by standard input"},
                                       {MuteRequester::osc, "by OSC"}})
        if (other != holder && silence.isHeldBy(other))
            others += std::string(others.empty() ? "" : " and ") + words;
    return others.empty() ? "" : "silence: still asked for " + others;
}

} // namespace physvib
