// SPDX-License-Identifier: MIT
// Explains why a body would cause no vibration: simulates one impact with each surface of the scene. And
// makes bodies and materials vibrate.
#include "Scene/Drawing/ImpactTrial.h"
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

constexpr int stepsPerSecond = 100; // the step rate of the mixer
constexpr double trialSeconds = 0.5, standardGravity = 9.81;
// sound of a material that is in no table: dull and short, so that every actuator plays it
constexpr double defaultHz = 165.0, defaultDecayPerSecond = 22.0;

struct Surface {
    int material;
    bool isSource;
    bool operator==(const Surface&) const = default;
};

bool isFixed(const BodyDescription& body) { return body.type != BodyType::dynamicBody; }

/// The different surfaces that the body can hit, or its own if it is alone. Fixed ones hit none.
std::vector<Surface> findSurfaces(const Scene& scene, const BodyDescription& body) {
    std::vector<Surface> surfaces;
    for (const BodyDescription& other : scene.bodies)
        if (other.name != body.name && !(isFixed(other) && isFixed(body)))
            for (const FixtureDescription& f : other.fixtures)
                if (const Surface s{f.material, f.isCamera}; std::ranges::find(surfaces, s) == surfaces.end())
                    surfaces.push_back(s);
    if (surfaces.empty() && !isFixed(body) && !body.fixtures.empty())
        surfaces.push_back({body.fixtures.front().material, false});
    return surfaces;
}

/// False if a haptic source has a material without a sound, which makes the scene invalid.
bool isPlayable(const Scene& scene) { return validate(scene).empty(); }

ContactCounts simulateImpact(const Scene& scene, BodyDescription body, const Surface& surface) {
    const double height = scene.fieldHeightMetres, width = scene.fieldWidthMetres;
    Scene trial = sceneWithoutBodies(scene);
    BodyDescription other;
    other.name = "other";
    other.fixtures.resize(1);
    other.fixtures[0].material = surface.material;
    const LocalBounds bounds = localBounds(body);
    const double radius = std::max(
        {std::abs(bounds.min.x), std::abs(bounds.max.x), std::abs(bounds.min.y), std::abs(bounds.max.y)});
    const double impactSpeed = std::sqrt(2.0 * standardGravity * height / 3.0), gapMetres = 0.02 * height;
    body.name = "body";
    body.positionMetres = {0.5 * width, 0.5 * height};
    if (isFixed(body)) { // a disc falls on it
        const double size = 0.06 * height;
        other.fixtures[0].shape = CircleShape{size};
        other.positionMetres = {0.5 * width, 0.5 * height + radius + size + gapMetres};
        other.velocityMetresPerSecond = {0.0, -impactSpeed};
    } else {
        other.type = BodyType::staticBody;
        other.fixtures[0].shape = BoxShape{width, 0.1 * height};
        other.positionMetres = {0.5 * width, 0.45 * height - radius - gapMetres};
        body.velocityMetresPerSecond = {0.0, -impactSpeed};
    }
    setSource(trial, other, surface.isSource);
    trial.bodies = {other, body};
    if (!isPlayable(trial)) return {};
    Simulation simulation{trial, 0, stepsPerSecond};
    std::vector<CollisionEvent> events;
    for (int k = 0; k < static_cast<int>(trialSeconds * stepsPerSecond) && simulation.counts().events == 0;
         ++k)
        simulation.step(events);
    return simulation.counts();
}

} // namespace

std::string silentBodyReason(const Scene& scene, const BodyDescription& body) {
    const auto surfaces = findSurfaces(scene, body);
    if (surfaces.empty()) return {}; // nothing in the scene can hit it yet
    ContactCounts counts;
    for (const Surface& surface : surfaces) {
        counts += simulateImpact(scene, body, surface);
        if (counts.events > 0) return {};
    }
    if (counts.steps == 0) return "Its material has no sound: give it a frequency under Materials.";
    return replaceNames(explain(counts), Names::mixer);
}

std::string silentBodyReason(const Scene& scene, int material) {
    const double height = scene.fieldHeightMetres;
    auto ball = makeBall({0.5 * scene.fieldWidthMetres, 0.5 * height},
                         {0.5 * scene.fieldWidthMetres + 0.06 * height, 0.5 * height});
    if (!ball) return ball.error;
    for (auto& fixture : ball.value.fixtures) fixture.material = material;
    const bool hasSound = scene.materials[static_cast<std::size_t>(material)].frequencyHz > 0.0;
    if (hasSound && startsAsSource(ball.value)) setSource(scene, ball.value, true);
    return silentBodyReason(scene, ball.value);
}

Scene sceneWithSound(Scene scene, int material) {
    Material& changed = scene.materials[static_cast<std::size_t>(material)];
    changed.frequencyHz = defaultHz;
    changed.decayPerSecond = defaultDecayPerSecond;
    for (const MaterialTable& table : builtInMaterials())
        for (const Material& builtIn : table.materials)
            if (builtIn.frequencyHz > 0.0 && builtIn.name == changed.name) {
                changed.frequencyHz = builtIn.frequencyHz;
                changed.decayPerSecond = builtIn.decayPerSecond;
                return scene;
            }
    return scene;
}

std::vector<Action> actionsToVibrate(const Scene& scene, const BodyDescription& body) {
    const auto vibrates = [](const Material& m) { return m.frequencyHz > 0.0; };
    const auto first = std::ranges::find_if(scene.materials, vibrates);
    if (first == scene.materials.end()) return {};
    BodyDescription vibrating = body;
    for (FixtureDescription& fixture : vibrating.fixtures)
        if (!vibrates(scene.materials[static_cast<std::size_t>(fixture.material)]))
            fixture.material = static_cast<int>(first - scene.materials.begin());
    if (!isSource(vibrating)) setSource(scene, vibrating, true);
    if (vibrating == body) return {};
    return {changeAction(std::move(vibrating))};
}

} // namespace physvib
