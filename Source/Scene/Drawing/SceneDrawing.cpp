// SPDX-License-Identifier: MIT
// Applies edits to a scene, and finds each action's inverse before it acts.
#include "Scene/Drawing/SceneDrawing.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace physvib {
namespace {

bool isStructural(const Action& action) {
    return bodyPutBy(action) != nullptr || std::holds_alternative<RemoveAction>(action) ||
           std::holds_alternative<JoinAction>(action) || std::holds_alternative<UnjoinAction>(action);
}

/// One action per fixture, with its present value.
template <class Make>
std::vector<Action> ofFixtures(const BodyDescription* body, Make make) {
    std::vector<Action> back;
    for (std::size_t i = 0; body != nullptr && i < body->fixtures.size(); ++i)
        back.push_back(make(static_cast<int>(i), body->fixtures[i]));
    return back;
}

} // namespace

std::optional<BodyPose> drawable(BodyPose pose) {
    if (std::abs(pose.angleRadians) > sceneLimits::maxAngleRadians)
        pose.angleRadians = std::remainder(pose.angleRadians, 2.0 * std::numbers::pi);
    const bool isNear =
        std::max(std::abs(pose.xMetres), std::abs(pose.yMetres)) <= sceneLimits::maxPositionMetres;
    return isNear ? std::optional{pose} : std::nullopt;
}

SceneDrawing::SceneDrawing(Scene scene)
    : drawn_{std::move(scene)}
    , cast_{drawn_} {}

std::string SceneDrawing::check(const std::vector<Action>& actions) const {
    return InputCheck{cast_}.take(actions);
}

void SceneDrawing::take(std::span<const Action> actions) {
    editScene(drawn_, actions);
    for (const Action& action : actions)
        if (isStructural(action))
            cast_.inputs.push_back({0.0, action});
        else if (isLasting(action))
            describeEdit(cast_, action);
}

const BodyDescription* SceneDrawing::find(std::string_view body) const noexcept {
    const auto found = std::ranges::find(drawn_.bodies, body, &BodyDescription::name);
    return found == drawn_.bodies.end() ? nullptr : &*found;
}

std::vector<std::string> SceneDrawing::freeNames(const std::string& stem, std::size_t count) const {
    std::set<std::string> taken;
    for (const BodyDescription& body : sceneCast(cast_)) taken.insert(body.name);
    for (const JointDescription& joint : drawn_.joints) taken.insert(joint.name);
    for (const LiveInput& input : cast_.inputs)
        if (const auto* join = std::get_if<JoinAction>(&input.action)) taken.insert(join->joint.name);
    std::vector<std::string> names;
    for (int n = 1; names.size() < count; ++n)
        if (std::string name = stem + " " + std::to_string(n); !taken.contains(name))
            names.push_back(std::move(name));
    return names;
}

std::vector<Action> SceneDrawing::undoOf(const Action& action, const PoseNow& now) const {
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const BodyDescription* const there = find(removal->body);
        if (there == nullptr) return {};
        ChangeAction back{*there, false};
        if (const auto pose = now ? now(removal->body) : std::nullopt) {
            back.body.positionMetres = {pose->xMetres, pose->yMetres};
            back.body.angleRadians = pose->angleRadians;
        }
        return {back};
    }
    if (const BodyDescription* put = bodyPutBy(action)) {
        const BodyDescription* const there = find(put->name);
        const auto* change = std::get_if<ChangeAction>(&action);
        if (there == nullptr) return {RemoveAction{put->name}};
        return {ChangeAction{*there, change != nullptr && change->stays}};
    }
    if (const auto* join = std::get_if<JoinAction>(&action)) return {UnjoinAction{join->joint.name}};
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action)) {
        const Scene here = sceneNow(drawn_, now);
        const auto joint = std::ranges::find(here.joints, unjoin->joint, &JointDescription::name);
        if (joint == here.joints.end()) return {};
        std::vector<Action> back; // what it held was drawn elsewhere, and goes on alone
        for (const BodyDescription& body : here.bodies)
            if ((body.name == joint->bodyA || body.name == joint->bodyB) && body != *find(body.name))
                back.push_back(ChangeAction{body, false});
        back.push_back(JoinAction{*joint});
        return back;
    }
    if (const auto* material = std::get_if<MaterialAction>(&action))
        return ofFixtures(find(material->body), [&](int i, const FixtureDescription& f) {
            return MaterialAction{material->body, i, f.material};
        });
    if (const auto* camera = std::get_if<CameraAction>(&action))
        return ofFixtures(find(camera->body), [&](int i, const FixtureDescription& f) {
            return CameraAction{camera->body, i, f.isCamera};
        });
    if (const auto* sound = std::get_if<SoundAction>(&action)) {
        const Material& old = drawn_.materials[static_cast<std::size_t>(sound->material)];
        return {SoundAction{sound->material, old.frequencyHz, old.decayPerSecond}};
    }
    if (const auto* texture = std::get_if<TextureAction>(&action)) {
        const Material& old = drawn_.materials[static_cast<std::size_t>(texture->material)];
        return {
            TextureAction{texture->material, old.grainMetres, old.roughness, old.grainPattern, old.rolling}};
    }
    return {};
}

void SceneEdit::run(bool isForth, const SceneDrawing& drawing, const PoseNow& now,
                    const std::function<void(std::span<const Action>)>& act) {
    const auto& actions = isForth ? forth_ : back_;
    std::vector<Action> opposite;               // from the end
    const bool isErased = std::ranges::none_of( // a joint that is changed stays where it was drawn
        actions, [](const Action& action) { return std::holds_alternative<JoinAction>(action); });
    for (std::span<const Action> left{actions}; !left.empty();) {
        const auto run = left.first(takenTogether(left));
        left = left.subspan(run.size());
        for (const Action& action : run) {
            const auto back = drawing.undoOf(action, isErased ? now : PoseNow{});
            opposite.insert(opposite.end(), back.rbegin(), back.rend());
        }
        act(run);
    }
    (isForth ? back_ : forth_).assign(opposite.rbegin(), opposite.rend());
}

SceneEdit SceneEdit::followedBy(const SceneEdit& next) const {
    SceneEdit both{next.forth_};
    both.back_ = back_;
    return both;
}

} // namespace physvib
