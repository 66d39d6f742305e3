// SPDX-License-Identifier: MIT
// Tracks the impulses of the last steps per contact of a haptic source, and subtracts the resting load.
#include "Contacts/ChainLoads.h"

namespace physvib {

namespace {
constexpr std::size_t expectedContacts = 128;
}

ChainLoads::ChainLoads(const FixtureTable& table, TouchingPairs& pairs)
    : table_(table)
    , pairs_(pairs) {
    contacts_.reserve(expectedContacts);
    pasts_.reserve(expectedContacts);
    passed_.reserve(expectedContacts);
    receivers_.reserve(expectedContacts);
}

void ChainLoads::settle() {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const Contact& contact = contacts_[i];
        const Vector3 load = pasts_[i].load;
        if (!contact.isSolved || contact.isUnknown || contact.now.lengthSquared() <= load.lengthSquared())
            continue;
        const TouchingPairs::Name& of = pasts_[i].of;
        const Vector3 beyond = contact.now - load;
        const float size = beyond.length();
        pass(of.a, of.b, -beyond, size, contact.point);
        pass(of.b, of.a, beyond, size, contact.point);
    }
}

void ChainLoads::pass(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds, float size,
                      Vector3 point) {
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
        Past& past = pasts_[i];
        if (contact.isSolved) {
            if (contact.isUnknown) past.pushed.fill(contact.now);
            past.pushed = {contact.now, past.pushed[0], past.pushed[1]};
            past.load = smallestOf(past.pushed);
            contact.now = {};
            contact.isSolved = contact.isUnknown = false;
        } else if (!graph.isTouching(past.of.a, past.of.b)) {
            drop(i);
        }
    }
}

void ChainLoads::forget(std::int32_t slot) noexcept {
    for (std::size_t i = pasts_.size(); i-- > 0;)
        if (pasts_[i].of.a == slot || pasts_[i].of.b == slot) drop(i);
}

// Without branches, which could not be predicted here.
Vector3 ChainLoads::smallestOf(const std::array<Vector3, 3>& pushed) noexcept {
    const float squared[] = {pushed[0].lengthSquared(), pushed[1].lengthSquared(), pushed[2].lengthSquared()};
    const auto ofNewer = static_cast<std::size_t>(squared[1] < squared[0]);
    return pushed[squared[2] < squared[ofNewer] ? 2 : ofNewer];
}

ChainLoads::Contact& ChainLoads::meet(const TouchingPairs::Name& pair, bool isUnknown) {
    pairs_[pair.number].load = static_cast<std::int32_t>(contacts_.size());
    pasts_.push_back({pair});
    return contacts_.emplace_back(Contact{{}, {}, pair.b, false, isUnknown});
}

void ChainLoads::drop(std::size_t index) noexcept {
    pairs_[pasts_[index].of.number].load = TouchingPairs::none;
    contacts_[index] = contacts_.back();
    pasts_[index] = pasts_.back();
    contacts_.pop_back();
    pasts_.pop_back();
    if (index < pasts_.size()) pairs_[pasts_[index].of.number].load = static_cast<std::int32_t>(index);
}

} // namespace physvib
