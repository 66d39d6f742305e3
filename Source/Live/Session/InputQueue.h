// SPDX-License-Identifier: MIT
// What one thread has read and another has still to do, in order. So reading waits for nothing, and finds
// silence in what comes behind.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace physvib {

/// One thread pushes, another pops. Neither is R.
template <class Item>
class InputQueue {
public:
    static constexpr std::size_t mostBytes = 16 << 20; ///< of what waits
    static constexpr std::size_t itemBytes = 256;      ///< what each takes beside its text

    /// False, and nothing changes, while there is no room.
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

    /// Whether something waits, or comes in that time.
    bool wait(std::chrono::milliseconds patience) {
        std::unique_lock lock{mutex_};
        return came_.wait_for(lock, patience, [this] { return !items_.empty(); });
    }

    /// The first, if one waits.
    std::optional<Item> pop() {
        const std::lock_guard lock{mutex_};
        if (items_.empty()) return std::nullopt;
        std::optional<Item> item{std::move(items_.front().first)};
        bytes_ -= items_.front().second;
        items_.pop_front();
        return item;
    }

private:
    std::mutex mutex_; // guards what follows
    std::condition_variable came_;
    std::deque<std::pair<Item, std::size_t>> items_; // and its bytes
    std::size_t bytes_ = 0;
};

} // namespace physvib
