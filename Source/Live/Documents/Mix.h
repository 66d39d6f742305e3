// SPDX-License-Identifier: MIT
// Everything that is set on the mixer's desk: the scene that is played, the enchanters, and a strip for each.
#pragma once
#include "Core/Decibels.h"
#include "Core/RenderControl.h"
#include "Live/Documents/GainLane.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace physvib {

struct Strip {
    double gainDb = 0.0; ///< leastStripDb (silence) to mostStripDb
    bool isMuted = false;
    bool isSolo = false;
    bool isInverted = false; ///< polarity
    double delayMs = 0.0;    ///< 0 to limits::maxChannelDelaySeconds
    double ceilingDb = 0.0;  ///< of full scale, leastCeilingDb to 0
    int output = -1;         ///< of the device, from 0; -1: none
    int group = -1;          ///< of the mix; -1: none
    GainLane lane{};         ///< on top of the fader
    bool operator==(const Strip&) const = default;
};

/// Strips that one fader and one mute act on: a hand, a back.
struct StripGroup {
    std::string name;
    double gainDb = 0.0; ///< on top of each of them, as a strip's
    bool isMuted = false;
    GainLane lane{};
    bool operator==(const StripGroup&) const = default;
};
constexpr std::size_t mostGroups = 16;

constexpr double leastCeilingDb = -60.0; // lower is a mute by another name
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

/// True if their enchanters sit at the same places of the same extent. Any thread.
inline bool isSame(const EnchanterLayout& a, const EnchanterLayout& b) noexcept {
    const auto equal = [](const EnchanterPlace& p, const EnchanterPlace& q) {
        return p.xMetres == q.xMetres && p.yMetres == q.yMetres;
    };
    return a.extentWidthMetres == b.extentWidthMetres && a.extentHeightMetres == b.extentHeightMetres &&
           a.count == b.count &&
           std::equal(a.places.begin(), a.places.begin() + a.count, b.places.begin(), equal);
}

/// The gain of a channel: its level and polarity. Any thread.
inline float channelGain(const Strip& strip) noexcept {
    const double gain = strip.gainDb <= leastStripDb ? 0.0 : fromDecibels(strip.gainDb);
    return static_cast<float>(strip.isInverted ? -gain : gain);
}

/// What all enchanters are multiplied by at last. Any thread.
inline float masterGain(const Mix& mix) noexcept {
    return mix.levelDb <= leastStripDb ? 0.0f : static_cast<float>(fromDecibels(mix.levelDb));
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
