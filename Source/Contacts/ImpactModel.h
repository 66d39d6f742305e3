// SPDX-License-Identifier: MIT
// From the impulse of a hit to the amplitude of its vibration: Eq. 5.4 and 5.7 of the thesis.
#pragma once

namespace physvib {

/// Eq. 5.4 with a drive gain, which lifts a scene to the level of its actuators.
struct ImpactModel {
    double normalisation = 0.0; ///< A*, seconds per metre
    double handMassKg = 0.0;    ///< m_h, the mass of what holds the vibrating object
    double driveGain = 1.0;

    /// A = driveGain A* |J| / (m_i + m_h), 1 = full scale; |J| in N s, m_i in kg. Any thread.
    /// With `onset` timing |J| is the solver's whole impulse, without Eq. 5.2 on top of it.
    double amplitude(double impulseNewtonSeconds, double massKg) const noexcept {
        return driveGain * normalisation * impulseNewtonSeconds / (massKg + handMassKg);
    }
};

/// v_max of Eq. 5.7 in m/s: one field width per second. Any thread.
constexpr double largestSpeed(double fieldWidthMetres) noexcept { return fieldWidthMetres / 1.0; }

/// Eq. 5.7: A* = 1 / (2 v_max) in s/m. Any thread.
double defaultNormalisation(double fieldWidthMetres) noexcept;

} // namespace physvib
