// SPDX-License-Identifier: MIT
// `onset` timing: direct impacts are finished at once, transmitted ones a step later.
#include "Contacts/ImpactTimings.h"
#include <algorithm>
#include <utility>

namespace physvib {
OnsetImpacts::OnsetImpacts(CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph)
    : catcher_(catcher)
    , table_(table)
    , graph_(graph) {
    waiting_.reserve(CollisionCatcher::expectedCollisions);
}

void OnsetImpacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    strike(span, impacts);
    complete(span, impacts);
    waiting_.clear();
    begin();
    std::swap(before_, strikes_);
}

void OnsetImpacts::reset() noexcept {
    waiting_.clear();
    before_.clear();
}

void OnsetImpacts::shift(Vector2 by) noexcept {
    for (HandedOn& handedOn : waiting_) handedOn.point += by;
}

void OnsetImpacts::forget(std::int32_t slot, bool withdraws) noexcept {
    before_.forget(slot);
    std::erase_if(waiting_, [&](const HandedOn& handedOn) {
        return handedOn.camera == slot || (withdraws && (handedOn.a == slot || handedOn.b == slot));
    });
    for (HandedOn& handedOn : waiting_)
        if (handedOn.passed.other == slot) handedOn.passed.other = FixtureTable::none;
}

void OnsetImpacts::strike(const StepSpan& span, std::vector<Impact>& impacts) {
    strikes_.clear();
    for (const Collision& collision : catcher_.collisions()) {
        const double impulse = collision.impulse();
        if (!span.isStrike(impulse, collision.lighterMassKg, collision.gravityScale)) continue;
        const std::int64_t timeNs = span.timeNs(collision.fraction);
        strikes_.add({collision.a, collision.b, collision.pair, timeNs, impulse});
        if (table_.isCamera(collision.a))
            impacts.push_back({collision.a, collision.b, timeNs, impulse, collision.point});
        if (table_.isCamera(collision.b))
            impacts.push_back({collision.b, collision.a, timeNs, impulse, collision.point});
    }
}

void OnsetImpacts::complete(const StepSpan& span, std::vector<Impact>& impacts) {
    before_.follow(catcher_);
    isUsed_.clear();
    isUsed_.fit(table_.size());
    for (const HandedOn& handedOn : waiting_) {
        isUsed_.mark(handedOn.camera);
        const auto later = [&] { return before_.find(handedOn.camera, graph_).aftermath; };
        complete(handedOn, catcher_.loads().passed(handedOn.camera), later, span, impacts);
    }
    if (!before_.isEmpty()) completeLate(span, impacts);
}

// Haptic sources that transmitted impulses of the last step's collisions reach only in this step.
void OnsetImpacts::completeLate(const StepSpan& span, std::vector<Impact>& impacts) {
    const double usual = span.thresholdMetresPerSecond(1.0F);
    before_.prepare(graph_, table_.size());
    for (const std::int32_t camera : catcher_.loads().receivers()) {
        if (isUsed_.isMarked(camera)) continue;
        const StrikeCauses::Found& found = before_.findPrepared(camera, graph_);
        if (found.strongest == nullptr) continue;
        isUsed_.mark(camera);
        const ChainLoads::Passed& now = catcher_.loads().received(camera);
        const Limit limit = limitOf(camera, now);
        const double threshold =
            limit.gravityScale == 1.0F ? usual : span.thresholdMetresPerSecond(limit.gravityScale);
        const double least = threshold * limit.lighterMassKg,
                     whole = static_cast<double>(now.newtonSeconds.length());
        if (!isWhole(whole, now, least)) continue;
        const double impulse = std::min(whole, found.newtonSeconds + found.aftermath);
        if (StepSpan::isStrike(impulse, least))
            impacts.push_back({camera, now.other, std::max(span.earliestNs, found.strongest->timeNs), impulse,
                               catcher_.loads().pointOf(now)});
    }
}

// Of what a source received, most of it as `main`.
inline OnsetImpacts::Limit OnsetImpacts::limitOf(std::int32_t slot,
                                                 const ChainLoads::Passed& main) const noexcept {
    const FixtureTable::Mobility& camera = table_.mobility(slot);
    const FixtureTable::Mobility& other =
        main.other == FixtureTable::none ? camera : table_.mobility(main.other);
    return {std::min(camera.movableMassKg, other.movableMassKg),
            std::max(camera.gravityScale, other.gravityScale)};
}

// True if it is an impact; counts what is none although its strongest part would be one.
inline bool OnsetImpacts::isWhole(double newtonSeconds, const ChainLoads::Passed& main,
                                  double least) const noexcept {
    if (StepSpan::isStrike(newtonSeconds, least)) return true;
    catcher_.tally().handedOn += StepSpan::isStrike(static_cast<double>(main.strongest), least) ? 1 : 0;
    return false;
}

// `later` returns the causes' impulse in their second step; called only where that could matter: seldom.
template <class Later>
inline void OnsetImpacts::complete(const HandedOn& handedOn, const ChainLoads::Passed& now, Later later,
                                   const StepSpan& span, std::vector<Impact>& impacts) const {
    if (!table_.isCamera(handedOn.camera)) return;
    const bool isLate = now.strongest > handedOn.passed.strongest;
    const ChainLoads::Passed& main = isLate ? now : handedOn.passed;
    const auto whole = static_cast<double>((handedOn.passed.newtonSeconds + now.newtonSeconds).length());
    const Limit limit = limitOf(handedOn.camera, main);
    const double least = span.leastNewtonSeconds(limit.lighterMassKg, limit.gravityScale);
    if (!isWhole(whole, main, least)) return;
    const double impulse = std::min(whole, handedOn.causedNewtonSeconds + later());
    if (StepSpan::isStrike(impulse, least))
        impacts.push_back({handedOn.camera, main.other, std::max(span.earliestNs, handedOn.timeNs), impulse,
                           isLate ? catcher_.loads().pointOf(now) : handedOn.point});
}

void OnsetImpacts::finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const {
    for (const HandedOn& handedOn : waiting_)
        if (handedOn.camera == camera)
            complete(
                handedOn, {}, [] { return 0.0; }, span, impacts);
}

void OnsetImpacts::begin() {
    if (strikes_.isEmpty()) return;
    strikes_.prepare(graph_, table_.size());
    for (const std::int32_t camera : catcher_.loads().receivers()) {
        if (isUsed_.isMarked(camera)) continue;
        if (const auto& found = strikes_.findPrepared(camera, graph_); found.strongest != nullptr) {
            const ChainLoads::Passed& passed = catcher_.loads().received(camera);
            waiting_.push_back({camera, found.strongest->timeNs, found.strongest->a, found.strongest->b,
                                found.newtonSeconds, passed, catcher_.loads().pointOf(passed)});
        }
    }
}

StrikeCauses::StrikeCauses() {
    strikes_.reserve(CollisionCatcher::expectedCollisions);
    sums_.reserve(CollisionCatcher::expectedCollisions);
    reached_.reserve(CollisionCatcher::expectedCollisions);
}

void StrikeCauses::add(const HardCollision& strike) {
    strikes_.push_back(strike);
    isLocated_ = false;
}

void StrikeCauses::follow(const CollisionCatcher& catcher) {
    isLocated_ = false; // the graph has changed as well
    for (HardCollision& strike : strikes_) strike.aftermath = catcher.aftermath(strike.pair);
}

void StrikeCauses::locate(ContactGraph& graph) {
    isLocated_ = true;
    std::sort(strikes_.begin(), strikes_.end(), [](const HardCollision& one, const HardCollision& two) {
        return one.newtonSeconds != two.newtonSeconds ? one.newtonSeconds > two.newtonSeconds
                                                      : one.timeNs < two.timeNs;
    });
    sums_.clear();
    sumOf_.clear();
    struck_.clear();
    for (std::size_t i = 0; i < strikes_.size(); ++i) {
        HardCollision& strike = strikes_[i];
        strike.componentA = graph.component(strike.a);
        strike.componentB = graph.component(strike.b);
        sum(strike.componentA, i);
        if (strike.componentB != strike.componentA) sum(strike.componentB, i);
    }
    for (std::size_t i = strikes_.size(); i-- > 0;) {
        HardCollision& strike = strikes_[i];
        for (auto [slot, next] : {std::pair{strike.a, &strike.nextA}, {strike.b, &strike.nextB}}) {
            *next = struck_.find(slot);
            struck_.set(slot, static_cast<std::int32_t>(i));
        }
    }
}

void StrikeCauses::sum(std::int32_t component, std::size_t strike) {
    if (component == ContactGraph::noComponent) return;
    std::int32_t at = sumOf_.find(component);
    if (at == SlotMap::none) {
        at = static_cast<std::int32_t>(sums_.size());
        sumOf_.set(component, at);
        sums_.push_back({&strikes_[strike], 0.0, 0.0});
    }
    sums_[static_cast<std::size_t>(at)].newtonSeconds += strikes_[strike].newtonSeconds;
    sums_[static_cast<std::size_t>(at)].aftermath += strikes_[strike].aftermath;
}

const StrikeCauses::Found& StrikeCauses::findAround(std::int32_t camera, ContactGraph& graph) {
    Found& found = around_ = {};
    graph.reach(camera, reached_);
    std::size_t strongest = strikes_.size();
    for (const std::int32_t component : reached_) {
        const std::int32_t at = sumOf_.find(component);
        if (at == SlotMap::none) continue;
        const Found& sum = sums_[static_cast<std::size_t>(at)];
        strongest = std::min(strongest, static_cast<std::size_t>(sum.strongest - strikes_.data()));
        found.newtonSeconds += sum.newtonSeconds;
        found.aftermath += sum.aftermath;
    }
    if (std::int32_t own = struck_.find(camera); own != SlotMap::none) {
        const auto isOwn = [camera](const HardCollision& strike) {
            return strike.a == camera || strike.b == camera;
        };
        while (own != SlotMap::none) {
            const HardCollision& strike = strikes_[static_cast<std::size_t>(own)];
            own = strike.a == camera ? strike.nextA : strike.nextB;
            if (!isReached(strike)) continue;
            found.newtonSeconds -= strike.newtonSeconds;
            found.aftermath -= strike.aftermath;
        }
        while (strongest < strikes_.size() && (isOwn(strikes_[strongest]) || !isReached(strikes_[strongest])))
            ++strongest;
    }
    if (strongest == strikes_.size()) return found = {};
    found.strongest = &strikes_[strongest];
    return found;
}

void StrikeCauses::forget(std::int32_t slot) noexcept {
    isLocated_ = false; // indices have changed
    std::erase_if(strikes_,
                  [slot](const HardCollision& strike) { return strike.a == slot || strike.b == slot; });
}

bool StrikeCauses::isReached(const HardCollision& strike) const noexcept {
    const auto isIn = [&](std::int32_t component) {
        return std::ranges::find(reached_, component) != reached_.end();
    };
    return isIn(strike.componentA) || isIn(strike.componentB);
}

} // namespace physvib
