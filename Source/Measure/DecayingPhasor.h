// SPDX-License-Identifier: MIT
// Recursive generator of exp(-tau t) cos(omega t) and exp(-tau t) sin(omega t), without a library call per
// sample.
#pragma once
#include "Core/Trigonometry.h"
#include <cmath>

namespace physvib {

class DecayingPhasor {
public:
    /// The first sample lies at `seconds`.
    DecayingPhasor(double omega, double tau, double rateHz, double seconds = 0.0)
        : turn_{at(omega, tau, 1.0 / rateHz)}
        , now_{at(omega, tau, seconds)} {}
    double cosine() const noexcept { return now_.re; }
    double sine() const noexcept { return now_.im; }
    void next() noexcept { now_ = now_ * turn_; }

private:
    static Complex<double> at(double omega, double tau, double seconds) {
        const double decay = std::exp(-tau * seconds);
        return {decay * std::cos(omega * seconds), decay * std::sin(omega * seconds)};
    }
    Complex<double> turn_, now_;
};

} // namespace physvib
