// SPDX-License-Identifier: MIT
// Gain lanes (interpolation, sum, simplification), groups of strips, and the user's limits of levels.
#include "Live/Documents/Mix.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"

namespace physvib {
namespace {

double roundedToFaderStep(double db) noexcept { return std::round(10.0 * db) / 10.0; }

double lineDb(const GainPoint& start, const GainPoint& end, double seconds) noexcept {
    const double length = end.seconds - start.seconds;
    return length > 0.0 ? start.db + (end.db - start.db) * (seconds - start.seconds) / length : end.db;
}

/// Index in first..last of the largest deviation from a straight line; `first` if all are within tolerance.
std::size_t farthestPoint(const GainLane& lane, std::size_t first, std::size_t last, double toleranceDb) {
    std::size_t found = first;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double deviationDb = std::abs(lane[i].db - lineDb(lane[first], lane[last], lane[i].seconds));
        if (deviationDb > toleranceDb) toleranceDb = deviationDb, found = i;
    }
    return found;
}

/// Ramer 1972, Douglas and Peucker 1973: keeps the ends, and points too far from the line between them.
GainLane withinTolerance(const GainLane& lane, double toleranceDb) {
    if (lane.size() < 3) return lane;
    GainLane result{lane.front()};
    std::vector<std::size_t> ends{lane.size() - 1}; // ends of the segments still to check, the next one last
    for (std::size_t first = 0; !ends.empty();) {
        const std::size_t middle = farthestPoint(lane, first, ends.back(), toleranceDb);
        if (middle != first) {
            ends.push_back(middle);
            continue;
        }
        first = ends.back();
        ends.pop_back();
        result.push_back(lane[first]);
    }
    return result;
}

/// The strip's group; for a strip without one, a group that changes nothing.
const StripGroup& findGroup(const Mix& mix, const Strip& strip) {
    static const StripGroup none{};
    return strip.group < 0 ? none : mix.groups[static_cast<std::size_t>(strip.group)];
}

/// The strip with its group's fader, mute and lane applied, in no group.
Strip ungrouped(const Strip& strip, const StripGroup& group) {
    Strip single = strip;
    single.gainDb = sumDb({strip.gainDb, group.gainDb});
    single.isMuted |= group.isMuted;
    single.lane = simplified(sumLanes(strip.lane, group.lane));
    single.group = -1;
    return single;
}

constexpr std::size_t maxTextBytes = 100'000; // 64 strips need 8 kB

class ChangeNotes {
public:
    void lower(double& value, double maxDb, const std::string& what) {
        if (value <= maxDb) return;
        add(what + ' ' + fixedNumber(value, 1) + " to " + fixedNumber(maxDb, 1) + " dB");
        value = maxDb;
    }
    void add(const std::string& note) {
        constexpr int maxNotes = 8; // users do not read more
        if (++count_ <= maxNotes) text_ += (text_.empty() ? "" : "; ") + note;
    }
    std::string text() const { return text_; }

private:
    std::string text_;
    int count_ = 0;
};

/// The highest fader position at which the strip's loudest gain, with group and lanes, is `maxDb`.
double maxFaderDb(const Mix& mix, std::size_t strip, double maxDb) {
    if (maxGainDb(mix, strip) <= maxDb) return maxStripDb;
    return maxDb <= minStripDb ? minStripDb
                               : std::clamp(maxDb - maxAddedDb(mix, strip), minStripDb, maxStripDb);
}

void lowerStrip(const Strip* cap, bool isLimitMuted, double maxDb, Strip& strip, const std::string& label,
                ChangeNotes& notes) {
    if (cap == nullptr) {
        notes.add(label + " without output " + std::to_string(strip.output + 1));
        strip.output = -1;
        return;
    }
    notes.lower(strip.gainDb, maxDb, label + " gain");
    notes.lower(strip.ceilingDb, cap->ceilingDb, label + " ceiling");
    if (!isLimitMuted || strip.isMuted) return;
    notes.add(label + " muted");
    strip.isMuted = true;
}

} // namespace

double laneDbAt(const GainLane& lane, double seconds) noexcept {
    if (lane.empty()) return 0.0;
    const auto next = std::ranges::upper_bound(lane, seconds, {}, &GainPoint::seconds);
    if (next == lane.begin()) return roundedToFaderStep(lane.front().db);
    if (next == lane.end()) return roundedToFaderStep(lane.back().db);
    return roundedToFaderStep(lineDb(*std::prev(next), *next, seconds));
}

double maxGainDb(const GainLane& lane) noexcept {
    return lane.empty() ? 0.0 : std::ranges::max(lane, {}, &GainPoint::db).db;
}

double sumDb(std::initializer_list<double> gainsDb) noexcept {
    double sum = 0.0;
    for (const double db : gainsDb) {
        if (db <= minStripDb) return minStripDb;
        sum += db;
    }
    return std::clamp(sum, minStripDb, maxStripDb);
}

GainLane sumLanes(const GainLane& a, const GainLane& b) {
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

GainLane simplified(const GainLane& lane, std::size_t maxPoints) {
    constexpr double minToleranceDb = 0.25; // a quarter of the just noticeable difference
    GainLane result = withinTolerance(lane, minToleranceDb);
    for (double toleranceDb = minToleranceDb; result.size() > maxPoints; toleranceDb *= 2.0)
        result = withinTolerance(lane, toleranceDb);
    if (result.size() == 2 && result[0].db == result[1].db) result.pop_back(); // the gain is constant
    return result;
}

std::vector<Strip> effectiveStrips(const Mix& mix) {
    std::vector<Strip> effective = mix.strips;
    for (Strip& strip : effective) {
        if (strip.group >= 0) strip.gainDb = sumDb({strip.gainDb, findGroup(mix, strip).gainDb});
        strip.isMuted |= findGroup(mix, strip).isMuted;
        strip.group = -1;
        strip.lane.clear();
    }
    return effective;
}

bool hasLane(const Mix& mix, std::size_t strip) {
    return !mix.strips[strip].lane.empty() || !findGroup(mix, mix.strips[strip]).lane.empty();
}

double gainDbAt(const Mix& mix, std::size_t strip, double seconds) {
    const Strip& self = mix.strips[strip];
    const StripGroup& group = findGroup(mix, self);
    return sumDb({self.gainDb, group.gainDb, laneDbAt(self.lane, seconds), laneDbAt(group.lane, seconds)});
}

double maxGainDb(const Mix& mix, std::size_t strip) {
    const Strip& self = mix.strips[strip];
    const StripGroup& group = findGroup(mix, self);
    return sumDb({self.gainDb, group.gainDb, maxGainDb(self.lane), maxGainDb(group.lane)});
}

double maxAddedDb(const Mix& mix, std::size_t strip) {
    const StripGroup& group = findGroup(mix, mix.strips[strip]);
    return maxGainDb(mix.strips[strip].lane) + (group.gainDb + maxGainDb(group.lane));
}

int addGroup(Mix& mix, std::string name) {
    mix.groups.push_back({.name = std::move(name)});
    return static_cast<int>(mix.groups.size()) - 1;
}

std::string freeGroupName(const Mix& mix) {
    static constexpr std::array<const char*, 3> defaultNames{"Left hand", "Right hand", "Back"};
    const auto isFree = [&](const std::string& name) {
        return std::ranges::find(mix.groups, name, &StripGroup::name) == mix.groups.end();
    };
    for (const char* const name : defaultNames)
        if (isFree(name)) return name;
    for (int n = static_cast<int>(defaultNames.size()) + 1;; ++n)
        if (std::string name = "Group " + std::to_string(n); isFree(name)) return name;
}

void removeGroup(Mix& mix, int group) {
    for (Strip& strip : mix.strips) {
        if (strip.group == group)
            strip = ungrouped(strip, mix.groups[static_cast<std::size_t>(group)]);
        else if (strip.group > group)
            --strip.group;
    }
    mix.groups.erase(mix.groups.begin() + group);
}

MixerLimits MixerLimits::fromMix(const Mix& mix) {
    std::vector<Strip> strips = effectiveStrips(mix);
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].gainDb = maxGainDb(mix, j);
    return {mix.levelDb, strips};
}

double MixerLimits::loudestOutputDb() const {
    std::vector<double> gains;
    for (const Strip& strip : strips)
        if (strip.output >= 0) gains.push_back(std::min(strip.gainDb, strip.ceilingDb));
    return gains.empty() ? levelDb : std::max(minStripDb, levelDb + std::ranges::max(gains));
}

std::string lowerToLimits(const MixerLimits& limits, Mix& mix) {
    ChangeNotes notes;
    notes.lower(mix.levelDb, limits.levelDb, "master");
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        Strip& strip = mix.strips[j];
        if (strip.output < 0) continue;
        const auto cap = std::ranges::find(limits.strips, strip.output, &Strip::output);
        const bool hasLimit = cap != limits.strips.end();
        lowerStrip(hasLimit ? &*cap : nullptr,
                   hasLimit && isSilent(limits.strips, static_cast<std::size_t>(cap - limits.strips.begin())),
                   hasLimit ? maxFaderDb(mix, j, cap->gainDb) : minStripDb, strip,
                   mix.layout.actuators[j].label, notes);
    }
    return notes.text();
}

std::string mixerLimitsText(const MixerLimits& limits) { return writeTable(limits).dump(); }

std::optional<MixerLimits> readMixerLimits(std::string_view text) {
    auto read = readJson(text, "settings", maxTextBytes, [](const Json& root) {
        return kinds::Object<MixerLimits>{}(JsonField{root, {}});
    });
    return read ? std::optional{std::move(read.value)} : std::nullopt;
}

} // namespace physvib
