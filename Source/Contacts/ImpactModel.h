// SPDX-License-Identifier: MIT
// Impact model: from the impulse of an impact to the amplitude of its vibration (Eq. 5.4 and 5.7 of the
// thesis).
#pragma once

namespace physvib {

/// Eq. 5.4 with a drive gain, which raises a scene to the level of its actuators.
struct ImpactModel {
    double normalisation = 0.0; ///< A*, seconds per metre
    double handMassKg = 0.0;    ///< m_h, the mass of the hand or device that holds the vibrating object
    double driveGain = 1.0;
    double fullScaleNewtonSeconds = 0.0; ///< above 0: the impulse of full scale, instead of Eq. 5.4

    /// A = driveGain A* |J| / (m_i + m_h), 1 = full scale; |J| in N s, m_i in kg. Any thread. With `onset`
    /// timing |J| is the solver's whole impulse, without the spin term of Eq. 5.2. With
    /// fullScaleNewtonSeconds A = driveGain |J| / fullScaleNewtonSeconds.
    double amplitude(double impulseNewtonSeconds, double massKg) const noexcept {
        if (fullScaleNewtonSeconds > 0.0) return driveGain * impulseNewtonSeconds / fullScaleNewtonSeconds;
        return driveGain * normalisation * impulseNewtonSeconds / (massKg + handMassKg);
    }
};

/// v_max of Eq. 5.7 in m/s: one field width per second. Any thread.
constexpr double largestSpeed(double fieldWidthMetres) noexcept { return fieldWidthMetres / 1.0; }

/// Eq. 5.7: A* = 1 / (2 v_max) in s/m. Any thread.
double defaultNormalisation(double fieldWidthMetres) noexcept;

} // namespace physvib
