// SPDX-License-Identifier: MIT
// Insertion into a sorted array: stable, and nothing is allocated, as std::stable_sort would.
#include "Contacts/EventSorter.h"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace physvib {

EventSorter::EventSorter(std::size_t capacity)
    : capacity_(capacity) {
    held_.reserve(capacity);
}

void EventSorter::push(const CollisionEvent& event) noexcept {
    const auto isWeaker = [](const CollisionEvent& a, const CollisionEvent& b) { return std::abs(a.amplitude) < std::abs(b.amplitude); };
    if (held_.size() == capacity_) {
        ++drops_;
        const auto weakest = std::min_element(held_.begin(), held_.end(), isWeaker);
        if (weakest == held_.end() || !isWeaker(*weakest, event)) return;
        held_.erase(weakest);
    }
    const auto isBefore = [](const CollisionEvent& a, const CollisionEvent& b) {
        return std::tie(a.timeNs, a.source.fixture) < std::tie(b.timeNs, b.source.fixture);
    };
    held_.insert(std::upper_bound(held_.begin(), held_.end(), event, isBefore), event);
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    const auto isEarly = [beforeNs](const CollisionEvent& event) { return event.timeNs < beforeNs; };
    const auto end = std::partition_point(held_.begin(), held_.end(), isEarly);
    finished.insert(finished.end(), held_.begin(), end);
    held_.erase(held_.begin(), end);
}

void EventSorter::flush(std::vector<CollisionEvent>& finished) {
    finished.insert(finished.end(), held_.begin(), held_.end());
    held_.clear();
}

void EventSorter::withdraw(std::int32_t fixture, bool asOther) noexcept {
    std::erase_if(held_, [fixture, asOther](const CollisionEvent& event) {
        return event.source.fixture == fixture || (asOther && event.source.other == fixture);
    });
}

} // namespace physvib
