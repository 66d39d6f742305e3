// SPDX-License-Identifier: MIT
// `release` timing: impacts that are pending until their contact ends.
#include "Contacts/ImpactTimings.h"
#include <algorithm>
#include <limits>
#include <utility>

namespace physvib {

ReleaseImpacts::ReleaseImpacts(const CollisionRecorder& recorder, const FixtureTable& table,
                               ContactGraph& graph, const BodyReader& bodies)
    : recorder_(recorder)
    , table_(table)
    , graph_(graph)
    , bodies_(bodies) {
    pending_.reserve(CollisionRecorder::expectedCollisions);
    reachedComponents_.reserve(CollisionRecorder::expectedCollisions);
    impulses_.reserve(CollisionRecorder::expectedCollisions);
}

void ReleaseImpacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    release(false, span, impacts);
    beginPending(span);
    addMomentumChanges();
    addCausedImpulses();
    release(true, span, impacts);
    expire(span, impacts);
    std::swap(lastCauses_, causes_);
    causes_.clear();
    for (PendingImpact& pending : pending_) pending.order = -1;
}

void ReleaseImpacts::forget(std::int32_t slot, bool dropsCaused) noexcept {
    lastCauses_.forget(slot);
    const auto involves = [slot](const PendingImpact& s) {
        return s.other == slot || s.a == slot || s.b == slot;
    };
    std::erase_if(pending_,
                  [&](const PendingImpact& s) { return s.source == slot || (dropsCaused && involves(s)); });
    for (PendingImpact& pending : pending_) {
        pending.hasEnded = pending.hasEnded || involves(pending);
        if (pending.other == slot) pending.other = FixtureTable::none;
        if (involves(pending)) pending.a = pending.b = FixtureTable::none;
    }
}

void ReleaseImpacts::beginPending(const StepSpan& span) {
    if (recorder_.collisions().empty()) return;
    pendingKindOf_.clear();
    for (const PendingImpact& pending : pending_)
        pendingKindOf_.set(pending.source, pending.isDirect ? direct : transmitted);
    findCauses(span);
    for (std::size_t i = 0; i < recorder_.collisions().size(); ++i)
        // 0 for a collision that the user has disabled
        if (impulses_[i] > 0.0) beginDirect(recorder_.collisions()[i], span);
    // only haptic sources that touch something can receive transmitted impulses
    graph_.forEachTouching([&](std::int32_t slot) {
        if (table_.isSource(slot) && pendingKindOf_.find(slot) == SlotMap::none) beginTransmitted(slot, span);
    });
}

// Finds the strongest collision of each component, the first of equal ones.
void ReleaseImpacts::findCauses(const StepSpan& span) {
    const std::vector<Collision>& collisions = recorder_.collisions();
    impulses_.resize(collisions.size());
    strongestOf_.clear();
    for (std::size_t i = 0; i < collisions.size(); ++i) {
        const Collision& collision = collisions[i];
        impulses_[i] = collision.impulse();
        if (!span.isImpact(impulses_[i], collision.lighterMassKg, collision.gravityScale)) continue;
        causes_.add(
            {collision.a, collision.b, collision.pair, span.timeNs(collision.fraction), impulses_[i]});
        for (const std::int32_t slot : {collision.a, collision.b}) {
            const std::int32_t component = graph_.component(slot);
            if (component != ContactGraph::noComponent &&
                isStronger(static_cast<std::int32_t>(i), strongestOf_.find(component)))
                strongestOf_.set(component, static_cast<std::int32_t>(i));
        }
    }
}

bool ReleaseImpacts::isStronger(std::int32_t collision, std::int32_t rival) const noexcept {
    if (collision == SlotMap::none || rival == SlotMap::none) return collision != SlotMap::none;
    const double first = impulses_[static_cast<std::size_t>(collision)],
                 second = impulses_[static_cast<std::size_t>(rival)];
    return first != second ? first > second : collision < rival;
}

void ReleaseImpacts::beginDirect(const Collision& collision, const StepSpan& span) {
    for (const bool isA : {true, false}) {
        const std::int32_t source = isA ? collision.a : collision.b;
        if (!table_.isSource(source)) continue;
        // From now on transmitted impulses cannot be separated from the direct collision.
        if (pendingKindOf_.find(source) == transmitted)
            std::erase_if(pending_,
                          [source](const PendingImpact& s) { return s.source == source && !s.isDirect; });
        push({source, isA ? collision.b : collision.a, collision.a, collision.b, collision.order, true, false,
              span.timeNs(collision.fraction), collision.point, isA ? collision.armA : collision.armB,
              isA ? collision.motionA : collision.motionB, collision.lighterMassKg, collision.gravityScale});
    }
}

void ReleaseImpacts::beginTransmitted(std::int32_t source, const StepSpan& span) {
    graph_.findComponents(source, reachedComponents_);
    std::int32_t strongest = SlotMap::none;
    for (const std::int32_t component : reachedComponents_)
        if (const std::int32_t collision = strongestOf_.find(component); isStronger(collision, strongest))
            strongest = collision;
    if (strongest == SlotMap::none) return;
    const Collision* const cause = &recorder_.collisions()[static_cast<std::size_t>(strongest)];
    const TransmittedImpulses::Transmitted received = recorder_.impulses().transmittedTo(source);
    const bool isKnown = received.other != FixtureTable::none;
    const Vector3 point = isKnown ? recorder_.impulses().pointOf(received) : cause->point;
    const std::uint64_t body = table_[source].body.body;
    push({source, isKnown ? received.other : cause->a, cause->a, cause->b, cause->order, false, false,
          span.timeNs(cause->fraction), point, inPlane(point) - bodies_.centre(body),
          bodies_.motionBefore(body), std::min(table_.mobility(source).movableMassKg, cause->lighterMassKg),
          cause->gravityScale});
}

void ReleaseImpacts::push(const PendingImpact& pending) {
    if (pending_.size() == CollisionRecorder::maxDistantCollisions) {
        ++drops_;
        return;
    }
    pending_.push_back(pending);
    pendingKindOf_.set(pending.source, pending.isDirect ? direct : transmitted);
}

void ReleaseImpacts::addMomentumChanges() {
    std::int32_t source = FixtureTable::none;
    Vector2 gainedMomentum;
    for (PendingImpact& pending : pending_) {
        if (table_[pending.source].isDynamic()) continue;
        if (pending.source != source) gainedMomentum = momentumChange(pending.source);
        source = pending.source;
        pending.gainedMomentum += gainedMomentum;
    }
}

// Engines spread an impact over two steps.
void ReleaseImpacts::addCausedImpulses() {
    lastCauses_.addAftermath(recorder_);
    if (causes_.isEmpty() && lastCauses_.isEmpty()) return;
    for (PendingImpact& pending : pending_)
        if (!pending.isDirect)
            pending.causedNewtonSeconds += causes_.find(pending.source, graph_).newtonSeconds +
                                           lastCauses_.find(pending.source, graph_).aftermathNewtonSeconds;
}

Vector2 ReleaseImpacts::momentumChange(std::int32_t source) {
    momentumSums_ = momentumSums_ == std::numeric_limits<std::int32_t>::max() ? 0 : momentumSums_ + 1;
    Vector2 sum;
    graph_.forEachNeighbour(source, [&](std::int32_t neighbour) { sum += momentumChangeOf(neighbour); });
    for (const Collision& collision : recorder_.collisions()) { // its contact may have ended already
        if (collision.a == source) sum += momentumChangeOf(collision.b);
        if (collision.b == source) sum += momentumChangeOf(collision.a);
    }
    return sum;
}

Vector2 ReleaseImpacts::momentumChangeOf(std::int32_t slot) {
    const FixtureEntry& known = table_[slot];
    if (!known.isDynamic() || lastSumOf_.find(known.body.body) == momentumSums_) return {};
    lastSumOf_.set(known.body.body, momentumSums_);
    const Vector2 before = bodies_.motionBefore(known.body.body).metresPerSecond;
    return static_cast<float>(known.massKg()) * (bodies_.motion(known.body.body).metresPerSecond - before);
}

void ReleaseImpacts::release(bool beganThisStep, const StepSpan& span, std::vector<Impact>& impacts) {
    if (recorder_.ends().empty() || pending_.empty()) return;
    struckA_.clear();
    struckB_.clear();
    for (const PendingImpact& pending : pending_) {
        if (pending.a == FixtureTable::none) continue;
        struckA_.set(pending.a, 1);
        struckB_.set(pending.b, 1);
    }
    for (const ContactEnd& end : recorder_.ends())
        if (struckA_.find(end.a) != SlotMap::none && struckB_.find(end.b) != SlotMap::none)
            release(end, span, impacts, [&](const PendingImpact& pending) {
                return pending.order < end.order && (pending.order >= 0) == beganThisStep;
            });
}

void ReleaseImpacts::endOutsideStep(const ContactEnd& end, const StepSpan& span,
                                    std::vector<Impact>& impacts) {
    release(end, span, impacts, [](const PendingImpact&) { return true; });
}

template <class Filter>
void ReleaseImpacts::release(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts,
                             Filter filter) {
    const auto isReleased = [&](const PendingImpact& pending) {
        return pending.a == end.a && pending.b == end.b && filter(pending);
    };
    for (const PendingImpact& pending : pending_) {
        if (!isReleased(pending)) continue;
        const BodyMotion motion = pending.isDirect ? (pending.source == end.a ? end.motionA : end.motionB)
                                                   : bodies_.motionBefore(table_[pending.source].body.body);
        finish(pending, motion, span.timeNs(end.fraction), span, impacts);
    }
    std::erase_if(pending_, isReleased);
}

void ReleaseImpacts::expire(const StepSpan& span, std::vector<Impact>& impacts) {
    const auto isExpired = [&](const PendingImpact& pending) {
        return pending.hasEnded || pending.beginNs + latestNs <= span.endNs;
    };
    for (const PendingImpact& pending : pending_) {
        if (!isExpired(pending)) continue;
        const std::int64_t timeNs = pending.hasEnded ? span.startNs : pending.beginNs + latestNs;
        finish(pending, bodies_.motion(table_[pending.source].body.body), std::max(timeNs, span.earliestNs),
               span, impacts);
    }
    std::erase_if(pending_, isExpired);
}

void ReleaseImpacts::finish(std::int32_t source, const StepSpan& span, std::vector<Impact>& impacts) const {
    for (const PendingImpact& pending : pending_)
        if (pending.source == source)
            finish(pending, bodies_.motion(table_[source].body.body), span.endNs, span, impacts);
}

void ReleaseImpacts::finish(const PendingImpact& pending, const BodyMotion& end, std::int64_t timeNs,
                            const StepSpan& span, std::vector<Impact>& impacts) const {
    const FixtureEntry& source = table_[pending.source];
    if (!source.values.isCamera) return;
    const Vector2 impulseChange = impulse(pending, end);
    auto newtonSeconds = static_cast<double>(impulseChange.length());
    if (!pending.isDirect && source.isDynamic()) {
        const auto massKg = static_cast<float>(source.massKg());
        const auto seconds = static_cast<float>(timeNs - pending.beginNs) * 1.0e-9F;
        const Vector2 withoutFall = impulseChange - seconds * massKg * span.gravityMetresPerSecond2;
        newtonSeconds = std::min(newtonSeconds, static_cast<double>(withoutFall.length()));
    }
    if (!pending.isDirect) newtonSeconds = std::min(newtonSeconds, pending.causedNewtonSeconds);
    if (span.isImpact(newtonSeconds, pending.lighterMassKg, pending.gravityScale))
        impacts.push_back({pending.source, pending.other, timeNs, newtonSeconds, pending.point});
}

Vector2 ReleaseImpacts::impulse(const PendingImpact& pending, const BodyMotion& end) const {
    const FixtureEntry& source = table_[pending.source];
    if (!source.isDynamic()) return pending.gainedMomentum;
    const Vector2 linear =
        static_cast<float>(source.massKg()) * (end.metresPerSecond - pending.start.metresPerSecond);
    const float length = pending.arm.length();
    if (length <= 0.0F) return linear;
    const auto inertia = static_cast<float>(bodies_.inertia(source.body.body));
    const float spin = end.radiansPerSecond - pending.start.radiansPerSecond;
    return linear + (inertia * spin / (length * length)) * pending.arm.turnedLeft();
}

} // namespace physvib
