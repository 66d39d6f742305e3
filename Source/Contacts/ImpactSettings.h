// SPDX-License-Identifier: MIT
// What can be chosen about the way from contacts to events.
#pragma once
#include <optional>

namespace physvib {

/// onset: the solver's impulses, when a contact begins. release: the thesis' velocities at begin and end of a
/// contact (Eq. 5.2, 5.3), up to 50 ms later (SPEC erratum 3).
enum class ImpactTiming { onset, release };

/// Where an event is felt: at the point of contact, or at the centre of the camera's fixture (SPEC erratum
/// 11).
enum class ImpactLocation { contact, fixture };

/// For an Attachment. All can be changed while it runs.
struct ImpactSettings {
    double fieldWidthMetres = 1.0;       ///< v_max of Eq. 5.7 is one field width per second
    std::optional<double> normalisation; ///< A* in s/m, instead of Eq. 5.7's
    std::optional<double> handMassKg;    ///< m_h, instead of the largest mass in the world (Eq. 5.7)
    double driveGain = 1.0;              ///< on top of Eq. 5.4 (SPEC erratum 15)
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;

    /// Hits that change the velocity of the lighter body by less than this are no strikes: 0.15 m/s is a
    /// landing from about a millimetre. Never less than 1.5 g dt is asked for, g being the world's gravity: a
    /// body at rest gets g dt in every step, and contacts that tremble open and shut give this again and
    /// again.
    double thresholdMetresPerSecond = 0.15;

    /// True: a camera also feels the hit of a body that is destroyed right after it (a shell that bursts).
    /// False: events not yet handed out go with either body.
    bool keepsHitsOfDestroyed = false;
};

} // namespace physvib
