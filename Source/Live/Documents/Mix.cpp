// SPDX-License-Identifier: MIT
// Gain lanes (interpolation, sum, simplification), groups of strips, and the user's limits of levels.
#include "Live/Documents/Mix.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"

namespace physvib {
namespace {

double onFaderStep(double db) noexcept { return std::round(10.0 * db) / 10.0; }

double lineAt(const GainPoint& from, const GainPoint& to, double seconds) noexcept {
    const double length = to.seconds - from.seconds;
    return length > 0.0 ? from.db + (to.db - from.db) * (seconds - from.seconds) / length : to.db;
}

/// The point farthest from the line between the ends of lane[from..to]; `from` if none exceeds it.
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

/// The strip's group, or one without effect.
const StripGroup& groupOf(const Mix& mix, const Strip& strip) {
    static const StripGroup none{};
    return strip.group < 0 ? none : mix.groups[static_cast<std::size_t>(strip.group)];
}

/// The strip with its group's fader, mute and lane applied, in no group.
Strip ungrouped(const Strip& strip, const StripGroup& group) {
    Strip alone = strip;
    alone.gainDb = sumDb({strip.gainDb, group.gainDb});
    alone.isMuted |= group.isMuted;
    alone.lane = thinned(sumOf(strip.lane, group.lane));
    alone.group = -1;
    return alone;
}

constexpr std::size_t mostTextBytes = 100'000; // 64 strips need 8 kB

class Notes {
public:
    void lower(double& value, double most, const std::string& what) {
        if (value <= most) return;
        add(what + ' ' + fixedNumber(value, 1) + " to " + fixedNumber(most, 1) + " dB");
        value = most;
    }
    void add(const std::string& note) {
        constexpr int mostNotes = 8; // users do not read more
        if (++count_ <= mostNotes) words_ += (words_.empty() ? "" : "; ") + note;
    }
    std::string words() const { return words_; }

private:
    std::string words_;
    int count_ = 0;
};

/// The highest fader position at which the strip's loudest gain, with group and lanes, is `mostDb`.
double mostFaderDb(const Mix& mix, std::size_t strip, double mostDb) {
    if (loudestDb(mix, strip) <= mostDb) return mostStripDb;
    return mostDb <= leastStripDb ? leastStripDb
                                  : std::clamp(mostDb - mostAddedDb(mix, strip), leastStripDb, mostStripDb);
}

void lowerStrip(const Strip* most, bool isSilentThere, double mostDb, Strip& strip, const std::string& label,
                Notes& notes) {
    if (most == nullptr) {
        notes.add(label + " without output " + std::to_string(strip.output + 1));
        strip.output = -1;
        return;
    }
    notes.lower(strip.gainDb, mostDb, label + " gain");
    notes.lower(strip.ceilingDb, most->ceilingDb, label + " ceiling");
    if (!isSilentThere || strip.isMuted) return;
    notes.add(label + " muted");
    strip.isMuted = true;
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

std::vector<Strip> feltStrips(const Mix& mix) {
    std::vector<Strip> felt = mix.strips;
    for (Strip& strip : felt) {
        if (strip.group >= 0) strip.gainDb = sumDb({strip.gainDb, groupOf(mix, strip).gainDb});
        strip.isMuted |= groupOf(mix, strip).isMuted;
        strip.group = -1;
        strip.lane.clear();
    }
    return felt;
}

bool hasLane(const Mix& mix, std::size_t strip) {
    return !mix.strips[strip].lane.empty() || !groupOf(mix, mix.strips[strip]).lane.empty();
}

double gainDbAt(const Mix& mix, std::size_t strip, double seconds) {
    const Strip& own = mix.strips[strip];
    const StripGroup& group = groupOf(mix, own);
    return sumDb({own.gainDb, group.gainDb, laneDbAt(own.lane, seconds), laneDbAt(group.lane, seconds)});
}

double loudestDb(const Mix& mix, std::size_t strip) {
    const Strip& own = mix.strips[strip];
    const StripGroup& group = groupOf(mix, own);
    return sumDb({own.gainDb, group.gainDb, loudestDb(own.lane), loudestDb(group.lane)});
}

double mostAddedDb(const Mix& mix, std::size_t strip) {
    const StripGroup& group = groupOf(mix, mix.strips[strip]);
    return loudestDb(mix.strips[strip].lane) + (group.gainDb + loudestDb(group.lane));
}

int addGroup(Mix& mix, std::string name) {
    mix.groups.push_back({.name = std::move(name)});
    return static_cast<int>(mix.groups.size()) - 1;
}

std::string freeGroupName(const Mix& mix) {
    static constexpr std::array<const char*, 3> usual{"Left hand", "Right hand", "Back"};
    const auto isFree = [&](const std::string& name) {
        return std::ranges::find(mix.groups, name, &StripGroup::name) == mix.groups.end();
    };
    for (const char* const name : usual)
        if (isFree(name)) return name;
    for (int n = static_cast<int>(usual.size()) + 1;; ++n)
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

DeskLimits DeskLimits::of(const Mix& mix) {
    std::vector<Strip> strips = feltStrips(mix);
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].gainDb = loudestDb(mix, j);
    return {mix.levelDb, strips};
}

double DeskLimits::loudestOutputDb() const {
    std::vector<double> gains;
    for (const Strip& strip : strips)
        if (strip.output >= 0) gains.push_back(std::min(strip.gainDb, strip.ceilingDb));
    return gains.empty() ? levelDb : std::max(leastStripDb, levelDb + std::ranges::max(gains));
}

std::string lowerTo(const DeskLimits& most, Mix& mix) {
    Notes notes;
    notes.lower(mix.levelDb, most.levelDb, "master");
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        Strip& strip = mix.strips[j];
        if (strip.output < 0) continue;
        const auto own = std::ranges::find(most.strips, strip.output, &Strip::output);
        const bool isThere = own != most.strips.end();
        lowerStrip(isThere ? &*own : nullptr,
                   isThere && isSilent(most.strips, static_cast<std::size_t>(own - most.strips.begin())),
                   isThere ? mostFaderDb(mix, j, own->gainDb) : leastStripDb, strip,
                   mix.layout.enchanters[j].label, notes);
    }
    return notes.words();
}

std::string deskLimitsText(const DeskLimits& limits) { return writeTable(limits).dump(); }

std::optional<DeskLimits> readDeskLimits(std::string_view text) {
    auto read = readJson(text, "settings", mostTextBytes, [](const Json& root) {
        return kinds::Object<DeskLimits>{}(JsonField{root, {}});
    });
    return read ? std::optional{std::move(read.value)} : std::nullopt;
}

} // namespace physvib
