// SPDX-License-Identifier: MIT
// Four steps of impulses per pair of a camera and what touches it.
#include "Contacts/ChainLoads.h"
#include <algorithm>

namespace physvib {

namespace {
constexpr std::size_t expectedContacts = 1024;
}

ChainLoads::ChainLoads()
    : indices_(expectedContacts) {
    contacts_.reserve(expectedContacts);
    passed_.reserve(expectedContacts);
    receivers_.reserve(expectedContacts);
}

void ChainLoads::add(std::int32_t a, std::int32_t b, Vector2 newtonSeconds, Vector2 point) {
    Contact& contact = find(a, b, true);
    contact.now +=
        contact.b == b ? newtonSeconds : -newtonSeconds; // the points and passes of the step, the parts of a chain
    contact.point = point;
    contact.isSolved = true;
}

void ChainLoads::settle() {
    for (const Contact& contact : contacts_) {
        if (!contact.isSolved || contact.isUnknown) continue;
        const Vector2 load = loadOf(contact);
        if (contact.now.lengthSquared() <= load.lengthSquared()) continue;
        pass(contact.a, contact.b, load - contact.now, contact.point);
        pass(contact.b, contact.a, contact.now - load, contact.point);
    }
}

void ChainLoads::pass(std::int32_t slot, std::int32_t other, Vector2 newtonSeconds, Vector2 point) {
    const auto index = static_cast<std::size_t>(slot);
    if (passed_.size() <= index) passed_.resize(index + 1);
    Passed& passed = passed_[index];
    if (passed.other == FixtureTable::none) receivers_.push_back(slot);
    passed.newtonSeconds += newtonSeconds;
    const float size = newtonSeconds.length();
    if (size <= passed.strongest) return;
    passed.strongest = size;
    passed.other = other;
    passed.point = point;
}

void ChainLoads::begin(std::int32_t a, std::int32_t b) {
    find(a, b, false);
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
        } else if (!graph.isTouching(contact.a, contact.b)) {
            drop(i);
        }
    }
}

void ChainLoads::forget(std::int32_t slot) noexcept {
    for (std::size_t i = contacts_.size(); i-- > 0;)
        if (contacts_[i].a == slot || contacts_[i].b == slot) drop(i);
}

Vector2 ChainLoads::loadOf(const Contact& contact) noexcept {
    const auto isLess = [](const Vector2& a, const Vector2& b) {
        return a.lengthSquared() < b.lengthSquared();
    };
    return *std::min_element(contact.past.begin(), contact.past.end(), isLess);
}

ChainLoads::Contact& ChainLoads::find(std::int32_t a, std::int32_t b, bool isUnknown) {
    const std::int32_t known = indices_.find(pairKey(a, b));
    if (known != IntegerMap::none) return contacts_[static_cast<std::size_t>(known)];
    indices_.set(pairKey(a, b), static_cast<std::int32_t>(contacts_.size()));
    contacts_.push_back(
        {a, b, {}, {}, {}, false, isUnknown});
    return contacts_.back();
}

void ChainLoads::drop(std::size_t index) noexcept {
    indices_.erase(pairKey(contacts_[index].a, contacts_[index].b));
    contacts_[index] = contacts_.back();
    contacts_.pop_back();
    if (index < contacts_.size())
        indices_.set(pairKey(contacts_[index].a, contacts_[index].b), static_cast<std::int32_t>(index));
}

} // namespace physvib
