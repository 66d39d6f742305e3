// SPDX-License-Identifier: MIT
// One function per question: whose sound, where.
#include "Contacts/ImpactEvents.h"

namespace physvib {

namespace {

/// Of a HapticFixture or a PairSound.
template <class Sound>
void push(CollisionEvent event, const Sound& sound, EventSorter& events, ContactCounts& counts) {
    const double amplitude = event.amplitude;
    const auto add = [&](double frequencyHz, double decayPerSecond) {
        event.frequencyHz = frequencyHz;
        event.decayPerSecond = decayPerSecond;
        if (!isPlayable(event)) {
            ++counts.unplayable;
            return;
        }
        events.push(event);
        ++counts.events;
    };
    add(sound.frequencyHz, sound.decayPerSecond);
    for (const Overtone& mode : sound.overtones) {
        event.amplitude = mode.relativeAmplitude * amplitude;
        if (mode.frequencyHz > 0.0) add(mode.frequencyHz, mode.decayPerSecond);
    }
}

double massOf(const KnownFixture& camera, const BodyReader& bodies) {
    const BodyFacts body = bodies.facts(camera.body.body);
    return body.isDynamic ? body.massKg : camera.values.staticMassKg;
}

double amplitudeOf(double newtonSeconds, double massKg, const HapticFixture& camera, const ImpactModel& model) {
    ImpactModel own = model;
    own.handMassKg = camera.handMassKg.value_or(model.handMassKg);
    return camera.gain * own.amplitude(newtonSeconds, massKg);
}

} // namespace

double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies, const ImpactModel& model) {
    return amplitudeOf(impact.newtonSeconds, massOf(table[impact.camera], bodies), table[impact.camera].values, model);
}

void addEvents(const Impact& impact, const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies, const ImpactModel& model,
               const ImpactSettings& settings, const FieldFrame& field, EventSorter& events, ContactCounts& counts) {
    const KnownFixture& camera = table[impact.camera];
    if (settings.isMuted || camera.values.gain == 0.0) {
        ++counts.muted;
        return;
    }
    const KnownFixture* other = impact.other == FixtureTable::none ? nullptr : &table[impact.other];
    const bool isAtContact = settings.location == ImpactLocation::contact;
    const Vector2 place = field.toField(isAtContact ? impact.point : bodies.toWorld(camera.body.body, camera.centre));

    CollisionEvent event;
    event.timeNs = impact.timeNs;
    const double massKg = massOf(camera, bodies);
    event.amplitude = amplitudeOf(impact.newtonSeconds, massKg, camera.values, model);
    event.x = static_cast<double>(place.x);
    event.y = static_cast<double>(place.y);
    event.source = {camera.id, other == nullptr ? -1 : other->id, impact.newtonSeconds, massKg, impact.kind};

    if (const PairSound* pair = other == nullptr ? nullptr : pairs.find(camera.values.surface, other->values.surface)) {
        event.amplitude *= pair->gain;
        return push(event, *pair, events, counts);
    }
    const Voice voice = camera.values.voice;
    const bool othersSounds = voice != Voice::own && other != nullptr && other->values.frequencyHz > 0.0;
    if (voice != Voice::other || !othersSounds) push(event, camera.values, events, counts);
    if (othersSounds) push(event, other->values, events, counts);
}

} // namespace physvib
