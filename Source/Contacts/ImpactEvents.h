// SPDX-License-Identifier: MIT
// From what a camera felt to collision events: amplitude, voice and place.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"

namespace physvib {

/// Adds the event of an impact (Eq. 5.4), or two if the camera's voice is `both`: each with the full
/// amplitude, as two bodies sound that ring at the same time (Eq. 5.1 adds). Voice `other` or `both` with a
/// partner that has no frequency is `own`; where there is none either, or no mass for Eq. 5.4, nothing
/// sounds. Two surfaces that have a sound of their own make that one instead. Each mode of a sound is an event. While the
/// camera's body is in the world; M only.
void addEvents(const Impact& impact, const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies, const ImpactModel& model,
               const ImpactSettings& settings, EventSorter& events);

/// The amplitude of its first mode (Eq. 5.4 and the camera's gain). As above.
double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies, const ImpactModel& model);

} // namespace physvib
