// SPDX-License-Identifier: GPL-3.0-or-later
// Converts fader moves during a recording to lanes, added to the lanes that were playing.
#include "Mixer/Desk/DeskLanes.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr double jumpSeconds = 1e-3; // between two steps of the world

void setPoint(GainLane& lane, double seconds, double db) {
    if (!lane.empty() && lane.back().seconds >= seconds)
        lane.back().db = db; // the world is paused
    else
        lane.push_back({seconds, db});
}

double highestDb(const GainLane& lane) { return std::ranges::max(lane, {}, &GainPoint::db).db; }

/// Splits the sum of the moved fader and the old lane into a new lane and a fader value. The fader returns to
/// its start value. If it was silent, it gets the highest value of the move instead. If the lane cannot rise
/// that far, the fader is raised by the rest.
void write(const GainLane& moves, double startDb, double& faderDb, GainLane& lane) {
    const double highest = highestDb(moves);
    faderDb = startDb <= leastStripDb ? highest : std::max(startDb, highest - mostStripDb);
    GainLane moved = moves;
    for (GainPoint& point : moved)
        point.db = point.db <= leastStripDb ? leastStripDb : std::max(leastStripDb, point.db - faderDb);
    lane = thinned(sumOf(lane, moved));
}

} // namespace

double DeskLanes::sceneSeconds() const {
    return 1e-9 * static_cast<double>(desk_.session().world().sceneNs());
}

std::vector<double> DeskLanes::faders() const {
    std::vector<double> all;
    for (const Strip& strip : desk_.mix().strips) all.push_back(strip.gainDb);
    for (const StripGroup& group : desk_.mix().groups) all.push_back(group.gainDb);
    return all;
}

void DeskLanes::look() {
    const bool isWanted = desk_.recording().isRunning();
    const bool isOther = take_ != desk_.session().world().take() || strips_ != desk_.mix().strips.size() ||
                         faders_.size() != strips_ + desk_.mix().groups.size();
    if (!faders_.empty() && (!isWanted || isOther)) end();
    if (!isWanted) return;
    if (faders_.empty())
        begin();
    else
        follow();
    lookedAtSeconds_ = sceneSeconds();
}

void DeskLanes::begin() {
    strips_ = desk_.mix().strips.size();
    take_ = desk_.session().world().take();
    for (const double db : faders()) faders_.push_back({db, db});
}

// Each move starts at the fader's value of the last look().
void DeskLanes::follow() {
    const auto now = faders();
    for (std::size_t i = 0; i < now.size(); ++i) {
        Fader& fader = faders_[i];
        if (now[i] == fader.nowDb) continue;
        setPoint(fader.moves, lookedAtSeconds_, fader.nowDb);
        setPoint(fader.moves, std::max(lookedAtSeconds_ + jumpSeconds, sceneSeconds()), now[i]);
        fader.nowDb = now[i];
    }
}

void DeskLanes::end() {
    const auto moved = std::exchange(faders_, {});
    Mix next = desk_.mix();
    juce::StringArray names;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (moved[i].moves.empty() || highestDb(moved[i].moves) <= leastStripDb) continue;
        const std::size_t k = i - std::min(i, strips_);
        if (i < strips_ ? i >= next.strips.size() : k >= next.groups.size())
            continue; // it was removed meanwhile
        if (i < strips_) {
            write(moved[i].moves, moved[i].startDb, next.strips[i].gainDb, next.strips[i].lane);
            names.add(utf8(next.layout.enchanters[i].label));
        } else {
            write(moved[i].moves, moved[i].startDb, next.groups[k].gainDb, next.groups[k].lane);
            names.add(utf8(next.groups[k].name));
        }
    }
    if (names.isEmpty()) return;
    desk_.edit("Record gains", next);
    desk_.tell("The moves of " + names.joinIntoString(", ") +
               " are a lane now (Gain lanes); the faders are back where they were");
}

} // namespace physvib
