// SPDX-License-Identifier: MIT
// Points, their paths, the grains on them.
#include "Contacts/LastingContacts.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace physvib {

namespace {

constexpr std::size_t mostPoints = 4096; // a step; who piles up more than this hears noise
constexpr double farMetres = 1.0e9;      // beyond, a double knows no grains any more

std::uint64_t trackKey(const LastingPoint& point, std::int32_t surface) noexcept {
    std::uint64_t key = pairKey(point.a, point.b) * 0x9E3779B97F4A7C15U + point.feature;
    key = (key ^ (key >> 31U)) * 0xBF58476D1CE4E5B9U + (surface == point.a ? 1U : 2U);
    return key != 0 ? key : 1; // IntegerMap has no 0
}

bool isUsable(const SurfacePath& path) noexcept {
    return std::abs(path.metres) < farMetres && std::abs(path.metresPerSecond) < farMetres; // not NaN
}

template <class Item>
void keepNew(std::vector<Item>& items, IntegerMap& places) {
    for (std::size_t i = 0; i < items.size();) {
        if (items[i].isNew) {
            items[i++].isNew = false;
            continue;
        }
        places.erase(items[i].key);
        if (i + 1 < items.size()) {
            items[i] = items.back();
            places.set(items[i].key, static_cast<std::int32_t>(i));
        }
        items.pop_back();
    }
}

/// The item of that key, a new one if need be.
template <class Item>
Item& itemOf(std::uint64_t key, std::vector<Item>& items, IntegerMap& places, bool& isThere) {
    const std::int32_t at = places.find(key);
    isThere = at != IntegerMap::none;
    if (isThere) return items[static_cast<std::size_t>(at)];
    places.set(key, static_cast<std::int32_t>(items.size()));
    Item& item = items.emplace_back();
    item.key = key;
    return item;
}

} // namespace

LastingContacts::LastingContacts(const FixtureTable& table)
    : table_{table} {
    points_.reserve(64);
}

void LastingContacts::touch(const LastingPoint& point) {
    const std::uint64_t key = trackKey(point, point.a);
    if (points_.size() == mostPoints || !isUsable(point.onA) || !isUsable(point.onB) || !(point.normalNewtonSeconds >= 0.0) || told_.find(key) != IntegerMap::none) return;
    told_.set(key, 0);
    points_.push_back(point);
}

void LastingContacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    const double seconds = span.seconds();
    passages_.clear();
    if (points_.empty() || !(seconds > 0.0) || seconds > longestStepSeconds) return;
    for (const LastingPoint& point : points_) addLoad(point, seconds);
    for (const LastingPoint& point : points_) {
        if (table_.isRough(point.a)) follow(point, point.a, point.onA, seconds);
        if (table_.isRough(point.b)) follow(point, point.b, point.onB, seconds);
    }
    thinTogether(seconds);
    for (const Passage& passage : passages_) pass(passage, span, impacts);
}

void LastingContacts::addLoad(const LastingPoint& point, double seconds) {
    bool isThere = false;
    Load& load = itemOf(pairKey(point.a, point.b), loads_, loadOf_, isThere);
    if (!load.isNew) load.lastNewtons = std::exchange(load.newtons, 0.0);
    load.isNew = true;
    load.newtons += point.normalNewtonSeconds / seconds;
}

/// How much of a pair's load was there in the step before, 0 to 1.
double LastingContacts::steadyShare(const LastingPoint& point) const noexcept {
    const Load& load = loads_[static_cast<std::size_t>(loadOf_.find(pairKey(point.a, point.b)))];
    return load.newtons > 0.0 ? std::min(1.0, load.lastNewtons / load.newtons) : 0.0;
}

void LastingContacts::follow(const LastingPoint& point, std::int32_t surface, SurfacePath path, double seconds) {
    bool isThere = false;
    Track& track = itemOf(trackKey(point, surface), tracks_, trackOf_, isThere);
    // Half a step's gain of speed behind the engine's own path, see above; of what is new, as if it had come at this speed.
    const double end = path.metres - 0.5 * path.metresPerSecond * seconds;
    const double gone = path.metresPerSecond * seconds;
    SurfaceMotion motion{end - gone, path.metresPerSecond, 0.0, seconds};
    const bool hasJumped = isThere && std::abs(path.metres - track.metres - gone) > 0.5 * std::abs(gone) + 1.0e-3;
    if (isThere && !hasJumped) {
        motion.startMetres = track.metres - 0.5 * track.metresPerSecond * seconds;
        motion.metresPerSecond2 = (path.metresPerSecond - track.metresPerSecond) / seconds;
        motion.metresPerSecond = (end - motion.startMetres) / seconds - 0.5 * motion.metresPerSecond2 * seconds;
    }
    track.a = point.a;
    track.b = point.b;
    track.metres = path.metres;
    track.metresPerSecond = path.metresPerSecond;
    track.isNew = true;

    const double fastest = std::max(std::abs(motion.metresPerSecond), std::abs(motion.speedAt(seconds)));
    const double newtons = steadyShare(point) * point.normalNewtonSeconds / seconds;
    if (fastest < leastMetresPerSecond || newtons <= 0.0) return;
    const double perSecond = fastest / table_[surface].values.texture.grainMetres;
    const auto times = static_cast<std::uint64_t>(std::ceil(std::max(1.0, perSecond / mostPerSecond)));
    passages_.push_back({&point, surface, newtons, motion, static_cast<std::int64_t>(std::bit_ceil(times))});
}

void LastingContacts::thinTogether(double seconds) {
    double grains = 0.0;
    for (const Passage& p : passages_)
        grains += std::abs(p.motion.metresAt(seconds) - p.motion.startMetres) / table_[p.surface].values.texture.grainMetres / static_cast<double>(p.every);
    const auto times = static_cast<std::uint64_t>(std::ceil(std::max(1.0, grains / (mostTogetherPerSecond * seconds))));
    for (Passage& p : passages_) p.every *= static_cast<std::int64_t>(std::bit_ceil(times));
}

void LastingContacts::pass(const Passage& passage, const StepSpan& span, std::vector<Impact>& impacts) {
    const LastingPoint& point = *passage.point;
    const Texture& texture = table_[passage.surface].values.texture;
    const Grains grains{static_cast<std::uint64_t>(table_[passage.surface].id), texture};
    const double power = std::sqrt(static_cast<double>(passage.every));
    const double seconds = passage.motion.seconds;
    grains.along(passage.motion, passage.every, [&](std::int64_t index, double t) {
        thinned_ += static_cast<std::uint64_t>(passage.every - 1);
        const double speed = std::abs(passage.motion.speedAt(t));
        if (speed < leastMetresPerSecond) return;
        const double slip = std::min(speed, std::abs(point.slipMetresPerSecond));
        const double felt = slip + texture.rolling * (speed - slip);
        Impact impact;
        impact.timeNs = span.timeNs(t / seconds);
        impact.newtonSeconds = power * grains.strengthOf(index) * grainImpulse(texture.roughness, passage.loadNewtons, felt);
        impact.point = point.point + static_cast<float>(t - 1.5 * seconds) * point.metresPerSecond;
        impact.kind = slip > 0.5 * speed ? ContactKind::slide : ContactKind::roll;
        for (const auto& [camera, other] : {std::pair{point.a, point.b}, std::pair{point.b, point.a}}) {
            if (!table_.isCamera(camera)) continue;
            impact.camera = camera;
            impact.other = other;
            impacts.push_back(impact);
        }
    });
}

void LastingContacts::endStep() {
    points_.clear();
    told_.clear();
    keepNew(tracks_, trackOf_);
    keepNew(loads_, loadOf_);
}

void LastingContacts::forget(std::int32_t slot) noexcept {
    std::erase_if(points_, [slot](const LastingPoint& p) { return p.a == slot || p.b == slot; });
    for (Track& track : tracks_)
        if (track.a == slot || track.b == slot) track.metres = farMetres; // what comes next has jumped
}

void LastingContacts::reset() noexcept {
    points_.clear();
    told_.clear();
    tracks_.clear();
    trackOf_.clear();
    loads_.clear();
    loadOf_.clear();
}

} // namespace physvib
