// SPDX-License-Identifier: MIT
// Four steps of impulses per pair of a camera and what touches it.
#include "Contacts/ChainLoads.h"
#include <algorithm>

namespace physvib {

namespace {
constexpr std::size_t expectedContacts = 1024;
}

ChainLoads::ChainLoads(const FixtureTable& table, TouchingPairs& pairs)
    : table_(table)
    , pairs_(pairs) {
    contacts_.reserve(expectedContacts);
    passed_.reserve(expectedContacts);
    receivers_.reserve(expectedContacts);
}

void ChainLoads::add(const TouchingPairs::Name& pair, Vector2 newtonSeconds, Vector2 point) {
    Contact& contact = find(pair, true);
    contact.now += contact.of.b == pair.b ? newtonSeconds : -newtonSeconds; // the points and passes of the step, the parts of a chain
    contact.point = point;
    contact.isSolved = true;
}

void ChainLoads::settle() {
    for (const Contact& contact : contacts_) {
        if (!contact.isSolved || contact.isUnknown) continue;
        const Vector2 load = loadOf(contact);
        if (contact.now.lengthSquared() <= load.lengthSquared()) continue;
        const Vector2 beyond = contact.now - load;
        const float size = beyond.length();
        pass(contact.of.a, contact.of.b, -beyond, size, contact.point);
        pass(contact.of.b, contact.of.a, beyond, size, contact.point);
    }
}

void ChainLoads::pass(std::int32_t slot, std::int32_t other, Vector2 newtonSeconds, float size, Vector2 point) {
    if (!table_.isCamera(slot)) return;
    const auto index = static_cast<std::size_t>(slot);
    if (passed_.size() <= index) passed_.resize(index + 1);
    Passed& passed = passed_[index];
    if (passed.other == FixtureTable::none) receivers_.push_back(slot);
    passed.newtonSeconds += newtonSeconds;
    if (size <= passed.strongest) return;
    passed.strongest = size;
    passed.other = other;
    passed.point = point;
}

void ChainLoads::endStep(const ContactGraph& graph) noexcept {
    for (const std::int32_t slot : receivers_) passed_[static_cast<std::size_t>(slot)] = {};
    receivers_.clear();
    for (std::size_t i = contacts_.size(); i-- > 0;) {
        Contact& contact = contacts_[i];
        if (contact.isSolved) {
            if (contact.isUnknown) contact.past.fill(contact.now);
            contact.past = {contact.now, contact.past[0], contact.past[1]};
            contact.now = {};
            contact.isSolved = contact.isUnknown = false;
        } else if (!graph.isTouching(contact.of.a, contact.of.b)) {
            drop(i);
        }
    }
}

void ChainLoads::forget(std::int32_t slot) noexcept {
    for (std::size_t i = contacts_.size(); i-- > 0;)
        if (contacts_[i].of.a == slot || contacts_[i].of.b == slot) drop(i);
}

Vector2 ChainLoads::loadOf(const Contact& contact) noexcept {
    const auto isLess = [](const Vector2& a, const Vector2& b) {
        return a.lengthSquared() < b.lengthSquared();
    };
    return *std::min_element(contact.past.begin(), contact.past.end(), isLess);
}

ChainLoads::Contact& ChainLoads::find(const TouchingPairs::Name& pair, bool isUnknown) {
    std::int32_t& load = pairs_[pair.number].load;
    if (load == TouchingPairs::none) {
        load = static_cast<std::int32_t>(contacts_.size());
        contacts_.push_back({pair, {}, {}, {}, false, isUnknown});
    }
    return contacts_[static_cast<std::size_t>(load)];
}

void ChainLoads::drop(std::size_t index) noexcept {
    pairs_[contacts_[index].of.number].load = TouchingPairs::none;
    contacts_[index] = contacts_.back();
    contacts_.pop_back();
    if (index < contacts_.size()) pairs_[contacts_[index].of.number].load = static_cast<std::int32_t>(index);
}

} // namespace physvib
