// SPDX-License-Identifier: MIT
// Validates a scene in this order: ranges, totals, unique names, outlines and masses, references, and the
// needs of haptic sources. And warns of sizes that Box2D simulates badly.
#include "Scene/SceneValidation.h"
#include "Core/PortableMath.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneRanges.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/BodyMass.h"
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

std::string countError(const std::string& what, std::size_t max, std::size_t found) {
    if (found <= max) return {};
    return what + ": expected at most " + std::to_string(max) + " in all, found " + std::to_string(found);
}

std::size_t countChainEdges(const BodyDescription& body) {
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
        edges += times * countChainEdges(body);
    }
    void remove(const BodyDescription& body) {
        bodies -= 1;
        fixtures -= body.fixtures.size();
        edges -= countChainEdges(body);
    }
    std::string error() const {
        for (std::string error :
             {countError("bodies", maxBodies, bodies), countError("fixtures", maxFixtures, fixtures),
              countError("chain edges", maxChainEdges, edges)})
            if (!error.empty()) return error;
        return {};
    }
};

/// Checks the numbers of bodies, fixtures, edges and actions: with the script's repetitions, and with those
/// bodies of live inputs that exist at the same time.
std::string checkTotals(const Scene& scene) {
    Totals totals;
    std::size_t actions = 0;
    for (const BodyDescription& body : scene.bodies) totals.add(body);
    for (const ScriptInput& input : scene.script) {
        actions += static_cast<std::size_t>(input.times);
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action))
            totals.add(spawn->body, static_cast<std::size_t>(input.times));
    }
    std::string error = totals.error();
    if (error.empty()) error = countError("script actions", maxActions, actions);
    std::map<std::string_view, const BodyDescription*> spawned;
    for (std::size_t i = 0; i < scene.inputs.size() && error.empty(); ++i) {
        if (const auto* removal = std::get_if<RemoveAction>(&scene.inputs[i].action))
            if (const auto removed = spawned.find(removal->body); removed != spawned.end()) {
                totals.remove(*removed->second);
                spawned.erase(removed);
            }
        const BodyDescription* body = bodyAddedBy(scene.inputs[i].action);
        if (body == nullptr) continue;
        totals.add(*body);
        const auto [present, isNew] = spawned.emplace(body->name, body);
        if (!isNew) totals.remove(*std::exchange(present->second, body)); // a later body replaces it
        error = totals.error();
    }
    return error;
}

std::string checkEdges(const std::vector<Vector>& v, bool isLoop) {
    for (std::size_t i = 0; i + (isLoop ? 0 : 1) < v.size(); ++i) {
        if (detail::distance(v[i], v[(i + 1) % v.size()]) < minSizeMetres)
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

// Box2D computes the inertia about the origin and subtracts the part due to the centre's distance, in single
// precision: for a small shape far from the origin the result would be 0.
std::string checkCentre(const BodyWithPath& entry, const Scene& scene) {
    constexpr double farthestRadii = 100.0;
    if (entry.body->type != BodyType::dynamicBody) return {};
    const BodyMoments moments = bodyMoments(*entry.body, scene);
    const double radius = std::sqrt(moments.inertiaKgSquareMetres / moments.massKg);
    const double distance = portable::hypot(moments.centreMetres.x, moments.centreMetres.y);
    if (distance <= farthestRadii * radius) return {};
    return entry.path + ".fixtures: expected a centre of mass nearer to the body's origin";
}

std::string checkBody(const BodyWithPath& entry) {
    const BodyDescription& body = *entry.body;
    for (std::size_t i = 0; i < body.fixtures.size(); ++i) {
        const std::string path = itemPath(entry.path + ".fixtures", i);
        const Shape& shape = body.fixtures[i].shape;
        const std::string error = std::visit([](const auto& s) { return checkOutline(s); }, shape);
        if (!error.empty()) return path + ".vertices_m: " + error;
        if (body.type == BodyType::dynamicBody && std::holds_alternative<ChainShape>(shape))
            return path + ".shape: a chain has no mass, expected another shape for a dynamic body";
    }
    return {};
}

std::string sizeWarning(const std::string& path, const Shape& shape) {
    const double minMetres = thicknessMetres(shape), maxMetres = lengthMetres(shape);
    if (minMetres >= minWarnMetres && maxMetres <= maxWarnMetres) return {};
    const double found = minMetres < minWarnMetres ? minMetres : maxMetres;
    return detail::rangeError(path, minWarnMetres, maxWarnMetres, found) +
           " m: Box2D simulates such moving bodies less well";
}

std::string unknownNameError(const std::string& path, const char* what, const std::string& name) {
    return path + ": expected the name of a " + what + ", found \"" + name + "\"";
}

/// Checks the names of bodies and joints, references to them in joints and inputs, and the inputs' times.
/// Fields and totals must be in range.
class References {
public:
    explicit References(const Scene& scene)
        : scene_(scene)
        , scriptedBodies_(scriptedBodies(scene)) {
        for (const JointDescription& joint : scene.joints) joints_.emplace(joint.name, &joint);
        for (const LiveInput& input : scene.inputs)
            if (const auto* join = std::get_if<JoinAction>(&input.action))
                joints_.emplace(join->joint.name, &join->joint);
    }

    std::string check() {
        std::string error = checkBodyNames();
        if (error.empty()) error = checkJointNames();
        for (std::size_t i = 0; i < scene_.joints.size() && error.empty(); ++i)
            error = checkJoint(scene_.joints[i], itemPath("joints", i));
        for (std::size_t i = 0; i < scene_.script.size() && error.empty(); ++i)
            error = checkScriptInput(scene_.script[i], itemPath("script", i));
        for (std::size_t i = 0; i < scene_.inputs.size() && error.empty(); ++i)
            error = checkLiveInput(i, itemPath("inputs", i));
        return error;
    }

private:
    // The name of a spawned and removed body may be used again.
    std::string checkBodyNames() {
        const auto duplicateError = [](const std::string& name) {
            return "bodies: expected names of their own, found \"" + name + "\" twice";
        };
        for (const BodyDescription& body : scriptedBodies_)
            if (!bodies_.emplace(body.name, &body).second) return duplicateError(body.name);
        std::set<std::string_view> present, removed;
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* removal = std::get_if<RemoveAction>(&input.action);
                removal != nullptr && present.erase(removal->body) > 0)
                removed.insert(removal->body);
            const BodyDescription* added = bodyAddedBy(input.action);
            if (added == nullptr) continue;
            const BodyDescription& body = *added;
            const bool isChange = std::holds_alternative<ChangeAction>(input.action);
            if (isChange && !bodies_.contains(body.name))
                return unknownNameError("body.name", "body", body.name);
            const auto [known, isNew] = bodies_.emplace(body.name, &body);
            if (removed.erase(body.name) == 0 && !isNew && !isChange) return duplicateError(body.name);
            if (body.fixtures.size() > known->second->fixtures.size()) known->second = &body;
            present.insert(body.name);
        }
        return {};
    }

    // Like bodies: the name of a removed joint may be used again.
    std::string checkJointNames() const {
        std::set<std::string_view> present;
        for (const JointDescription& joint : scene_.joints) present.insert(joint.name);
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* unjoin = std::get_if<UnjoinAction>(&input.action)) present.erase(unjoin->joint);
            const auto* join = std::get_if<JoinAction>(&input.action);
            if (join != nullptr && !present.insert(join->joint.name).second)
                return "joints: expected names of their own, found \"" + join->joint.name + "\" twice";
            if (present.size() > sceneLimits::maxJoints)
                return "joints: expected at most " + std::to_string(sceneLimits::maxJoints);
        }
        return {};
    }

    std::string checkJoint(const JointDescription& joint, const std::string& path) const {
        if (!bodies_.contains(joint.bodyA)) return unknownNameError(path + ".body_a", "body", joint.bodyA);
        if (!bodies_.contains(joint.bodyB)) return unknownNameError(path + ".body_b", "body", joint.bodyB);
        if (joint.bodyA == joint.bodyB) return path + ".body_b: expected another body than body_a";
        const auto hasNoAxis = [](const auto* slidingJoint) {
            return slidingJoint != nullptr &&
                   portable::hypot(slidingJoint->axis.x, slidingJoint->axis.y) < 1.0e-3;
        };
        if (hasNoAxis(std::get_if<WheelJoint>(&joint.joint)) ||
            hasNoAxis(std::get_if<SliderJoint>(&joint.joint)))
            return path + ".axis: expected a direction, found none";
        return {};
    }

    std::string checkScriptInput(const ScriptInput& input, const std::string& path) const {
        const double last = input.timeSeconds + (input.times - 1) * input.everySeconds;
        const double period = scene_.scriptPeriodSeconds;
        const double end = period > 0.0 ? period : sceneLimits::maxScriptSeconds;
        if (!(last <= end)) return detail::rangeError(path + ".time_s", 0.0, end, last);
        if (isAnyOf<ChangeAction, JoinAction, UnjoinAction>(input.action))
            return path + ".input: expected another: change, join and unjoin are live inputs only";
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkLiveInput(std::size_t index, const std::string& path) const {
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
        return hasMotor ? std::string()
                        : unknownNameError(path + ".joint", "revolute or wheel joint", action.joint);
    }
    std::string checkAction(const JoinAction& action, const std::string& path) const {
        return checkJoint(action.joint, path + ".joint");
    }
    std::string checkAction(const UnjoinAction& action, const std::string& path) const {
        return joints_.contains(action.joint) ? std::string()
                                              : unknownNameError(path + ".joint", "joint", action.joint);
    }
    template <class Kind>
    std::string checkAction(const Kind& action, const std::string& path) const {
        if constexpr (requires { bodies_.find(action.body); }) { // `body` is a name here
            const auto body = bodies_.find(action.body);
            if (body == bodies_.end()) return unknownNameError(path + ".body", "body", action.body);
            if constexpr (requires { action.fixture; }) {
                const auto count = static_cast<int>(body->second->fixtures.size());
                if (action.fixture >= count)
                    return detail::rangeError(path + ".fixture", 0, count - 1, action.fixture);
            }
        }
        return {};
    }

    const Scene& scene_;
    std::vector<BodyDescription> scriptedBodies_;
    std::map<std::string_view, const BodyDescription*> bodies_;
    std::map<std::string_view, const JointDescription*> joints_;
};

/// Checks that fixtures which may become haptic sources have the mass and the sounds that they need.
class SourceCheck {
public:
    explicit SourceCheck(const Scene& scene)
        : scene_(scene) {
        for (const ScriptInput& input : scene.script)
            if (!std::holds_alternative<SpawnAction>(input.action)) noteAction(input.action);
        for (const LiveInput& input : scene.inputs) noteAction(input.action);
        nameCounts_.clear();
    }

    /// Checks every repetition, because each has its own name in camera and material actions.
    std::string check(const BodyWithPath& entry) {
        const SpawnAction spawn{*entry.body, {}};
        if (entry.isLive) count(entry.body->name);
        for (int k = 0; k < entry.times; ++k) {
            const BodyDescription body = spawnedBody(spawn, k, entry.times);
            for (int i = 0; i < static_cast<int>(body.fixtures.size()); ++i)
                if (mayBeSource(body, i))
                    if (auto error = checkSource(body, i, entry.path); !error.empty()) return error;
        }
        return {};
    }

private:
    // One of the bodies that had a name in turn; actions apply to the body that had it at their time.
    struct NamedBody {
        std::string_view name;
        int number; // counts the live bodies of that name from 1; earlier actions are of the first
        auto operator<=>(const NamedBody&) const = default;
    };
    void count(std::string_view name) { ++nameCounts_[name]; }
    NamedBody latestBody(std::string_view name) const {
        const auto found = nameCounts_.find(name);
        return {name, found == nameCounts_.end() ? 1 : found->second};
    }

    void noteAction(const Action& action) {
        if (const BodyDescription* body = bodyAddedBy(action)) count(body->name);
        if (const auto* camera = std::get_if<CameraAction>(&action))
            if (camera->isOn) enabledSources_.emplace(latestBody(camera->body), camera->fixture);
        if (const auto* change = std::get_if<MaterialAction>(&action))
            changes_[latestBody(change->body)].push_back(change);
    }

    static const FixtureDescription& fixtureOf(const BodyDescription& body, int index) {
        return body.fixtures[static_cast<std::size_t>(index)];
    }

    bool isSilent(int material) const {
        const Material& values = scene_.materials[static_cast<std::size_t>(material)];
        return values.frequencyHz <= 0.0 || values.decayPerSecond <= 0.0;
    }

    bool mayBeSource(const BodyDescription& body, int fixture) const {
        return fixtureOf(body, fixture).isCamera ||
               enabledSources_.contains({latestBody(body.name), everyFixture}) ||
               enabledSources_.contains({latestBody(body.name), fixture});
    }

    std::string checkSource(const BodyDescription& body, int index, const std::string& path) const {
        const std::string place = itemPath(path + ".fixtures", static_cast<std::size_t>(index));
        const Voice voice = fixtureOf(body, index).voice;
        if (massKg(body, scene_) <= 0.0) return path + ".mass_kg: expected above 0, as a line has none";
        if (voice != Voice::own)
            if (auto error = checkOtherMaterials(place); !error.empty()) return error;
        if (voice != Voice::other && mayBeSilent(body, index))
            return place +
                   ".material: a camera's material vibrates, expected one with frequency_hz and decay_per_s";
        return {};
    }

    bool mayBeSilent(const BodyDescription& body, int index) const {
        if (isSilent(fixtureOf(body, index).material)) return true;
        const auto changes = changes_.find(latestBody(body.name));
        if (changes == changes_.end()) return false;
        return std::ranges::any_of(changes->second, [&](const MaterialAction* change) {
            const bool concernsFixture = change->fixture == everyFixture || change->fixture == index;
            return concernsFixture && isSilent(change->material);
        });
    }

    // With the voice of the other fixture, any material may sound.
    std::string checkOtherMaterials(const std::string& camera) const {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            if (isSilent(static_cast<int>(i)))
                return itemPath("materials", i) + ": expected frequency_hz and decay_per_s, for " + camera +
                       " has the voice of what strikes it";
        return {};
    }

    const Scene& scene_;
    std::map<std::string_view, int> nameCounts_;
    std::set<std::pair<NamedBody, int>> enabledSources_;
    std::map<NamedBody, std::vector<const MaterialAction*>> changes_;
};

/// Checks that every fixture that may become a haptic source has a mass for Eq. 5.4, and the sounds that its
/// voice may play: the first error, or empty. References must be valid.
std::string checkSources(const Scene& scene) {
    SourceCheck sourceCheck(scene);
    for (const BodyWithPath& entry : bodiesWithPaths(scene))
        if (std::string error = sourceCheck.check(entry); !error.empty()) return error;
    return {};
}

} // namespace

std::string validate(const Scene& scene) {
    if (std::string error = checkRanges(scene); !error.empty()) return error;
    const auto entries = bodiesWithPaths(scene);
    if (std::string error = checkTotals(scene); !error.empty()) return error;
    for (std::string error : {checkMaterialNames(scene.materials), checkUnique("bodies", scene.bodies),
                              checkUnique("joints", scene.joints)})
        if (!error.empty()) return error;
    for (const BodyWithPath& body : entries)
        for (std::string error : {checkBody(body), checkCentre(body, scene)})
            if (!error.empty()) return error;
    if (std::string error = References(scene).check(); !error.empty()) return error;
    return checkSources(scene);
}

std::vector<std::string> sceneWarnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (const BodyWithPath& entry : bodiesWithPaths(scene)) {
        if (entry.body->type != BodyType::dynamicBody) continue;
        for (std::size_t i = 0; i < entry.body->fixtures.size(); ++i) {
            auto warning = sizeWarning(itemPath(entry.path + ".fixtures", i), entry.body->fixtures[i].shape);
            if (!warning.empty()) warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

} // namespace physvib
