// SPDX-License-Identifier: MIT
// Slots by address, checked against the world once per step.
#include "Physics/FixtureTable.h"
#include <algorithm>

namespace physvib {

std::int32_t FixtureTable::set(const b2Fixture& fixture, const HapticFixture& values) {
    KnownFixture& known = at(slotOf(fixture));
    set(fixture, values, known.isNamed() ? known.id : nextId_);
    return known.id;
}

void FixtureTable::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    KnownFixture& known = at(slotOf(fixture));
    known.id = id;
    known.values = values;
    nextId_ = std::max(nextId_, id + 1);
}

void FixtureTable::unset(std::int32_t slot) noexcept {
    at(slot).id = nextNameless_--;
    at(slot).values = {};
}

void FixtureTable::release(std::int32_t slot) {
    slots_.erase(keyOf(at(slot).fixture));
    at(slot) = {};
    free_.push_back(slot);
}

void FixtureTable::refresh(const b2World& world, std::vector<std::int32_t>& vanished) {
    ++looks_;
    largestMassKg_ = 0.0;
    cameras_.clear();
    std::int32_t bodyIndex = 0;
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext(), ++bodyIndex)
        for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr;
             fixture = fixture->GetNext())
            look(*fixture, bodyIndex);
    for (std::int32_t slot = 0; slot < size(); ++slot)
        if (at(slot).fixture != nullptr && at(slot).seen != looks_) vanished.push_back(slot);
}

void FixtureTable::look(const b2Fixture& fixture, std::int32_t bodyIndex) {
    const std::int32_t slot = slotOf(fixture);
    KnownFixture& known = at(slot);
    known.body = fixture.GetBody();
    known.bodyIndex = bodyIndex;
    known.seen = looks_;
    if (known.values.isCamera) cameras_.push_back(slot);
    if (known.body->IsEnabled()) largestMassKg_ = std::max(largestMassKg_, known.massKg());
}

std::int32_t FixtureTable::slotOf(const b2Fixture& fixture) {
    if (const std::int32_t slot = find(fixture); slot != none) return slot;
    if (free_.empty()) {
        free_.push_back(size());
        known_.emplace_back();
        free_.reserve(known_.capacity()); // releasing a slot never allocates
    }
    const std::int32_t slot = free_.back();
    free_.pop_back();
    at(slot).fixture = &fixture;
    at(slot).body = fixture.GetBody();
    at(slot).id = nextNameless_--;
    slots_.set(keyOf(&fixture), slot);
    return slot;
}

} // namespace physvib
