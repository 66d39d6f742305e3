// SPDX-License-Identifier: MIT
// Slots by the engine's names, checked against the world once per step.
#include "Contacts/FixtureTable.h"
#include <algorithm>

namespace physvib {

std::int32_t FixtureTable::set(const FixtureFacts& facts, const HapticFixture& values) {
    KnownFixture& known = at(slotOf(facts));
    set(facts, values, known.isNamed() ? known.id : nextId_);
    return known.id;
}

void FixtureTable::set(const FixtureFacts& facts, const HapticFixture& values, std::int32_t id) {
    KnownFixture& known = at(slotOf(facts));
    known.id = id;
    known.values = values;
    nextId_ = std::max(nextId_, id + 1);
}

void FixtureTable::unset(std::int32_t slot) noexcept {
    at(slot).id = nextNameless_--;
    at(slot).values = {};
}

void FixtureTable::release(std::int32_t slot) {
    slots_.erase(at(slot).facts.fixture);
    at(slot) = {};
    free_.push_back(slot);
}

void FixtureTable::beginLook() noexcept {
    ++looks_;
    largestMassKg_ = 0.0;
    cameras_.clear();
}

void FixtureTable::look(const FixtureFacts& facts, bool isEnabled) {
    const std::int32_t slot = slotOf(facts);
    KnownFixture& known = at(slot);
    known.facts = facts;
    known.seen = looks_;
    if (known.values.isCamera) cameras_.push_back(slot);
    if (isEnabled) largestMassKg_ = std::max(largestMassKg_, known.massKg());
}

void FixtureTable::endLook(std::vector<std::int32_t>& vanished) const {
    for (std::int32_t slot = 0; slot < size(); ++slot)
        if ((*this)[slot].isUsed() && (*this)[slot].seen != looks_) vanished.push_back(slot);
}

std::int32_t FixtureTable::slotOf(const FixtureFacts& facts) {
    if (const std::int32_t slot = find(facts.fixture); slot != none) return slot;
    if (free_.empty()) {
        free_.push_back(size());
        known_.emplace_back();
        free_.reserve(known_.capacity()); // releasing a slot never allocates
    }
    const std::int32_t slot = free_.back();
    free_.pop_back();
    at(slot).facts = facts;
    at(slot).id = nextNameless_--;
    slots_.set(facts.fixture, slot);
    return slot;
}

} // namespace physvib
