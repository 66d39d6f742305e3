// SPDX-License-Identifier: MIT
// Holds events back until nothing earlier can come, and lets them go in the order of their times.
#pragma once
#include "Core/CollisionEvent.h"
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// Sorted by time, ties by fixture index, then in the order of arrival. Allocates in its constructor only. M
/// only.
class EventSorter {
public:
    explicit EventSorter(std::size_t capacity);

    /// Takes the event in; without room, the weakest of all is dropped and counted.
    void push(const CollisionEvent& event) noexcept;

    /// Appends all events before `beforeNs` to `finished`, and forgets them.
    void release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished);

    /// All of them, whatever their time.
    void flush(std::vector<CollisionEvent>& finished) { release(std::numeric_limits<std::int64_t>::max(), finished); }

    /// Forgets the events of a fixture (by its id), and if `asOther`, those it gave to others.
    void withdraw(std::int32_t fixture, bool asOther) noexcept;

    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Place {
        std::int64_t timeNs;
        std::uint64_t tie; // fixture, then place in held_
        std::uint32_t index() const noexcept { return static_cast<std::uint32_t>(tie); }
        friend bool operator<(const Place& a, const Place& b) noexcept { return a.timeNs != b.timeNs ? a.timeNs < b.timeNs : a.tie < b.tie; }
    };
    std::size_t capacity_;
    std::uint64_t drops_ = 0;
    std::vector<CollisionEvent> held_; // in the order of arrival
    std::vector<Place> order_;
};

} // namespace physvib
