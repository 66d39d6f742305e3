// SPDX-License-Identifier: MIT
// Converts recorded live inputs to a scene script with the same steps.
#include "Scene/Drawing/HandScript.h"
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
std::string stateOf(const Scene& scene, const Action& action) {
    if (isAnyOf<GravityAction, TiltAction>(action)) return "gravity"; // either replaces the other
    if (isAnyOf<HoldAction>(action)) return "hold";
    if (const auto* motor = std::get_if<MotorAction>(&action)) return "motor " + motor->joint;
    const auto* velocity = std::get_if<VelocityAction>(&action);
    const auto* moved = velocity != nullptr ? findNamed(scene.bodies, velocity->body) : nullptr;
    return moved != nullptr && moved->type == BodyType::kinematicBody ? "velocity " + moved->name : "";
}

/// Bodies that are still gripped after those inputs.
std::vector<std::string> heldAfter(const std::vector<LiveInput>& inputs) {
    std::map<std::string, bool> held;
    for (const LiveInput& input : inputs)
        if (const auto* grip = std::get_if<GripAction>(&input.action))
            held[grip->body] = grip->toMetres.has_value();
    std::vector<std::string> names;
    for (const auto& [name, isHeld] : held)
        if (isHeld) names.push_back(name);
    return names;
}

} // namespace

Scene sceneToRecord(const Scene& scene) {
    Scene recorded = sceneForHands(scene);
    recorded.inputs.clear();
    if (recorded.script.empty()) recorded.scriptPeriodSeconds = 0.0;
    return recorded;
}

double maxRecordedSeconds(const Scene& recordedIn) {
    return recordedIn.scriptPeriodSeconds > 0.0 ? recordedIn.scriptPeriodSeconds
                                                : sceneLimits::maxScriptSeconds;
}

std::size_t maxRecordedInputs(const Scene& recordedIn) {
    constexpr std::size_t room = 64; // for inputs that trimming adds: device orientation and ends of grips
    return sceneLimits::maxInputs - std::min(sceneLimits::maxInputs, recordedIn.script.size() + room);
}

HandScript recordedHands(const SceneRun& take) {
    HandScript hands{{}, 1e-9 * static_cast<double>(take.worldEndNs)};
    const std::size_t most = maxRecordedInputs(*take.scene);
    for (const LiveInput& input : take.inputs) {
        if (isLasting(input.action) || hands.inputs.size() == most) {
            hands.lengthSeconds = input.timeSeconds;
            break;
        }
        hands.inputs.push_back(input);
    }
    hands.lengthSeconds = std::min(hands.lengthSeconds, maxRecordedSeconds(*take.scene));
    return hands;
}

HandScript trimmed(const Scene& recordedIn, const HandScript& hands, const ScriptTrim& trim) {
    const double to = std::min(trim.toSeconds, hands.lengthSeconds);
    HandScript part{{}, std::max(0.0, to - trim.fromSeconds)};
    std::map<std::string, Action> before;
    for (const LiveInput& input : hands.inputs) {
        if (input.timeSeconds > to) break;
        if (input.timeSeconds >= trim.fromSeconds)
            part.inputs.push_back({input.timeSeconds - trim.fromSeconds, input.action});
        else if (const std::string state = stateOf(recordedIn, input.action); !state.empty())
            before.insert_or_assign(state, input.action);
    }
    std::vector<LiveInput> first;
    for (auto& [state, action] : before) first.push_back({0.0, std::move(action)});
    part.inputs.insert(part.inputs.begin(), first.begin(), first.end());
    for (const std::string& body : heldAfter(part.inputs))
        part.inputs.push_back({part.lengthSeconds, GripAction{body, {}, {}}});
    return part;
}

Scene withHands(Scene recordedIn, const HandScript& hands, const ScriptTrim& trim) {
    const HandScript part = trimmed(recordedIn, hands, trim);
    std::vector<ScriptInput> script;
    for (const LiveInput& input : part.inputs) script.push_back({input.timeSeconds, 1, 0.0, input.action});
    const bool keepGoing = !recordedIn.script.empty(); // the scene's script keeps its own period
    script.insert(script.end(), recordedIn.script.begin(),
                  recordedIn.script.end()); // last, because live inputs of a step act before the script's
    recordedIn.script = std::move(script);
    if (!keepGoing)
        recordedIn.scriptPeriodSeconds =
            trim.repeats && part.lengthSeconds >= sceneLimits::minScriptPeriodSeconds ? part.lengthSeconds
                                                                                      : 0.0;
    return recordedIn;
}

} // namespace physvib
