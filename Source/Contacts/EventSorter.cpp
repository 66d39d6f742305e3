// SPDX-License-Identifier: MIT
// Events stay where they arrive; only their places are sorted, when they are let go.
#include "Contacts/EventSorter.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr std::uint64_t tieOf(std::int32_t fixture, std::uint32_t index) noexcept {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(fixture) ^ 0x80000000U) << 32U | index; // those below 0 first
}

} // namespace

EventSorter::EventSorter(std::size_t capacity)
    : capacity_(capacity) {
    held_.reserve(capacity);
    order_.reserve(capacity);
}

void EventSorter::push(const CollisionEvent& event) noexcept {
    const auto isWeaker = [](const CollisionEvent& a, const CollisionEvent& b) { return std::abs(a.amplitude) < std::abs(b.amplitude); };
    if (held_.size() == capacity_) {
        ++drops_;
        const auto weakest = std::min_element(held_.begin(), held_.end(), isWeaker);
        if (weakest == held_.end() || !isWeaker(*weakest, event)) return;
        held_.erase(weakest);
    }
    held_.push_back(event);
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    order_.clear();
    for (std::uint32_t i = 0; i < held_.size(); ++i)
        if (held_[i].timeNs < beforeNs) order_.push_back({held_[i].timeNs, tieOf(held_[i].source.fixture, i)});
    if (order_.empty()) return;
    std::sort(order_.begin(), order_.end());
    for (const Place& place : order_) finished.push_back(held_[place.index()]);
    if (order_.size() == held_.size()) return held_.clear();
    std::erase_if(held_, [beforeNs](const CollisionEvent& event) { return event.timeNs < beforeNs; });
}

void EventSorter::withdraw(std::int32_t fixture, bool asOther) noexcept {
    std::erase_if(held_, [fixture, asOther](const CollisionEvent& event) {
        return event.source.fixture == fixture || (asOther && event.source.other == fixture);
    });
}

} // namespace physvib
