// SPDX-License-Identifier: MIT
// Compares the ids of a contact's manifold points from one callback to the next.
#include "Physics/FreshPoints.h"
#include "Physics/WorldNames.h"
#include <algorithm>

namespace physvib {

namespace {

bool hasPoint(const b2Manifold& manifold, std::uint32_t id) noexcept {
    const auto isIt = [id](const b2ManifoldPoint& point) { return point.id.key == id; };
    return std::any_of(manifold.points, manifold.points + manifold.pointCount, isIt);
}

/// True if both have the same points in the same order.
bool isSame(const b2Manifold& before, const b2Manifold& now) noexcept {
    if (before.pointCount < now.pointCount) return false;
    for (int i = 0; i < now.pointCount; ++i)
        if (before.points[i].id.key != now.points[i].id.key) return false;
    return true;
}

} // namespace

unsigned FreshPoints::look(const b2Contact& contact, const b2Manifold& before, bool isStepping) {
    const b2Manifold& now = *contact.GetManifold();
    int known = find(contact);
    if (!isStepping && known >= 0 && entries_[static_cast<std::size_t>(known)].isSolved) {
        drop(static_cast<std::size_t>(known));
        known = -1;
    }
    if (known < 0 && isSame(before, now)) return 0U; // the usual case
    // then all of its points are still new
    const bool isWaiting = known >= 0 && !entries_[static_cast<std::size_t>(known)].isSolved;
    for (int i = 0; i < now.pointCount; ++i) {
        const std::uint32_t id = now.points[i].id.key;
        if (!isWaiting && hasPoint(before, id)) continue;
        if (known < 0) {
            known = static_cast<int>(entries_.size());
            entries_.push_back({nameOf(contact), {}, 0, false});
            indices_.set(nameOf(contact), known);
        }
        Entry& entry = entries_[static_cast<std::size_t>(known)];
        if (!has(entry, id) && entry.count < static_cast<int>(entry.ids.size()))
            entry.ids[static_cast<std::size_t>(entry.count++)] = id;
    }
    return known < 0 ? 0U : maskOf(entries_[static_cast<std::size_t>(known)], now);
}

unsigned FreshPoints::solved(const b2Contact& contact) noexcept {
    const int known = find(contact);
    if (known < 0) return 0U;
    entries_[static_cast<std::size_t>(known)].isSolved = true;
    return maskOf(entries_[static_cast<std::size_t>(known)], *contact.GetManifold());
}

bool FreshPoints::has(const Entry& entry, std::uint32_t id) noexcept {
    const auto* end = entry.ids.data() + entry.count;
    return std::find(entry.ids.data(), end, id) != end;
}

unsigned FreshPoints::maskOf(const Entry& entry, const b2Manifold& manifold) noexcept {
    unsigned mask = 0;
    for (int i = 0; i < manifold.pointCount; ++i)
        mask |= has(entry, manifold.points[i].id.key) ? 1U << i : 0U;
    return mask;
}

void FreshPoints::forget(const b2Contact& contact) noexcept {
    if (const int known = find(contact); known >= 0) drop(static_cast<std::size_t>(known));
}

void FreshPoints::endStep() noexcept {
    for (std::size_t i = entries_.size(); i-- > 0;)
        if (entries_[i].isSolved) drop(i);
}

int FreshPoints::find(const b2Contact& contact) const noexcept {
    return entries_.empty() ? IntegerMap::none : indices_.find(nameOf(contact));
}

void FreshPoints::drop(std::size_t entry) noexcept {
    indices_.erase(entries_[entry].contact);
    entries_[entry] = entries_.back();
    entries_.pop_back();
    if (entry < entries_.size()) indices_.set(entries_[entry].contact, static_cast<std::int32_t>(entry));
}

} // namespace physvib
