// SPDX-License-Identifier: MIT
// Sums of strikes by component.
#include "Contacts/StrikeCauses.h"
#include <algorithm>

namespace physvib {

namespace {

std::uint64_t keyOf(std::int32_t number) noexcept { return static_cast<std::uint64_t>(number) + 1; } // a key is not 0

} // namespace

StrikeCauses::StrikeCauses() {
    constexpr std::size_t most = CollisionCatcher::maxDirectBlows + CollisionCatcher::maxDistantBlows;
    strikes_.reserve(most);
    sums_.reserve(most);
    reached_.reserve(most);
}

void StrikeCauses::clear() noexcept { strikes_.clear(); }

void StrikeCauses::follow(const CollisionCatcher& catcher) {
    for (HardBlow& strike : strikes_) strike.aftermath = catcher.aftermath(strike.a, strike.b);
}

void StrikeCauses::locate(ContactGraph& graph) {
    std::sort(strikes_.begin(), strikes_.end(), [](const HardBlow& one, const HardBlow& two) {
        return one.newtonSeconds != two.newtonSeconds ? one.newtonSeconds > two.newtonSeconds : one.timeNs < two.timeNs;
    });
    sums_.clear();
    sumOf_.clear();
    struck_.clear();
    for (std::size_t i = 0; i < strikes_.size(); ++i) {
        HardBlow& strike = strikes_[i];
        strike.componentA = graph.component(strike.a);
        strike.componentB = graph.component(strike.b);
        sum(strike.componentA, i);
        if (strike.componentB != strike.componentA) sum(strike.componentB, i);
        for (const std::int32_t slot : {strike.a, strike.b}) struck_.set(keyOf(slot), 0);
    }
}

void StrikeCauses::sum(std::int32_t component, std::size_t strike) {
    if (component == ContactGraph::noComponent) return;
    std::int32_t at = sumOf_.find(keyOf(component));
    if (at == IntegerMap::none) {
        at = static_cast<std::int32_t>(sums_.size());
        sumOf_.set(keyOf(component), at);
        sums_.push_back({strike, 0.0, 0.0});
    }
    sums_[static_cast<std::size_t>(at)].newtonSeconds += strikes_[strike].newtonSeconds;
    sums_[static_cast<std::size_t>(at)].aftermath += strikes_[strike].aftermath;
}

StrikeCauses::Found StrikeCauses::find(std::int32_t camera, ContactGraph& graph) {
    graph.reach(camera, reached_);
    Found found;
    std::size_t strongest = strikes_.size();
    for (const std::int32_t component : reached_) {
        const std::int32_t at = sumOf_.find(keyOf(component));
        if (at == IntegerMap::none) continue;
        const Sum& sum = sums_[static_cast<std::size_t>(at)];
        strongest = std::min(strongest, sum.strongest);
        found.newtonSeconds += sum.newtonSeconds;
        found.aftermath += sum.aftermath;
    }
    if (struck_.find(keyOf(camera)) != IntegerMap::none) {
        const auto isOwn = [camera](const HardBlow& strike) { return strike.a == camera || strike.b == camera; };
        for (const HardBlow& strike : strikes_) {
            if (!isOwn(strike) || !isReached(strike)) continue;
            found.newtonSeconds -= strike.newtonSeconds;
            found.aftermath -= strike.aftermath;
        }
        while (strongest < strikes_.size() && (isOwn(strikes_[strongest]) || !isReached(strikes_[strongest]))) ++strongest;
    }
    if (strongest == strikes_.size()) return {};
    found.strongest = &strikes_[strongest];
    return found;
}

void StrikeCauses::forget(std::int32_t slot) noexcept {
    std::erase_if(strikes_, [slot](const HardBlow& strike) { return strike.a == slot || strike.b == slot; });
}

bool StrikeCauses::isReached(const HardBlow& strike) const noexcept {
    const auto isIn = [&](std::int32_t component) {
        return component != ContactGraph::noComponent && std::find(reached_.begin(), reached_.end(), component) != reached_.end();
    };
    return isIn(strike.componentA) || isIn(strike.componentB);
}

} // namespace physvib
