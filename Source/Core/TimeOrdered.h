// SPDX-License-Identifier: MIT
// A fixed store that gives its items back in time order, equal times in the order of arrival: a binary heap.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// At most `Capacity` items of type T, each with an integer time. R, bounded by log2(Capacity) moves a call, of small
/// nodes: items stay where they are.
template <class T, int Capacity>
class TimeOrdered {
public:
    TimeOrdered() noexcept {
        for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].item = static_cast<std::uint32_t>(i);
    }
    bool empty() const noexcept { return size_ == 0; }
    bool full() const noexcept { return size_ == Capacity; }
    int size() const noexcept { return size_; }
    void clear() noexcept { size_ = 0; }

    /// False if the store is full; then nothing has changed.
    bool push(std::int64_t time, const T& item) noexcept {
        if (full()) return false;
        Node& node = nodes_[static_cast<std::size_t>(size_++)];
        node.time = time;
        node.arrival = arrivals_++;
        items_[node.item] = item;
        std::push_heap(nodes_.begin(), nodes_.begin() + size_, isLater);
        return true;
    }

    /// Time and item that come first. Only when not empty.
    std::int64_t nextTime() const noexcept { return nodes_.front().time; }
    const T& next() const noexcept { return items_[nodes_.front().item]; }

    /// Removes the first item. Only when not empty.
    void pop() noexcept { std::pop_heap(nodes_.begin(), nodes_.begin() + size_--, isLater); }

    /// Gives every item a new time: `newTime(oldTime, item)`, which may change the item too. M, not while rendering.
    template <class Function>
    void retime(Function newTime) noexcept {
        const auto end = nodes_.begin() + size_;
        for (auto n = nodes_.begin(); n != end; ++n) n->time = newTime(n->time, items_[n->item]);
        std::make_heap(nodes_.begin(), end, isLater);
    }

private:
    struct Node {
        std::int64_t time = 0;
        std::uint32_t arrival = 0; // may wrap: those in the store are never 2^31 apart
        std::uint32_t item = 0;    // where it lies; nodes behind the heap hold the free places
    };
    static bool isLater(const Node& a, const Node& b) noexcept {
        return a.time != b.time ? a.time > b.time : static_cast<std::int32_t>(a.arrival - b.arrival) > 0;
    }
    std::array<Node, static_cast<std::size_t>(Capacity)> nodes_{};
    std::array<T, static_cast<std::size_t>(Capacity)> items_{};
    std::uint32_t arrivals_ = 0;
    int size_ = 0;
};

} // namespace physvib
