// SPDX-License-Identifier: MIT
// Holds events until no earlier one can arrive, and releases them in time order.
#pragma once
#include "Core/CollisionEvent.h"
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// Sorted by time, then by fixture id, then by arrival. Memory grows with what waits, up to the capacity.
/// World thread (M) only.
class EventSorter {
public:
    explicit EventSorter(std::size_t capacity)
        : capacity_{capacity} {}

    /// Adds an event; when full, or without memory, the weakest of all is dropped and counted.
    void push(const CollisionEvent& event) noexcept {
        if (free_.empty() && !grow() && !dropWeakest(event.amplitude)) return;
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        held_[slot] = event;
        waiting_.push_back({event.timeNs, event.source.fixture, slot});
    }

    /// Moves all events before `beforeNs` to the end of `finished`.
    void release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished);

    /// Releases all events, whatever their time.
    void flush(std::vector<CollisionEvent>& finished) {
        release(std::numeric_limits<std::int64_t>::max(), finished);
    }

    /// Removes the events of a fixture (by its id), and if `asOther` also those of other fixtures that it
    /// caused.
    void withdraw(std::int32_t fixture, bool asOther) noexcept;

    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Waiting {
        std::int64_t timeNs;
        std::int32_t fixture;
        std::uint32_t slot; // index in held_
    };
    struct Place : Waiting {
        std::uint32_t arrival; // order of arrival among the released
        std::uint32_t share;   // bucket in time
        friend bool operator<(const Place& a, const Place& b) noexcept {
            if (a.timeNs != b.timeNs) return a.timeNs < b.timeNs;
            return a.fixture != b.fixture ? a.fixture < b.fixture : a.arrival < b.arrival;
        }
    };
    bool grow() noexcept;                        // false: full, or no memory
    bool dropWeakest(double amplitude) noexcept; // only an event weaker than `amplitude`
    void sort();
    void forget(std::size_t place) noexcept;

    std::size_t capacity_;
    std::uint64_t drops_ = 0;
    std::vector<CollisionEvent> held_; // an event stays in its slot until it is released
    std::vector<std::uint32_t> free_;  // free slots
    std::vector<Waiting> waiting_;     // in order of arrival
    std::vector<Place> order_, other_; // of those being released
    std::vector<std::uint32_t> ends_;  // ends of the buckets
};

} // namespace physvib
