// SPDX-License-Identifier: MIT
// The inputs to a session from outside: by mouse, text line, message, program or sequencer.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/RenderControl.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/ContactSounds.h"
#include "Scene/Scene.h"
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {
/// Events that no world produced (a test pulse, a material preview), at their own times after the input's.
/// The caller keeps them alive during the call.
struct Strikes {
    std::span<const CollisionEvent> events;
    bool canBeStopped = false; ///< events wait in the session until their time; a Stop can discard them
};

/// Fades out what sounds, and discards pending events from its time on.
struct Stop {};

/// Recordings that events play instead of modes; empty: modes. Sounding recordings fade out.
struct PlayedRecordings {
    std::vector<ContactRecording> recordings;
};

/// From now on automated gains (lanes) follow the scene's time, of each strip that has a lane itself or by
/// its group. They act at the world's steps like moved faders, and are logged. A gain that is set otherwise
/// holds until the scene time advances.
struct Lanes {
    std::shared_ptr<const Mix> mix; ///< null: no lanes
};

/// One input of any kind.
struct Input {
    static constexpr std::int64_t now = std::numeric_limits<std::int64_t>::min();

    /// An Action acts in the world; a RenderControl changes how later events are rendered. Of several
    /// edits, which the caller keeps alive during the call, all act or none.
    std::variant<Action, std::span<const Action>, RenderControl, PlayedRecordings, Strikes, Stop, Lanes> what;
    /// Session time at which it acts. Strikes and Stop may be in the future; if that time is past they are
    /// late. All other inputs act now.
    std::int64_t timeNs = now;
};

// Bounded queue from a thread that reads input to a thread that acts on it. The reader is never blocked, so
// it can react to a request for silence further behind.

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
