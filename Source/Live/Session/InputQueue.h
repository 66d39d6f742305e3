// SPDX-License-Identifier: MIT
// Bounded queue from a thread that reads input to a thread that acts on it. The reader is never blocked, so
// it can react to a request for silence further behind.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace physvib {

/// One thread pushes, another pops. Neither may be the render thread (R).
template <class Item>
class InputQueue {
public:
    static constexpr std::size_t mostBytes = 16 << 20; ///< limit for pending items
    static constexpr std::size_t itemBytes = 256;      ///< counted per item beside its text

    /// False, and nothing changes, while the queue is full.
    bool push(Item&& item, std::size_t textBytes) {
        const std::size_t bytes = textBytes + itemBytes;
        {
            const std::lock_guard lock{mutex_};
            if (bytes_ + bytes > mostBytes) return false;
            items_.emplace_back(std::move(item), bytes);
            bytes_ += bytes;
        }
        came_.notify_one();
        return true;
    }

    /// Waits for an item; false after the time-out.
    bool wait(std::chrono::milliseconds patience) {
        std::unique_lock lock{mutex_};
        return came_.wait_for(lock, patience, [this] { return !items_.empty(); });
    }

    /// The first item, if any.
    std::optional<Item> pop() {
        const std::lock_guard lock{mutex_};
        if (items_.empty()) return std::nullopt;
        std::optional<Item> item{std::move(items_.front().first)};
        bytes_ -= items_.front().second;
        items_.pop_front();
        return item;
    }

private:
    std::mutex mutex_; // guards the following members
    std::condition_variable came_;
    std::deque<std::pair<Item, std::size_t>> items_; // with their sizes in bytes
    std::size_t bytes_ = 0;
};

} // namespace physvib
