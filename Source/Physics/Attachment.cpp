// SPDX-License-Identifier: MIT
// Comes into a world, and leaves it as it was.
#include "Physics/Attachment.h"
#include "Physics/InstalledListener.h"
#include "Physics/WorldNames.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace physvib {

Attachment::Attachment(b2World& world, const ImpactSettings& settings)
    : world_(world)
    , chained_(destructionListenerOf(world))
    , bodies_(sweeps_)
    , events_(bodies_, settings)
    , listener_(events_.fixtures(), events_.catcher(), sweeps_, *world.GetContactManager().m_contactListener) {
    look();
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
        listener_.meet(*contact);
    world.SetContactListener(&listener_);
    world.SetDestructionListener(this);
}

Attachment::~Attachment() {
    if (world_.GetContactManager().m_contactListener == &listener_)
        world_.SetContactListener(&listener_.chained());
    if (destructionListenerOf(world_) == this) world_.SetDestructionListener(chained_);
}

std::int32_t Attachment::set(const b2Fixture& fixture, const HapticFixture& values) {
    check(fixture);
    return events_.fixtures().set(factsOf(fixture), values);
}

void Attachment::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    check(fixture);
    events_.fixtures().set(factsOf(fixture), values, id);
}

const HapticFixture* Attachment::find(const b2Fixture& fixture) const noexcept {
    const std::int32_t slot = slotOf(fixture);
    if (slot == FixtureTable::none) return nullptr;
    const KnownFixture& known = events_.fixtures()[slot];
    return known.isNamed() ? &known.values : nullptr;
}

void Attachment::remove(const b2Fixture& fixture) {
    if (const std::int32_t slot = slotOf(fixture); slot != FixtureTable::none) events_.remove(slot);
}

void Attachment::step(float stepSeconds, int velocityIterations, int positionIterations) {
    if (!(stepSeconds > 0.0F)) return;
    beginStep(static_cast<double>(stepSeconds));
    world_.Step(stepSeconds, velocityIterations, positionIterations);
    endStep();
}

void Attachment::beginStep(double stepSeconds) {
    constexpr double longest = 3600.0; // keeps nonsense inside 64 bits
    const double seconds = stepSeconds > 0.0 ? std::min(stepSeconds, longest) : 0.0;
    beginStepUntil(timeNs() + std::llround(seconds * 1.0e9));
}

void Attachment::beginStepUntil(std::int64_t endNs) {
    look();
    events_.beginStep(endNs, toVector(world_.GetGravity()));
    sweeps_.beginStep(world_, events_.stepSeconds());
}

void Attachment::endStep() { events_.endStep(); }

void Attachment::SayGoodbye(b2Joint* joint) {
    if (chained_ != nullptr) chained_->SayGoodbye(joint);
}

void Attachment::SayGoodbye(b2Fixture* fixture) {
    if (const std::int32_t slot = slotOf(*fixture); slot != FixtureTable::none) events_.release(slot);
    if (chained_ != nullptr) chained_->SayGoodbye(fixture);
}

void Attachment::look() {
    FixtureTable& table = events_.fixtures();
    table.beginLook();
    std::int32_t bodyIndex = 0;
    for (const b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext(), ++bodyIndex)
        for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext())
            table.look(factsOf(*fixture, bodyIndex), body->IsEnabled());
    events_.endLook();
}

std::int32_t Attachment::slotOf(const b2Fixture& fixture) const noexcept {
    return events_.fixtures().find(nameOf(fixture));
}

void Attachment::check(const b2Fixture& fixture) const {
    if (fixture.GetBody()->GetWorld() != &world_)
        throw std::invalid_argument("fixture: expected one of the world attached to");
}

} // namespace physvib
