// SPDX-License-Identifier: MIT
// Events that were scheduled for a later time and can still be cancelled.
#pragma once
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace physvib {

/// In session time. One thread at a time: Session guards it by its world mutex.
class WaitingStrikes {
public:
    static constexpr std::size_t most = 65'536; ///< an hour of one every 50 ms

    /// False, and nothing has changed, if there would be too many.
    bool add(std::span<const CollisionEvent> strikes) {
        if (waiting_.size() + strikes.size() > most) return false;
        for (const CollisionEvent& strike : strikes)
            waiting_.insert(std::ranges::upper_bound(waiting_, strike.timeNs, {}, &CollisionEvent::timeNs),
                            strike);
        return true;
    }

    /// Moves the events up to `untilNs` to the end of `due`.
    void take(std::int64_t untilNs, std::vector<CollisionEvent>& due) {
        if (waiting_.empty() || waiting_.front().timeNs > untilNs) return;
        const auto end = std::ranges::upper_bound(waiting_, untilNs, {}, &CollisionEvent::timeNs);
        due.insert(due.end(), waiting_.begin(), end);
        waiting_.erase(waiting_.begin(), end);
    }

    /// Cancels the events from `fromNs` on.
    void forget(std::int64_t fromNs) {
        waiting_.erase(std::ranges::lower_bound(waiting_, fromNs, {}, &CollisionEvent::timeNs),
                       waiting_.end());
    }

    std::size_t size() const noexcept { return waiting_.size(); }

private:
    std::deque<CollisionEvent> waiting_; // in time order; most are added at the end, all are removed at the
                                         // front
};

} // namespace physvib
