// SPDX-License-Identifier: MIT
// Events stay where they arrive; only their places are sorted, when they are let go.
#include "Contacts/EventSorter.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {

EventSorter::EventSorter(std::size_t capacity)
    : capacity_(capacity)
    , held_(capacity) {
    free_.reserve(capacity);
    waiting_.reserve(capacity);
    order_.reserve(capacity);
    other_.resize(capacity);
    for (std::size_t slot = capacity; slot-- > 0;) free_.push_back(static_cast<std::uint32_t>(slot));
}

void EventSorter::forget(std::size_t place) noexcept {
    free_.push_back(waiting_[place].slot);
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(place));
}

void EventSorter::push(const CollisionEvent& event) noexcept {
    if (free_.empty()) {
        ++drops_;
        const auto amplitudeOf = [this](const Place& place) { return std::abs(held_[place.slot].amplitude); };
        const auto weakest = std::ranges::min_element(waiting_, {}, amplitudeOf);
        if (weakest == waiting_.end() || !(amplitudeOf(*weakest) < std::abs(event.amplitude))) return;
        forget(static_cast<std::size_t>(weakest - waiting_.begin()));
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    held_[slot] = event;
    waiting_.push_back({event.timeNs, event.source.fixture, slot, arrivals_++});
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    order_.clear();
    std::size_t kept = 0;
    for (const Place& place : waiting_) {
        if (place.timeNs < beforeNs) order_.push_back(place);
        else waiting_[kept++] = place;
    }
    waiting_.resize(kept);
    sort();
    for (const Place& place : order_) {
        finished.push_back(held_[place.slot]);
        free_.push_back(place.slot);
    }
}

// Grains come by hundreds in a step of 10^7 ns: sorted by the digits of their times, which keeps the order of arrival.
void EventSorter::sort() {
    constexpr std::size_t many = 64;
    if (order_.size() < many) return std::sort(order_.begin(), order_.end());
    const auto [first, last] = std::ranges::minmax(order_, {}, &Place::timeNs);
    const std::int64_t start = first.timeNs;
    const auto range = static_cast<std::uint64_t>(last.timeNs) - static_cast<std::uint64_t>(start);
    if (range >> 32U != 0) return std::sort(order_.begin(), order_.end());
    for (unsigned shift = 0; shift < 32 && range >> shift != 0; shift += 8) {
        const auto digit = [start, shift](const Place& place) { return static_cast<std::size_t>(static_cast<std::uint64_t>(place.timeNs - start) >> shift & 255U); };
        std::array<std::uint32_t, 257> begin{};
        for (const Place& place : order_) ++begin[digit(place) + 1];
        for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
        for (const Place& place : order_) other_[begin[digit(place)]++] = place;
        std::copy_n(other_.begin(), order_.size(), order_.begin());
    }
    for (auto run = order_.begin(); run != order_.end();) { // of one time: by fixture
        const auto end = std::find_if(run, order_.end(), [run](const Place& place) { return place.timeNs != run->timeNs; });
        std::sort(run, end);
        run = end;
    }
}

void EventSorter::withdraw(std::int32_t fixture, bool asOther) noexcept {
    for (std::size_t i = waiting_.size(); i-- > 0;) {
        const CollisionSource& source = held_[waiting_[i].slot].source;
        if (source.fixture == fixture || (asOther && source.other == fixture)) forget(i);
    }
}

} // namespace physvib
