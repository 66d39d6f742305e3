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
    void push(const CollisionEvent& event) noexcept {
        if (free_.empty() && !dropWeakest(event.amplitude)) return;
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        held_[slot] = event;
        waiting_.push_back({event.timeNs, event.source.fixture, slot});
    }

    /// Appends all events before `beforeNs` to `finished`, and forgets them.
    void release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished);

    /// All of them, whatever their time.
    void flush(std::vector<CollisionEvent>& finished) {
        release(std::numeric_limits<std::int64_t>::max(), finished);
    }

    /// Forgets the events of a fixture (by its id), and if `asOther`, those it gave to others.
    void withdraw(std::int32_t fixture, bool asOther) noexcept;

    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Waiting {
        std::int64_t timeNs;
        std::int32_t fixture;
        std::uint32_t slot; // of held_
    };
    struct Place : Waiting {
        std::uint32_t arrival; // among those that go
        std::uint32_t share;   // of the time
        friend bool operator<(const Place& a, const Place& b) noexcept {
            if (a.timeNs != b.timeNs) return a.timeNs < b.timeNs;
            return a.fixture != b.fixture ? a.fixture < b.fixture : a.arrival < b.arrival;
        }
    };
    bool dropWeakest(double amplitude) noexcept; // of those that are weaker
    void sort();
    void forget(std::size_t place) noexcept;

    std::uint64_t drops_ = 0;
    std::vector<CollisionEvent> held_; // an event stays in its slot until it goes
    std::vector<std::uint32_t> free_;  // slots
    std::vector<Waiting> waiting_;     // in the order of arrival
    std::vector<Place> order_, other_; // of those that go
    std::vector<std::uint32_t> ends_;  // of shares of the time among them
};

} // namespace physvib
