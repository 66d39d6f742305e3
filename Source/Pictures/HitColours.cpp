// SPDX-License-Identifier: MIT
// Assigns colours to impacts by material, part of the body or frequency, and names them in the legend.
#include "Pictures/PictureParts.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <limits>
#include <set>
#include <span>

namespace physvib::picture {
namespace {

constexpr double anyDecay = -1.0;
constexpr double endless = std::numeric_limits<double>::infinity();

bool sounds(const Material& material, const CollisionEvent& event) {
    return material.frequencyHz == event.frequencyHz && material.decayPerSecond == event.decayPerSecond;
}

} // namespace

HitColours::HitColours(const PictureInput& input) {
    if (input.scene != nullptr && input.scene->materials.size() <= palette::materialCount)
        takeMaterials(input);
    else if (!takeParts(input))
        takeFrequencies(input);
    if (!input.events.empty()) classes_.push_back({"strongest", palette::now});
}

Colour HitColours::of(const CollisionEvent& event) const {
    for (const auto& rule : rules_)
        if ((rule.part == 0 || rule.part == event.source.part) && event.frequencyHz >= rule.lowestHz &&
            event.frequencyHz <= rule.highestHz &&
            (rule.decayPerSecond == anyDecay || rule.decayPerSecond == event.decayPerSecond))
            return rule.colour;
    return palette::other;
}

// (f, tau) tells the material, whichever of the two bodies gave its voice to the hit.
void HitColours::takeMaterials(const PictureInput& input) {
    meaning_ = "material";
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

bool HitColours::takeParts(const PictureInput& input) {
    const std::span places{input.layout.places.data(), static_cast<std::size_t>(input.layout.count)};
    const auto channelOf = [&](PartNumber part) {
        return static_cast<int>(std::ranges::find(places, part, &ActuatorPlace::part) - places.begin());
    };
    std::set<int> channels; // the first of each part
    for (const auto& event : input.events) {
        const int channel = event.source.part == 0 ? input.layout.count : channelOf(event.source.part);
        if (channel == input.layout.count) return false;
        channels.insert(channel);
    }
    for (const int channel : channels) {
        const PartNumber part = places[static_cast<std::size_t>(channel)].part;
        const auto name = builtInPart(part);
        rules_.push_back({0.0, endless, anyDecay, palette::enchanter(channel), part});
        classes_.push_back(
            {name.empty() ? labelOf(input, channel) : std::string{name}, palette::enchanter(channel)});
    }
    if (!channels.empty()) meaning_ = "part of the body";
    return !channels.empty();
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
