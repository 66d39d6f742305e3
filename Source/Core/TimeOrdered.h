// SPDX-License-Identifier: MIT
// A fixed store that gives its items back in time order, equal times in the order of arrival: a binary heap.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// At most `Capacity` items of type T, each with an integer time. R, bounded by log2(Capacity) moves a call.
template <class T, int Capacity>
class TimeOrdered {
public:
    bool empty() const noexcept { return size_ == 0; }
    bool full() const noexcept { return size_ == Capacity; }
    int size() const noexcept { return size_; }
    void clear() noexcept { size_ = 0; }

    /// False if the store is full; then nothing has changed.
    bool push(std::int64_t time, const T& item) noexcept {
        if (full()) return false;
        entries_[static_cast<std::size_t>(size_++)] = {time, arrivals_++, item};
        std::push_heap(entries_.begin(), entries_.begin() + size_, isLater);
        return true;
    }

    /// Time and item that come first. Only when not empty.
    std::int64_t nextTime() const noexcept { return entries_.front().time; }
    const T& next() const noexcept { return entries_.front().item; }

    /// Removes the first item. Only when not empty.
    void pop() noexcept { std::pop_heap(entries_.begin(), entries_.begin() + size_--, isLater); }

    /// Gives every item a new time: `newTime(oldTime, item)`, which may change the item too. M, not while rendering.
    template <class Function>
    void retime(Function newTime) noexcept {
        const auto end = entries_.begin() + size_;
        for (auto e = entries_.begin(); e != end; ++e) e->time = newTime(e->time, e->item);
        std::make_heap(entries_.begin(), end, isLater);
    }

private:
    struct Entry {
        std::int64_t time = 0;
        std::uint64_t arrival = 0;
        T item{};
    };
    static bool isLater(const Entry& a, const Entry& b) noexcept {
        return a.time != b.time ? a.time > b.time : a.arrival > b.arrival;
    }
    std::array<Entry, static_cast<std::size_t>(Capacity)> entries_{};
    std::uint64_t arrivals_ = 0;
    int size_ = 0;
};

} // namespace physvib
