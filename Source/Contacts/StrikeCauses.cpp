// SPDX-License-Identifier: MIT
// Sums the impulses of collisions per component of the contact graph.
#include "Contacts/StrikeCauses.h"
#include <algorithm>
#include <utility>

namespace physvib {

void StrikeCauses::clear() noexcept { strikes_.clear(); }

void StrikeCauses::add(const HardCollision& strike) {
    strikes_.push_back(strike);
    isLocated_ = false;
}

void StrikeCauses::follow(const CollisionCatcher& catcher) {
    isLocated_ = false; // the graph has changed as well
    for (HardCollision& strike : strikes_) strike.aftermath = catcher.aftermath(strike.pair);
}

void StrikeCauses::locate(ContactGraph& graph) {
    if (std::exchange(isLocated_, true)) return;
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
        sums_.push_back({strike, 0.0, 0.0});
    }
    sums_[static_cast<std::size_t>(at)].newtonSeconds += strikes_[strike].newtonSeconds;
    sums_[static_cast<std::size_t>(at)].aftermath += strikes_[strike].aftermath;
}

StrikeCauses::Found StrikeCauses::find(std::int32_t camera, ContactGraph& graph) {
    if (strikes_.empty()) return {};
    locate(graph);
    if (graph.isPassing(camera) && struck_.find(camera) == SlotMap::none) { // the usual case
        const std::int32_t at = sumOf_.find(graph.component(camera));
        if (at == SlotMap::none) return {};
        const Sum& sum = sums_[static_cast<std::size_t>(at)];
        return {&strikes_[sum.strongest], sum.newtonSeconds, sum.aftermath};
    }
    Found found;
    graph.reach(camera, reached_);
    std::size_t strongest = strikes_.size();
    for (const std::int32_t component : reached_) {
        const std::int32_t at = sumOf_.find(component);
        if (at == SlotMap::none) continue;
        const Sum& sum = sums_[static_cast<std::size_t>(at)];
        strongest = std::min(strongest, sum.strongest);
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
    if (strongest == strikes_.size()) return {};
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
        return component != ContactGraph::noComponent &&
               std::find(reached_.begin(), reached_.end(), component) != reached_.end();
    };
    return isIn(strike.componentA) || isIn(strike.componentB);
}

} // namespace physvib
