// SPDX-License-Identifier: MIT
// Executes a request for silence or its withdrawal, and reports which other inputs still request it.
#include "Live/Session/SilenceHolders.h"
#include "Live/Documents/InputLine.h"
#include <utility>

namespace physvib {

std::string takeSilence(SilenceHolders& silence, const SilenceControl& control, SilenceHolder holder) {
    if (control.isOn) {
        if (control.number == SilenceControl::unnumbered)
            silence.ask(holder);
        else
            silence.ask(holder, control.number);
        return {};
    }
    silence.lift(holder, control.number);
    std::string others;
    for (const auto& [other, words] : {std::pair{SilenceHolder::machine, "at the machine"},
                                       {SilenceHolder::standardInput, "by standard input"},
                                       {SilenceHolder::osc, "by OSC"}})
        if (other != holder && silence.isHeldBy(other))
            others += std::string(others.empty() ? "" : " and ") + words;
    return others.empty() ? "" : "silence: still asked for " + others;
}

} // namespace physvib
