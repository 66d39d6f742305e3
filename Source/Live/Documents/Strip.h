// SPDX-License-Identifier: MIT
// A strip of the mixer or the plug-in for each actuator, and groups of strips: the structs, and below each
// the table of its fields in files.
#pragma once
#include "Core/Decibels.h"
#include "Core/Limits.h"
#include "Core/RenderControl.h"
#include "Io/Json/FieldTable.h"
#include "Live/Documents/GainLane.h"
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// The version of the session format that brought the newest field of a strip or a group.
constexpr int stripsVersion = 8;

namespace kinds {
/// The plug-in's strips, one per actuator: each leaves by the channel of its number.
struct PluginStrips {
    int count;
};
} // namespace kinds

struct Strip {
    double gainDb = 0.0;
    bool isMuted = false;
    bool isSolo = false;
    bool isInverted = false; ///< polarity
    double delayMs = 0.0;
    double ceilingDb = 0.0; ///< of full scale
    int output = -1;        ///< of the device, from 0; -1: none
    int group = -1;         ///< of the mix; -1: none
    GainLane lane{};        ///< on top of the fader
    bool operator==(const Strip&) const = default;
};

constexpr double leastCeilingDb = -60.0; // lower is a mute by another name
constexpr int mostStripOutputs = 1024;
constexpr std::size_t mostGroups = 16;
inline constexpr auto stripRangeDb = kinds::within(leastStripDb, mostStripDb); // the least is silence

/// What the plug-in's strips have as well. They have no groups and lanes.
void visitStrip(auto& v) {
    v.field("gain_db", &Strip::gainDb, stripRangeDb);
    v.field("mute", &Strip::isMuted, kinds::truth);
    v.field("solo", &Strip::isSolo, kinds::truth);
    v.field("invert", &Strip::isInverted, kinds::truth);
    v.field("delay_ms", &Strip::delayMs, kinds::within(0.0, 1e3 * limits::maxChannelDelaySeconds));
    v.field("ceiling_db", &Strip::ceilingDb, kinds::within(leastCeilingDb, 0.0));
}

struct PluginStrip; // in its files
void visitFields(auto& v, FieldsOf<PluginStrip>) { visitStrip(v); }
void visitFields(auto& v, FieldsOf<Strip>) {
    visitStrip(v);
    v.field("output", &Strip::output, kinds::FromOne{0, mostStripOutputs}); // 0: none
    v.field("group", &Strip::group, kinds::FromOne{1, static_cast<int>(mostGroups)}, Need::optional.from(8));
    v.field("lane", &Strip::lane, Own<GainLane>{}, Need::optional.from(8));
}

/// Strips that one fader and one mute act on: a hand, a back.
struct StripGroup {
    std::string name;
    double gainDb = 0.0; ///< on top of each of them, as a strip's
    bool isMuted = false;
    GainLane lane{};
    bool operator==(const StripGroup&) const = default;
};

void visitFields(auto& v, FieldsOf<StripGroup>) {
    v.field("name", &StripGroup::name, kinds::text);
    v.field("gain_db", &StripGroup::gainDb, stripRangeDb);
    v.field("mute", &StripGroup::isMuted, kinds::truth);
    v.field("lane", &StripGroup::lane, Own<GainLane>{}, Need::optional);
}

/// The first output that no strip has. Any thread.
inline int freeOutput(std::span<const Strip> strips) noexcept {
    for (int k = 0;; ++k)
        if (std::ranges::find(strips, k, &Strip::output) == strips.end()) return k;
}

/// For one enchanter more: on the first output that no other has, with the lowest ceiling of the others. Any
/// thread.
inline Strip nextStrip(std::span<const Strip> strips) noexcept {
    Strip next;
    next.output = freeOutput(strips);
    for (const Strip& s : strips) next.ceilingDb = std::min(next.ceilingDb, s.ceilingDb);
    return next;
}

/// As many strips as there are enchanters. Any thread.
inline void resizeStrips(std::vector<Strip>& strips, int enchanters) {
    const auto wanted = static_cast<std::size_t>(enchanters);
    while (strips.size() < wanted) strips.push_back(nextStrip(strips));
    strips.resize(wanted);
}

/// True if the strip is not to be felt: it is muted, or others are solo. Any thread.
inline bool isSilent(std::span<const Strip> strips, std::size_t strip) noexcept {
    return strips[strip].isMuted || (!strips[strip].isSolo && std::ranges::any_of(strips, &Strip::isSolo));
}

/// The gain of a channel: its level and polarity. Any thread.
inline float channelGain(const Strip& strip) noexcept {
    const double gain = strip.gainDb <= leastStripDb ? 0.0 : fromDecibels(strip.gainDb);
    return static_cast<float>(strip.isInverted ? -gain : gain);
}

/// The largest sample that a strip lets pass. Any thread.
inline float ceilingOf(const Strip& strip) noexcept {
    return static_cast<float>(fromDecibels(strip.ceilingDb));
}

/// What a session has been told of a channel's strip; at first what it begins with.
struct ToldStrip {
    float gain = 1.0f, delaySeconds = 0.0f, ceiling = 1.0f, mute = 0.0f;
};

/// Tells a session, strip by strip, what it does not know yet; `told` has room for all of them.
/// `tell(control)` is false where it found no room: so is this then, and it is told by the next call. Any
/// thread.
template <class Tell>
bool tellStrips(std::span<ToldStrip> told, std::span<const Strip> strips, Tell tell) {
    using Kind = RenderControl::Kind;
    bool isTold = true;
    for (std::size_t j = 0; j < strips.size(); ++j) {
        const auto change = [&](Kind kind, float value, float& known) {
            if (value == known) return;
            if (tell(RenderControl{0, kind, static_cast<int>(j), value, {}}))
                known = value;
            else
                isTold = false;
        };
        change(Kind::gain, channelGain(strips[j]), told[j].gain);
        change(Kind::delay, static_cast<float>(1e-3 * strips[j].delayMs), told[j].delaySeconds);
        change(Kind::ceiling, ceilingOf(strips[j]), told[j].ceiling);
        change(Kind::mute, isSilent(strips, j) ? 1.0f : 0.0f, told[j].mute);
    }
    return isTold;
}

} // namespace physvib
