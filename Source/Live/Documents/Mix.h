// SPDX-License-Identifier: MIT
// The mixer state: the scene, the layout of actuators, and one strip per actuator.
#pragma once
#include "Live/Documents/Strip.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
// N s per metre of the screen (thesis 5.3.1)
constexpr double thesisDrag = 32'000.0, leastDrag = 1'000.0, mostDrag = 100'000.0;

struct Mix {
    std::shared_ptr<const Scene> scene; ///< never null
    std::uint32_t seed = 1;
    LayoutDescription layout;
    PanningLaw law = PanningLaw::automatic;
    double exponent = 1.0;
    std::vector<Strip> strips; ///< one per actuator
    std::vector<StripGroup> groups{};
    double levelDb = -12.0;                              ///< master level; leastStripDb is silence
    double dragNewtonSecondsPerScreenMetre = thesisDrag; ///< impulse of a drag in the world

    int count() const noexcept { return layout.geometry.count; }
    PhantomPanner panner() const noexcept {
        PhantomPanner made{layout.geometry, law, exponent, scene->fieldWidthMetres, scene->fieldHeightMetres};
        // files of before the law `auto` named the default so: grains keep it
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

inline constexpr auto exponentRange = kinds::within(1e-3, 100.0);
inline constexpr auto masterRangeDb = kinds::within(leastStripDb, 0.0);

/// A kind: layout, law, exponent and field of a panner, for at most `channels` actuators. `described` has
/// what the panner does not keep of its layout: name, labels, full scales; without actuators: not known.
template <class Layout>
struct DescribedPanner {
    int channels;
    Layout& described; ///< LayoutDescription, const for writers
};
template <class Layout>
DescribedPanner(int, Layout&) -> DescribedPanner<Layout>; // Clang 14 wants it

/// Scene and seed come from the session's last scene run.
void visitFields(auto& v, FieldsOf<Mix>) {
    constexpr auto dragRange = kinds::within(leastDrag, mostDrag);
    v.field("layout", &Mix::layout, Own<LayoutDescription>{});
    v.field("law", &Mix::law, kinds::OneOf{panningLawNames});
    v.field("exponent", &Mix::exponent, exponentRange);
    v.field("level_db", &Mix::levelDb, masterRangeDb);
    // Older files: per metre of the field. Drags already recorded in the inputs keep their values.
    v.formerly("drag_ns_per_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange);
    v.field("drag_ns_per_screen_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange, Need::required.from(4));
    v.field("strips", &Mix::strips, PerChannel<std::vector<Strip>>{v.object.count()});
    v.field("groups", &Mix::groups, kinds::Objects<StripGroup>{mostGroups, "groups"}, Need::optional.from(8));
}

/// True if the actuators are at the same places of the same extent, on the same parts. Any thread.
inline bool isSame(const EnchanterLayout& a, const EnchanterLayout& b) noexcept {
    const auto equal = [](const EnchanterPlace& p, const EnchanterPlace& q) {
        return p.xMetres == q.xMetres && p.yMetres == q.yMetres && p.zMetres == q.zMetres && p.part == q.part;
    };
    return a.extentWidthMetres == b.extentWidthMetres && a.extentHeightMetres == b.extentHeightMetres &&
           a.count == b.count &&
           std::equal(a.places.begin(), a.places.begin() + a.count, b.places.begin(), equal);
}

/// True if both play the same, and say so in the same words. Any thread.
inline bool isSame(const Mix& a, const Mix& b) {
    return (a.scene == b.scene || *a.scene == *b.scene) && a.seed == b.seed &&
           a.layout.name == b.layout.name && isSame(a.layout.geometry, b.layout.geometry) &&
           a.layout.enchanters == b.layout.enchanters && a.law == b.law && a.exponent == b.exponent &&
           a.strips == b.strips && a.groups == b.groups && a.levelDb == b.levelDb &&
           a.dragNewtonSecondsPerScreenMetre == b.dragNewtonSecondsPerScreenMetre;
}

/// Factor that all channels are multiplied by last. Any thread.
inline float masterGain(const Mix& mix) noexcept {
    return mix.levelDb <= leastStripDb ? 0.0f : static_cast<float>(fromDecibels(mix.levelDb));
}

// Effective gain and mute of strips, with their groups and lanes applied.

/// The strips as they are sent to the session: with their group's fader and mute applied, without group and
/// lanes. Any thread (allocates), as all functions here.
std::vector<Strip> feltStrips(const Mix& mix);

/// Whether the strip or its group has a lane.
bool hasLane(const Mix& mix, std::size_t strip);

/// The strip's gain at that time of the scene run, in dB: fader, group and both lanes.
double gainDbAt(const Mix& mix, std::size_t strip, double seconds);

/// Maximum of gainDbAt() over time; and of what group and lanes add to the fader, beyond a fader's range.
double loudestDb(const Mix& mix, std::size_t strip);
double mostAddedDb(const Mix& mix, std::size_t strip);

/// Adds an empty group; returns its index.
int addGroup(Mix& mix, std::string name);
/// An unused name: "Left hand", "Right hand", "Back", then numbers.
std::string freeGroupName(const Mix& mix);
/// Removes a group without changing the output: its strips absorb its fader, mute and lane.
void removeGroup(Mix& mix, int group);

// Limits that a mixer state loaded from a file must not exceed: the levels that this computer's user has set.

/// The limits, taken from the mixer state as the user left it.
struct DeskLimits {
    double levelDb = 0.0;
    std::vector<Strip> strips; ///< one per output in use, with the gain that reaches it

    static DeskLimits of(const Mix& mix);
    /// Level of the loudest output by gain, ceiling and master; the master's alone if no output is in use.
    double loudestOutputDb() const;
};

void visitFields(auto& v, FieldsOf<DeskLimits>) {
    v.field("level_db", &DeskLimits::levelDb, masterRangeDb);
    v.field("strips", &DeskLimits::strips, kinds::Objects<Strip>{});
}

/// Lowers `mix` to `most`: its master level, and gain and ceiling of each output. An output that is muted in
/// `most` is muted. An actuator on an output that `most` does not use gets no output. Returns a text for the
/// user that lists the changes; empty: none. Any thread.
std::string lowerTo(const DeskLimits& most, Mix& mix);

/// Conversion to text for a program's settings, and back; nullopt if the text is invalid. Any thread.
std::string deskLimitsText(const DeskLimits& limits);
std::optional<DeskLimits> readDeskLimits(std::string_view text);

} // namespace physvib
