// SPDX-License-Identifier: MIT
// The mixer state: scene, layout, channel strips, groups, gain lanes; its effective gains; the user's limits.
#pragma once
#include "Core/Limits.h"
#include "Core/RenderControl.h"
#include "Core/Units.h"
#include "Io/Json/FieldTable.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// Channel strips of mixer and plug-in, one per actuator, and groups of strips. The fields of each struct in
// files are listed below it.

// Gain automation over the time of a scene run: points joined by straight lines in dB.

constexpr double minStripDb = -60.0, maxStripDb = 6.0; ///< faders and lanes; minStripDb is silence

struct GainPoint {
    double seconds = 0.0; ///< of the world, from the start of the scene run
    double db = 0.0;      ///< added to the fader, minStripDb (silence) to maxStripDb
    bool operator==(const GainPoint&) const = default;
};

/// Points in time order; without points the lane adds 0 dB.
using GainLane = std::vector<GainPoint>;
constexpr std::size_t maxGainPoints = 2'000;

/// The lane's gain at that time, in steps of 0.1 dB, as faders have. Any thread, as all functions here.
double laneDbAt(const GainLane& lane, double seconds) noexcept;
double maxGainDb(const GainLane& lane) noexcept; ///< largest value of its points

/// Total of gains in series: silence if one of them is, and limited to the range of a fader.
double sumDb(std::initializer_list<double> gainsDb) noexcept;

/// The sum of both lanes, with the points of both (allocates).
GainLane sumLanes(const GainLane& a, const GainLane& b);

/// Removes points within 0.25 dB of the line between their neighbours, and more until at most `maxPoints`
/// remain (allocates).
GainLane simplified(const GainLane& lane, std::size_t maxPoints = maxGainPoints);

/// The session format version that introduced the newest field of a strip or group.
constexpr int stripsVersion = 8;

namespace kinds {
/// The plug-in's strips, one per actuator; each plays on the channel of the same number.
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
    double ceilingDb = 0.0; ///< relative to full scale
    int output = -1;        ///< device output from 0; -1: none
    int group = -1;         ///< index into the mix's groups; -1: none
    GainLane lane{};        ///< added to the fader
    bool operator==(const Strip&) const = default;
};

constexpr double minCeilingDb = -60.0; // lower values would amount to a mute
constexpr int maxStripOutputs = 1024;
constexpr std::size_t maxGroups = 16;
inline constexpr auto stripRangeDb = kinds::range(minStripDb, maxStripDb); // minStripDb is silence

/// The fields that the plug-in's strips, which have no groups and lanes, have too.
void visitStrip(auto& v) {
    v.field("gain_db", &Strip::gainDb, stripRangeDb);
    v.field("mute", &Strip::isMuted, kinds::boolean);
    v.field("solo", &Strip::isSolo, kinds::boolean);
    v.field("invert", &Strip::isInverted, kinds::boolean);
    v.field("delay_ms", &Strip::delayMs, kinds::range(0.0, 1e3 * limits::maxChannelDelaySeconds));
    v.field("ceiling_db", &Strip::ceilingDb, kinds::range(minCeilingDb, 0.0));
}

struct PluginStrip; // the plug-in's strip in files
void visitFields(auto& v, FieldsOf<PluginStrip>) { visitStrip(v); }
void visitFields(auto& v, FieldsOf<Strip>) {
    visitStrip(v);
    v.field("output", &Strip::output, kinds::OneBased{0, maxStripOutputs}); // 0: none
    v.field("group", &Strip::group, kinds::OneBased{1, static_cast<int>(maxGroups)}, Need::optional.from(8));
    v.field("lane", &Strip::lane, Custom<GainLane>{}, Need::optional.from(8));
}

/// Strips with a common fader and mute, such as those of a hand or the back.
struct StripGroup {
    std::string name;
    double gainDb = 0.0; ///< added to each strip's gain
    bool isMuted = false;
    GainLane lane{};
    bool operator==(const StripGroup&) const = default;
};

void visitFields(auto& v, FieldsOf<StripGroup>) {
    v.field("name", &StripGroup::name, kinds::text);
    v.field("gain_db", &StripGroup::gainDb, stripRangeDb);
    v.field("mute", &StripGroup::isMuted, kinds::boolean);
    v.field("lane", &StripGroup::lane, Custom<GainLane>{}, Need::optional);
}

/// The lowest of `outputs` outputs that no strip uses and that is not in use otherwise; -1: none. Any thread.
inline int freeOutput(std::span<const Strip> strips, std::span<const int> inUse = {},
                      int outputs = maxStripOutputs) noexcept {
    for (int k = 0; k < outputs; ++k)
        if (std::ranges::find(strips, k, &Strip::output) == strips.end() &&
            std::ranges::find(inUse, k) == inUse.end())
            return k;
    return -1;
}

/// Gives a strip an output; -1: none. The strip that had it gets this one's former output. Any thread.
inline void assignOutput(std::span<Strip> strips, std::size_t strip, int output) noexcept {
    const auto owner = output < 0 ? strips.end() : std::ranges::find(strips, output, &Strip::output);
    if (owner != strips.end()) owner->output = strips[strip].output;
    strips[strip].output = output;
}

/// Removes the output of each strip that shares it with an earlier strip. Returns their indices. Any thread.
inline std::vector<std::size_t> removeSharedOutputs(std::span<Strip> strips) {
    std::vector<std::size_t> changed;
    for (std::size_t j = 1; j < strips.size(); ++j) {
        if (strips[j].output < 0) continue;
        const auto earlier = strips.first(j);
        if (std::ranges::find(earlier, strips[j].output, &Strip::output) == earlier.end()) continue;
        strips[j].output = -1;
        changed.push_back(j);
    }
    return changed;
}

/// A strip for one more actuator: on the lowest free output, with the others' lowest ceiling. Any thread.
inline Strip makeNextStrip(std::span<const Strip> strips) noexcept {
    Strip next;
    next.output = freeOutput(strips);
    for (const Strip& s : strips) next.ceilingDb = std::min(next.ceilingDb, s.ceilingDb);
    return next;
}

/// Resizes to one strip per actuator. Any thread.
inline void resizeStrips(std::vector<Strip>& strips, int actuators) {
    const auto count = static_cast<std::size_t>(actuators);
    while (strips.size() < count) strips.push_back(makeNextStrip(strips));
    strips.resize(count);
}

/// Whether the strip is silent: muted, or another strip is solo and this one is not. Any thread.
inline bool isSilent(std::span<const Strip> strips, std::size_t strip) noexcept {
    return strips[strip].isMuted || (!strips[strip].isSolo && std::ranges::any_of(strips, &Strip::isSolo));
}

/// Gain of the channel: level and polarity. Any thread.
inline float channelGain(const Strip& strip) noexcept {
    const double gain = strip.gainDb <= minStripDb ? 0.0 : fromDecibels(strip.gainDb);
    return static_cast<float>(strip.isInverted ? -gain : gain);
}

/// Largest sample value that the strip lets pass. Any thread.
inline float channelCeiling(const Strip& strip) noexcept {
    return static_cast<float>(fromDecibels(strip.ceilingDb));
}

/// The strip values last sent to a session; initially those a session starts with.
struct SentStrip {
    float gain = 1.0f, delaySeconds = 0.0f, ceiling = 1.0f, mute = 0.0f;
};

/// Sends a session the values of strips that have changed. `sent` has one entry per strip. `send(control)`
/// returns false if the queue is full; then this function returns false too, and the next call sends the
/// value again. Any thread.
template <class Send>
bool sendStrips(std::span<SentStrip> sent, std::span<const Strip> strips, Send send) {
    using Kind = RenderControl::Kind;
    bool isSent = true;
    for (std::size_t j = 0; j < strips.size(); ++j) {
        const auto sendChange = [&](Kind kind, float value, float& sentValue) {
            if (value == sentValue) return;
            if (send(RenderControl{0, kind, static_cast<int>(j), value, {}}))
                sentValue = value;
            else
                isSent = false;
        };
        sendChange(Kind::gain, channelGain(strips[j]), sent[j].gain);
        sendChange(Kind::delay, static_cast<float>(1e-3 * strips[j].delayMs), sent[j].delaySeconds);
        sendChange(Kind::ceiling, channelCeiling(strips[j]), sent[j].ceiling);
        sendChange(Kind::mute, isSilent(strips, j) ? 1.0f : 0.0f, sent[j].mute);
    }
    return isSent;
}

// N s per metre of the screen (thesis 5.3.1)
constexpr double defaultDrag = 32'000.0, minDrag = 1'000.0, maxDrag = 100'000.0;

struct Mix {
    std::shared_ptr<const Scene> scene; ///< never null
    std::uint32_t seed = 1;
    LayoutDescription layout;
    PanningLaw law = PanningLaw::automatic;
    double exponent = 1.0;
    std::vector<Strip> strips; ///< one per actuator
    std::vector<StripGroup> groups{};
    double levelDb = -12.0;                               ///< master level; minStripDb is silence
    double dragNewtonSecondsPerScreenMetre = defaultDrag; ///< impulse of a drag in the world

    int count() const noexcept { return layout.geometry.count; }
    PhantomPanner panner() const noexcept {
        PhantomPanner made{layout.geometry, law, exponent, scene->fieldWidthMetres, scene->fieldHeightMetres};
        // older files, without the law `auto`, call the default linear; grains keep it
        if (law == PanningLaw::linear && exponent == 1.0) made.setGrains(grainSpread);
        return made;
    }

    void resizeStrips() { physvib::resizeStrips(strips, count()); } ///< one per actuator
    bool isSilent(int strip) const noexcept {
        const int group = strips[static_cast<std::size_t>(strip)].group;
        return physvib::isSilent(strips, static_cast<std::size_t>(strip)) ||
               (group >= 0 && groups[static_cast<std::size_t>(group)].isMuted);
    }
};

inline constexpr auto exponentRange = kinds::range(1e-3, 100.0);
inline constexpr auto masterRangeDb = kinds::range(minStripDb, 0.0);

/// A JSON kind: layout, law, exponent and field of a panner, for at most `channels` actuators. `described`
/// has the parts of the layout that a panner does not store: name, labels, full scales; empty: not known.
template <class Layout>
struct DescribedPanner {
    int channels;
    Layout& described; ///< LayoutDescription, const for writers
};
template <class Layout>
DescribedPanner(int, Layout&) -> DescribedPanner<Layout>; // Clang 14 does not deduce it

/// Scene and seed are no fields: they come from the session's last scene run.
void visitFields(auto& v, FieldsOf<Mix>) {
    constexpr auto dragRange = kinds::range(minDrag, maxDrag);
    v.field("layout", &Mix::layout, Custom<LayoutDescription>{});
    v.field("law", &Mix::law, kinds::OneOf{panningLawNames});
    v.field("exponent", &Mix::exponent, exponentRange);
    v.field("level_db", &Mix::levelDb, masterRangeDb);
    // Older files: per metre of the field. Drags already recorded in the inputs keep their values.
    v.legacyField("drag_ns_per_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange);
    v.field("drag_ns_per_screen_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange, Need::required.from(4));
    v.field("strips", &Mix::strips, PerChannel<std::vector<Strip>>{v.object.count()});
    v.field("groups", &Mix::groups, kinds::Objects<StripGroup>{maxGroups, "groups"}, Need::optional.from(8));
}

/// True if the actuators are at the same places of the same extent, on the same parts. Any thread.
inline bool isSame(const ActuatorLayout& a, const ActuatorLayout& b) noexcept {
    const auto equal = [](const ActuatorPlace& p, const ActuatorPlace& q) {
        return p.xMetres == q.xMetres && p.yMetres == q.yMetres && p.zMetres == q.zMetres && p.part == q.part;
    };
    return a.extentWidthMetres == b.extentWidthMetres && a.extentHeightMetres == b.extentHeightMetres &&
           a.count == b.count &&
           std::equal(a.places.begin(), a.places.begin() + a.count, b.places.begin(), equal);
}

/// True if both play the same and have the same names and labels. Any thread.
inline bool isSame(const Mix& a, const Mix& b) {
    return (a.scene == b.scene || *a.scene == *b.scene) && a.seed == b.seed &&
           a.layout.name == b.layout.name && isSame(a.layout.geometry, b.layout.geometry) &&
           a.layout.actuators == b.layout.actuators && a.law == b.law && a.exponent == b.exponent &&
           a.strips == b.strips && a.groups == b.groups && a.levelDb == b.levelDb &&
           a.dragNewtonSecondsPerScreenMetre == b.dragNewtonSecondsPerScreenMetre;
}

/// Factor that all channels are multiplied by last. Any thread.
inline float masterGain(const Mix& mix) noexcept {
    return mix.levelDb <= minStripDb ? 0.0f : static_cast<float>(fromDecibels(mix.levelDb));
}

// Effective gain and mute of strips, with their groups and lanes applied.

/// The strips as they are sent to the session: with their group's fader and mute applied, without group and
/// lanes. Any thread (allocates), as all functions here.
std::vector<Strip> effectiveStrips(const Mix& mix);

/// Whether the strip or its group has a lane.
bool hasLane(const Mix& mix, std::size_t strip);

/// The strip's gain at that time of the scene run, in dB: fader, group and both lanes.
double gainDbAt(const Mix& mix, std::size_t strip, double seconds);

/// Maximum of gainDbAt() over time; and of the sum that group and lanes add to the fader, without limits.
double maxGainDb(const Mix& mix, std::size_t strip);
double maxAddedDb(const Mix& mix, std::size_t strip);

/// Adds an empty group; returns its index.
int addGroup(Mix& mix, std::string name);
/// An unused name: "Left hand", "Right hand", "Back", then numbers.
std::string freeGroupName(const Mix& mix);
/// Removes a group without changing the output: its strips absorb its fader, mute and lane.
void removeGroup(Mix& mix, int group);

// Limits that a mixer state loaded from a file must not exceed: the levels that this computer's user has set.

/// The limits, taken from the mixer state as the user left it.
struct MixerLimits {
    double levelDb = 0.0;
    std::vector<Strip> strips; ///< one per output in use, with the gain that reaches it

    static MixerLimits fromMix(const Mix& mix);
    /// Level of the loudest output by gain, ceiling and master; the master's alone if no output is in use.
    double loudestOutputDb() const;
};

void visitFields(auto& v, FieldsOf<MixerLimits>) {
    v.field("level_db", &MixerLimits::levelDb, masterRangeDb);
    v.field("strips", &MixerLimits::strips, kinds::Objects<Strip>{});
}

/// Lowers `mix` to `limits`: its master level, and gain and ceiling of each output. An output that is muted
/// in `limits` is muted. An actuator on an output that `limits` does not use gets no output. Returns a text
/// for the user that lists the changes; empty: none. Any thread.
std::string lowerToLimits(const MixerLimits& limits, Mix& mix);

/// Conversion to text for a program's settings, and back; nullopt if the text is invalid. Any thread.
std::string mixerLimitsText(const MixerLimits& limits);
std::optional<MixerLimits> readMixerLimits(std::string_view text);

} // namespace physvib
