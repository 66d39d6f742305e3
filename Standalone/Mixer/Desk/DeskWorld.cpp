// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs, and edits with their opposites.
#include "Mixer/Desk/DeskWorld.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneCast.h"
#include "Scene/SceneEdits.h"
#include <algorithm>

namespace physvib {

/// Does something to the world, and the opposite; a body that comes back has another name.
class DeskWorld::Edit final : public juce::UndoableAction {
public:
    Edit(DeskWorld& world, Action action)
        : world_{world}
        , forth_{{std::move(action)}} {}
    bool perform() override { return run(forth_, back_); }
    bool undo() override { return run(back_, forth_); }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override { // a sound or a texture that is turned
        const auto* other = dynamic_cast<Edit*>(next);
        if (other == nullptr || !(isTurned<SoundAction>(*other) || isTurned<TextureAction>(*other))) return nullptr;
        auto* both = new Edit{world_, other->forth_.front()};
        both->back_ = back_;
        return both;
    }

private:
    template <class Turned>
    bool isTurned(const Edit& next) const {
        if (forth_.size() != 1 || next.forth_.size() != 1) return false;
        const auto *here = std::get_if<Turned>(&forth_.front()), *there = std::get_if<Turned>(&next.forth_.front());
        return here != nullptr && there != nullptr && here->material == there->material;
    }
    bool run(const std::vector<Action>& actions, std::vector<Action>& opposite) {
        opposite.clear();
        for (const Action& wanted : actions) {
            const Action action = world_.renamed(wanted);
            const auto back = world_.undoOf(action);
            if (!world_.act(action).empty()) return false;
            opposite.insert(opposite.begin(), back.begin(), back.end());
        }
        return true;
    }
    DeskWorld& world_;
    std::vector<Action> forth_, back_;
};

DeskWorld::DeskWorld(Session& session, const Mix& mix, juce::UndoManager& undo, std::function<void(bool isShown)> onInput)
    : session_{session}
    , mix_{mix}
    , undo_{undo}
    , onInput_{std::move(onInput)}
    , scene_{*mix.scene} {}

std::string DeskWorld::act(const Action& action) {
    auto fault = session_.take({action}).error;
    if (fault.empty()) onInput_(show(action));
    return fault;
}

bool DeskWorld::show(const Action& action) {
    if (std::holds_alternative<SpawnAction>(action)) scene_.inputs.push_back({0.0, action});
    else if (std::holds_alternative<MaterialAction>(action) || std::holds_alternative<SoundAction>(action) || std::holds_alternative<TextureAction>(action) ||
             std::holds_alternative<CameraAction>(action))
        describeEdit(scene_, action);
    else return false;
    ++edits_;
    return true;
}

// A name is given once.
Action DeskWorld::renamed(const Action& action) {
    Action named = action;
    if (auto* spawn = std::get_if<SpawnAction>(&named)) spawn->body.name = "added " + std::to_string(++added_);
    return named;
}

std::vector<Action> DeskWorld::undoOf(const Action& action) const {
    const auto cast = sceneCast(scene_);
    const auto body = [&cast](const std::string& name) { return std::ranges::find(cast, name, &BodyDescription::name); };
    if (const auto* spawn = std::get_if<SpawnAction>(&action)) return {RemoveAction{spawn->body.name}};
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const auto found = body(removal->body);
        std::vector<BodyPose> poses;
        session_.world().readPoses(poses);
        const auto index = static_cast<std::size_t>(found - cast.begin());
        if (found == cast.end() || index >= poses.size()) return {};
        BodyDescription back = *found;
        back.positionMetres = {poses[index].xMetres, poses[index].yMetres};
        back.angleRadians = poses[index].angleRadians;
        return {SpawnAction{back, {}}};
    }
    if (const auto* material = std::get_if<MaterialAction>(&action)) {
        const auto found = body(material->body);
        std::vector<Action> back;
        for (std::size_t i = 0; found != cast.end() && i < found->fixtures.size(); ++i) back.push_back(MaterialAction{material->body, static_cast<int>(i), found->fixtures[i].material});
        return back;
    }
    if (const auto* sound = std::get_if<SoundAction>(&action)) {
        const auto& old = scene_.materials[static_cast<std::size_t>(sound->material)];
        return {SoundAction{sound->material, old.frequencyHz, old.decayPerSecond}};
    }
    if (const auto* texture = std::get_if<TextureAction>(&action)) {
        const auto& old = scene_.materials[static_cast<std::size_t>(texture->material)];
        return {TextureAction{texture->material, old.grainMetres, old.roughness, old.grainPattern, old.rolling}};
    }
    return {};
}

std::string DeskWorld::edit(const juce::String& name, const Action& action, bool goesOn) {
    Action trial = action;
    if (auto* spawn = std::get_if<SpawnAction>(&trial)) spawn->body.name = "added " + std::to_string(added_ + 1);
    Scene scene = scene_;
    if (auto fault = InputCheck{scene}.take(trial); !fault.empty()) return fault;
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new Edit{*this, action});
    return {};
}

std::string DeskWorld::begin(bool isSameScene) {
    auto scene = std::make_shared<Scene>(*mix_.scene);
    for (std::size_t i = 0; isSameScene && i < scene->materials.size(); ++i) {
        scene->materials[i].frequencyHz = scene_.materials[i].frequencyHz;
        scene->materials[i].decayPerSecond = scene_.materials[i].decayPerSecond;
        scene->materials[i].setTexture(scene_.materials[i].texture());
    }
    scene_ = *scene;
    ++edits_;
    const SessionState state{std::move(scene), mix_.seed};
    if (!(state == session_.world().state())) return session_.world().setState(state);
    session_.world().restart();
    return {};
}

} // namespace physvib
