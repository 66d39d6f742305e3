// SPDX-License-Identifier: MIT
// One function per question: whose sound, where.
#include "Contacts/ImpactEvents.h"
#include <cmath>

namespace physvib {

namespace {

void push(CollisionEvent event, const HapticFixture& sound, EventSorter& events) {
    event.frequencyHz = sound.frequencyHz;
    event.decayPerSecond = sound.decayPerSecond;
    if (isPlayable(event)) events.push(event);
}

Vector2 toField(Vector2 world, const ImpactSettings& settings) noexcept {
    const Vector2 from = world - settings.fieldOrigin;
    const float c = std::cos(settings.fieldRadians), s = std::sin(settings.fieldRadians);
    return {c * from.x + s * from.y, c * from.y - s * from.x};
}

} // namespace

void addEvents(const Impact& impact, const FixtureTable& table, const BodyReader& bodies, const ImpactModel& model,
               const ImpactSettings& settings, EventSorter& events) {
    const KnownFixture& camera = table[impact.camera];
    const KnownFixture* other = impact.other == FixtureTable::none ? nullptr : &table[impact.other];
    const bool isAtContact = settings.location == ImpactLocation::contact;
    const Vector2 place = toField(isAtContact ? impact.point : bodies.toWorld(camera.body.body, camera.centre), settings);
    const BodyFacts body = bodies.facts(camera.body.body);
    const double massKg = body.isDynamic ? body.massKg : camera.values.staticMassKg;

    CollisionEvent event;
    event.timeNs = impact.timeNs;
    event.amplitude = model.amplitude(impact.newtonSeconds, massKg);
    event.x = static_cast<double>(place.x);
    event.y = static_cast<double>(place.y);
    event.source = {camera.id, other == nullptr ? -1 : other->id, impact.newtonSeconds, massKg};

    const Voice voice = camera.values.voice;
    const bool othersSounds = voice != Voice::own && other != nullptr && other->values.frequencyHz > 0.0;
    if (voice != Voice::other || !othersSounds) push(event, camera.values, events);
    if (othersSounds) push(event, other->values, events);
}

} // namespace physvib
