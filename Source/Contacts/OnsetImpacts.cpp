// SPDX-License-Identifier: MIT
// `onset` timing: direct impacts are finished at once, transmitted ones, with their causes, a step later.
#include "Contacts/ImpactTimings.h"
#include <algorithm>
#include <utility>

namespace physvib {
OnsetImpacts::OnsetImpacts(CollisionRecorder& recorder, const FixtureTable& table, ContactGraph& graph)
    : recorder_(recorder)
    , table_(table)
    , graph_(graph) {
    pending_.reserve(CollisionRecorder::expectedCollisions);
}

void OnsetImpacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    addDirect(span, impacts);
    completePending(span, impacts);
    pending_.clear();
    beginTransmitted();
    std::swap(lastCauses_, causes_);
}

void OnsetImpacts::reset() noexcept {
    pending_.clear();
    lastCauses_.clear();
}

void OnsetImpacts::shift(Vector2 offset) noexcept {
    for (TransmittedImpact& transmitted : pending_) transmitted.point += offset;
}

void OnsetImpacts::forget(std::int32_t slot, bool dropsCaused) noexcept {
    lastCauses_.forget(slot);
    std::erase_if(pending_, [&](const TransmittedImpact& transmitted) {
        return transmitted.source == slot ||
               (dropsCaused && (transmitted.a == slot || transmitted.b == slot));
    });
    for (TransmittedImpact& transmitted : pending_)
        if (transmitted.received.other == slot) transmitted.received.other = FixtureTable::none;
}

void OnsetImpacts::addDirect(const StepSpan& span, std::vector<Impact>& impacts) {
    causes_.clear();
    for (const Collision& collision : recorder_.collisions()) {
        const double impulse = collision.impulse();
        if (!span.isImpact(impulse, collision.lighterMassKg, collision.gravityScale)) continue;
        const std::int64_t timeNs = span.timeNs(collision.fraction);
        causes_.add({collision.a, collision.b, collision.pair, timeNs, impulse});
        if (table_.isSource(collision.a))
            impacts.push_back({collision.a, collision.b, timeNs, impulse, collision.point});
        if (table_.isSource(collision.b))
            impacts.push_back({collision.b, collision.a, timeNs, impulse, collision.point});
    }
}

void OnsetImpacts::completePending(const StepSpan& span, std::vector<Impact>& impacts) {
    lastCauses_.addAftermath(recorder_);
    usedSources_.clear();
    usedSources_.ensureSlots(table_.size());
    for (const TransmittedImpact& transmitted : pending_) {
        usedSources_.mark(transmitted.source);
        const auto later = [&] {
            return lastCauses_.find(transmitted.source, graph_).aftermathNewtonSeconds;
        };
        complete(transmitted, recorder_.impulses().transmittedTo(transmitted.source), later, span, impacts);
    }
    if (!lastCauses_.isEmpty()) completeLate(span, impacts);
}

// Haptic sources that transmitted impulses of the last step's collisions reach only in this step.
void OnsetImpacts::completeLate(const StepSpan& span, std::vector<Impact>& impacts) {
    const double defaultThreshold = span.thresholdMetresPerSecond(1.0F);
    lastCauses_.prepare(graph_, table_.size());
    for (const std::int32_t source : recorder_.impulses().receivers()) {
        if (usedSources_.isMarked(source)) continue;
        const ImpactCauses::CauseSum& found = lastCauses_.findPrepared(source, graph_);
        if (found.strongest == nullptr) continue;
        usedSources_.mark(source);
        const TransmittedImpulses::Transmitted& now = recorder_.impulses().transmittedToReceiver(source);
        const Limit limit = limitOf(source, now);
        const double threshold =
            limit.gravityScale == 1.0F ? defaultThreshold : span.thresholdMetresPerSecond(limit.gravityScale);
        const double minImpulse = threshold * limit.lighterMassKg,
                     total = static_cast<double>(now.newtonSeconds.length());
        if (!isImpact(total, now, minImpulse)) continue;
        const double impulse = std::min(total, found.newtonSeconds + found.aftermathNewtonSeconds);
        if (StepSpan::isImpact(impulse, minImpulse))
            impacts.push_back({source, now.other, std::max(span.earliestNs, found.strongest->timeNs), impulse,
                               recorder_.impulses().pointOf(now)});
    }
}

// Threshold values of an impulse that a source received, mainly as `mainPart`.
inline OnsetImpacts::Limit
OnsetImpacts::limitOf(std::int32_t slot, const TransmittedImpulses::Transmitted& mainPart) const noexcept {
    const FixtureTable::Mobility& source = table_.mobility(slot);
    const FixtureTable::Mobility& other =
        mainPart.other == FixtureTable::none ? source : table_.mobility(mainPart.other);
    return {std::min(source.movableMassKg, other.movableMassKg),
            std::max(source.gravityScale, other.gravityScale)};
}

// True for an impact. Otherwise counts it as handed on if its strongest part alone would be one.
inline bool OnsetImpacts::isImpact(double newtonSeconds, const TransmittedImpulses::Transmitted& mainPart,
                                   double minImpulse) const noexcept {
    if (StepSpan::isImpact(newtonSeconds, minImpulse)) return true;
    recorder_.tally().handedOn +=
        StepSpan::isImpact(static_cast<double>(mainPart.strongest), minImpulse) ? 1 : 0;
    return false;
}

// `later` returns the causes' impulse in their second step; it is slow, and called for impacts alone.
template <class Later>
inline void OnsetImpacts::complete(const TransmittedImpact& transmitted,
                                   const TransmittedImpulses::Transmitted& now, Later later,
                                   const StepSpan& span, std::vector<Impact>& impacts) const {
    if (!table_.isSource(transmitted.source)) return;
    const bool isLate = now.strongest > transmitted.received.strongest;
    const TransmittedImpulses::Transmitted& mainPart = isLate ? now : transmitted.received;
    const auto total = static_cast<double>((transmitted.received.newtonSeconds + now.newtonSeconds).length());
    const Limit limit = limitOf(transmitted.source, mainPart);
    const double minImpulse = span.minNewtonSeconds(limit.lighterMassKg, limit.gravityScale);
    if (!isImpact(total, mainPart, minImpulse)) return;
    const double impulse = std::min(total, transmitted.causedNewtonSeconds + later());
    if (StepSpan::isImpact(impulse, minImpulse))
        impacts.push_back({transmitted.source, mainPart.other, std::max(span.earliestNs, transmitted.timeNs),
                           impulse, isLate ? recorder_.impulses().pointOf(now) : transmitted.point});
}

void OnsetImpacts::finish(std::int32_t source, const StepSpan& span, std::vector<Impact>& impacts) const {
    for (const TransmittedImpact& transmitted : pending_)
        if (transmitted.source == source)
            complete(
                transmitted, {}, [] { return 0.0; }, span, impacts);
}

void OnsetImpacts::beginTransmitted() {
    if (causes_.isEmpty()) return;
    causes_.prepare(graph_, table_.size());
    for (const std::int32_t source : recorder_.impulses().receivers()) {
        if (usedSources_.isMarked(source)) continue;
        if (const auto& found = causes_.findPrepared(source, graph_); found.strongest != nullptr) {
            const TransmittedImpulses::Transmitted& received =
                recorder_.impulses().transmittedToReceiver(source);
            pending_.push_back({source, found.strongest->timeNs, found.strongest->a, found.strongest->b,
                                found.newtonSeconds, received, recorder_.impulses().pointOf(received)});
        }
    }
}

ImpactCauses::ImpactCauses() {
    collisions_.reserve(CollisionRecorder::expectedCollisions);
    sums_.reserve(CollisionRecorder::expectedCollisions);
    reachedComponents_.reserve(CollisionRecorder::expectedCollisions);
}

void ImpactCauses::add(const HardCollision& collision) {
    collisions_.push_back(collision);
    areSumsCurrent_ = false;
}

void ImpactCauses::addAftermath(const CollisionRecorder& recorder) {
    areSumsCurrent_ = false; // the graph has changed as well
    for (HardCollision& collision : collisions_)
        collision.aftermathNewtonSeconds = recorder.aftermathNewtonSeconds(collision.pair);
}

void ImpactCauses::sumByComponent(ContactGraph& graph) {
    areSumsCurrent_ = true;
    std::sort(collisions_.begin(), collisions_.end(), [](const HardCollision& a, const HardCollision& b) {
        return a.newtonSeconds != b.newtonSeconds ? a.newtonSeconds > b.newtonSeconds : a.timeNs < b.timeNs;
    });
    sums_.clear();
    sumOf_.clear();
    ownCollisions_.clear();
    for (std::size_t i = 0; i < collisions_.size(); ++i) {
        HardCollision& collision = collisions_[i];
        collision.componentA = graph.component(collision.a);
        collision.componentB = graph.component(collision.b);
        addToSum(collision.componentA, i);
        if (collision.componentB != collision.componentA) addToSum(collision.componentB, i);
    }
    for (std::size_t i = collisions_.size(); i-- > 0;) {
        HardCollision& collision = collisions_[i];
        for (auto [slot, next] :
             {std::pair{collision.a, &collision.nextA}, {collision.b, &collision.nextB}}) {
            *next = ownCollisions_.find(slot);
            ownCollisions_.set(slot, static_cast<std::int32_t>(i));
        }
    }
}

void ImpactCauses::addToSum(std::int32_t component, std::size_t collision) {
    if (component == ContactGraph::noComponent) return;
    std::int32_t index = sumOf_.find(component);
    if (index == SlotMap::none) {
        index = static_cast<std::int32_t>(sums_.size());
        sumOf_.set(component, index);
        sums_.push_back({&collisions_[collision], 0.0, 0.0});
    }
    sums_[static_cast<std::size_t>(index)].newtonSeconds += collisions_[collision].newtonSeconds;
    sums_[static_cast<std::size_t>(index)].aftermathNewtonSeconds +=
        collisions_[collision].aftermathNewtonSeconds;
}

const ImpactCauses::CauseSum& ImpactCauses::findAtSource(std::int32_t source, ContactGraph& graph) {
    CauseSum& found = sourceSum_ = {};
    graph.findComponents(source, reachedComponents_);
    std::size_t strongest = collisions_.size();
    for (const std::int32_t component : reachedComponents_) {
        const std::int32_t index = sumOf_.find(component);
        if (index == SlotMap::none) continue;
        const CauseSum& sum = sums_[static_cast<std::size_t>(index)];
        strongest = std::min(strongest, static_cast<std::size_t>(sum.strongest - collisions_.data()));
        found.newtonSeconds += sum.newtonSeconds;
        found.aftermathNewtonSeconds += sum.aftermathNewtonSeconds;
    }
    if (std::int32_t index = ownCollisions_.find(source); index != SlotMap::none) {
        const auto isOwn = [source](const HardCollision& collision) {
            return collision.a == source || collision.b == source;
        };
        while (index != SlotMap::none) {
            const HardCollision& collision = collisions_[static_cast<std::size_t>(index)];
            index = collision.a == source ? collision.nextA : collision.nextB;
            if (!isReached(collision)) continue;
            found.newtonSeconds -= collision.newtonSeconds;
            found.aftermathNewtonSeconds -= collision.aftermathNewtonSeconds;
        }
        while (strongest < collisions_.size() &&
               (isOwn(collisions_[strongest]) || !isReached(collisions_[strongest])))
            ++strongest;
    }
    if (strongest == collisions_.size()) return found = {};
    found.strongest = &collisions_[strongest];
    return found;
}

void ImpactCauses::forget(std::int32_t slot) noexcept {
    areSumsCurrent_ = false; // indices have changed
    std::erase_if(collisions_, [slot](const HardCollision& collision) {
        return collision.a == slot || collision.b == slot;
    });
}

bool ImpactCauses::isReached(const HardCollision& collision) const noexcept {
    const auto isIn = [&](std::int32_t component) {
        return std::ranges::find(reachedComponents_, component) != reachedComponents_.end();
    };
    return isIn(collision.componentA) || isIn(collision.componentB);
}

} // namespace physvib
