// SPDX-License-Identifier: MIT
// Combines strips with the faders, mutes and lanes of their groups.
#include "Live/Documents/StripGroups.h"
#include <algorithm>
#include <array>

namespace physvib {
namespace {

const StripGroup* groupOf(const Mix& mix, const Strip& strip) {
    return strip.group < 0 ? nullptr : &mix.groups[static_cast<std::size_t>(strip.group)];
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

} // namespace

std::vector<Strip> feltStrips(const Mix& mix) {
    std::vector<Strip> felt = mix.strips;
    for (Strip& strip : felt) {
        if (const StripGroup* group = groupOf(mix, strip)) {
            strip.gainDb = sumDb({strip.gainDb, group->gainDb});
            strip.isMuted |= group->isMuted;
        }
        strip.group = -1;
        strip.lane.clear();
    }
    return felt;
}

bool hasLane(const Mix& mix, std::size_t strip) {
    const StripGroup* group = groupOf(mix, mix.strips[strip]);
    return !mix.strips[strip].lane.empty() || (group != nullptr && !group->lane.empty());
}

double gainDbAt(const Mix& mix, std::size_t strip, double seconds) {
    const Strip& own = mix.strips[strip];
    const StripGroup* group = groupOf(mix, own);
    if (group == nullptr) return sumDb({own.gainDb, laneDbAt(own.lane, seconds)});
    return sumDb({own.gainDb, group->gainDb, laneDbAt(own.lane, seconds), laneDbAt(group->lane, seconds)});
}

double loudestDb(const Mix& mix, std::size_t strip) {
    const Strip& own = mix.strips[strip];
    const StripGroup* group = groupOf(mix, own);
    if (group == nullptr) return sumDb({own.gainDb, loudestDb(own.lane)});
    return sumDb({own.gainDb, group->gainDb, loudestDb(own.lane), loudestDb(group->lane)});
}

double mostAddedDb(const Mix& mix, std::size_t strip) {
    const Strip& own = mix.strips[strip];
    const StripGroup* group = groupOf(mix, own);
    return loudestDb(own.lane) + (group == nullptr ? 0.0 : group->gainDb + loudestDb(group->lane));
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

} // namespace physvib
