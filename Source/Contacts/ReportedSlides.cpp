// SPDX-License-Identifier: MIT
// Integrates reported surface speeds to positions along the surfaces.
#include "Contacts/ReportedSlides.h"
#include <algorithm>
#include <utility>

namespace physvib {

void ReportedSlides::tell(const Rub& told) {
    const std::uint64_t key = pairKey(told.a, told.b);
    std::int32_t at = trackOf_.find(key);
    if (at == IntegerMap::none) {
        at = static_cast<std::int32_t>(tracks_.size());
        trackOf_.set(key, at);
        Track& made = tracks_.emplace_back();
        made.key = key;
        made.isNew = true;
        made.isTold = false;
        made.point.a = told.a;
        made.point.b = told.b;
    }
    Track& track = tracks_[static_cast<std::size_t>(at)];
    LastingPoint& point = track.point;
    if (!std::exchange(track.isTold, true)) point.normalNewtonSeconds = 0.0;
    point.normalNewtonSeconds += std::max(0.0, told.newtonSeconds);
    point.point = told.point;
    const bool isTurned = point.a != told.a; // the fixtures were reported in the other order
    point.onA.metresPerSecond = isTurned ? told.alongB : told.alongA;
    point.onB.metresPerSecond = isTurned ? told.alongA : told.alongB;
}

void ReportedSlides::endStep(double seconds, LastingContacts& lasting) {
    for (std::size_t i = 0; i < tracks_.size();) {
        Track& track = tracks_[i];
        if (!std::exchange(track.isTold, false)) {
            drop(i);
            continue;
        }
        LastingPoint& point = track.point;
        for (SurfacePath* path : {&point.onA, &point.onB}) path->metres += path->metresPerSecond * seconds;
        point.slipMetresPerSecond = point.onA.metresPerSecond - point.onB.metresPerSecond;
        point.metresPerSecond = {};
        if (!std::exchange(track.isNew, false) && seconds > 0.0)
            point.metresPerSecond = static_cast<float>(1.0 / seconds) * (point.point - track.before);
        track.before = point.point;
        lasting.touch(point);
        ++i;
    }
}

void ReportedSlides::forget(std::int32_t slot) {
    for (std::size_t i = tracks_.size(); i-- > 0;)
        if (tracks_[i].point.a == slot || tracks_[i].point.b == slot) drop(i);
}

void ReportedSlides::drop(std::size_t track) {
    trackOf_.erase(tracks_[track].key);
    if (track + 1 < tracks_.size()) {
        tracks_[track] = tracks_.back();
        trackOf_.set(tracks_[track].key, static_cast<std::int32_t>(track));
    }
    tracks_.pop_back();
}

} // namespace physvib
