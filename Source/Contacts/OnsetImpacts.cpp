// SPDX-License-Identifier: MIT
// Direct strikes at once; what is handed on one step later.
#include "Contacts/OnsetImpacts.h"
#include <algorithm>

namespace physvib {

OnsetImpacts::OnsetImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph)
    : catcher_(catcher)
    , table_(table)
    , graph_(graph) {
    strikes_.reserve(CollisionCatcher::maxDirectRecords + CollisionCatcher::maxDistantRecords);
    for (std::vector<HandedOn>* each : {&waiting_, &begun_})
        each->reserve(CollisionCatcher::maxDirectRecords);
    reached_.reserve(CollisionCatcher::maxDirectRecords);
}

void OnsetImpacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    strike(span, impacts);
    complete(span, impacts);
    begun_.clear();
    if (!strikes_.empty()) begin();
    waiting_.swap(begun_);
}

void OnsetImpacts::forget(std::int32_t slot, bool withdraws) noexcept {
    std::erase_if(waiting_, [&](const HandedOn& handedOn) {
        const bool isOf = handedOn.strike.a == slot || handedOn.strike.b == slot;
        return handedOn.camera == slot || (withdraws && isOf);
    });
    for (HandedOn& handedOn : waiting_)
        if (handedOn.passed.other == slot) handedOn.passed.other = FixtureTable::none;
}

void OnsetImpacts::strike(const StepSpan& span, std::vector<Impact>& impacts) {
    strikes_.clear();
    for (const ContactRecord& record : catcher_.records()) {
        const double impulse = record.impulse();
        if (!span.isStrike(impulse, record.lighterMassKg)) continue;
        const std::int64_t timeNs = span.timeNs(record.fraction);
        strikes_.push_back({record.a, record.b, timeNs, impulse, 0, 0});
        if (table_[record.a].values.isCamera)
            impacts.push_back({record.a, record.b, timeNs, impulse, record.point});
        if (table_[record.b].values.isCamera)
            impacts.push_back({record.b, record.a, timeNs, impulse, record.point});
    }
}

void OnsetImpacts::complete(const StepSpan& span, std::vector<Impact>& impacts) {
    isUsed_.assign(static_cast<std::size_t>(table_.size()), false);
    for (const HandedOn& handedOn : waiting_) {
        isUsed_[static_cast<std::size_t>(handedOn.camera)] = true;
        const ChainLoads::Passed& now = catcher_.loads().passed(handedOn.camera);
        const ChainLoads::Passed& main = now.strongest > handedOn.passed.strongest ? now : handedOn.passed;
        const auto impulse =
            static_cast<double>((handedOn.passed.newtonSeconds + now.newtonSeconds).length());
        const KnownFixture& camera = table_[handedOn.camera];
        const double others =
            main.other == FixtureTable::none ? camera.movableMassKg() : table_[main.other].movableMassKg();
        if (camera.values.isCamera && span.isStrike(impulse, std::min(camera.movableMassKg(), others)))
            impacts.push_back({handedOn.camera, main.other, std::max(span.earliestNs, handedOn.strike.timeNs),
                               impulse, main.point});
    }
}

void OnsetImpacts::begin() {
    for (Strike& strike : strikes_) {
        strike.componentA = graph_.component(strike.a);
        strike.componentB = graph_.component(strike.b);
    }
    std::sort(strikes_.begin(), strikes_.end(), [](const Strike& one, const Strike& two) {
        return one.newtonSeconds != two.newtonSeconds ? one.newtonSeconds > two.newtonSeconds
                                                      : one.timeNs < two.timeNs;
    });
    for (const std::int32_t camera : table_.cameras()) {
        const Strike* strike = table_[camera].values.isCamera ? cause(camera) : nullptr;
        if (strike == nullptr) continue;
        begun_.push_back({camera, *strike, {}});
        if (!isUsed_[static_cast<std::size_t>(camera)])
            begun_.back().passed = catcher_.loads().passed(camera);
    }
}

const OnsetImpacts::Strike* OnsetImpacts::cause(std::int32_t camera) {
    graph_.reach(camera, reached_);
    const auto isCause = [&](const Strike& strike) {
        return strike.a != camera && strike.b != camera &&
               (isReached(strike.componentA) || isReached(strike.componentB));
    };
    const auto found = std::find_if(strikes_.begin(), strikes_.end(), isCause);
    return found == strikes_.end() ? nullptr : &*found;
}

bool OnsetImpacts::isReached(std::int32_t component) const noexcept {
    return component != ContactGraph::noComponent &&
           std::find(reached_.begin(), reached_.end(), component) != reached_.end();
}

} // namespace physvib
