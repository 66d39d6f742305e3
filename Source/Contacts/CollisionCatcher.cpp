// SPDX-License-Identifier: MIT
// Sorts an engine's contact reports into collisions and resting loads.
#include "Contacts/CollisionCatcher.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <span>

namespace physvib {
CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph)
    , pairs_(graph.pairs()) {
    collisions_.reserve(expectedCollisions);
    ends_.reserve(expectedCollisions);
    last_.reserve(expectedCollisions);
    struck_.reserve(2 * expectedCollisions);
}

void CollisionCatcher::beginStep(const StepSpan& span) noexcept {
    span_ = span;
    isStepping_ = true;
}

void CollisionCatcher::settle() {
    isStepping_ = false;
    if (!collisions_.empty() || !last_.empty())
        loads_.settle(); // without a collision no impulse is transmitted
}

void CollisionCatcher::endStep() {
    for (const Aftermath& last : last_) {
        pairs_[last.pair].last = TouchingPairs::none;
        loads_.noteLast(last.pair);
    }
    last_.clear();
    for (const std::uint64_t fixture : struck_) struckNames_.remove(fixture);
    struck_.clear();
    for (const Collision& collision : collisions_) {
        pairs_[collision.pair].collision = TouchingPairs::none;
        pairs_[collision.pair].last = static_cast<std::int32_t>(last_.size());
        loads_.noteLast(collision.pair);
        last_.push_back({collision.pair, {}});
        for (const std::int32_t slot : {collision.a, collision.b}) {
            struck_.push_back(table_[slot].fixture);
            struckNames_.add(struck_.back());
        }
    }
    loads_.endStep();
    pairs_.endStep();
    hasHeard_ = false;
    collisions_.clear();
    ends_.clear();
    directCollisions_ = 0;
    order_ = 0;
}

void CollisionCatcher::forget(std::int32_t slot) noexcept {
    const auto isOf = [slot](const auto& noted) { return noted.a == slot || noted.b == slot; };
    for (const Collision& collision : collisions_) pairs_[collision.pair].collision = TouchingPairs::none;
    std::erase_if(collisions_, isOf);
    directCollisions_ = 0;
    for (std::size_t i = 0; i < collisions_.size(); ++i) {
        pairs_[collisions_[i].pair].collision = static_cast<std::int32_t>(i);
        directCollisions_ += touchesSource(collisions_[i].a, collisions_[i].b) ? 1 : 0;
    }
    std::erase_if(ends_, isOf);
    loads_.forget(slot);
}

std::int32_t CollisionCatcher::begin(std::int32_t a, std::int32_t b) {
    const std::int32_t number = graph_.insert(a, b);
    meet(a, b);
    if (isStepping_ && touchesSource(a, b)) loads_.begin({a, b, number});
    return number;
}

ContactEnd* CollisionCatcher::end(const TouchingPairs::Name& pair) {
    graph_.erase(pair.number);
    if (ends_.size() == maxDirectCollisions + maxDistantCollisions) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = pair.a;
    end.b = pair.b;
    end.order = order_++;
    return &end;
}

void CollisionCatcher::passOver(std::int32_t a, std::int32_t b, double metresPerSecond) noexcept {
    if (!touchesSource(a, b)) return;
    ++tally_.belowThreshold;
    if (std::isfinite(std::min(table_.mobility(a).movableMassKg, table_.mobility(b).movableMassKg)))
        tally_.strongestBelow = std::max(tally_.strongestBelow, metresPerSecond);
    else
        ++tally_.immovable;
}

bool CollisionCatcher::wasStruck(std::int32_t slot) const noexcept {
    const std::uint64_t fixture = table_[slot].fixture;
    return struckNames_.mayHave(fixture) && std::ranges::find(struck_, fixture) != struck_.end();
}

double CollisionCatcher::aftermath(std::int32_t pair) const noexcept {
    const std::int32_t last = pairs_[pair].last;
    return last == TouchingPairs::none
               ? 0.0
               : static_cast<double>(last_[static_cast<std::size_t>(last)].newtonSeconds.length());
}

Collision* CollisionCatcher::strike(const TouchingPairs::Name& pair, double approachMetresPerSecond) {
    hasHeard_ = true;
    const auto [a, b, number] = pair;
    tally_.fastestApproach = std::max(tally_.fastestApproach, approachMetresPerSecond);
    const bool isDirect = touchesSource(a, b);
    const std::size_t count = isDirect ? directCollisions_ : collisions_.size() - directCollisions_;
    const FixtureTable::Mobility &ofA = table_.mobility(a), &ofB = table_.mobility(b);
    const double lighterMassKg = std::min(ofA.movableMassKg, ofB.movableMassKg);
    const double expected = lighterMassKg * approachMetresPerSecond;
    Collision* made = nullptr;
    if (count < (isDirect ? maxDirectCollisions : maxDistantCollisions)) {
        made = &collisions_.emplace_back();
        directCollisions_ += isDirect ? 1 : 0;
    } else {
        ++drops_;
        made = weakest(isDirect);
        if (made->expectedNewtonSeconds >= expected) return nullptr;
        pairs_[made->pair].collision = TouchingPairs::none;
        *made = {};
    }
    pairs_[number].collision = static_cast<std::int32_t>(made - collisions_.data());
    made->pair = number;
    made->a = a;
    made->b = b;
    made->order = order_++;
    made->gravityScale = std::max(ofA.gravityScale, ofB.gravityScale);
    made->lighterMassKg = lighterMassKg;
    made->expectedNewtonSeconds = expected;
    return made;
}

// Linear search, because the list is full only when hundreds of pairs collide at once.
Collision* CollisionCatcher::weakest(bool isDirect) noexcept {
    Collision* found = nullptr;
    for (Collision& collision : collisions_)
        if (touchesSource(collision.a, collision.b) == isDirect &&
            (found == nullptr || collision.expectedNewtonSeconds < found->expectedNewtonSeconds))
            found = &collision;
    return found;
}

ChainLoads::ChainLoads(const FixtureTable& table, TouchingPairs& pairs)
    : table_(table)
    , pairs_(pairs) {
    constexpr std::size_t expectedContacts = 128, expectedLoads = 48; // a load has 160 bytes
    contacts_.reserve(expectedLoads);
    passed_.reserve(expectedContacts);
    receivers_.reserve(expectedContacts);
    ended_.reserve(expectedContacts);
}

ChainLoads::Place& ChainLoads::add(const TouchingPairs::Name& pair, std::int32_t load,
                                   Vector3 newtonSeconds) {
    Contact& contact = load != TouchingPairs::none ? contacts_.data()[load] : meet(pair, true);
    contact.isUnknown = contact.isUnknown && (contact.step == 0 || contact.step == step_);
    noteUsual(contact);
    Place& place = push(contact, contact.of.b == pair.b ? newtonSeconds : -newtonSeconds);
    for (auto* const axis : {&contact.x, &contact.y, &contact.z})
        if (contact.isUnknown) axis->fill((*axis)[contact.newest]);
    return place;
}

inline std::array<float, 4> ChainLoads::Contact::squares() const noexcept {
    using Four = float __attribute__((vector_size(sizeof x)));
    const auto four = [](const std::array<float, 4>& axis) { return std::bit_cast<Four>(axis); };
    return std::bit_cast<std::array<float, 4>>(four(x) * four(x) + four(y) * four(y) + four(z) * four(z));
}

void ChainLoads::settle() {
    passed_.resize(static_cast<std::size_t>(table_.size()));
    const std::span<const Contact> contacts{contacts_};
    const std::uint32_t step = step_;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& contact = contacts[i];
        if (contact.step != step || contact.isUnknown) continue;
        const std::array<float, 4> squares = contact.squares();
        const auto before = [&](unsigned steps) { return (contact.newest - steps) % 4; };
        const unsigned one = before(1), two = before(2), three = before(3),
                       newer = squares[two] < squares[one] ? two : one,
                       load = squares[three] < squares[newer] ? three : newer;
        if (squares[contact.newest] <= squares[load]) continue;
        const Vector3 beyond = contact.push(contact.newest) - contact.push(load);
        const float size = beyond.length();
        pass(contact.of.a, contact.of.b, -beyond, size, i);
        pass(contact.of.b, contact.of.a, beyond, size, i);
    }
}

inline void ChainLoads::pass(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds, float size,
                             std::size_t contact) {
    if (!table_.isCamera(slot)) return;
    Passed& passed = passed_[static_cast<std::size_t>(slot)];
    if (passed.other == FixtureTable::none) {
        receivers_.push_back(slot);
        passed = {newtonSeconds, size, other, contact};
        return;
    }
    passed.newtonSeconds += newtonSeconds;
    if (size <= passed.strongest) return;
    passed.strongest = size;
    passed.other = other;
    passed.contact = contact;
}

// What has ended and pushes no more is dropped, from the last on: sums depend on the order of the others.
void ChainLoads::endStep() {
    for (const std::int32_t slot : receivers_)
        passed_[static_cast<std::size_t>(slot)].other = FixtureTable::none;
    receivers_.clear();
    ended_.clear();
    pairs_.forLoose([&](const TouchingPairs::Pair& pair) {
        if (pair.load != TouchingPairs::none &&
            contacts_[static_cast<std::size_t>(pair.load)].step != step_ && !pair.isTouching())
            ended_.push_back(pair.load);
    });
    std::sort(ended_.begin(), ended_.end(), std::greater<>{});
    ended_.erase(std::unique(ended_.begin(), ended_.end()), ended_.end());
    for (const std::int32_t contact : ended_) drop(static_cast<std::size_t>(contact));
    if (++step_ == 0) step_ = 1;
}

void ChainLoads::forget(std::int32_t slot) noexcept {
    for (std::size_t i = contacts_.size(); i-- > 0;)
        if (contacts_[i].of.a == slot || contacts_[i].of.b == slot) drop(i);
}

ChainLoads::Contact& ChainLoads::meet(const TouchingPairs::Name& pair, bool isUnknown) {
    pairs_[pair.number].load = static_cast<std::int32_t>(contacts_.size());
    noteUsual(contacts_.emplace_back(Contact{.of = pair, .isUnknown = isUnknown}));
    return contacts_.back();
}

void ChainLoads::drop(std::size_t index) noexcept {
    pairs_[contacts_[index].of.number].load = TouchingPairs::none;
    contacts_[index] = contacts_.back();
    contacts_.pop_back();
    if (index < contacts_.size()) pairs_[contacts_[index].of.number].load = static_cast<std::int32_t>(index);
}

} // namespace physvib
