// SPDX-License-Identifier: MIT
// Simulates one impact of a body with each kind of surface that the scene has.
#include "Scene/Drawing/FeltTrial.h"
#include "Contacts/ContactCounts.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

constexpr int stepsPerSecond = 100; // as the mixer plays
constexpr double usualSeconds = 0.5, standardGravity = 9.81;
// the default for a material in no table: a dull, short sound that every actuator plays
constexpr double plainHertz = 165.0, plainDecayPerSecond = 22.0;

struct Surface {
    int material;
    bool isSource;
    bool operator==(const Surface&) const = default;
};

bool isFixed(const BodyDescription& body) { return body.type != BodyType::dynamicBody; }

/// The bodies that it can hit. Two fixed bodies never meet.
std::vector<Surface> surfacesOf(const Scene& scene, const BodyDescription& body) {
    std::vector<Surface> all;
    for (const BodyDescription& other : scene.bodies)
        if (other.name != body.name && !(isFixed(other) && isFixed(body)))
            for (const FixtureDescription& f : other.fixtures)
                if (const Surface s{f.material, f.isCamera}; std::ranges::find(all, s) == all.end())
                    all.push_back(s);
    if (all.empty() && !isFixed(body) && !body.fixtures.empty())
        all.push_back({body.fixtures.front().material, false});
    return all;
}

/// False if a haptic source has a material without a sound: such a scene is invalid, and does not vibrate.
bool isPlayable(const Scene& scene) { return validate(scene).empty(); }

ContactCounts countsOf(const Scene& scene, BodyDescription body, const Surface& surface) {
    const double height = scene.fieldHeightMetres, width = scene.fieldWidthMetres;
    Scene trial = emptied(scene);
    BodyDescription other;
    other.name = "other";
    other.fixtures.resize(1);
    other.fixtures[0].material = surface.material;
    const Reach reach = reachOf(body);
    const double radius = std::max(
        {std::abs(reach.least.x), std::abs(reach.most.x), std::abs(reach.least.y), std::abs(reach.most.y)});
    const double fast = std::sqrt(2.0 * standardGravity * height / 3.0), apart = 0.02 * height;
    body.name = "body";
    body.positionMetres = {0.5 * width, 0.5 * height};
    if (isFixed(body)) { // something falls on it
        const double size = 0.06 * height;
        other.fixtures[0].shape = CircleShape{size};
        other.positionMetres = {0.5 * width, 0.5 * height + radius + size + apart};
        other.velocityMetresPerSecond = {0.0, -fast};
    } else {
        other.type = BodyType::staticBody;
        other.fixtures[0].shape = BoxShape{width, 0.1 * height};
        other.positionMetres = {0.5 * width, 0.45 * height - radius - apart};
        body.velocityMetresPerSecond = {0.0, -fast};
    }
    setSource(trial, other, surface.isSource);
    trial.bodies = {other, body};
    if (!isPlayable(trial)) return {};
    Simulation simulation{trial, 0, stepsPerSecond};
    std::vector<CollisionEvent> events;
    for (int k = 0; k < static_cast<int>(usualSeconds * stepsPerSecond) && simulation.counts().events == 0;
         ++k)
        simulation.step(events);
    return simulation.counts();
}

} // namespace

std::string whyNotFelt(const Scene& scene, const BodyDescription& body) {
    const auto others = surfacesOf(scene, body);
    if (others.empty()) return {}; // nothing has been drawn yet that could meet it
    ContactCounts all;
    for (const Surface& surface : others) {
        all += countsOf(scene, body, surface);
        if (all.events > 0) return {};
    }
    if (all.steps == 0) return "Its material has no sound: give it a frequency under Materials.";
    return inNames(explain(all), Names::mixer);
}

std::string whyNotFelt(const Scene& scene, int material) {
    const double height = scene.fieldHeightMetres;
    auto ball = drawnBall({0.5 * scene.fieldWidthMetres, 0.5 * height},
                          {0.5 * scene.fieldWidthMetres + 0.06 * height, 0.5 * height});
    if (!ball) return ball.error;
    for (auto& fixture : ball.value.fixtures) fixture.material = material;
    const bool sounds = scene.materials[static_cast<std::size_t>(material)].frequencyHz > 0.0;
    if (sounds && startsAsSource(ball.value)) setSource(scene, ball.value, true);
    return whyNotFelt(scene, ball.value);
}

Scene withSound(Scene scene, int material) {
    Material& changed = scene.materials[static_cast<std::size_t>(material)];
    changed.frequencyHz = plainHertz;
    changed.decayPerSecond = plainDecayPerSecond;
    for (const MaterialTable& table : builtInMaterials())
        for (const Material& known : table.materials)
            if (known.frequencyHz > 0.0 && known.name == changed.name) {
                changed.frequencyHz = known.frequencyHz;
                changed.decayPerSecond = known.decayPerSecond;
                return scene;
            }
    return scene;
}

std::vector<Action> feltChanges(const Scene& scene, const BodyDescription& body) {
    const auto vibrates = [](const Material& m) { return m.frequencyHz > 0.0; };
    const auto first = std::ranges::find_if(scene.materials, vibrates);
    if (first == scene.materials.end()) return {};
    BodyDescription felt = body;
    for (FixtureDescription& fixture : felt.fixtures)
        if (!vibrates(scene.materials[static_cast<std::size_t>(fixture.material)]))
            fixture.material = static_cast<int>(first - scene.materials.begin());
    if (!isSource(felt)) setSource(scene, felt, true);
    if (felt == body) return {};
    return {changed(std::move(felt))};
}

} // namespace physvib
