// SPDX-License-Identifier: GPL-3.0-or-later
// What was played last: hits one by one, what rolls or slides as one contact with all its grains.
#pragma once
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>

namespace physvib {

struct RecentContact {
    CollisionEvent event; ///< the first; as strong as the strongest, and where the last was
    int grains = 1;
    std::int64_t lastNs = 0;
};

/// M.
class RecentContacts {
public:
    static constexpr std::size_t most = 100;
    static constexpr std::int64_t pauseNs = 250'000'000; ///< what pauses for longer has begun anew

    void add(const CollisionEvent& event) {
        if (RecentContact* const known = find(event)) {
            ++known->grains;
            known->lastNs = event.timeNs;
            known->event.x = event.x;
            known->event.y = event.y;
            if (std::abs(event.amplitude) > std::abs(known->event.amplitude)) known->event.amplitude = event.amplitude;
            return;
        }
        contacts_.push_front({event, 1, event.timeNs});
        if (contacts_.size() > most) contacts_.pop_back();
    }
    const std::deque<RecentContact>& newestFirst() const noexcept { return contacts_; }

private:
    RecentContact* find(const CollisionEvent& event) {
        if (event.source.kind == ContactKind::hit) return nullptr;
        const auto goesOn = [&](const RecentContact& c) {
            const CollisionSource &a = c.event.source, &b = event.source;
            return a.kind == b.kind && a.fixture == b.fixture && a.other == b.other && event.timeNs - c.lastNs < pauseNs;
        };
        const auto found = std::ranges::find_if(contacts_, goesOn);
        return found == contacts_.end() ? nullptr : &*found;
    }
    std::deque<RecentContact> contacts_;
};

} // namespace physvib
