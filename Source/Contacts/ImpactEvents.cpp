// SPDX-License-Identifier: MIT
// One function per question: whose sound, where.
#include "Contacts/ImpactEvents.h"

namespace physvib {

namespace {

void push(CollisionEvent event, const HapticFixture& sound, EventSorter& events) {
    event.frequencyHz = sound.frequencyHz;
    event.decayPerSecond = sound.decayPerSecond;
    if (isPlayable(event)) events.push(event);
}

} // namespace

void addEvents(const Impact& impact, const FixtureTable& table, const BodyReader& bodies, const ImpactModel& model,
               ImpactLocation location, EventSorter& events) {
    const KnownFixture& camera = table[impact.camera];
    const KnownFixture* other = impact.other == FixtureTable::none ? nullptr : &table[impact.other];
    const Vector2 place = location == ImpactLocation::contact ? impact.point : bodies.centreOfFixture(camera);

    CollisionEvent event;
    event.timeNs = impact.timeNs;
    event.amplitude = model.amplitude(impact.newtonSeconds, camera.massKg());
    event.x = static_cast<double>(place.x);
    event.y = static_cast<double>(place.y);
    event.source = {camera.id, other == nullptr ? -1 : other->id, impact.newtonSeconds, camera.massKg()};

    const Voice voice = camera.values.voice;
    const bool othersSounds = voice != Voice::own && other != nullptr && other->values.frequencyHz > 0.0;
    if (voice != Voice::other || !othersSounds) push(event, camera.values, events);
    if (othersSounds) push(event, other->values, events);
}

} // namespace physvib
