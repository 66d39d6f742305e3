// SPDX-License-Identifier: MIT
// Validates a scene: ranges, totals, outlines and masses, then references, and what haptic sources need.
#include "Scene/SceneValidation.h"
#include "Core/PortableMath.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneRanges.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <set>
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
        if (portable::hypot(next.x - v[i].x, next.y - v[i].y) < minSizeMetres)
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
    const double distance = portable::hypot(moments.centreMetres.x, moments.centreMetres.y);
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

std::string missing(const std::string& path, const char* what, const std::string& name) {
    return path + ": expected the name of a " + what + ", found \"" + name + "\"";
}

/// Names of bodies and joints, and references to them in joints and the script with its times. Fields and
/// totals must be in range.
class References {
public:
    explicit References(const Scene& scene)
        : scene_(scene)
        , cast_(scriptedCast(scene)) {
        for (const JointDescription& joint : scene.joints) joints_.emplace(joint.name, &joint);
        for (const LiveInput& input : scene.inputs)
            if (const auto* join = std::get_if<JoinAction>(&input.action))
                joints_.emplace(join->joint.name, &join->joint);
    }

    std::string check() {
        std::string fault = nameBodies();
        if (fault.empty()) fault = countJoints();
        for (std::size_t i = 0; i < scene_.joints.size() && fault.empty(); ++i)
            fault = checkJoint(scene_.joints[i], itemPath("joints", i));
        for (std::size_t i = 0; i < scene_.script.size() && fault.empty(); ++i)
            fault = checkInput(scene_.script[i], itemPath("script", i));
        for (std::size_t i = 0; i < scene_.inputs.size() && fault.empty(); ++i)
            fault = checkLive(i, itemPath("inputs", i));
        return fault;
    }

private:
    // The name of a spawned and removed body may be used again.
    std::string nameBodies() {
        const auto twice = [](const std::string& name) {
            return "bodies: expected names of their own, found \"" + name + "\" twice";
        };
        for (const BodyDescription& body : cast_)
            if (!bodies_.emplace(body.name, &body).second) return twice(body.name);
        std::set<std::string_view> there, gone;
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* removal = std::get_if<RemoveAction>(&input.action);
                removal != nullptr && there.erase(removal->body) > 0)
                gone.insert(removal->body);
            const BodyDescription* put = bodyPutBy(input.action);
            if (put == nullptr) continue;
            const BodyDescription& body = *put;
            const bool isChange = std::holds_alternative<ChangeAction>(input.action);
            if (isChange && !bodies_.contains(body.name)) return missing("body.name", "body", body.name);
            const auto [known, isNew] = bodies_.emplace(body.name, &body);
            if (gone.erase(body.name) == 0 && !isNew && !isChange) return twice(body.name);
            if (body.fixtures.size() > known->second->fixtures.size()) known->second = &body;
            there.insert(body.name);
        }
        return {};
    }

    // Like bodies: the name of a removed joint may be used again.
    std::string countJoints() const {
        std::set<std::string_view> there;
        for (const JointDescription& joint : scene_.joints) there.insert(joint.name);
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* unjoin = std::get_if<UnjoinAction>(&input.action)) there.erase(unjoin->joint);
            const auto* join = std::get_if<JoinAction>(&input.action);
            if (join != nullptr && !there.insert(join->joint.name).second)
                return "joints: expected names of their own, found \"" + join->joint.name + "\" twice";
            if (there.size() > sceneLimits::maxJoints)
                return "joints: expected at most " + std::to_string(sceneLimits::maxJoints);
        }
        return {};
    }

    std::string checkJoint(const JointDescription& joint, const std::string& path) const {
        if (!bodies_.contains(joint.bodyA)) return missing(path + ".body_a", "body", joint.bodyA);
        if (!bodies_.contains(joint.bodyB)) return missing(path + ".body_b", "body", joint.bodyB);
        if (joint.bodyA == joint.bodyB) return path + ".body_b: expected another body than body_a";
        const auto isNoAxis = [](const auto* slides) {
            return slides != nullptr && portable::hypot(slides->axis.x, slides->axis.y) < 1.0e-3;
        };
        if (isNoAxis(std::get_if<WheelJoint>(&joint.joint)) ||
            isNoAxis(std::get_if<SliderJoint>(&joint.joint)))
            return path + ".axis: expected a direction, found none";
        return {};
    }

    std::string checkInput(const ScriptInput& input, const std::string& path) const {
        const double last = input.timeSeconds + (input.times - 1) * input.everySeconds;
        const double period = scene_.scriptPeriodSeconds;
        const double end = period > 0.0 ? period : sceneLimits::maxScriptSeconds;
        if (!(last <= end)) return detail::outside(path + ".time_s", 0.0, end, last);
        if (isAnyOf<ChangeAction, JoinAction, UnjoinAction>(input.action))
            return path + ".input: expected another: change, join and unjoin are live inputs only";
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkLive(std::size_t index, const std::string& path) const {
        const LiveInput& input = scene_.inputs[index];
        if (index > 0 && input.timeSeconds < scene_.inputs[index - 1].timeSeconds)
            return path + ".time_s: expected a time that is not before that of the input above";
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkAction(const MotorAction& action, const std::string& path) const {
        const auto joint = joints_.find(action.joint);
        const bool hasMotor =
            joint != joints_.end() && (std::holds_alternative<RevoluteJoint>(joint->second->joint) ||
                                       std::holds_alternative<WheelJoint>(joint->second->joint));
        return hasMotor ? std::string() : missing(path + ".joint", "revolute or wheel joint", action.joint);
    }
    std::string checkAction(const JoinAction& action, const std::string& path) const {
        return checkJoint(action.joint, path + ".joint");
    }
    std::string checkAction(const UnjoinAction& action, const std::string& path) const {
        return joints_.contains(action.joint) ? std::string()
                                              : missing(path + ".joint", "joint", action.joint);
    }
    template <class One>
    std::string checkAction(const One& action, const std::string& path) const {
        if constexpr (requires { bodies_.find(action.body); }) { // a name; other actions have none
            const auto body = bodies_.find(action.body);
            if (body == bodies_.end()) return missing(path + ".body", "body", action.body);
            if constexpr (requires { action.fixture; }) {
                const auto count = static_cast<int>(body->second->fixtures.size());
                if (action.fixture >= count)
                    return detail::outside(path + ".fixture", 0, count - 1, action.fixture);
            }
        }
        return {};
    }

    const Scene& scene_;
    std::vector<BodyDescription> cast_;
    std::map<std::string_view, const BodyDescription*> bodies_;
    std::map<std::string_view, const JointDescription*> joints_;
};

class Cameras {
public:
    explicit Cameras(const Scene& scene)
        : scene_(scene) {
        for (const ScriptInput& input : scene.script)
            if (!std::holds_alternative<SpawnAction>(input.action)) note(input.action);
        for (const LiveInput& input : scene.inputs) note(input.action);
        bearers_.clear();
    }

    /// Checks every repetition, because each has its own name in camera and material actions.
    std::string check(const PlacedBody& placed) {
        const SpawnAction spawn{*placed.body, {}};
        if (placed.isLive) count(placed.body->name);
        for (int k = 0; k < placed.times; ++k) {
            const BodyDescription body = spawnedBody(spawn, k, placed.times);
            for (int i = 0; i < static_cast<int>(body.fixtures.size()); ++i)
                if (mayBeCamera(body, i))
                    if (auto fault = checkCamera(body, i, placed.path); !fault.empty()) return fault;
        }
        return {};
    }

private:
    // A body that had a name; a name may pass to another body, to which earlier actions do not apply.
    struct Bearer {
        std::string_view name;
        int number; // index among live-spawned bodies of that name; earlier actions count for the first
        auto operator<=>(const Bearer&) const = default;
    };
    void count(std::string_view name) { ++bearers_[name]; }
    Bearer bearer(std::string_view name) const {
        const auto found = bearers_.find(name);
        return {name, found == bearers_.end() ? 1 : found->second};
    }

    void note(const Action& action) {
        if (const BodyDescription* body = bodyPutBy(action)) count(body->name);
        if (const auto* camera = std::get_if<CameraAction>(&action))
            if (camera->isOn) switchedOn_.emplace(bearer(camera->body), camera->fixture);
        if (const auto* change = std::get_if<MaterialAction>(&action))
            changes_[bearer(change->body)].push_back(change);
    }

    static const FixtureDescription& fixtureOf(const BodyDescription& body, int index) {
        return body.fixtures[static_cast<std::size_t>(index)];
    }

    bool isSilent(int material) const {
        const Material& made = scene_.materials[static_cast<std::size_t>(material)];
        return made.frequencyHz <= 0.0 || made.decayPerSecond <= 0.0;
    }

    bool mayBeCamera(const BodyDescription& body, int fixture) const {
        return fixtureOf(body, fixture).isCamera || switchedOn_.contains({bearer(body.name), everyFixture}) ||
               switchedOn_.contains({bearer(body.name), fixture});
    }

    std::string checkCamera(const BodyDescription& body, int index, const std::string& path) const {
        const std::string place = itemPath(path + ".fixtures", static_cast<std::size_t>(index));
        const Voice voice = fixtureOf(body, index).voice;
        if (massKg(body, scene_) <= 0.0) return path + ".mass_kg: expected above 0, as a line has none";
        if (voice != Voice::own)
            if (auto fault = checkOthers(place); !fault.empty()) return fault;
        if (voice != Voice::other && mayBeSilent(body, index))
            return place +
                   ".material: a camera's material vibrates, expected one with frequency_hz and decay_per_s";
        return {};
    }

    bool mayBeSilent(const BodyDescription& body, int index) const {
        if (isSilent(fixtureOf(body, index).material)) return true;
        const auto changes = changes_.find(bearer(body.name));
        if (changes == changes_.end()) return false;
        return std::ranges::any_of(changes->second, [&](const MaterialAction* change) {
            const bool isMeant = change->fixture == everyFixture || change->fixture == index;
            return isMeant && isSilent(change->material);
        });
    }

    // Any material may collide with it.
    std::string checkOthers(const std::string& camera) const {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            if (isSilent(static_cast<int>(i)))
                return itemPath("materials", i) + ": expected frequency_hz and decay_per_s, for " + camera +
                       " has the voice of what strikes it";
        return {};
    }

    const Scene& scene_;
    std::map<std::string_view, int> bearers_;
    std::set<std::pair<Bearer, int>> switchedOn_;
    std::map<Bearer, std::vector<const MaterialAction*>> changes_;
};

/// Every fixture that may become a haptic source has what it needs: a mass for Eq. 5.4, and the sounds that
/// its voice may play. References must be valid. The first error, or empty.
std::string checkCameras(const Scene& scene) {
    Cameras cameras(scene);
    for (const PlacedBody& placed : placedBodies(scene))
        if (std::string fault = cameras.check(placed); !fault.empty()) return fault;
    return {};
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
    if (std::string fault = References(scene).check(); !fault.empty()) return fault;
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
