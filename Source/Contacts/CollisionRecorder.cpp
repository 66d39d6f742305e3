// SPDX-License-Identifier: MIT
// Sorts an engine's contact reports into collisions and resting loads, and sums transmitted impulses.
#include "Contacts/CollisionRecorder.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <span>

namespace physvib {
CollisionRecorder::CollisionRecorder(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph)
    , pairs_(graph.pairs()) {
    collisions_.reserve(expectedCollisions);
    ends_.reserve(expectedCollisions);
    aftermaths_.reserve(expectedCollisions);
    struckIds_.reserve(2 * expectedCollisions);
}

void CollisionRecorder::beginStep(const StepSpan& span) noexcept {
    span_ = span;
    isStepping_ = true;
}

void CollisionRecorder::endReports() {
    isStepping_ = false;
    if (!collisions_.empty() || !aftermaths_.empty())
        impulses_.endReports(); // without a collision no impulse is transmitted
}

void CollisionRecorder::endStep() {
    for (const Aftermath& aftermath : aftermaths_) {
        pairs_[aftermath.pair].lastIndex = TouchingPairs::none;
        impulses_.updateLast(aftermath.pair);
    }
    aftermaths_.clear();
    for (const std::uint64_t fixture : struckIds_) struckFilter_.remove(fixture);
    struckIds_.clear();
    for (const Collision& collision : collisions_) {
        pairs_[collision.pair].collisionIndex = TouchingPairs::none;
        pairs_[collision.pair].lastIndex = static_cast<std::int32_t>(aftermaths_.size());
        impulses_.updateLast(collision.pair);
        aftermaths_.push_back({collision.pair, {}});
        for (const std::int32_t slot : {collision.a, collision.b}) {
            struckIds_.push_back(table_[slot].fixture);
            struckFilter_.add(struckIds_.back());
        }
    }
    impulses_.endStep();
    pairs_.endStep();
    hasReports_ = false;
    collisions_.clear();
    ends_.clear();
    directCollisions_ = 0;
    order_ = 0;
}

void CollisionRecorder::forget(std::int32_t slot) noexcept {
    const auto involves = [slot](const auto& record) { return record.a == slot || record.b == slot; };
    for (const Collision& collision : collisions_)
        pairs_[collision.pair].collisionIndex = TouchingPairs::none;
    std::erase_if(collisions_, involves);
    directCollisions_ = 0;
    for (std::size_t i = 0; i < collisions_.size(); ++i) {
        pairs_[collisions_[i].pair].collisionIndex = static_cast<std::int32_t>(i);
        directCollisions_ += touchesSource(collisions_[i].a, collisions_[i].b) ? 1 : 0;
    }
    std::erase_if(ends_, involves);
    impulses_.forget(slot);
}

std::int32_t CollisionRecorder::begin(std::int32_t a, std::int32_t b) {
    const std::int32_t number = graph_.insert(a, b);
    countContact(a, b);
    if (isStepping_ && touchesSource(a, b)) impulses_.begin({a, b, number});
    return number;
}

ContactEnd* CollisionRecorder::end(const TouchingPairs::Handle& pair) {
    graph_.erase(pair.number);
    if (ends_.size() == maxDirectCollisions + maxDistantCollisions) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = pair.a;
    end.b = pair.b;
    end.order = order_++;
    return &end;
}

void CollisionRecorder::countBelowThreshold(std::int32_t a, std::int32_t b, double metresPerSecond) noexcept {
    if (!touchesSource(a, b)) return;
    ++tally_.belowThreshold;
    if (std::isfinite(std::min(table_.mobility(a).movableMassKg, table_.mobility(b).movableMassKg)))
        tally_.strongestBelowMetresPerSecond =
            std::max(tally_.strongestBelowMetresPerSecond, metresPerSecond);
    else
        ++tally_.immovable;
}

bool CollisionRecorder::collidedInLastStep(std::int32_t slot) const noexcept {
    const std::uint64_t fixture = table_[slot].fixture;
    return struckFilter_.mayContain(fixture) && std::ranges::find(struckIds_, fixture) != struckIds_.end();
}

double CollisionRecorder::aftermathNewtonSeconds(std::int32_t pair) const noexcept {
    const std::int32_t index = pairs_[pair].lastIndex;
    return index == TouchingPairs::none
               ? 0.0
               : static_cast<double>(aftermaths_[static_cast<std::size_t>(index)].newtonSeconds.length());
}

Collision* CollisionRecorder::addCollision(const TouchingPairs::Handle& pair,
                                           double approachMetresPerSecond) {
    hasReports_ = true;
    const auto [a, b, number] = pair;
    tally_.fastestApproachMetresPerSecond =
        std::max(tally_.fastestApproachMetresPerSecond, approachMetresPerSecond);
    const bool isDirect = touchesSource(a, b);
    const std::size_t count = isDirect ? directCollisions_ : collisions_.size() - directCollisions_;
    const FixtureTable::Mobility &mobilityA = table_.mobility(a), &mobilityB = table_.mobility(b);
    const double lighterMassKg = std::min(mobilityA.movableMassKg, mobilityB.movableMassKg);
    const double expected = lighterMassKg * approachMetresPerSecond;
    Collision* collision = nullptr;
    if (count < (isDirect ? maxDirectCollisions : maxDistantCollisions)) {
        collision = &collisions_.emplace_back();
        directCollisions_ += isDirect ? 1 : 0;
    } else {
        ++drops_;
        collision = findWeakest(isDirect);
        if (collision->expectedNewtonSeconds >= expected) return nullptr;
        pairs_[collision->pair].collisionIndex = TouchingPairs::none;
        *collision = {};
    }
    pairs_[number].collisionIndex = static_cast<std::int32_t>(collision - collisions_.data());
    collision->pair = number;
    collision->a = a;
    collision->b = b;
    collision->order = order_++;
    collision->gravityScale = std::max(mobilityA.gravityScale, mobilityB.gravityScale);
    collision->lighterMassKg = lighterMassKg;
    collision->expectedNewtonSeconds = expected;
    return collision;
}

// Linear search, because the list is full only when hundreds of pairs collide at once.
Collision* CollisionRecorder::findWeakest(bool isDirect) noexcept {
    Collision* found = nullptr;
    for (Collision& collision : collisions_)
        if (touchesSource(collision.a, collision.b) == isDirect &&
            (found == nullptr || collision.expectedNewtonSeconds < found->expectedNewtonSeconds))
            found = &collision;
    return found;
}

TransmittedImpulses::TransmittedImpulses(const FixtureTable& table, TouchingPairs& pairs)
    : table_(table)
    , pairs_(pairs) {
    constexpr std::size_t expectedContacts = 128, expectedLoads = 48; // a load has 160 bytes
    contacts_.reserve(expectedLoads);
    transmitted_.reserve(expectedContacts);
    receivers_.reserve(expectedContacts);
    endedLoads_.reserve(expectedContacts);
}

TransmittedImpulses::Place& TransmittedImpulses::add(const TouchingPairs::Handle& pair, std::int32_t load,
                                                     Vector3 newtonSeconds) {
    Contact& contact = load != TouchingPairs::none ? contacts_.data()[load] : addContact(pair, true);
    contact.isUnknown = contact.isUnknown && (contact.step == 0 || contact.step == step_);
    updateSteady(contact);
    Place& place = push(contact, contact.pair.b == pair.b ? newtonSeconds : -newtonSeconds);
    for (auto* const axis : {&contact.x, &contact.y, &contact.z})
        if (contact.isUnknown) axis->fill((*axis)[contact.newest]);
    return place;
}

inline std::array<float, 4> TransmittedImpulses::Contact::squares() const noexcept {
    using Four = float __attribute__((vector_size(sizeof x)));
    const auto four = [](const std::array<float, 4>& axis) { return std::bit_cast<Four>(axis); };
    return std::bit_cast<std::array<float, 4>>(four(x) * four(x) + four(y) * four(y) + four(z) * four(z));
}

// The load is the smallest of a contact's impulses in the last three steps; both sources receive the excess.
void TransmittedImpulses::endReports() {
    transmitted_.resize(static_cast<std::size_t>(table_.size()));
    const std::span<const Contact> contacts{contacts_};
    const std::uint32_t step = step_;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& contact = contacts[i];
        if (contact.step != step || contact.isUnknown) continue;
        const std::array<float, 4> squares = contact.squares();
        const auto indexAgo = [&](unsigned steps) { return (contact.newest - steps) % 4; };
        const unsigned oneAgo = indexAgo(1), twoAgo = indexAgo(2), threeAgo = indexAgo(3),
                       newer = squares[twoAgo] < squares[oneAgo] ? twoAgo : oneAgo,
                       load = squares[threeAgo] < squares[newer] ? threeAgo : newer;
        if (squares[contact.newest] <= squares[load]) continue;
        const Vector3 excess = contact.impulse(contact.newest) - contact.impulse(load);
        const float magnitude = excess.length();
        addReceived(contact.pair.a, contact.pair.b, -excess, magnitude, i);
        addReceived(contact.pair.b, contact.pair.a, excess, magnitude, i);
    }
}

inline void TransmittedImpulses::addReceived(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds,
                                             float magnitude, std::size_t contact) {
    if (!table_.isSource(slot)) return;
    Transmitted& received = transmitted_[static_cast<std::size_t>(slot)];
    if (received.other == FixtureTable::none) {
        receivers_.push_back(slot);
        received = {newtonSeconds, magnitude, other, contact};
        return;
    }
    received.newtonSeconds += newtonSeconds;
    if (magnitude <= received.strongest) return;
    received.strongest = magnitude;
    received.other = other;
    received.contact = contact;
}

// Drops contacts that have ended and push no more, from the last one on: sums depend on the others' order.
void TransmittedImpulses::endStep() {
    for (const std::int32_t slot : receivers_)
        transmitted_[static_cast<std::size_t>(slot)].other = FixtureTable::none;
    receivers_.clear();
    endedLoads_.clear();
    pairs_.forEachReleaseCandidate([&](const TouchingPairs::Pair& pair) {
        if (pair.loadIndex != TouchingPairs::none &&
            contacts_[static_cast<std::size_t>(pair.loadIndex)].step != step_ && !pair.isTouching())
            endedLoads_.push_back(pair.loadIndex);
    });
    std::sort(endedLoads_.begin(), endedLoads_.end(), std::greater<>{});
    endedLoads_.erase(std::unique(endedLoads_.begin(), endedLoads_.end()), endedLoads_.end());
    for (const std::int32_t contact : endedLoads_) drop(static_cast<std::size_t>(contact));
    if (++step_ == 0) step_ = 1;
}

void TransmittedImpulses::forget(std::int32_t slot) noexcept {
    for (std::size_t i = contacts_.size(); i-- > 0;)
        if (contacts_[i].pair.a == slot || contacts_[i].pair.b == slot) drop(i);
}

TransmittedImpulses::Contact& TransmittedImpulses::addContact(const TouchingPairs::Handle& pair,
                                                              bool isUnknown) {
    pairs_[pair.number].loadIndex = static_cast<std::int32_t>(contacts_.size());
    updateSteady(contacts_.emplace_back(Contact{.pair = pair, .isUnknown = isUnknown}));
    return contacts_.back();
}

void TransmittedImpulses::drop(std::size_t index) noexcept {
    pairs_[contacts_[index].pair.number].loadIndex = TouchingPairs::none;
    contacts_[index] = contacts_.back();
    contacts_.pop_back();
    if (index < contacts_.size())
        pairs_[contacts_[index].pair.number].loadIndex = static_cast<std::int32_t>(index);
}

} // namespace physvib
