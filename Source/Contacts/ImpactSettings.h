// SPDX-License-Identifier: MIT
// Settings of the conversion from contacts to events, and the impact model that follows from them: from the
// impulse of an impact to the amplitude of its vibration (Eq. 5.4 and 5.7 of the thesis).
#pragma once
#include "Contacts/Vectors.h"
#include <optional>
#include <string_view>

namespace physvib {

/// onset: the solver's impulses, when a contact begins. release: the thesis' change of velocities between
/// begin and end of a contact (Eq. 5.2, 5.3), up to 50 ms later. m dv alone is the whole impulse of a
/// contact, so Eq. 5.2, which adds the spin, overestimates oblique impacts.
enum class ImpactTiming { onset, release };

/// Where an event is felt: at the contact point, or, as in the thesis, at the centre of the source's fixture,
/// which makes a whole wall one point.
enum class ImpactLocation { contact, fixture };

/// Settings of an Attachment. All can be changed at any time.
struct ImpactSettings {
    double fieldWidthMetres = 1.0;         ///< v_max of Eq. 5.7 is one field width per second
    std::optional<double> normalisation{}; ///< A* in s/m, instead of Eq. 5.7's
    std::optional<double> handMassKg{}; ///< m_h, instead of the largest mass in the world (Eq. 5.7); a haptic
                                        ///< source may have its own
    double driveGain = 1.0;             ///< factor on Eq. 5.4, which leaves most impacts far below full scale
    ImpactTiming timing = ImpactTiming::onset;         ///< time and impulse of an impact
    ImpactLocation location = ImpactLocation::contact; ///< place of an impact

    /// Impacts that change the velocity of the lighter body by less than this are ignored, as are those of
    /// surfaces that approach at less than two thirds of it: 0.15 m/s is a fall of about a millimetre. At
    /// least 1.5 g dt is used, g being the gravity that acts on the bodies: a body at rest gets g dt in every
    /// step, and jittering contacts give this again and again.
    double thresholdMetresPerSecond = 0.15;

    /// True: impacts that a body caused or received before it was destroyed are played (a bursting shell, a
    /// breaking jar). False: pending events are dropped with either body.
    bool keepsHitsOfDestroyed = true;

    /// True: no events are sent. Contacts are still tracked, so that events are right when it is false again.
    bool isMuted = false;

    /// Maximum number of impacts per step that become events; the strongest are kept, the others counted.
    std::optional<int> hitsPerStep{};

    /// Current position of the field in the world: its lower left corner and rotation. Events give places in
    /// the field. It may move at any time, like a scrolling camera.
    Vector2 fieldOrigin{};
    float fieldRadians = 0.0F; ///< counter-clockwise

    /// The impulse that gives full scale, amplitude 1, instead of Eq. 5.4: masses, the hand and A* then have
    /// no effect on amplitudes; driveGain and the gains of sources and pairs still do. `automatic`: it is
    /// learned from the world's hits, see FullScale.
    double fullScaleNewtonSeconds = 0.0;      ///< 0: off
    static constexpr double automatic = -1.0; ///< a value of fullScaleNewtonSeconds

    /// Impacts before this world time are not felt, nor learned from: bodies that are created in the air, or
    /// in each other, come to rest first. They are counted as muted.
    double settlingSeconds = 0.0;
};

/// The error of a setting, with what was expected; empty if all are valid. Any thread.
std::string_view errorOf(const ImpactSettings& settings) noexcept;

/// Eq. 5.4 with a drive gain, which raises a scene to the level of its actuators.
struct ImpactModel {
    double normalisation = 0.0; ///< A*, seconds per metre
    double handMassKg = 0.0;    ///< m_h, the mass of the hand or device that holds the vibrating object
    double driveGain = 1.0;     ///< see ImpactSettings
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
constexpr double defaultNormalisation(double fieldWidthMetres) noexcept {
    return 1.0 / (2.0 * largestSpeed(fieldWidthMetres));
}

} // namespace physvib
