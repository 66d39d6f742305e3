// SPDX-License-Identifier: MIT
// Applies lasting actions to scene descriptions, skips invalid ones; removes scripted user input.
#include "Scene/SceneEdits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/ScenePlayer.h"
#include <algorithm>
#include <set>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {
namespace {

BodyDescription* findBody(Scene& scene, const std::string& name) {
    // of several bodies of that name the last one exists
    for (auto input = scene.inputs.rbegin(); input != scene.inputs.rend(); ++input)
        if (auto* added = bodyAddedBy(input->action); added != nullptr && added->name == name) return added;
    return findNamed(scene.bodies, name);
}

template <class Change>
void changeFixtures(Scene& scene, const std::string& body, int fixture, Change change) {
    BodyDescription* found = findBody(scene, body);
    if (found == nullptr) return;
    for (std::size_t i = 0; i < found->fixtures.size(); ++i)
        if (fixture == everyFixture || fixture == static_cast<int>(i)) change(found->fixtures[i]);
}

} // namespace

void recordEdit(Scene& scene, const Action& action) {
    if (const auto* material = std::get_if<MaterialAction>(&action))
        changeFixtures(scene, material->body, material->fixture,
                       [material](FixtureDescription& f) { f.material = material->material; });
    if (const auto* camera = std::get_if<CameraAction>(&action))
        changeFixtures(scene, camera->body, camera->fixture,
                       [camera](FixtureDescription& f) { f.isCamera = camera->isOn; });
    if (const auto* sound = std::get_if<SoundAction>(&action)) {
        Material& material = scene.materials[static_cast<std::size_t>(sound->material)];
        material.frequencyHz = sound->frequencyHz;
        material.decayPerSecond = sound->decayPerSecond;
    }
    if (const auto* change = std::get_if<ChangeAction>(&action))
        if (BodyDescription* found = findBody(scene, change->body.name)) *found = change->body;
    if (const auto* texture = std::get_if<TextureAction>(&action))
        scene.materials[static_cast<std::size_t>(texture->material)].setTexture(texture->texture());
}

namespace {

void applyEdit(Scene& scene, const Action& action) {
    recordEdit(scene, action);
    if (const auto* removal = std::get_if<RemoveAction>(&action))
        std::erase_if(scene.bodies, [removal](const BodyDescription& b) { return b.name == removal->body; });
    if (const auto* join = std::get_if<JoinAction>(&action)) scene.joints.push_back(join->joint);
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action))
        std::erase_if(scene.joints, [unjoin](const JointDescription& j) { return j.name == unjoin->joint; });
    const BodyDescription* added = bodyAddedBy(action);
    if (added != nullptr && findNamed(scene.bodies, added->name) == nullptr) scene.bodies.push_back(*added);
}

} // namespace

bool isLasting(const Action& action) {
    return std::visit(
        []<class Kind>(const Kind&) {
            return requires { Kind::isLasting; };
        },
        action);
}

std::size_t independentActions(std::span<const Action> actions) {
    std::set<std::string_view> names;
    for (const Action& action : actions) {
        const auto* removal = std::get_if<RemoveAction>(&action);
        const auto* added = bodyAddedBy(action);
        if (action.index() != actions.front().index() || (removal == nullptr && added == nullptr) ||
            !names.insert(added ? added->name : removal->body).second)
            break;
    }
    return std::max<std::size_t>(1, names.size());
}

void editScene(Scene& scene, std::span<const Action> actions) {
    while (!actions.empty()) {
        const auto group = actions.first(independentActions(actions));
        actions = actions.subspan(group.size());
        if (!isLasting(group.front())) continue;
        Scene next = scene;
        for (const Action& action : group) applyEdit(next, action);
        if (validate(next).empty())
            scene = std::move(next);
        else if (group.size() > 1)
            for (const Action& action : group) editScene(scene, {&action, 1});
    }
}

Scene sceneAtEndOfRun(const SceneRun& run) {
    Scene scene = *run.scene;
    std::vector<Action> actions;
    for (const LiveInput& input : run.inputs) actions.push_back(input.action);
    editScene(scene, actions);
    return scene;
}

Scene sceneForUserInput(Scene scene) {
    const ScenePlayer player{scene};
    std::erase_if(scene.script, [&](const ScriptInput& input) {
        const Action& a = input.action;
        if (player.isPresent()) return player.controls(a) || std::holds_alternative<TiltAction>(a);
        return std::visit(
            []<class Kind>(const Kind&) {
                return requires { Kind::isUserInput; };
            },
            a);
    });
    return scene;
}

} // namespace physvib
