// SPDX-License-Identifier: MIT
// Assigns colours to impacts by material or frequency, and names them in the legend.
#include "Pictures/PictureParts.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <limits>
#include <set>

namespace physvib::picture {
namespace {

constexpr double anyDecay = -1.0;
constexpr double endless = std::numeric_limits<double>::infinity();

bool sounds(const Material& material, const CollisionEvent& event) {
    return material.frequencyHz == event.frequencyHz && material.decayPerSecond == event.decayPerSecond;
}

} // namespace

HitColours::HitColours(const PictureInput& input) {
    byMaterial_ = input.scene != nullptr && input.scene->materials.size() <= palette::materialCount;
    byMaterial_ ? takeMaterials(input) : takeFrequencies(input);
    if (!input.events.empty()) classes_.push_back({"strongest", palette::now});
}

Colour HitColours::of(const CollisionEvent& event) const {
    for (const auto& rule : rules_)
        if (event.frequencyHz >= rule.lowestHz && event.frequencyHz <= rule.highestHz &&
            (rule.decayPerSecond == anyDecay || rule.decayPerSecond == event.decayPerSecond))
            return rule.colour;
    return palette::other;
}

// (f, tau) tells the material, whichever of the two bodies gave its voice to the hit.
void HitColours::takeMaterials(const PictureInput& input) {
    const auto& materials = input.scene->materials;
    bool unknown = false;
    std::set<std::size_t> used;
    for (const auto& body : sceneCast(*input.scene))
        for (const auto& fixture : body.fixtures) used.insert(static_cast<std::size_t>(fixture.material));
    for (const auto& event : input.events) {
        const auto found = std::ranges::find_if(materials, [&](const auto& m) { return sounds(m, event); });
        found == materials.end() ? void(unknown = true)
                                 : void(used.insert(static_cast<std::size_t>(found - materials.begin())));
    }
    for (const auto index : used) {
        if (index >= materials.size()) continue;
        const auto& m = materials[index];
        const auto colour = palette::material(static_cast<int>(index));
        rules_.push_back({m.frequencyHz, m.frequencyHz, m.decayPerSecond, colour});
        const auto name = cleanLine(m.name);
        classes_.push_back(
            {m.frequencyHz > 0.0 ? name + " " + shortNumber(m.frequencyHz) + " Hz" : name, colour});
    }
    if (unknown) classes_.push_back({"other", palette::other});
}

void HitColours::takeFrequencies(const PictureInput& input) {
    std::set<double> heard;
    for (const auto& event : input.events) {
        heard.insert(event.frequencyHz);
        if (heard.size() > palette::rampCount) break;
    }
    if (heard.size() <= palette::rampCount) {
        for (int i = 0; const double f : heard) {
            rules_.push_back({f, f, anyDecay, palette::ramp(i)});
            classes_.push_back({shortNumber(f) + " Hz", palette::ramp(i++)});
        }
        return;
    }
    const std::string to = "\xe2\x80\x93";
    constexpr double edges[] = {0.0, 50.0, 100.0, 200.0, 400.0, 800.0, endless}; // octaves of touch
    for (int i = 0; i < palette::rampCount; ++i) {
        rules_.push_back({edges[i], edges[i + 1], anyDecay, palette::ramp(i)});
        const auto name = i == 0                    ? "up to " + shortNumber(edges[1])
                          : edges[i + 1] == endless ? "above " + shortNumber(edges[i])
                                                    : shortNumber(edges[i]) + to + shortNumber(edges[i + 1]);
        classes_.push_back({name + " Hz", palette::ramp(i)});
    }
}

} // namespace physvib::picture
