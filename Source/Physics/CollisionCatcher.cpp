// SPDX-License-Identifier: MIT
// From contact callbacks to collision events.
#include "Physics/CollisionCatcher.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace physvib {

namespace {

double movableMassKg(const b2Body& body) {
    return body.GetType() == b2_dynamicBody ? body.GetMass() : std::numeric_limits<double>::infinity();
}

} // namespace

CollisionCatcher::CollisionCatcher(double thresholdMetresPerSecond)
    : threshold_(thresholdMetresPerSecond) {
    records_.reserve(maxRecords);
}

std::int32_t CollisionCatcher::add(const b2Fixture& fixture, const HapticFixture& values) {
    const auto index = static_cast<std::int32_t>(known_.size());
    indices_.emplace(&fixture, index);
    known_.push_back({fixture.GetBody(), values});
    sweeps_.add(*fixture.GetBody());
    return index;
}

double CollisionCatcher::largestMassKg() const noexcept {
    double largest = 0.0;
    for (std::size_t i = 0; i < known_.size(); ++i)
        largest = std::max(largest, massKg(static_cast<std::int32_t>(i)));
    return largest;
}

void CollisionCatcher::beginStep(double stepSeconds) noexcept {
    stepSeconds_ = stepSeconds;
    records_.clear();
    sweeps_.beginStep(stepSeconds);
}

void CollisionCatcher::BeginContact(b2Contact* contact) {
    const b2Fixture& a = *contact->GetFixtureA();
    const b2Fixture& b = *contact->GetFixtureB();
    const bool isFelt = isCamera(indexOf(a)) || isCamera(indexOf(b));
    const bool isSolid = !a.IsSensor() && !b.IsSensor(); // a sensor's contact has no points
    if (!isFelt || !isSolid) return;
    if (records_.size() == maxRecords)
        ++drops_;
    else
        records_.push_back(describe(*contact));
}

void CollisionCatcher::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    sweeps_.solved(*contact->GetFixtureA()->GetBody());
    sweeps_.solved(*contact->GetFixtureB()->GetBody());
    Record* record = find(*contact);
    if (record == nullptr) return;
    for (int i = 0; i < impulse->count; ++i) {
        record->normalImpulse += impulse->normalImpulses[i];
        record->tangentialImpulse += impulse->tangentImpulses[i];
    }
}

void CollisionCatcher::collect(const StepClock& clock, std::int64_t step, const ImpactModel& model,
                               EventSorter& events) const {
    const std::int64_t startNs = clock.timeNs(step);
    const std::int64_t earliestNs = clock.timeNs(step > 0 ? step - 1 : 0);
    const auto stepNs = static_cast<double>(clock.timeNs(step + 1) - startNs);
    const auto timeOf = [&](const Record& record) {
        const auto sinceStart = static_cast<std::int64_t>(std::llround(record.stepFraction * stepNs));
        return std::max(earliestNs, startNs + sinceStart);
    };
    for (const Record& record : records_) {
        const double impulse = std::hypot(record.normalImpulse, record.tangentialImpulse);
        if (impulse <= 0.0 || impulse < threshold_ * record.lighterMassKg) continue;
        const auto feel = [&](std::int32_t fixture, std::int32_t other) {
            if (!isCamera(fixture)) return;
            CollisionEvent event = toEvent(record, fixture, other);
            event.timeNs = timeOf(record);
            event.amplitude = model.amplitude(impulse, event.source.massKg);
            event.source.impulseNewtonSeconds = impulse;
            events.push(event);
        };
        feel(record.fixtureA, record.fixtureB);
        feel(record.fixtureB, record.fixtureA);
    }
}

std::int32_t CollisionCatcher::indexOf(const b2Fixture& fixture) const noexcept {
    const auto place = indices_.find(&fixture);
    return place == indices_.end() ? unknown : place->second;
}

bool CollisionCatcher::isCamera(std::int32_t index) const noexcept {
    return index != unknown && known_[static_cast<std::size_t>(index)].values.isCamera;
}

double CollisionCatcher::massKg(std::int32_t index) const noexcept {
    const Known& known = known_[static_cast<std::size_t>(index)];
    const bool isDynamic = known.body->GetType() == b2_dynamicBody;
    return isDynamic ? known.body->GetMass() : known.values.staticMassKg;
}

CollisionCatcher::Record* CollisionCatcher::find(const b2Contact& contact) noexcept {
    const auto isSame = [&contact](const Record& record) { return record.contact == &contact; };
    const auto found = std::find_if(records_.begin(), records_.end(), isSame);
    return found == records_.end() ? nullptr : &*found;
}

CollisionCatcher::Record CollisionCatcher::describe(const b2Contact& contact) const noexcept {
    const b2Body& a = *contact.GetFixtureA()->GetBody();
    const b2Body& b = *contact.GetFixtureB()->GetBody();
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const int count = contact.GetManifold()->pointCount;
    const int deepest = count > 1 && manifold.separations[1] < manifold.separations[0] ? 1 : 0;
    const b2Vec2 touch = manifold.points[deepest];
    const b2Vec2 velocity =
        b.GetLinearVelocityFromWorldPoint(touch) - a.GetLinearVelocityFromWorldPoint(touch);

    Record record{};
    record.contact = &contact;
    record.fixtureA = indexOf(*contact.GetFixtureA());
    record.fixtureB = indexOf(*contact.GetFixtureB());
    // A flat landing touches along a line: its middle, not whichever end is deeper by a rounding.
    record.point = count > 1 ? 0.5F * (manifold.points[0] + manifold.points[1]) : touch;
    record.normal = manifold.normal;
    record.separationMetres = manifold.separations[deepest];
    record.approachMetresPerSecond = -b2Dot(velocity, manifold.normal);
    record.lighterMassKg = std::min(movableMassKg(a), movableMassKg(b));

    const double perStep = record.approachMetresPerSecond * stepSeconds_;
    const double depth = std::max(0.0, -record.separationMetres);
    const double stepsAgo = perStep > 0.0 ? std::min(1.0, depth / perStep) : 0.0;
    record.stepFraction = sweeps_.fraction(a, b) - stepsAgo;
    return record;
}

CollisionEvent CollisionCatcher::toEvent(const Record& record, std::int32_t fixture,
                                         std::int32_t other) const noexcept {
    const HapticFixture& values = known_[static_cast<std::size_t>(fixture)].values;
    CollisionEvent event;
    event.frequencyHz = values.frequencyHz;
    event.decayPerSecond = values.decayPerSecond;
    event.x = record.point.x;
    event.y = record.point.y;
    event.source.fixture = fixture;
    event.source.other = other;
    event.source.massKg = massKg(fixture);
    return event;
}

} // namespace physvib
