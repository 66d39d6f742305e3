// SPDX-License-Identifier: MIT
// `release` timing: impacts that are pending until their contact ends.
#include "Contacts/ImpactTimings.h"
#include <algorithm>
#include <limits>
#include <utility>

namespace physvib {

ReleaseImpacts::ReleaseImpacts(const CollisionCatcher& catcher, const FixtureTable& table,
                               ContactGraph& graph, const BodyReader& bodies)
    : catcher_(catcher)
    , table_(table)
    , graph_(graph)
    , bodies_(bodies) {
    strikes_.reserve(CollisionCatcher::expectedCollisions);
    reached_.reserve(CollisionCatcher::expectedCollisions);
    impulses_.reserve(CollisionCatcher::expectedCollisions);
}

void ReleaseImpacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    release(false, span, impacts);
    open(span);
    follow();
    followCauses();
    release(true, span, impacts);
    expire(span, impacts);
    std::swap(before_, causes_);
    causes_.clear();
    for (Strike& strike : strikes_) strike.order = -1;
}

void ReleaseImpacts::forget(std::int32_t slot, bool withdraws) noexcept {
    before_.forget(slot);
    const auto isOf = [slot](const Strike& s) { return s.other == slot || s.a == slot || s.b == slot; };
    std::erase_if(strikes_, [&](const Strike& s) { return s.camera == slot || (withdraws && isOf(s)); });
    for (Strike& strike : strikes_) {
        strike.isOver = strike.isOver || isOf(strike);
        if (strike.other == slot) strike.other = FixtureTable::none;
        if (isOf(strike)) strike.a = strike.b = FixtureTable::none;
    }
}

void ReleaseImpacts::open(const StepSpan& span) {
    if (catcher_.collisions().empty()) return;
    underWay_.clear();
    for (const Strike& strike : strikes_) underWay_.set(strike.camera, strike.isDirect ? direct : handedOn);
    findCauses(span);
    for (std::size_t i = 0; i < catcher_.collisions().size(); ++i)
        // 0 for a collision that the user has disabled
        if (impulses_[i] > 0.0) openDirect(catcher_.collisions()[i], span);
    // only haptic sources that touch something can receive transmitted impulses
    graph_.forTouching([&](std::int32_t slot) {
        if (table_.isCamera(slot) && underWay_.find(slot) == SlotMap::none) openHandedOn(slot, span);
    });
}

// Finds the strongest collision of each component, the first of equal ones.
void ReleaseImpacts::findCauses(const StepSpan& span) {
    const std::vector<Collision>& collisions = catcher_.collisions();
    impulses_.resize(collisions.size());
    strongestOf_.clear();
    for (std::size_t i = 0; i < collisions.size(); ++i) {
        const Collision& collision = collisions[i];
        impulses_[i] = collision.impulse();
        if (!span.isStrike(impulses_[i], collision.lighterMassKg, collision.gravityScale)) continue;
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

bool ReleaseImpacts::isStronger(std::int32_t collision, std::int32_t than) const noexcept {
    if (collision == SlotMap::none || than == SlotMap::none) return collision != SlotMap::none;
    const double one = impulses_[static_cast<std::size_t>(collision)],
                 other = impulses_[static_cast<std::size_t>(than)];
    return one != other ? one > other : collision < than;
}

void ReleaseImpacts::openDirect(const Collision& collision, const StepSpan& span) {
    for (const bool isA : {true, false}) {
        const std::int32_t camera = isA ? collision.a : collision.b;
        if (!table_.isCamera(camera)) continue;
        // From now on transmitted impulses cannot be separated from the direct collision.
        if (underWay_.find(camera) == handedOn)
            std::erase_if(strikes_, [camera](const Strike& s) { return s.camera == camera && !s.isDirect; });
        push({camera, isA ? collision.b : collision.a, collision.a, collision.b, collision.order, true, false,
              span.timeNs(collision.fraction), collision.point, isA ? collision.armA : collision.armB,
              isA ? collision.motionA : collision.motionB, collision.lighterMassKg, collision.gravityScale});
    }
}

void ReleaseImpacts::openHandedOn(std::int32_t camera, const StepSpan& span) {
    graph_.reach(camera, reached_);
    std::int32_t strongest = SlotMap::none;
    for (const std::int32_t component : reached_)
        if (const std::int32_t collision = strongestOf_.find(component); isStronger(collision, strongest))
            strongest = collision;
    if (strongest == SlotMap::none) return;
    const Collision* const cause = &catcher_.collisions()[static_cast<std::size_t>(strongest)];
    const ChainLoads::Passed passed = catcher_.loads().passed(camera);
    const bool isKnown = passed.other != FixtureTable::none;
    const Vector3 point = isKnown ? catcher_.loads().pointOf(passed) : cause->point;
    const std::uint64_t body = table_[camera].body.body;
    push({camera, isKnown ? passed.other : cause->a, cause->a, cause->b, cause->order, false, false,
          span.timeNs(cause->fraction), point, inPlane(point) - bodies_.centre(body),
          bodies_.motionBefore(body), std::min(table_.mobility(camera).movableMassKg, cause->lighterMassKg),
          cause->gravityScale});
}

void ReleaseImpacts::push(const Strike& strike) {
    if (strikes_.size() == CollisionCatcher::maxDistantCollisions) {
        ++drops_;
        return;
    }
    strikes_.push_back(strike);
    underWay_.set(strike.camera, strike.isDirect ? direct : handedOn);
}

void ReleaseImpacts::follow() {
    std::int32_t camera = FixtureTable::none;
    Vector2 gained;
    for (Strike& strike : strikes_) {
        if (table_[strike.camera].isDynamic()) continue;
        if (strike.camera != camera) gained = gain(strike.camera);
        camera = strike.camera;
        strike.gained += gained;
    }
}

// Engines spread an impact over two steps.
void ReleaseImpacts::followCauses() {
    before_.follow(catcher_);
    if (causes_.isEmpty() && before_.isEmpty()) return;
    for (Strike& strike : strikes_)
        if (!strike.isDirect)
            strike.causedNewtonSeconds += causes_.find(strike.camera, graph_).newtonSeconds +
                                          before_.find(strike.camera, graph_).aftermath;
}

Vector2 ReleaseImpacts::gain(std::int32_t camera) {
    sums_ = sums_ == std::numeric_limits<std::int32_t>::max() ? 0 : sums_ + 1;
    Vector2 sum;
    graph_.forNeighbours(camera, [&](std::int32_t neighbour) { sum += gainOf(neighbour); });
    for (const Collision& collision : catcher_.collisions()) { // its contact may have ended already
        if (collision.a == camera) sum += gainOf(collision.b);
        if (collision.b == camera) sum += gainOf(collision.a);
    }
    return sum;
}

Vector2 ReleaseImpacts::gainOf(std::int32_t slot) {
    const KnownFixture& known = table_[slot];
    if (!known.isDynamic() || counted_.find(known.body.body) == sums_) return {};
    counted_.set(known.body.body, sums_);
    const Vector2 before = bodies_.motionBefore(known.body.body).metresPerSecond;
    return static_cast<float>(known.massKg()) * (bodies_.motion(known.body.body).metresPerSecond - before);
}

void ReleaseImpacts::release(bool ofThisStep, const StepSpan& span, std::vector<Impact>& impacts) {
    if (catcher_.ends().empty() || strikes_.empty()) return;
    isStruckA_.clear();
    isStruckB_.clear();
    for (const Strike& strike : strikes_) {
        if (strike.a == FixtureTable::none) continue;
        isStruckA_.set(strike.a, 1);
        isStruckB_.set(strike.b, 1);
    }
    for (const ContactEnd& end : catcher_.ends())
        if (isStruckA_.find(end.a) != SlotMap::none && isStruckB_.find(end.b) != SlotMap::none)
            release(end, span, impacts, [&](const Strike& strike) {
                return strike.order < end.order && (strike.order >= 0) == ofThisStep;
            });
}

void ReleaseImpacts::cut(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts) {
    release(end, span, impacts, [](const Strike&) { return true; });
}

template <class Choice>
void ReleaseImpacts::release(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts,
                             Choice choice) {
    const auto isReleased = [&](const Strike& strike) {
        return strike.a == end.a && strike.b == end.b && choice(strike);
    };
    for (const Strike& strike : strikes_) {
        if (!isReleased(strike)) continue;
        const BodyMotion motion = strike.isDirect ? (strike.camera == end.a ? end.motionA : end.motionB)
                                                  : bodies_.motionBefore(table_[strike.camera].body.body);
        finish(strike, motion, span.timeNs(end.fraction), span, impacts);
    }
    std::erase_if(strikes_, isReleased);
}

void ReleaseImpacts::expire(const StepSpan& span, std::vector<Impact>& impacts) {
    const auto isOld = [&](const Strike& strike) {
        return strike.isOver || strike.beginNs + latestNs <= span.endNs;
    };
    for (const Strike& strike : strikes_) {
        if (!isOld(strike)) continue;
        const std::int64_t timeNs = strike.isOver ? span.startNs : strike.beginNs + latestNs;
        finish(strike, bodies_.motion(table_[strike.camera].body.body), std::max(timeNs, span.earliestNs),
               span, impacts);
    }
    std::erase_if(strikes_, isOld);
}

void ReleaseImpacts::finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const {
    for (const Strike& strike : strikes_)
        if (strike.camera == camera)
            finish(strike, bodies_.motion(table_[camera].body.body), span.endNs, span, impacts);
}

void ReleaseImpacts::finish(const Strike& strike, const BodyMotion& end, std::int64_t timeNs,
                            const StepSpan& span, std::vector<Impact>& impacts) const {
    const KnownFixture& camera = table_[strike.camera];
    if (!camera.values.isCamera) return;
    const Vector2 felt = impulse(strike, end);
    auto size = static_cast<double>(felt.length());
    if (!strike.isDirect && camera.isDynamic()) {
        const auto massKg = static_cast<float>(camera.massKg());
        const auto seconds = static_cast<float>(timeNs - strike.beginNs) * 1.0e-9F;
        const Vector2 withoutFall = felt - seconds * massKg * span.gravityMetresPerSecond2;
        size = std::min(size, static_cast<double>(withoutFall.length()));
    }
    if (!strike.isDirect) size = std::min(size, strike.causedNewtonSeconds);
    if (span.isStrike(size, strike.lighterMassKg, strike.gravityScale))
        impacts.push_back({strike.camera, strike.other, timeNs, size, strike.point});
}

Vector2 ReleaseImpacts::impulse(const Strike& strike, const BodyMotion& end) const {
    const KnownFixture& camera = table_[strike.camera];
    if (!camera.isDynamic()) return strike.gained;
    const Vector2 linear =
        static_cast<float>(camera.massKg()) * (end.metresPerSecond - strike.start.metresPerSecond);
    const float length = strike.arm.length();
    if (length <= 0.0F) return linear;
    const auto inertia = static_cast<float>(bodies_.inertia(camera.body.body));
    const float spin = end.radiansPerSecond - strike.start.radiansPerSecond;
    return linear + (inertia * spin / (length * length)) * strike.arm.turnedLeft();
}

} // namespace physvib
