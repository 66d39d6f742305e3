// SPDX-License-Identifier: MIT
// Interpolates, adds and simplifies gain lanes.
#include "Live/Documents/GainLane.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

double onFaderStep(double db) noexcept { return std::round(10.0 * db) / 10.0; }

double lineAt(const GainPoint& from, const GainPoint& to, double seconds) noexcept {
    const double length = to.seconds - from.seconds;
    return length > 0.0 ? from.db + (to.db - from.db) * (seconds - from.seconds) / length : to.db;
}

/// The point farthest from the line between the ends of lane[from..to]; `from` if none is beyond the
/// tolerance.
std::size_t farthest(const GainLane& lane, std::size_t from, std::size_t to, double toleranceDb) {
    std::size_t found = from;
    for (std::size_t i = from + 1; i < to; ++i) {
        const double off = std::abs(lane[i].db - lineAt(lane[from], lane[to], lane[i].seconds));
        if (off > toleranceDb) toleranceDb = off, found = i;
    }
    return found;
}

/// Ramer 1972, Douglas and Peucker 1973: keeps the ends, and points too far from the line between them.
GainLane withinTolerance(const GainLane& lane, double toleranceDb) {
    if (lane.size() < 3) return lane;
    GainLane kept{lane.front()};
    std::vector<std::size_t> ends{lane.size() - 1}; // ends of the segments still to check, the next one last
    for (std::size_t from = 0; !ends.empty();) {
        const std::size_t middle = farthest(lane, from, ends.back(), toleranceDb);
        if (middle != from) {
            ends.push_back(middle);
            continue;
        }
        from = ends.back();
        ends.pop_back();
        kept.push_back(lane[from]);
    }
    return kept;
}

} // namespace

double laneDbAt(const GainLane& lane, double seconds) noexcept {
    if (lane.empty()) return 0.0;
    const auto next = std::ranges::upper_bound(lane, seconds, {}, &GainPoint::seconds);
    if (next == lane.begin()) return onFaderStep(lane.front().db);
    if (next == lane.end()) return onFaderStep(lane.back().db);
    return onFaderStep(lineAt(*std::prev(next), *next, seconds));
}

double loudestDb(const GainLane& lane) noexcept {
    return lane.empty() ? 0.0 : std::ranges::max(lane, {}, &GainPoint::db).db;
}

double sumDb(std::initializer_list<double> gainsDb) noexcept {
    double sum = 0.0;
    for (const double db : gainsDb) {
        if (db <= leastStripDb) return leastStripDb;
        sum += db;
    }
    return std::clamp(sum, leastStripDb, mostStripDb);
}

GainLane sumOf(const GainLane& a, const GainLane& b) {
    std::vector<double> times;
    for (const GainLane* lane : {&a, &b})
        for (const GainPoint& point : *lane) times.push_back(point.seconds);
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end()); // clang 14 lacks ranges::unique
    GainLane sum;
    for (const double seconds : times)
        sum.push_back({seconds, sumDb({laneDbAt(a, seconds), laneDbAt(b, seconds)})});
    return sum;
}

GainLane thinned(const GainLane& lane, std::size_t mostPoints) {
    constexpr double hardlyFeltDb = 0.25; // a quarter of the just noticeable difference
    GainLane kept = withinTolerance(lane, hardlyFeltDb);
    for (double toleranceDb = hardlyFeltDb; kept.size() > mostPoints; toleranceDb *= 2.0)
        kept = withinTolerance(lane, toleranceDb);
    if (kept.size() == 2 && kept[0].db == kept[1].db) kept.pop_back(); // the gain is constant
    return kept;
}

} // namespace physvib
