// SPDX-License-Identifier: MIT
// What can be chosen about the way from contacts to events.
#pragma once
#include "Contacts/Vector2.h"
#include <optional>
#include <string_view>

namespace physvib {

/// onset: the solver's impulses, when a contact begins. release: the thesis' velocities at begin and end of a
/// contact (Eq. 5.2, 5.3), up to 50 ms later. m dv alone is the whole impulse of a
/// contact, so Eq. 5.2, which adds the spin, tells too much of oblique hits.
enum class ImpactTiming { onset, release };

/// Where an event is felt: at the point of contact, or at the centre of the camera's fixture, as
/// the thesis has it, which makes a whole wall one point.
enum class ImpactLocation { contact, fixture };

/// For an Attachment. All can be changed while it runs.
struct ImpactSettings {
    double fieldWidthMetres = 1.0;         ///< v_max of Eq. 5.7 is one field width per second
    std::optional<double> normalisation{}; ///< A* in s/m, instead of Eq. 5.7's
    std::optional<double> handMassKg{}; ///< m_h, instead of the largest mass in the world (Eq. 5.7); a camera
                                        ///< may have its own
    double driveGain = 1.0;             ///< on top of Eq. 5.4, which leaves most hits far below full scale
    ImpactTiming timing = ImpactTiming::onset;         ///< when, and how hard, a hit is
    ImpactLocation location = ImpactLocation::contact; ///< where it is felt

    /// Hits that change the velocity of the lighter body by less than this are no strikes, nor are those of
    /// surfaces that near each other at less than two thirds of it: 0.15 m/s is a landing from about a
    /// millimetre. Never less than 1.5 g dt is asked for, g being the gravity that pulls the bodies: a body
    /// at rest gets g dt in every step, and contacts that tremble open and shut give this again and again.
    double thresholdMetresPerSecond = 0.15;

    /// True: what a body struck, or felt as a camera, before it was destroyed is felt (a shell that bursts, a
    /// jar that breaks). False: events not yet handed out go with either body.
    bool keepsHitsOfDestroyed = true;

    /// Nothing is sent out; contacts are followed all the same, so that what comes after is right at once.
    bool isMuted = false;

    /// At most so many hits become events in one step, those that would be the strongest; the others are
    /// counted.
    std::optional<int> hitsPerStep{};

    /// Where the field is in the world, now: its lower left corner and how it is turned. Events tell places
    /// in the field. It may move at any time, as a camera that scrolls does.
    Vector2 fieldOrigin{};
    float fieldRadians = 0.0F; ///< counter-clockwise
};

/// What is wrong with settings, and what was expected; empty if they can be used. Any thread.
std::string_view faultOf(const ImpactSettings& settings) noexcept;

} // namespace physvib
