// SPDX-License-Identifier: MIT
// Wait-free hand-over between two threads: queues of events, which count the items that a full queue refused,
// and the newest value.
#pragma once
#include "Core/Nonblocking.h"
#include "Core/Storage.h"
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace physvib {
/// Single producer, single consumer, first in first out, `Capacity` items (a power of two). Allocates only if
/// `isOnHeap`, and then only in resize(); before the first resize() it has no room for any item.
template <class T, std::size_t Capacity, bool isOnHeap = false>
class EventQueue {
    static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "capacity must be a power of two");
    static_assert(std::is_trivially_copyable_v<T>, "items are copied across threads");

public:
    /// Sets the number of items, a power of two, at most `Capacity`. A change discards the items that wait.
    /// False: no memory. Only while neither side uses the queue.
    bool resize(std::size_t capacity) noexcept {
        if (capacity == capacity_) return true;
        const bool hasMemory = items_.resize(capacity);
        capacity_ = hasMemory ? capacity : 0;
        write_ = read_ = readSeen_ = writeSeen_ = 0;
        return hasMemory;
    }

    /// False if the queue is full: the item is dropped and counted. Producer only, wait-free.
    bool push(const T& item) noexcept PHYSVIB_NONBLOCKING {
        return pushInPlace([&](T& place) noexcept { place = item; });
    }

    /// As push, but `write(T&)` writes the whole item in place. Producer only, wait-free.
    template <class Write>
    bool pushInPlace(Write write) noexcept PHYSVIB_NONBLOCKING {
        const std::size_t written = write_.load(std::memory_order_relaxed);
        if (written - readSeen_ == capacity_) {
            readSeen_ = read_.load(std::memory_order_acquire);
            if (written - readSeen_ == capacity_) {
                overflows_.store(overflows_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
                return false;
            }
        }
        write(items_[written & (capacity_ - 1)]);
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
        item = items_[read & (capacity_ - 1)];
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
    alignas(64) std::size_t capacity_ = isOnHeap ? 0 : Capacity;
    Storage<T, Capacity, isOnHeap> items_;
};

/// A queue whose producer may allocate: its memory grows by chunks when the consumer falls behind, up
/// to `MaxChunks`.
template <class T, std::size_t ChunkItems, std::size_t MaxChunks>
class GrowingQueue {
    static_assert(std::is_trivially_copyable_v<T>, "items are copied across threads");

public:
    GrowingQueue()
        : head_{new Chunk}
        , oldest_{new Chunk{.items = {}, .next = head_}} // one more, so that the second takes no memory later
        , tail_{head_} {}
    GrowingQueue(const GrowingQueue&) = delete;
    GrowingQueue& operator=(const GrowingQueue&) = delete;
    ~GrowingQueue() {
        while (oldest_ != nullptr) delete std::exchange(oldest_, oldest_->next);
    }

    /// False if the queue is full, or memory is lacking: the item is dropped and counted. Producer only.
    bool push(const T& item) noexcept {
        if (tailCount_ == ChunkItems) {
            Chunk* const chunk = spareChunk();
            if (chunk == nullptr) {
                overflows_.store(overflows_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
                return false;
            }
            chunk->next = nullptr;
            tail_ = tail_->next = chunk;
            tailCount_ = 0;
        }
        tail_->items[tailCount_++] = item;
        written_.store(written_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
        return true;
    }

    /// False if the queue is empty. Consumer only, wait-free.
    bool pop(T& item) noexcept PHYSVIB_NONBLOCKING {
        if (read_ == writtenSeen_) {
            writtenSeen_ = written_.load(std::memory_order_acquire);
            if (read_ == writtenSeen_) return false;
        }
        Chunk* head = head_.load(std::memory_order_relaxed);
        if (headIndex_ == ChunkItems) {
            head = head->next; // written before the item that is to be read
            head_.store(head, std::memory_order_release);
            headIndex_ = 0;
        }
        item = head->items[headIndex_++];
        ++read_;
        return true;
    }

    /// How many items were refused. Any thread, wait-free.
    std::size_t overflows() const noexcept { return overflows_.load(std::memory_order_relaxed); }

private:
    struct Chunk {
        std::array<T, ChunkItems> items;
        Chunk* next = nullptr;
    };
    // Chunks before the consumer's own are empty and are used again. Null: full, or no memory.
    Chunk* spareChunk() noexcept {
        if (oldest_ != head_.load(std::memory_order_acquire)) return std::exchange(oldest_, oldest_->next);
        if (chunks_ == MaxChunks) return nullptr;
        Chunk* const chunk = new (std::nothrow) Chunk;
        chunks_ += chunk != nullptr ? 1 : 0;
        return chunk;
    }

    alignas(64) std::atomic<std::size_t> written_{0};
    std::atomic<std::size_t> overflows_{0};
    alignas(64) std::atomic<Chunk*> head_; // of the consumer, as the next line; the producer reads this one
    std::size_t read_ = 0, writtenSeen_ = 0, headIndex_ = 0;
    alignas(64) Chunk* oldest_; // of the producer, as the next two lines
    Chunk* tail_;
    std::size_t tailCount_ = 0, chunks_ = 2;
};

/// Wait-free triple buffer for telemetry; no value is torn. One writer, one reader. The reader gets the
/// newest value; values in between may be skipped. Do not use it for anything audible: that needs a time and
/// travels as an event.
template <class T>
class LatestValue {
    static_assert(std::is_trivially_copyable_v<T>, "values are copied across threads");

public:
    /// Writer only, wait-free.
    void write(const T& value) noexcept PHYSVIB_NONBLOCKING {
        slots_[writing_].value = value;
        writing_ =
            shared_.exchange(static_cast<std::uint8_t>(writing_ | freshBit), std::memory_order_acq_rel) &
            mask;
    }

    /// The newest value; T{} before the first write. Reader only, wait-free.
    const T& read() noexcept PHYSVIB_NONBLOCKING {
        if (shared_.load(std::memory_order_relaxed) & freshBit)
            reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & mask;
        return slots_[reading_].value;
    }

private:
    static constexpr std::uint8_t mask = 3;
    static constexpr std::uint8_t freshBit = 4; // set by the writer, cleared by the reader
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) std::atomic<std::uint8_t> shared_{1};
    alignas(64) std::uint8_t writing_ = 0;
    alignas(64) std::uint8_t reading_ = 2;
};

} // namespace physvib
