// SPDX-License-Identifier: GPL-3.0-or-later
// What the desk does to the world: inputs, edits with their opposites, strikes of single enchanters.
#include "Mixer/Desk/Desk.h"
#include "Core/ToneEnd.h"
#include "Files/ActuatorFile.h"
#include "Mixer/Desk/DeskWords.h"
#include "Physics/InputCheck.h"
#include "Physics/Scenes/SceneCast.h"
#include "Physics/Scenes/SceneEdits.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr double strikeAmplitude = 0.5; // of pulses and auditions, in front of strip, ceiling and master

} // namespace

/// Does something to the world, and the opposite; a body that comes back has another name.
class Desk::WorldEdit final : public juce::UndoableAction {
public:
    WorldEdit(Desk& desk, Action action)
        : desk_{desk}
        , forth_{{std::move(action)}} {}
    bool perform() override { return run(forth_, back_); }
    bool undo() override { return run(back_, forth_); }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override { // a sound or a texture that is turned
        const auto* other = dynamic_cast<WorldEdit*>(next);
        if (other == nullptr || !(isTurned<SoundAction>(*other) || isTurned<TextureAction>(*other))) return nullptr;
        auto* both = new WorldEdit{desk_, other->forth_.front()};
        both->back_ = back_;
        return both;
    }

private:
    template <class Turned>
    bool isTurned(const WorldEdit& next) const {
        if (forth_.size() != 1 || next.forth_.size() != 1) return false;
        const auto *here = std::get_if<Turned>(&forth_.front()), *there = std::get_if<Turned>(&next.forth_.front());
        return here != nullptr && there != nullptr && here->material == there->material;
    }
    bool run(const std::vector<Action>& actions, std::vector<Action>& opposite) {
        opposite.clear();
        for (const Action& wanted : actions) {
            const Action action = desk_.renamed(wanted);
            const auto back = desk_.undoOf(action);
            if (!desk_.act(action).empty()) return false;
            opposite.insert(opposite.begin(), back.begin(), back.end());
        }
        return true;
    }
    Desk& desk_;
    std::vector<Action> forth_, back_;
};

std::string Desk::act(const Action& action) {
    const auto fault = session_.act(action);
    if (!fault.empty()) return fault;
    ++edits_;
    showEdit(action);
    return {};
}

void Desk::showEdit(const Action& action) {
    if (std::holds_alternative<SpawnAction>(action)) sceneNow_.inputs.push_back({0.0, action});
    else if (std::holds_alternative<MaterialAction>(action) || std::holds_alternative<SoundAction>(action) || std::holds_alternative<TextureAction>(action) ||
             std::holds_alternative<CameraAction>(action))
        describeEdit(sceneNow_, action);
    else return;
    ++worldEdits_;
    sendChangeMessage();
}

// A name is given once.
Action Desk::renamed(const Action& action) {
    Action named = action;
    if (auto* spawn = std::get_if<SpawnAction>(&named)) spawn->body.name = "added " + std::to_string(++added_);
    return named;
}

std::vector<Action> Desk::undoOf(const Action& action) const {
    const auto cast = sceneCast(sceneNow_);
    const auto body = [&cast](const std::string& name) { return std::ranges::find(cast, name, &BodyDescription::name); };
    if (const auto* spawn = std::get_if<SpawnAction>(&action)) return {RemoveAction{spawn->body.name}};
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const auto found = body(removal->body);
        std::vector<BodyPose> poses;
        session_.readPoses(poses);
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
        const auto& old = sceneNow_.materials[static_cast<std::size_t>(sound->material)];
        return {SoundAction{sound->material, old.frequencyHz, old.decayPerSecond}};
    }
    if (const auto* texture = std::get_if<TextureAction>(&action)) {
        const auto& old = sceneNow_.materials[static_cast<std::size_t>(texture->material)];
        return {TextureAction{texture->material, old.grainMetres, old.roughness, old.grainPattern, old.rolling}};
    }
    return {};
}

std::string Desk::editWorld(const juce::String& name, const Action& action, bool goesOn) {
    Action trial = action;
    if (auto* spawn = std::get_if<SpawnAction>(&trial)) spawn->body.name = "added " + std::to_string(added_ + 1);
    Scene scene = sceneNow_;
    if (auto fault = InputCheck{scene}.take(trial); !fault.empty()) return fault;
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new WorldEdit{*this, action});
    return {};
}

void Desk::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    ++edits_;
    takeScene(true);
    sendChangeMessage();
}

// The world begins anew. What was measured or tuned stays, as the strips do.
void Desk::takeScene(bool keepsMaterials) {
    auto scene = std::make_shared<Scene>(*mix_.scene);
    for (std::size_t i = 0; keepsMaterials && i < scene->materials.size(); ++i) {
        scene->materials[i].frequencyHz = sceneNow_.materials[i].frequencyHz;
        scene->materials[i].decayPerSecond = sceneNow_.materials[i].decayPerSecond;
        scene->materials[i].setTexture(sceneNow_.materials[i].texture());
    }
    sceneNow_ = *scene;
    ++worldEdits_;
    if (const SessionState state{std::move(scene), mix_.seed}; state == session_.state()) session_.restart();
    else if (const auto fault = session_.setState(state); !fault.empty()) report(utf8(fault));
}

void Desk::setSlowness(int slowness) {
    session_.setSlowness(slowness);
    sendChangeMessage();
}

// In the field, where it is alone.
EnchanterPlace Desk::placeOf(int enchanter) const {
    const auto& layout = mix_.layout.geometry;
    const auto& place = layout.places[static_cast<std::size_t>(enchanter)];
    return {place.xMetres / layout.extentWidthMetres * mix_.scene->fieldWidthMetres, place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres};
}

void Desk::strike(int enchanter, std::vector<CollisionEvent> strikes) {
    const auto place = placeOf(enchanter);
    for (auto& s : strikes) {
        s.x = place.xMetres;
        s.y = place.yMetres;
    }
    ++edits_;
    session_.play(strikes);
    sendChangeMessage(); // who rests looks again
}

std::string Desk::audition(int material, double shareX, double shareY) {
    const auto index = static_cast<std::size_t>(material);
    if (index >= sceneNow_.materials.size() || sceneNow_.materials[index].frequencyHz <= 0.0) return "expected a material that sounds";
    const Material& heard = sceneNow_.materials[index];
    CollisionEvent hit;
    hit.frequencyHz = heard.frequencyHz;
    hit.decayPerSecond = heard.decayPerSecond;
    hit.amplitude = strikeAmplitude;
    hit.x = shareX * sceneNow_.fieldWidthMetres;
    hit.y = shareY * sceneNow_.fieldHeightMetres;
    ++edits_;
    sendChangeMessage(); // who rests looks again
    return session_.play({&hit, 1}) ? std::string{} : heard.name + ": cannot be played";
}

void Desk::testPulse(int enchanter) {
    CollisionEvent pulse;
    const auto profile = findActuator(mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].actuator);
    pulse.frequencyHz = profile && profile.value.resonanceHz ? *profile.value.resonanceHz : 205.0; // where the thesis' actuators are strongest
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = strikeAmplitude;
    strike(enchanter, {pulse});
}

void Desk::testSweep(int enchanter) {
    std::vector<CollisionEvent> tones;
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (count - 1)); // 40 to 400 Hz: what is felt
        tone.durationNs = softEndNs(tone.frequencyHz, 60'000'000);
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    strike(enchanter, std::move(tones));
}

} // namespace physvib
