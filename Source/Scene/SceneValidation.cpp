// SPDX-License-Identifier: MIT
// Validates a scene: ranges, totals, outlines and masses, then references.
#include "Scene/SceneValidation.h"
#include "Scene/MaterialCheck.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneRanges.h"
#include "Scene/SceneReferences.h"
#include "Scene/UniqueNames.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/PlacedBodies.h"
#include "Scene/World/ShapeGeometry.h"
#include <cmath>
#include <string_view>
#include <utility>

namespace physvib {

namespace {

using namespace sceneLimits;
using detail::itemPath;

std::string atMost(const std::string& what, std::size_t most, std::size_t found) {
    if (found <= most) return {};
    return what + ": expected at most " + std::to_string(most) + " in all, found " + std::to_string(found);
}

std::size_t edgesOf(const BodyDescription& body) {
    std::size_t edges = 0;
    for (const FixtureDescription& fixture : body.fixtures)
        if (const auto* chain = std::get_if<ChainShape>(&fixture.shape))
            edges += chain->verticesMetres.size();
    return edges;
}

struct Totals {
    std::size_t bodies = 0, fixtures = 0, edges = 0;
    void add(const BodyDescription& body, std::size_t times = 1) {
        bodies += times;
        fixtures += times * body.fixtures.size();
        edges += times * edgesOf(body);
    }
    void take(const BodyDescription& body) {
        bodies -= 1;
        fixtures -= body.fixtures.size();
        edges -= edgesOf(body);
    }
    std::string fault() const {
        for (std::string fault :
             {atMost("bodies", maxBodies, bodies), atMost("fixtures", maxFixtures, fixtures),
              atMost("chain edges", maxChainEdges, edges)})
            if (!fault.empty()) return fault;
        return {};
    }
};

/// Includes the script's repetitions; of live inputs, the bodies that exist at the same time.
std::string checkTotals(const Scene& scene) {
    Totals totals;
    std::size_t actions = 0;
    for (const BodyDescription& body : scene.bodies) totals.add(body);
    for (const ScriptInput& input : scene.script) {
        actions += static_cast<std::size_t>(input.times);
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action))
            totals.add(spawn->body, static_cast<std::size_t>(input.times));
    }
    std::string fault = totals.fault();
    if (fault.empty()) fault = atMost("script actions", maxActions, actions);
    std::map<std::string_view, const BodyDescription*> spawned;
    for (std::size_t i = 0; i < scene.inputs.size() && fault.empty(); ++i) {
        if (const auto* removal = std::get_if<RemoveAction>(&scene.inputs[i].action))
            if (const auto gone = spawned.find(removal->body); gone != spawned.end()) {
                totals.take(*gone->second);
                spawned.erase(gone);
            }
        const BodyDescription* body = bodyPutBy(scene.inputs[i].action);
        if (body == nullptr) continue;
        totals.add(*body);
        const auto [there, isNew] = spawned.emplace(body->name, body);
        if (!isNew) totals.take(*std::exchange(there->second, body)); // replaced
        fault = totals.fault();
    }
    return fault;
}

std::string checkEdges(const std::vector<Vector>& v, bool isLoop) {
    for (std::size_t i = 0; i + (isLoop ? 0 : 1) < v.size(); ++i) {
        const Vector& next = v[(i + 1) % v.size()];
        if (std::hypot(next.x - v[i].x, next.y - v[i].y) < minSizeMetres)
            return "expected edges at least 0.01 m long";
    }
    return {};
}

std::string checkOutline(const PolygonShape& polygon) {
    if (!isConvexCounterClockwise(polygon.verticesMetres))
        return "expected a convex outline, counter-clockwise";
    if (thicknessMetres(polygon) < minSizeMetres) return "expected an outline at least 0.01 m wide";
    return checkEdges(polygon.verticesMetres, true);
}

std::string checkOutline(const ChainShape& chain) {
    if (chain.isLoop && chain.verticesMetres.size() < 3) return "expected at least 3 vertices of a loop";
    return checkEdges(chain.verticesMetres, chain.isLoop);
}

std::string checkOutline(const CircleShape&) { return {}; }
std::string checkOutline(const BoxShape&) { return {}; }

// Box2D computes inertia about the origin and subtracts the centre's share in single precision: for a small
// shape far from the origin nothing would be left.
std::string checkCentre(const PlacedBody& placed, const Scene& scene) {
    constexpr double farthestRadii = 100.0;
    if (placed.body->type != BodyType::dynamicBody) return {};
    const BodyMoments moments = bodyMoments(*placed.body, scene);
    const double radius = std::sqrt(moments.inertiaKgSquareMetres / moments.massKg);
    const double distance = std::hypot(moments.centreMetres.x, moments.centreMetres.y);
    if (distance <= farthestRadii * radius) return {};
    return placed.path + ".fixtures: expected a centre of mass nearer to the body's origin";
}

std::string checkBody(const PlacedBody& placed) {
    const BodyDescription& body = *placed.body;
    for (std::size_t i = 0; i < body.fixtures.size(); ++i) {
        const std::string path = itemPath(placed.path + ".fixtures", i);
        const Shape& shape = body.fixtures[i].shape;
        const std::string fault = std::visit([](const auto& s) { return checkOutline(s); }, shape);
        if (!fault.empty()) return path + ".vertices_m: " + fault;
        if (body.type == BodyType::dynamicBody && std::holds_alternative<ChainShape>(shape))
            return path + ".shape: a chain has no mass, expected another shape for a dynamic body";
    }
    return {};
}

std::string sizeWarning(const std::string& path, const Shape& shape) {
    const double thin = thicknessMetres(shape), far = lengthMetres(shape);
    if (thin >= minWarnMetres && far <= maxWarnMetres) return {};
    const double found = thin < minWarnMetres ? thin : far;
    return detail::outside(path, minWarnMetres, maxWarnMetres, found) +
           " m: Box2D simulates such moving bodies less well";
}

} // namespace

std::string validate(const Scene& scene) {
    if (std::string fault = checkRanges(scene); !fault.empty()) return fault;
    const auto placed = placedBodies(scene);
    if (std::string fault = checkTotals(scene); !fault.empty()) return fault;
    for (std::string fault : {checkMaterialNames(scene.materials), checkUnique("bodies", scene.bodies),
                              checkUnique("joints", scene.joints)})
        if (!fault.empty()) return fault;
    for (const PlacedBody& body : placed)
        for (std::string fault : {checkBody(body), checkCentre(body, scene)})
            if (!fault.empty()) return fault;
    if (std::string fault = checkReferences(scene); !fault.empty()) return fault;
    return checkCameras(scene);
}

std::vector<std::string> sceneWarnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (const PlacedBody& placed : placedBodies(scene)) {
        if (placed.body->type != BodyType::dynamicBody) continue;
        for (std::size_t i = 0; i < placed.body->fixtures.size(); ++i) {
            auto warning =
                sizeWarning(itemPath(placed.path + ".fixtures", i), placed.body->fixtures[i].shape);
            if (!warning.empty()) warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

} // namespace physvib
