// SPDX-License-Identifier: MIT
// Containers of fixed capacity: an array (Storage), and a priority queue by time (TimeOrdered).
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

namespace physvib {

/// Array whose size is fixed when a renderer is prepared: on a computer it is allocated on the heap then, on
/// a board it lies inside the object. At most `Max` items. resize: message thread (M), not while rendering;
/// else: any thread that may use them.
template <class T, std::size_t Max, bool isOnHeap>
class Storage {
public:
    /// Provides `count` items. False, and empty, if there is no memory. The items are value-initialised if
    /// the count has changed; otherwise they keep their values.
    bool resize(std::size_t count) noexcept { return count <= Max; }

    T* data() noexcept { return items_.data(); }
    const T* data() const noexcept { return items_.data(); }
    T& operator[](std::size_t i) noexcept { return items_[i]; }
    const T& operator[](std::size_t i) const noexcept { return items_[i]; }

private:
    std::array<T, Max> items_{};
};

/// Aligned to cache lines. resize writes every item, so that the system has mapped all pages before render.
template <class T, std::size_t Max>
class Storage<T, Max, true> {
    static_assert(std::is_trivially_destructible_v<T>);

public:
    Storage() = default;
    Storage(const Storage&) = delete;
    Storage& operator=(const Storage&) = delete;
    ~Storage() { release(); }

    bool resize(std::size_t count) noexcept {
        if (count == count_) return true;
        release();
        if (count > Max) return false;
        items_ = static_cast<T*>(::operator new(count * sizeof(T), cacheLine, std::nothrow));
        if (items_ == nullptr) return false;
        count_ = count;
        for (std::size_t i = 0; i < count; ++i) new (items_ + i) T{};
        return true;
    }

    T* data() noexcept { return items_; }
    const T* data() const noexcept { return items_; }
    T& operator[](std::size_t i) noexcept { return items_[i]; }
    const T& operator[](std::size_t i) const noexcept { return items_[i]; }

private:
    static constexpr std::align_val_t cacheLine{64};
    void release() noexcept {
        ::operator delete(items_, cacheLine);
        items_ = nullptr;
        count_ = 0;
    }

    T* items_ = nullptr;
    std::size_t count_ = 0;
};

/// Fixed-capacity priority queue by time; equal times keep their order of arrival. Items that arrive in time
/// order, nearly all of them, are in a linked list; the others are in a binary heap. At most `Capacity` items
/// of type T, each with an integer time. Render thread (R): constant time for items in order, else at most
/// log2(Capacity) moves of indices. Items are not moved in memory.
template <class T, int Capacity, bool isOnHeap = false>
class TimeOrdered {
public:
    /// Empties the queue and reserves `capacity` items, at most `Capacity`. On the heap its capacity is 0
    /// before the first call. False: no memory. Message thread (M), not while rendering.
    bool resize(int capacity) noexcept {
        clear();
        const auto count = static_cast<std::size_t>(capacity);
        const bool hasMemory = nodes_.resize(count) && items_.resize(count) && heap_.resize(count);
        capacity_ = hasMemory ? capacity : 0;
        return hasMemory;
    }

    bool empty() const noexcept { return size_ == 0; }
    bool full() const noexcept { return size_ == capacity_; }
    int size() const noexcept { return size_; }
    void clear() noexcept {
        size_ = heapSize_ = usedItems_ = 0;
        firstFree_ = first_ = last_ = none;
    }

    /// False if the queue is full; then nothing has changed.
    bool push(std::int64_t time, const T& item) noexcept {
        if (full()) return false;
        freeItem() = item;
        pushFreeItem(time);
        return true;
    }

    /// The memory of the next item: write it in place, then call pushFreeItem. Only when not full.
    T& freeItem() noexcept { return items_[index(firstFree_ != none ? firstFree_ : usedItems_)]; }
    void pushFreeItem(std::int64_t time) noexcept {
        const std::int32_t i = firstFree_ != none ? firstFree_ : usedItems_++;
        if (firstFree_ != none) firstFree_ = node(i).next;
        node(i) = {time, arrivals_++, none};
        ++size_;
        if (first_ == none)
            first_ = last_ = i;
        else if (time >= node(last_).time)
            last_ = node(last_).next = i;
        else
            pushOnHeap(i);
    }

    /// Time and value of the first item. Only when not empty.
    std::int64_t nextTime() const noexcept { return node(firstIndex()).time; }
    const T& next() const noexcept { return items_[index(firstIndex())]; }

    /// Removes the first item. Only when not empty.
    void pop() noexcept {
        const std::int32_t i = firstIndex();
        if (i == first_)
            first_ = node(i).next;
        else
            std::pop_heap(heap_.data(), heap_.data() + heapSize_--, laterFirst());
        node(i).next = firstFree_;
        firstFree_ = i;
        --size_;
    }

    /// Gives every item a new time: `newTime(oldTime, item)`, which may change the item too. Linear time; not
    /// between next() and pop().
    template <class Function>
    void retime(Function newTime) noexcept {
        for (; first_ != none; first_ = node(first_).next)
            heap_[index(heapSize_++)] = static_cast<ItemIndex>(first_);
        std::for_each(heap_.data(), heap_.data() + heapSize_,
                      [&](std::int32_t i) { node(i).time = newTime(node(i).time, items_[index(i)]); });
        std::make_heap(heap_.data(), heap_.data() + heapSize_, laterFirst());
    }

private:
    static constexpr std::int32_t none = -1;
    struct Node {
        std::int64_t time = 0;
        std::uint32_t arrival = 0; // may wrap: arrivals in the queue are never 2^31 apart
        std::int32_t next = none;  // in the list of items, or in the list of free places
    };
    static constexpr std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
    Node& node(std::int32_t i) noexcept { return nodes_[index(i)]; }
    const Node& node(std::int32_t i) const noexcept { return nodes_[index(i)]; }
    static bool isLater(const Node& a, const Node& b) noexcept {
        return a.time != b.time ? a.time > b.time : static_cast<std::int32_t>(a.arrival - b.arrival) > 0;
    }
    auto laterFirst() const noexcept {
        return [this](std::int32_t a, std::int32_t b) { return isLater(node(a), node(b)); };
    }
    void pushOnHeap(std::int32_t i) noexcept {
        heap_[index(heapSize_++)] = static_cast<ItemIndex>(i);
        std::push_heap(heap_.data(), heap_.data() + heapSize_, laterFirst());
    }
    std::int32_t firstIndex() const noexcept {
        if (heapSize_ == 0) return first_;
        return first_ == none || isLater(node(first_), node(heap_[0])) ? heap_[0] : first_;
    }

    static constexpr auto maxItems = static_cast<std::size_t>(Capacity);
    Storage<Node, maxItems, isOnHeap> nodes_;
    Storage<T, maxItems, isOnHeap> items_;
    using ItemIndex = std::conditional_t<(Capacity < 128), std::int8_t, std::int32_t>; // for boards
    Storage<ItemIndex, maxItems, isOnHeap> heap_; // places of items that arrived out of order
    std::uint32_t arrivals_ = 0;
    std::int32_t first_ = none, last_ = none;       // of the list
    std::int32_t firstFree_ = none, usedItems_ = 0; // places from `usedItems_` on have never been used
    int size_ = 0, heapSize_ = 0;
    int capacity_ = isOnHeap ? 0 : Capacity;
};

} // namespace physvib
