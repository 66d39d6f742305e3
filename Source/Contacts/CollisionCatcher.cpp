// SPDX-License-Identifier: MIT
// Sorts an engine's contact reports into collisions and resting loads.
#include "Contacts/CollisionCatcher.h"
#include <algorithm>
#include <cmath>

namespace physvib {

CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph) {}

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
    for (const Aftermath& last : last_) pairs_[last.pair].last = TouchingPairs::none;
    last_.clear();
    for (const std::uint64_t fixture : struck_) struckNames_.remove(fixture);
    struck_.clear();
    for (const Collision& collision : collisions_) {
        pairs_[collision.pair].collision = TouchingPairs::none;
        pairs_[collision.pair].last = static_cast<std::int32_t>(last_.size());
        last_.push_back({collision.pair, {}});
        for (const std::int32_t slot : {collision.a, collision.b}) {
            struck_.push_back(table_[slot].fixture);
            struckNames_.add(struck_.back());
        }
    }
    loads_.endStep(graph_);
    pairs_.endStep(graph_);
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
    pairs_.loosen(slot);
}

void CollisionCatcher::begin(std::int32_t a, std::int32_t b) {
    graph_.insert(a, b);
    meet(a, b);
    if (isStepping_ && touchesSource(a, b)) loads_.begin({a, b, know(a, b)});
}

ContactEnd* CollisionCatcher::end(std::int32_t a, std::int32_t b) {
    graph_.erase(a, b);
    pairs_.loosen(a, b);
    if (ends_.size() == maxDirectCollisions + maxDistantCollisions) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = a;
    end.b = b;
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

} // namespace physvib
