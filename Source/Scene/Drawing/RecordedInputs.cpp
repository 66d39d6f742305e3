// SPDX-License-Identifier: MIT
// Records live inputs of a scene run, trims them, and converts them to a script that acts in the same steps.
#include "Scene/Drawing/RecordedInputs.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace physvib {
namespace {

/// Name of the state that an action sets until the next action of its kind; a trimmed part starts with that
/// state. Empty for actions without lasting state, such as pushes and grips.
std::string lastingStateName(const Scene& scene, const Action& action) {
    if (isAnyOf<GravityAction, TiltAction>(action)) return "gravity"; // either replaces the other
    if (isAnyOf<HoldAction>(action)) return "hold";
    if (const auto* motor = std::get_if<MotorAction>(&action)) return "motor " + motor->joint;
    const auto* velocity = std::get_if<VelocityAction>(&action);
    const auto* body = velocity != nullptr ? findNamed(scene.bodies, velocity->body) : nullptr;
    return body != nullptr && body->type == BodyType::kinematicBody ? "velocity " + body->name : "";
}

/// Makes `next` the state; of a motor whose torque it does not name, that stays.
void setState(Action& state, const Action& next) {
    const auto* before = std::get_if<MotorAction>(&state);
    const auto torque = before != nullptr ? before->maxTorqueNewtonMetres : std::nullopt;
    state = next;
    if (auto* motor = std::get_if<MotorAction>(&state); motor != nullptr && !motor->maxTorqueNewtonMetres)
        motor->maxTorqueNewtonMetres = torque;
}

/// Bodies that are still gripped after those inputs.
std::vector<std::string> bodiesGrippedAfter(const std::vector<LiveInput>& inputs) {
    std::map<std::string, bool> gripStates;
    for (const LiveInput& input : inputs)
        if (const auto* grip = std::get_if<GripAction>(&input.action))
            gripStates[grip->body] = grip->toMetres.has_value();
    std::vector<std::string> names;
    for (const auto& [name, isGripped] : gripStates)
        if (isGripped) names.push_back(name);
    return names;
}

} // namespace

Scene sceneToRecord(const Scene& scene) {
    Scene recorded = sceneForUserInput(scene);
    recorded.inputs.clear();
    if (recorded.script.empty()) recorded.scriptPeriodSeconds = 0.0;
    return recorded;
}

double maxRecordedSeconds(const Scene& recordedScene) {
    return recordedScene.scriptPeriodSeconds > 0.0 ? recordedScene.scriptPeriodSeconds
                                                   : sceneLimits::maxScriptSeconds;
}

std::size_t maxRecordedInputs(const Scene& recordedScene) {
    constexpr std::size_t reservedInputs = 64; // for inputs that trimming adds: device orientation, drives
                                               // and ends of grips
    return sceneLimits::maxInputs -
           std::min(sceneLimits::maxInputs, recordedScene.script.size() + reservedInputs);
}

RecordedInputs recordedInputs(const SceneRun& run) {
    RecordedInputs recording{{}, 1e-9 * static_cast<double>(run.worldEndNs)};
    const std::size_t maxInputs = maxRecordedInputs(*run.scene);
    for (const LiveInput& input : run.inputs) {
        if (isLasting(input.action) || recording.inputs.size() == maxInputs) {
            recording.lengthSeconds = input.timeSeconds;
            break;
        }
        recording.inputs.push_back(input);
    }
    recording.lengthSeconds = std::min(recording.lengthSeconds, maxRecordedSeconds(*run.scene));
    return recording;
}

RecordedInputs trimmedInputs(const Scene& recordedScene, const RecordedInputs& recording,
                             const ScriptTrim& trim) {
    const double endSeconds = std::min(trim.toSeconds, recording.lengthSeconds);
    RecordedInputs part{{}, std::max(0.0, endSeconds - trim.fromSeconds)};
    std::map<std::string, Action> lastStates;
    for (const LiveInput& input : recording.inputs) {
        if (input.timeSeconds > endSeconds) break;
        if (input.timeSeconds >= trim.fromSeconds)
            part.inputs.push_back({input.timeSeconds - trim.fromSeconds, input.action});
        else if (const std::string state = lastingStateName(recordedScene, input.action); !state.empty())
            setState(lastStates[state], input.action);
    }
    std::vector<LiveInput> initialInputs;
    for (auto& [state, action] : lastStates) initialInputs.push_back({0.0, std::move(action)});
    part.inputs.insert(part.inputs.begin(), initialInputs.begin(), initialInputs.end());
    for (const std::string& body : bodiesGrippedAfter(part.inputs))
        part.inputs.push_back({part.lengthSeconds, GripAction{body, {}, {}}});
    return part;
}

Scene sceneWithInputs(Scene recordedScene, const RecordedInputs& recording, const ScriptTrim& trim) {
    const RecordedInputs part = trimmedInputs(recordedScene, recording, trim);
    std::vector<ScriptInput> script;
    for (const LiveInput& input : part.inputs) script.push_back({input.timeSeconds, 1, 0.0, input.action});
    const bool hasOwnScript = !recordedScene.script.empty(); // the scene's script keeps its own period
    script.insert(script.end(), recordedScene.script.begin(),
                  recordedScene.script.end()); // last, because live inputs of a step act before the script's
    recordedScene.script = std::move(script);
    if (!hasOwnScript)
        recordedScene.scriptPeriodSeconds =
            trim.repeats && part.lengthSeconds >= sceneLimits::minScriptPeriodSeconds ? part.lengthSeconds
                                                                                      : 0.0;
    return recordedScene;
}

} // namespace physvib
