// SPDX-License-Identifier: MIT
// Sorts indices of the held events when they are released; the events themselves do not move.
#include "Contacts/EventSorter.h"
#include <algorithm>
#include <cmath>
#include <new>

namespace physvib {

// Doubles. What follows in the same step then needs no memory.
bool EventSorter::grow() noexcept {
    constexpr std::size_t least = 64;
    const std::size_t before = held_.size(), count = std::min(capacity_, std::max(least, 2 * before));
    if (before == count) return false;
    try {
        for (auto* const list : {&order_, &other_}) list->reserve(count);
        free_.reserve(count);
        waiting_.reserve(count);
        ends_.reserve(count + 2);
        held_.resize(count);
    } catch (const std::bad_alloc&) {
        return false;
    }
    for (std::size_t slot = count; slot-- > before;) free_.push_back(static_cast<std::uint32_t>(slot));
    return true;
}

void EventSorter::forget(std::size_t place) noexcept {
    free_.push_back(waiting_[place].slot);
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(place));
}

bool EventSorter::dropWeakest(double amplitude) noexcept {
    ++drops_;
    const auto amplitudeOf = [this](const Waiting& each) { return std::abs(held_[each.slot].amplitude); };
    const auto weakest = std::ranges::min_element(waiting_, {}, amplitudeOf);
    if (weakest == waiting_.end() || !(amplitudeOf(*weakest) < std::abs(amplitude))) return false;
    forget(static_cast<std::size_t>(weakest - waiting_.begin()));
    return true;
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    order_.clear();
    std::size_t kept = 0;
    for (const Waiting& each : waiting_) {
        if (each.timeNs < beforeNs)
            order_.push_back({each, static_cast<std::uint32_t>(order_.size()), 0});
        else
            waiting_[kept++] = each;
    }
    waiting_.resize(kept);
    sort();
    for (const Place& place : order_) {
        finished.push_back(held_[place.slot]);
        free_.push_back(place.slot);
    }
}

// Bucket sort by time: grains arrive by hundreds per step, evenly distributed, so each bucket has few entries
// to sort.
void EventSorter::sort() {
    constexpr std::size_t many = 64;
    const std::size_t count = order_.size();
    if (count < many) return std::sort(order_.begin(), order_.end());
    const auto [first, last] = std::ranges::minmax(order_, {}, &Place::timeNs);
    const auto startNs = static_cast<double>(first.timeNs);
    const double rangeNs = static_cast<double>(last.timeNs) - startNs;
    const double sharesPerNs = static_cast<double>(count) / (rangeNs + 1.0);
    ends_.assign(count + 2, 0); // rounding may give one bucket more
    for (Place& place : order_) {
        place.share = static_cast<std::uint32_t>((static_cast<double>(place.timeNs) - startNs) * sharesPerNs);
        ++ends_[place.share + 1];
    }
    for (std::size_t i = 1; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
    other_.resize(count);
    for (const Place& place : order_) other_[ends_[place.share]++] = place; // ends_: begins become ends
    order_.swap(other_);
    auto begin = order_.begin();
    for (const std::uint32_t place : ends_) {
        const auto end = order_.begin() + static_cast<std::ptrdiff_t>(place);
        if (end - begin > 1) std::sort(begin, end);
        begin = end;
    }
}

void EventSorter::withdraw(std::int32_t fixture, bool asOther) noexcept {
    for (std::size_t i = waiting_.size(); i-- > 0;) {
        const CollisionSource& source = held_[waiting_[i].slot].source;
        if (source.fixture == fixture || (asOther && source.other == fixture)) forget(i);
    }
}

} // namespace physvib
