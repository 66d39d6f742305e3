// SPDX-License-Identifier: GPL-3.0-or-later
// List of the contacts played last: single impacts, and rolling or sliding contacts that combine all their
// grains.
#pragma once
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace physvib {

struct RecentContact {
    CollisionEvent event; ///< the first event, with the largest amplitude and the last place
    int grains = 1;
    std::int64_t lastNs = 0;
    std::uint64_t number = 0; ///< unique
};

/// Message thread.
class RecentContacts {
public:
    static constexpr std::size_t most = 100;
    static constexpr std::size_t mostGrains = 20'000;    ///< limit of stored grains: 3 MB, some minutes of a
                                                         ///< rough surface
    static constexpr std::int64_t pauseNs = 250'000'000; ///< a longer pause starts a new contact

    void add(const CollisionEvent& event) {
        RecentContact* const known = find(event);
        if (known == nullptr)
            begin(event);
        else
            goOn(*known, event);
        if (event.source.kind == ContactKind::hit) return;
        grains_.push_back({known == nullptr ? contacts_.front().number : known->number, event});
        if (grains_.size() > mostGrains) grains_.pop_front();
    }
    const std::deque<RecentContact>& newestFirst() const noexcept { return contacts_; }

    /// Appends the contact's events: one impact, or its last grains as far as they are stored.
    void appendEvents(const RecentContact& contact, std::vector<CollisionEvent>& events) const {
        if (contact.event.source.kind == ContactKind::hit) return events.push_back(contact.event);
        for (const Grain& grain : grains_)
            if (grain.contact == contact.number) events.push_back(grain.event);
    }

private:
    struct Grain {
        std::uint64_t contact;
        CollisionEvent event;
    };
    void begin(const CollisionEvent& event) {
        contacts_.push_front({event, 1, event.timeNs, ++begun_});
        if (contacts_.size() > most) contacts_.pop_back();
    }
    static void goOn(RecentContact& known, const CollisionEvent& event) {
        ++known.grains;
        known.lastNs = event.timeNs;
        known.event.x = event.x;
        known.event.y = event.y;
        if (std::abs(event.amplitude) > std::abs(known.event.amplitude))
            known.event.amplitude = event.amplitude;
    }
    RecentContact* find(const CollisionEvent& event) {
        if (event.source.kind == ContactKind::hit) return nullptr;
        const auto goesOn = [&](const RecentContact& c) {
            const CollisionSource &a = c.event.source, &b = event.source;
            return a.kind == b.kind && a.fixture == b.fixture && a.other == b.other &&
                   event.timeNs - c.lastNs < pauseNs;
        };
        const auto found = std::ranges::find_if(contacts_, goesOn);
        return found == contacts_.end() ? nullptr : &*found;
    }
    std::deque<RecentContact> contacts_;
    std::deque<Grain> grains_;
    std::uint64_t begun_ = 0;
};

} // namespace physvib
