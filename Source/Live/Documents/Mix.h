// SPDX-License-Identifier: MIT
// Everything that is set on the mixer's desk: the scene that is played, the enchanters, and a strip for each.
#pragma once
#include "Live/Documents/Strip.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

// N s per metre of the screen (thesis 5.3.1)
constexpr double thesisDrag = 32'000.0, leastDrag = 1'000.0, mostDrag = 100'000.0;

struct Mix {
    std::shared_ptr<const Scene> scene; ///< never null
    std::uint32_t seed = 1;
    LayoutDescription layout;
    PanningLaw law = PanningLaw::linear;
    double exponent = 1.0;
    std::vector<Strip> strips; ///< one per enchanter
    std::vector<StripGroup> groups{};
    double levelDb = -12.0;                              ///< master; the least is silence
    double dragNewtonSecondsPerScreenMetre = thesisDrag; ///< that a drag in the world pushes with

    int count() const noexcept { return layout.geometry.count; }
    PhantomPanner panner() const noexcept {
        PhantomPanner made{layout.geometry, law, exponent, scene->fieldWidthMetres, scene->fieldHeightMetres};
        // nothing else was asked for
        if (law == PanningLaw::linear && exponent == 1.0) made.setGrains(grainSpread);
        return made;
    }

    void resizeStrips() { physvib::resizeStrips(strips, count()); } ///< as many as there are enchanters
    bool isSilent(int strip) const noexcept {
        const int group = strips[static_cast<std::size_t>(strip)].group;
        return physvib::isSilent(strips, static_cast<std::size_t>(strip)) ||
               (group >= 0 && groups[static_cast<std::size_t>(group)].isMuted);
    }
};

inline constexpr auto exponentRange = kinds::within(1e-3, 100.0);
inline constexpr auto masterRangeDb = kinds::within(leastStripDb, 0.0);

/// Scene and seed are those of the session's last run of a scene.
void visitFields(auto& v, FieldsOf<Mix>) {
    constexpr auto dragRange = kinds::within(leastDrag, mostDrag);
    v.field("layout", &Mix::layout, Own<LayoutDescription>{});
    v.field("law", &Mix::law, kinds::OneOf{panningLawNames});
    v.field("exponent", &Mix::exponent, exponentRange);
    v.field("level_db", &Mix::levelDb, masterRangeDb);
    // per metre of the field: what was dragged then stands in the inputs as it was
    v.formerly("drag_ns_per_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange);
    v.field("drag_ns_per_screen_m", &Mix::dragNewtonSecondsPerScreenMetre, dragRange, Need::required.from(4));
    v.field("strips", &Mix::strips, PerChannel<std::vector<Strip>>{v.object.count()});
    v.field("groups", &Mix::groups, kinds::Objects<StripGroup>{mostGroups, "groups"}, Need::optional.from(8));
}

/// True if their enchanters sit at the same places of the same extent. Any thread.
inline bool isSame(const EnchanterLayout& a, const EnchanterLayout& b) noexcept {
    const auto equal = [](const EnchanterPlace& p, const EnchanterPlace& q) {
        return p.xMetres == q.xMetres && p.yMetres == q.yMetres;
    };
    return a.extentWidthMetres == b.extentWidthMetres && a.extentHeightMetres == b.extentHeightMetres &&
           a.count == b.count &&
           std::equal(a.places.begin(), a.places.begin() + a.count, b.places.begin(), equal);
}

/// What all enchanters are multiplied by at last. Any thread.
inline float masterGain(const Mix& mix) noexcept {
    return mix.levelDb <= leastStripDb ? 0.0f : static_cast<float>(fromDecibels(mix.levelDb));
}

} // namespace physvib
