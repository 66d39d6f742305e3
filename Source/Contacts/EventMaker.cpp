// SPDX-License-Identifier: MIT
// Computes an impact's events: sound and place once per pair, time and amplitude for each impact.
#include "Contacts/EventMaker.h"
#include <cmath>

namespace physvib {

namespace {

double massOf(const KnownFixture& camera, const BodyReader& bodies) {
    const BodyFacts body = bodies.facts(camera.body.body);
    return body.isDynamic ? body.massKg : camera.values.staticMassKg;
}

ImpactModel modelOf(const HapticFixture& camera, const ImpactModel& model) noexcept {
    ImpactModel own = model;
    own.handMassKg = camera.handMassKg.value_or(model.handMassKg);
    return own;
}

} // namespace

double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model) {
    const KnownFixture& camera = table[impact.camera];
    const ImpactModel own = modelOf(camera.values, model);
    return camera.values.gain * own.amplitude(impact.newtonSeconds, massOf(camera, bodies));
}

EventMaker::EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
                       const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
                       ContactCounts& counts) noexcept
    : table_(table)
    , pairs_(pairs)
    , bodies_(bodies)
    , settings_(settings)
    , events_(events)
    , counts_(counts)
    , model_(model)
    , cos_(std::cos(settings.fieldRadians))
    , sin_(std::sin(settings.fieldRadians)) {}

void EventMaker::add(const Impact& impact) {
    if (impact.camera != camera_) setSource(impact.camera);
    if (isMuted_) {
        ++counts_.muted;
        return;
    }
    if (!hasMet_ || impact.other != other_) setPartner(impact.other);
    if (settings_.location == ImpactLocation::contact) place(impact.point);
    const double amplitude = pairGain_ * (gain_ * own_.amplitude(impact.newtonSeconds, event_.source.massKg));
    event_.timeNs = impact.timeNs;
    event_.source.impulseNewtonSeconds = impact.newtonSeconds;
    event_.source.kind = impact.kind;
    for (int i = 0; i < modeCount_; ++i) {
        const Mode& mode = modes_[static_cast<std::size_t>(i)];
        event_.frequencyHz = mode.frequencyHz;
        event_.decayPerSecond = mode.decayPerSecond;
        event_.amplitude = mode.relativeAmplitude * amplitude;
        event_.sound = mode.sound;
        if (!isPlayable(event_)) {
            ++counts_.unplayable;
            continue;
        }
        events_.push(event_);
        counts_.made(event_.x, event_.y);
    }
}

void EventMaker::setSource(std::int32_t camera) {
    camera_ = camera;
    hasMet_ = false;
    const KnownFixture& of = table_[camera];
    gain_ = of.values.gain;
    isMuted_ = settings_.isMuted || gain_ == 0.0;
    if (isMuted_) return;
    own_ = modelOf(of.values, model_);
    event_.source.fixture = of.id;
    event_.source.massKg = massOf(of, bodies_);
    event_.source.part = of.values.part;
    if (settings_.location == ImpactLocation::fixture) place(bodies_.toWorld(of.body.body, of.centre));
}

void EventMaker::setPartner(std::int32_t other) {
    hasMet_ = true;
    other_ = other;
    modeCount_ = 0;
    pairGain_ = 1.0;
    const HapticFixture& own = table_[camera_].values;
    if (other == FixtureTable::none) {
        event_.source.other = -1;
        return addModes(own);
    }
    const HapticFixture& others = table_[other].values;
    event_.source.other = table_[other].id;
    if (const PairSound* const pair = pairs_.find(own.surface, others.surface)) {
        pairGain_ = pair->gain;
        return addModes(*pair);
    }
    const bool othersSounds = own.voice != Voice::own && others.frequencyHz > 0.0;
    if (own.voice != Voice::other || !othersSounds) addModes(own);
    if (othersSounds) addModes(others);
}

/// `sound`: a HapticFixture or a PairSound.
template <class Sound>
void EventMaker::addModes(const Sound& sound) noexcept {
    const auto add = [this](const Mode& mode) { modes_[static_cast<std::size_t>(modeCount_++)] = mode; };
    add({sound.frequencyHz, sound.decayPerSecond, 1.0, sound.sound});
    for (const Overtone& mode : sound.overtones)
        if (mode.frequencyHz > 0.0) add({mode.frequencyHz, mode.decayPerSecond, mode.relativeAmplitude, 0});
}

// The field lies in the plane: its origin and rotation leave z as it is.
void EventMaker::place(Vector3 world) noexcept {
    const Vector2 from = inPlane(world) - settings_.fieldOrigin;
    event_.x = static_cast<double>(cos_ * from.x + sin_ * from.y);
    event_.y = static_cast<double>(cos_ * from.y - sin_ * from.x);
    event_.z = static_cast<double>(world.z);
}

} // namespace physvib
