// SPDX-License-Identifier: MIT
// From an engine's words to blows and loads.
#include "Contacts/CollisionCatcher.h"
#include <algorithm>

namespace physvib {

CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph) {
    blows_.reserve(maxDirectBlows + maxDistantBlows);
    ends_.reserve(maxDirectBlows + maxDistantBlows);
    last_.reserve(maxDirectBlows + maxDistantBlows);
}

void CollisionCatcher::beginStep(const StepSpan& span) noexcept {
    span_ = span;
    isStepping_ = true;
}

void CollisionCatcher::settle() {
    isStepping_ = false;
    if (!blows_.empty() || !last_.empty()) loads_.settle(); // else there is nothing to hand on
}

void CollisionCatcher::endStep() {
    if (!last_.empty()) lastOf_.clear();
    last_.assign(blows_.size(), {});
    for (std::size_t i = 0; i < blows_.size(); ++i) {
        blowOf_.erase(pairKey(blows_[i].a, blows_[i].b));
        lastOf_.set(pairKey(blows_[i].a, blows_[i].b), static_cast<std::int32_t>(i));
    }
    loads_.endStep(graph_);
    hasHeard_ = false;
    blows_.clear();
    ends_.clear();
    directBlows_ = 0;
    order_ = 0;
}

void CollisionCatcher::forget(std::int32_t slot) noexcept {
    const auto isOf = [slot](const auto& noted) { return noted.a == slot || noted.b == slot; };
    for (const Blow& blow : blows_) blowOf_.erase(pairKey(blow.a, blow.b));
    std::erase_if(blows_, isOf);
    directBlows_ = 0;
    for (std::size_t i = 0; i < blows_.size(); ++i) {
        blowOf_.set(pairKey(blows_[i].a, blows_[i].b), static_cast<std::int32_t>(i));
        directBlows_ += isFelt(blows_[i].a, blows_[i].b) ? 1 : 0;
    }
    std::erase_if(ends_, isOf);
    loads_.forget(slot);
}

void CollisionCatcher::begin(std::int32_t a, std::int32_t b) {
    graph_.insert(a, b);
    if (isStepping_ && isFelt(a, b)) loads_.begin(a, b);
}

ContactEnd* CollisionCatcher::end(std::int32_t a, std::int32_t b) {
    graph_.erase(a, b);
    if (ends_.size() == ends_.capacity()) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = a;
    end.b = b;
    end.order = order_++;
    return &end;
}

bool CollisionCatcher::isBlow(std::int32_t a, std::int32_t b, double approachMetresPerSecond) const noexcept {
    return approachMetresPerSecond >= span_.leastApproach(gravityScaleOf(a, b));
}

void CollisionCatcher::push(std::int32_t a, std::int32_t b, Vector2 newtonSeconds, Vector2 point) {
    hasHeard_ = true;
    if (const std::int32_t i = last_.empty() ? IntegerMap::none : lastOf_.find(pairKey(a, b)); i != IntegerMap::none) last_[static_cast<std::size_t>(i)] += newtonSeconds;
    if (isFelt(a, b)) loads_.add(a, b, newtonSeconds, point);
}

double CollisionCatcher::aftermath(std::int32_t a, std::int32_t b) const noexcept {
    const std::int32_t i = lastOf_.find(pairKey(a, b));
    return i == IntegerMap::none ? 0.0 : static_cast<double>(last_[static_cast<std::size_t>(i)].length());
}

Blow* CollisionCatcher::strike(std::int32_t a, std::int32_t b, double approachMetresPerSecond) {
    hasHeard_ = true;
    const bool isDirect = isFelt(a, b);
    const std::size_t count = isDirect ? directBlows_ : blows_.size() - directBlows_;
    const double lighterMassKg = std::min(table_[a].movableMassKg(), table_[b].movableMassKg());
    const double expected = lighterMassKg * approachMetresPerSecond;
    Blow* made = nullptr;
    if (count < (isDirect ? maxDirectBlows : maxDistantBlows)) {
        made = &blows_.emplace_back();
        directBlows_ += isDirect ? 1 : 0;
    } else {
        ++drops_;
        made = weakest(isDirect);
        if (made->expectedNewtonSeconds >= expected) return nullptr;
        blowOf_.erase(pairKey(made->a, made->b));
        *made = {};
    }
    blowOf_.set(pairKey(a, b), static_cast<std::int32_t>(made - blows_.data()));
    made->a = a;
    made->b = b;
    made->order = order_++;
    made->gravityScale = gravityScaleOf(a, b);
    made->lighterMassKg = lighterMassKg;
    made->expectedNewtonSeconds = expected;
    return made;
}

// A walk through all of them: there is no room only where hundreds meet at once.
Blow* CollisionCatcher::weakest(bool isDirect) noexcept {
    Blow* found = nullptr;
    for (Blow& blow : blows_)
        if (isFelt(blow.a, blow.b) == isDirect && (found == nullptr || blow.expectedNewtonSeconds < found->expectedNewtonSeconds)) found = &blow;
    return found;
}

Blow* CollisionCatcher::blow(std::int32_t a, std::int32_t b) noexcept {
    const std::int32_t known = blowOf_.find(pairKey(a, b));
    return known == IntegerMap::none ? nullptr : &blows_[static_cast<std::size_t>(known)];
}

bool CollisionCatcher::isFelt(std::int32_t a, std::int32_t b) const noexcept {
    return table_.isCamera(a) || table_.isCamera(b);
}

} // namespace physvib
