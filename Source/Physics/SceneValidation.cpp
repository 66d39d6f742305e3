// SPDX-License-Identifier: MIT
// What the range of a single field cannot tell: names that are referred to, sums, outlines, sounds.
#include "Physics/SceneValidation.h"
#include "Physics/BodyMass.h"
#include "Physics/SceneCast.h"
#include "Physics/SceneLimits.h"
#include "Physics/SceneRanges.h"
#include "Physics/ShapeGeometry.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

namespace physvib {

namespace {

using namespace sceneLimits;
using detail::itemPath;

/// A body of the scene or of its script, and where it stands in the file.
struct PlacedBody {
    const BodyDescription* body;
    std::string path;
    int times = 1;
};

std::vector<PlacedBody> placedBodies(const Scene& scene) {
    std::vector<PlacedBody> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        bodies.push_back({&scene.bodies[i], itemPath("bodies", i)});
    for (std::size_t i = 0; i < scene.script.size(); ++i)
        if (const auto* spawn = std::get_if<SpawnAction>(&scene.script[i].action))
            bodies.push_back({&spawn->body, itemPath("script", i) + ".body",
                              scene.script[i].times});
    return bodies;
}

std::string atMost(const std::string& what, std::size_t most, std::size_t found) {
    if (found <= most) return {};
    return what + ": expected at most " + std::to_string(most) + " in all, found " + std::to_string(found);
}

std::size_t edgesOf(const BodyDescription& body) {
    std::size_t edges = 0;
    for (const FixtureDescription& fixture : body.fixtures)
        if (const auto* chain = std::get_if<ChainShape>(&fixture.shape)) edges += chain->verticesMetres.size();
    return edges;
}

/// With the repetitions of the script.
std::string checkTotals(const Scene& scene, const std::vector<PlacedBody>& placed) {
    std::size_t bodies = 0, fixtures = 0, edges = 0, actions = 0;
    for (const PlacedBody& p : placed) {
        const auto times = static_cast<std::size_t>(p.times);
        bodies += times;
        fixtures += times * p.body->fixtures.size();
        edges += times * edgesOf(*p.body);
    }
    for (const ScriptInput& input : scene.script) actions += static_cast<std::size_t>(input.times);
    for (const std::string& fault :
         {atMost("bodies", maxBodies, bodies), atMost("fixtures", maxFixtures, fixtures),
          atMost("chain edges", maxChainEdges, edges), atMost("script actions", maxActions, actions)})
        if (!fault.empty()) return fault;
    return {};
}

template <class T>
std::string checkUnique(const std::string& list, const std::vector<T>& all) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!names.insert(all[i].name).second)
            return itemPath(list, i) + ".name: expected a name of its own, found \"" + all[i].name + "\" again";
    return {};
}

std::string checkOutline(const PolygonShape& polygon) {
    if (!isConvexCounterClockwise(polygon.verticesMetres))
        return "expected a convex outline, counter-clockwise";
    if (thicknessMetres(polygon) < minSizeMetres) return "expected an outline at least 0.01 m wide";
    const auto& v = polygon.verticesMetres;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vector& next = v[(i + 1) % v.size()];
        if (std::hypot(next.x - v[i].x, next.y - v[i].y) < minSizeMetres)
            return "expected edges at least 0.01 m long";
    }
    return {};
}

std::string checkOutline(const ChainShape& chain) {
    const auto& v = chain.verticesMetres;
    if (chain.isLoop && v.size() < 3) return "expected at least 3 vertices of a loop";
    for (std::size_t i = 0; i + (chain.isLoop ? 0 : 1) < v.size(); ++i) {
        const Vector& next = v[(i + 1) % v.size()];
        if (std::hypot(next.x - v[i].x, next.y - v[i].y) < minSizeMetres)
            return "expected edges at least 0.01 m long";
    }
    return {};
}

std::string checkOutline(const CircleShape&) {
    return {};
}
std::string checkOutline(const BoxShape&) {
    return {};
}

// Box2D takes the inertia about the origin and subtracts again, in single precision, what the distance of the
// centre of mass adds to it: of a small shape far out nothing would be left.
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

bool sounds(const Material& material) {
    return material.frequencyHz > 0.0 && material.decayPerSecond > 0.0;
}

/// Bodies, joints and actions by name, and which fixtures ever have a camera.
class References {
public:
    explicit References(const Scene& scene)
        : scene_(scene)
        , cast_(sceneCast(scene)) {
        for (const BodyDescription& body : cast_) bodies_.emplace(body.name, &body);
        for (const JointDescription& joint : scene.joints) joints_.emplace(joint.name, &joint);
        for (const ScriptInput& input : scene.script) {
            if (const auto* camera = std::get_if<CameraAction>(&input.action))
                if (camera->isOn) switchedOn_.emplace(camera->body, camera->fixture);
            if (const auto* change = std::get_if<MaterialAction>(&input.action))
                changes_[change->body].push_back(change);
        }
    }

    std::string check() const {
        if (bodies_.size() != cast_.size()) return repeatedBody();
        std::string fault;
        for (std::size_t i = 0; i < scene_.joints.size() && fault.empty(); ++i)
            fault = checkJoint(scene_.joints[i], itemPath("joints", i));
        for (std::size_t i = 0; i < scene_.script.size() && fault.empty(); ++i)
            fault = checkInput(scene_.script[i], itemPath("script", i));
        const auto placed = placedBodies(scene_);
        for (std::size_t i = 0; i < placed.size() && fault.empty(); ++i) fault = checkCameras(placed[i]);
        return fault;
    }

private:
    std::string repeatedBody() const {
        std::set<std::string_view> names;
        for (const BodyDescription& body : cast_)
            if (!names.insert(body.name).second)
                return "bodies: expected names of their own, found \"" + body.name + "\" twice";
        return {};
    }

    std::string missing(const std::string& path, const char* what, const std::string& name) const {
        return path + ": expected the name of a " + what + ", found \"" + name + "\"";
    }

    std::string checkJoint(const JointDescription& joint, const std::string& path) const {
        if (!bodies_.contains(joint.bodyA)) return missing(path + ".body_a", "body", joint.bodyA);
        if (!bodies_.contains(joint.bodyB)) return missing(path + ".body_b", "body", joint.bodyB);
        if (joint.bodyA == joint.bodyB) return path + ".body_b: expected another body than body_a";
        const auto* wheel = std::get_if<WheelJoint>(&joint.joint);
        if (wheel != nullptr && std::hypot(wheel->axis.x, wheel->axis.y) < 1.0e-3)
            return path + ".axis: expected a direction, found none";
        return {};
    }

    std::string checkInput(const ScriptInput& input, const std::string& path) const {
        const double last = input.timeSeconds + (input.times - 1) * input.everySeconds;
        const double end = scene_.scriptPeriodSeconds > 0.0 ? scene_.scriptPeriodSeconds : maxScriptSeconds;
        if (!(last <= end)) return detail::outside(path + ".time_s", 0.0, end, last);
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkAction(const GravityAction&, const std::string&) const { return {}; }
    std::string checkAction(const TiltAction&, const std::string&) const { return {}; }
    std::string checkAction(const SpawnAction&, const std::string&) const { return {}; }
    std::string checkAction(const MotorAction& action, const std::string& path) const {
        const auto joint = joints_.find(action.joint);
        const bool hasMotor = joint != joints_.end() && joint->second->joint.index() < 2; // revolute or wheel
        return hasMotor ? std::string() : missing(path + ".joint", "revolute or wheel joint", action.joint);
    }
    template <class BodyAction>
    std::string checkAction(const BodyAction& action, const std::string& path) const {
        const auto body = bodies_.find(action.body);
        if (body == bodies_.end()) return missing(path + ".body", "body", action.body);
        if constexpr (requires { action.fixture; }) {
            const auto count = static_cast<int>(body->second->fixtures.size());
            if (action.fixture >= count)
                return detail::outside(path + ".fixture", 0, count - 1, action.fixture);
        }
        return {};
    }

    bool mayBeCamera(const BodyDescription& body, int fixture) const {
        return body.fixtures[static_cast<std::size_t>(fixture)].isCamera ||
               switchedOn_.contains({body.name, everyFixture}) || switchedOn_.contains({body.name, fixture});
    }

    /// Of every repetition: each has a name of its own for camera and material actions.
    std::string checkCameras(const PlacedBody& placed) const {
        const SpawnAction spawn{*placed.body, {}};
        for (int k = 0; k < placed.times; ++k) {
            const BodyDescription body = spawnedBody(spawn, k, placed.times);
            for (int i = 0; i < static_cast<int>(body.fixtures.size()); ++i)
                if (mayBeCamera(body, i))
                    if (auto fault = checkCamera(body, i, placed.path); !fault.empty()) return fault;
        }
        return {};
    }

    std::string checkCamera(const BodyDescription& body, int index, const std::string& path) const {
        const FixtureDescription& fixture = body.fixtures[static_cast<std::size_t>(index)];
        const std::string place = itemPath(path + ".fixtures", static_cast<std::size_t>(index));
        if (body.type != BodyType::dynamicBody && body.massKg <= 0.0)
            return path + ".mass_kg: a camera body that is not dynamic has no mass in Box2D, expected one "
                          "above 0";
        if (fixture.voice != Voice::own)
            if (auto fault = checkOthers(place); !fault.empty()) return fault;
        if (fixture.voice != Voice::other && !alwaysSounds(body, index))
            return place +
                   ".material: a camera's material vibrates, expected one with frequency_hz and decay_per_s";
        return {};
    }

    bool alwaysSounds(const BodyDescription& body, int index) const {
        const auto isSilent = [this](int material) {
            return !sounds(scene_.materials[static_cast<std::size_t>(material)]);
        };
        if (isSilent(body.fixtures[static_cast<std::size_t>(index)].material)) return false;
        const auto changes = changes_.find(body.name);
        if (changes == changes_.end()) return true;
        return std::ranges::none_of(changes->second, [&](const MaterialAction* change) {
            const bool isMeant = change->fixture == everyFixture || change->fixture == index;
            return isMeant && isSilent(change->material);
        });
    }

    // Anything may strike it.
    std::string checkOthers(const std::string& camera) const {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            if (!sounds(scene_.materials[i]))
                return itemPath("materials", i) + ": expected frequency_hz and decay_per_s, for " + camera +
                       " has the voice of what strikes it";
        return {};
    }

    const Scene& scene_;
    std::vector<BodyDescription> cast_;
    std::map<std::string_view, const BodyDescription*> bodies_;
    std::map<std::string_view, const JointDescription*> joints_;
    std::set<std::pair<std::string_view, int>> switchedOn_;
    std::map<std::string_view, std::vector<const MaterialAction*>> changes_;
};

std::string sizeWarning(const std::string& path, const Shape& shape) {
    const double thin = thicknessMetres(shape), far = lengthMetres(shape);
    if (thin >= minWarnMetres && far <= maxWarnMetres) return {};
    const double found = thin < minWarnMetres ? thin : far;
    return detail::outside(path, minWarnMetres, maxWarnMetres, found) +
           " m: Box2D simulates such moving bodies less well";
}

} // namespace

std::string validateMaterials(const std::vector<Material>& materials) {
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (std::string fault = checkRanges(materials[i], itemPath("materials", i)); !fault.empty())
            return fault;
    return checkUnique("materials", materials);
}

std::string validate(const Scene& scene) {
    if (std::string fault = checkRanges(scene); !fault.empty()) return fault;
    const auto placed = placedBodies(scene);
    if (std::string fault = checkTotals(scene, placed); !fault.empty()) return fault;
    for (std::string fault : {checkUnique("materials", scene.materials), checkUnique("bodies", scene.bodies),
                              checkUnique("joints", scene.joints)})
        if (!fault.empty()) return fault;
    for (const PlacedBody& body : placed)
        for (std::string fault : {checkBody(body), checkCentre(body, scene)})
            if (!fault.empty()) return fault;
    return References(scene).check();
}

std::vector<std::string> sceneWarnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (const PlacedBody& placed : placedBodies(scene)) {
        if (placed.body->type != BodyType::dynamicBody) continue;
        for (std::size_t i = 0; i < placed.body->fixtures.size(); ++i) {
            auto warning = sizeWarning(itemPath(placed.path + ".fixtures", i), placed.body->fixtures[i].shape);
            if (!warning.empty()) warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

} // namespace physvib
