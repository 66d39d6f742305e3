// SPDX-License-Identifier: MIT
// How long somebody waits for a world to be simulated before the first sample: a stranger's scene may ask for
// hours.
#pragma once
#include "Io/Text/NumberText.h"
#include "Live/Session/ThreadTime.h"
#include <cstdint>
#include <string>

namespace physvib {

/// A StepWatch that says no once simulating has taken `seconds` of processor time more than what is simulated
/// lasts: a busy machine is no slow world. What the renderer makes does not depend on it, only whether it is
/// made. For the thread that makes it and simulates; stays where it is.
class Patience {
public:
    static constexpr double usualSeconds = 4.0; // our own scenes are simulated a hundred times faster than
                                                // they last

    /// Infinity waits for ever.
    explicit Patience(double seconds)
        : seconds_{seconds} {}

    bool operator()(std::int64_t simulatedNs) {
        simulatedSeconds_ = static_cast<double>(simulatedNs) * 1e-9;
        takenSeconds_ = threadSeconds() - beganSeconds_;
        return takenSeconds_ <= seconds_ + simulatedSeconds_;
    }

    /// Empty, or that it has come to an end.
    std::string fault() const {
        if (takenSeconds_ <= seconds_ + simulatedSeconds_) return {};
        return "expected a world that is simulated as fast as it lasts, found " +
               fixedNumber(simulatedSeconds_, 2) + " s of it after " + fixedNumber(takenSeconds_, 1) +
               " s of processor time (--patience waits longer)";
    }

private:
    double seconds_;
    double simulatedSeconds_ = 0.0, takenSeconds_ = 0.0;
    double beganSeconds_ = threadSeconds();
};

} // namespace physvib
