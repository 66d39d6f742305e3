// SPDX-License-Identifier: MIT
// Sorts an engine's contact reports into collisions and resting loads.
#include "Contacts/CollisionCatcher.h"
#include <algorithm>

namespace physvib {

CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph) {
    blows_.reserve(maxDirectBlows + maxDistantBlows);
    ends_.reserve(maxDirectBlows + maxDistantBlows);
    last_.reserve(maxDirectBlows + maxDistantBlows);
    struck_.reserve(2 * (maxDirectBlows + maxDistantBlows));
}

void CollisionCatcher::beginStep(const StepSpan& span) noexcept {
    span_ = span;
    isStepping_ = true;
}

void CollisionCatcher::settle() {
    isStepping_ = false;
    if (!blows_.empty() || !last_.empty()) loads_.settle(); // without a collision no impulse is transmitted
}

void CollisionCatcher::endStep() {
    for (const Aftermath& last : last_) pairs_[last.pair].last = TouchingPairs::none;
    last_.clear();
    for (const std::uint64_t fixture : struck_) struckNames_.remove(fixture);
    struck_.clear();
    for (const Blow& blow : blows_) {
        pairs_[blow.pair].blow = TouchingPairs::none;
        pairs_[blow.pair].last = static_cast<std::int32_t>(last_.size());
        last_.push_back({blow.pair, {}});
        for (const std::int32_t slot : {blow.a, blow.b}) {
            struck_.push_back(table_[slot].fixture);
            struckNames_.add(struck_.back());
        }
    }
    loads_.endStep(graph_);
    pairs_.endStep(graph_);
    hasHeard_ = false;
    blows_.clear();
    ends_.clear();
    directBlows_ = 0;
    order_ = 0;
}

void CollisionCatcher::forget(std::int32_t slot) noexcept {
    const auto isOf = [slot](const auto& noted) { return noted.a == slot || noted.b == slot; };
    for (const Blow& blow : blows_) pairs_[blow.pair].blow = TouchingPairs::none;
    std::erase_if(blows_, isOf);
    directBlows_ = 0;
    for (std::size_t i = 0; i < blows_.size(); ++i) {
        pairs_[blows_[i].pair].blow = static_cast<std::int32_t>(i);
        directBlows_ += isFelt(blows_[i].a, blows_[i].b) ? 1 : 0;
    }
    std::erase_if(ends_, isOf);
    loads_.forget(slot);
    pairs_.loosen(slot);
}

void CollisionCatcher::begin(std::int32_t a, std::int32_t b) {
    graph_.insert(a, b);
    meet(a, b);
    if (isStepping_ && isFelt(a, b)) loads_.begin({a, b, know(a, b)});
}

ContactEnd* CollisionCatcher::end(std::int32_t a, std::int32_t b) {
    graph_.erase(a, b);
    pairs_.loosen(a, b);
    if (ends_.size() == ends_.capacity()) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = a;
    end.b = b;
    end.order = order_++;
    return &end;
}

double CollisionCatcher::aftermath(std::int32_t pair) const noexcept {
    const std::int32_t last = pairs_[pair].last;
    return last == TouchingPairs::none
               ? 0.0
               : static_cast<double>(last_[static_cast<std::size_t>(last)].newtonSeconds.length());
}

Blow* CollisionCatcher::strike(const TouchingPairs::Name& pair, double approachMetresPerSecond) {
    hasHeard_ = true;
    const auto [a, b, number] = pair;
    const bool isDirect = isFelt(a, b);
    const std::size_t count = isDirect ? directBlows_ : blows_.size() - directBlows_;
    const FixtureTable::Mobility &ofA = table_.mobility(a), &ofB = table_.mobility(b);
    const double lighterMassKg = std::min(ofA.movableMassKg, ofB.movableMassKg);
    const double expected = lighterMassKg * approachMetresPerSecond;
    Blow* made = nullptr;
    if (count < (isDirect ? maxDirectBlows : maxDistantBlows)) {
        made = &blows_.emplace_back();
        directBlows_ += isDirect ? 1 : 0;
    } else {
        ++drops_;
        made = weakest(isDirect);
        if (made->expectedNewtonSeconds >= expected) return nullptr;
        pairs_[made->pair].blow = TouchingPairs::none;
        *made = {};
    }
    pairs_[number].blow = static_cast<std::int32_t>(made - blows_.data());
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
Blow* CollisionCatcher::weakest(bool isDirect) noexcept {
    Blow* found = nullptr;
    for (Blow& blow : blows_)
        if (isFelt(blow.a, blow.b) == isDirect &&
            (found == nullptr || blow.expectedNewtonSeconds < found->expectedNewtonSeconds))
            found = &blow;
    return found;
}

} // namespace physvib
