// SPDX-License-Identifier: MIT
// Wait-free ring buffer that carries events from one producer thread to one consumer thread and counts the
// items that a full ring refused.
#pragma once
#include "Core/Nonblocking.h"
#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

namespace physvib {

/// Single producer, single consumer, first in first out, `Capacity` items (a power of two). Never allocates.
template <class T, std::size_t Capacity>
class EventQueue {
    static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "capacity must be a power of two");
    static_assert(std::is_trivially_copyable_v<T>, "items are copied across threads");

public:
    /// False if the queue is full: the item is dropped and counted. Producer only, wait-free.
    bool push(const T& item) noexcept PHYSVIB_NONBLOCKING {
        return pushBy([&](T& place) noexcept { place = item; });
    }

    /// As push, but `write(T&)` writes the whole item in place. Producer only, wait-free.
    template <class Write>
    bool pushBy(Write write) noexcept PHYSVIB_NONBLOCKING {
        const std::size_t written = write_.load(std::memory_order_relaxed);
        if (written - readSeen_ == Capacity) {
            readSeen_ = read_.load(std::memory_order_acquire);
            if (written - readSeen_ == Capacity) {
                overflows_.store(overflows_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
                return false;
            }
        }
        write(items_[written & (Capacity - 1)]);
        write_.store(written + 1, std::memory_order_release);
        return true;
    }

    /// False if the queue is empty. Consumer only, wait-free.
    bool pop(T& item) noexcept PHYSVIB_NONBLOCKING {
        const std::size_t read = read_.load(std::memory_order_relaxed);
        if (read == writeSeen_) {
            writeSeen_ = write_.load(std::memory_order_acquire);
            if (read == writeSeen_) return false;
        }
        item = items_[read & (Capacity - 1)];
        read_.store(read + 1, std::memory_order_release);
        return true;
    }

    /// How many items a full queue has refused. Any thread, wait-free.
    std::size_t overflows() const noexcept { return overflows_.load(std::memory_order_relaxed); }

private:
    // Each side keeps its own index, and its last copy of the other side's, on a cache line of its own.
    alignas(64) std::atomic<std::size_t> write_{0};
    std::size_t readSeen_ = 0;
    std::atomic<std::size_t> overflows_{0};
    alignas(64) std::atomic<std::size_t> read_{0};
    std::size_t writeSeen_ = 0;
    alignas(64) std::array<T, Capacity> items_{};
};

} // namespace physvib
