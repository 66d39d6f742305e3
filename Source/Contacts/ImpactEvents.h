// SPDX-License-Identifier: MIT
// From what a camera felt to collision events: amplitude, voice and place.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"
#include <cmath>

namespace physvib {

/// Where the field is, for many events at once.
class FieldFrame {
public:
    explicit FieldFrame(const ImpactSettings& settings) noexcept
        : origin_(settings.fieldOrigin)
        , cos_(std::cos(settings.fieldRadians))
        , sin_(std::sin(settings.fieldRadians)) {}

    Vector2 toField(Vector2 world) const noexcept {
        const Vector2 from = world - origin_;
        return {cos_ * from.x + sin_ * from.y, cos_ * from.y - sin_ * from.x};
    }

private:
    Vector2 origin_;
    float cos_, sin_;
};

/// Adds the event of an impact (Eq. 5.4), or two if the camera's voice is `both`: each with the full
/// amplitude, as two bodies sound that ring at the same time (Eq. 5.1 adds). Voice `other` or `both` with a
/// partner that has no frequency is `own`; where there is none either, or no mass for Eq. 5.4, nothing
/// sounds. What is made, muted or cannot be played is counted. Two surfaces that have a sound of their own make that one instead. Each mode of a sound is an event. While the
/// camera's body is in the world; M only.
void addEvents(const Impact& impact, const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies, const ImpactModel& model,
               const ImpactSettings& settings, const FieldFrame& field, EventSorter& events, ContactCounts& counts);

/// The amplitude of its first mode (Eq. 5.4 and the camera's gain). As above.
double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies, const ImpactModel& model);

} // namespace physvib
