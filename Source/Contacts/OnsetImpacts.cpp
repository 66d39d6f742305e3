// SPDX-License-Identifier: MIT
// `onset` timing: direct impacts are finished at once, transmitted ones a step later.
#include "Contacts/OnsetImpacts.h"
#include <algorithm>
#include <utility>

namespace physvib {

OnsetImpacts::OnsetImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph)
    : catcher_(catcher)
    , table_(table)
    , graph_(graph) {}

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
    for (HandedOn& handedOn : waiting_) handedOn.passed.point += by;
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
        strikes_.add({collision.a, collision.b, collision.pair, timeNs, impulse, 0.0, 0, 0, SlotMap::none,
                      SlotMap::none});
        if (table_.isCamera(collision.a))
            impacts.push_back({collision.a, collision.b, timeNs, impulse, collision.point});
        if (table_.isCamera(collision.b))
            impacts.push_back({collision.b, collision.a, timeNs, impulse, collision.point});
    }
}

void OnsetImpacts::complete(const StepSpan& span, std::vector<Impact>& impacts) {
    before_.follow(catcher_);
    isUsed_.clear();
    for (const HandedOn& handedOn : waiting_) {
        isUsed_.set(handedOn.camera, 1);
        const auto later = [&] { return before_.find(handedOn.camera, graph_).aftermath; };
        complete(handedOn, catcher_.loads().passed(handedOn.camera), later, span, impacts);
    }
    if (!before_.isEmpty()) completeLate(span, impacts);
}

// Haptic sources that transmitted impulses of the last step's collisions reach only in this step.
void OnsetImpacts::completeLate(const StepSpan& span, std::vector<Impact>& impacts) {
    for (const std::int32_t camera : catcher_.loads().receivers()) {
        if (isUsed_.find(camera) != SlotMap::none) continue;
        const StrikeCauses::Found found = before_.find(camera, graph_);
        if (found.strongest == nullptr) continue;
        isUsed_.set(camera, 1);
        complete(
            handOn(camera, found, {}), catcher_.loads().passed(camera), [&] { return found.aftermath; }, span,
            impacts);
    }
}

// `later` returns the causes' impulse in their second step; it is called only where that could matter, which
// is rare.
template <class Later>
void OnsetImpacts::complete(const HandedOn& handedOn, const ChainLoads::Passed& now, Later later,
                            const StepSpan& span, std::vector<Impact>& impacts) const {
    if (!table_.isCamera(handedOn.camera)) return;
    const ChainLoads::Passed& main = now.strongest > handedOn.passed.strongest ? now : handedOn.passed;
    const auto whole = static_cast<double>((handedOn.passed.newtonSeconds + now.newtonSeconds).length());
    const FixtureTable::Mobility& camera = table_.mobility(handedOn.camera);
    const FixtureTable::Mobility& other =
        main.other == FixtureTable::none ? camera : table_.mobility(main.other);
    const double lighter = std::min(camera.movableMassKg, other.movableMassKg);
    const float gravityScale = std::max(camera.gravityScale, other.gravityScale);
    if (!span.isStrike(whole, lighter, gravityScale)) return;
    const double impulse = std::min(whole, handedOn.causedNewtonSeconds + later());
    if (span.isStrike(impulse, lighter, gravityScale))
        impacts.push_back(
            {handedOn.camera, main.other, std::max(span.earliestNs, handedOn.timeNs), impulse, main.point});
}

void OnsetImpacts::finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const {
    for (const HandedOn& handedOn : waiting_)
        if (handedOn.camera == camera)
            complete(
                handedOn, {}, [] { return 0.0; }, span, impacts);
}

void OnsetImpacts::begin() {
    if (strikes_.isEmpty()) return;
    for (const std::int32_t camera : catcher_.loads().receivers()) {
        if (isUsed_.find(camera) != SlotMap::none) continue;
        if (const StrikeCauses::Found found = strikes_.find(camera, graph_); found.strongest != nullptr)
            waiting_.push_back(handOn(camera, found, catcher_.loads().passed(camera)));
    }
}

OnsetImpacts::HandedOn OnsetImpacts::handOn(std::int32_t camera, const StrikeCauses::Found& found,
                                            const ChainLoads::Passed& passed) noexcept {
    return {camera, found.strongest->timeNs, found.strongest->a, found.strongest->b, found.newtonSeconds,
            passed};
}

} // namespace physvib
