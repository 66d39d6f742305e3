// SPDX-License-Identifier: MIT
// Checks live inputs by validating the scene with them added, and keeps those that affect later ones.
#include "Scene/World/InputCheck.h"
#include "Scene/SceneRanges.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include <algorithm>
#include <utility>
#include <variant>

namespace physvib {

namespace {

constexpr auto isRemoveAction = isAnyOf<RemoveAction>;

/// The name of the body that a spawn, change, remove, camera or material action refers to; others: empty.
const std::string& bodyName(const Action& action) {
    static const std::string none;
    if (const BodyDescription* body = bodyAddedBy(action)) return body->name;
    if (const auto* removal = std::get_if<RemoveAction>(&action)) return removal->body;
    if (const auto* camera = std::get_if<CameraAction>(&action)) return camera->body;
    if (const auto* material = std::get_if<MaterialAction>(&action)) return material->body;
    return none;
}

/// True if later inputs must be checked against this one. Pushes and tilts, the majority in a long list, and
/// repetitions change nothing that other inputs depend on.
bool affectsLaterInputs(const std::vector<LiveInput>& earlier, const Action& action) {
    if (isAnyOf<SpawnAction, ChangeAction, JoinAction, UnjoinAction>(action)) return true;
    const bool isSwitch = isAnyOf<CameraAction, MaterialAction>(action);
    if (!isSwitch && !isRemoveAction(action)) return false;
    for (auto input = earlier.rbegin(); input != earlier.rend(); ++input) {
        if (input->action == action) return false;
        if (bodyAddedBy(input->action) != nullptr && bodyName(input->action) == bodyName(action)) return true;
    }
    return isSwitch; // the scene's own bodies are never removed permanently
}

} // namespace

InputCheck::InputCheck(const Scene& scene, std::size_t maxInputs)
    : scene_(scene)
    , acceptedCount_(scene.inputs.size())
    , maxInputs_(maxInputs) {
    for (LiveInput& input : std::exchange(scene_.inputs, {})) addIfNeeded(std::move(input));
}

// Replaces an earlier input by `action` if possible; returns true if so. An editor changes the same bodies
// and joints repeatedly, and only the last change of each matters.
bool InputCheck::mergeInput(const Action& action) {
    auto& inputs = scene_.inputs;
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action)) {
        const auto isAffected = [&](const LiveInput& input) {
            const auto* join = std::get_if<JoinAction>(&input.action);
            return join != nullptr && join->joint.name == unjoin->joint;
        };
        return std::erase_if(inputs, isAffected) > 0;
    }
    const auto* change = std::get_if<ChangeAction>(&action);
    if (change == nullptr) return false;
    const auto last = std::find_if(inputs.rbegin(), inputs.rend(), [&](const LiveInput& input) {
        return bodyName(input.action) == change->body.name;
    });
    if (last == inputs.rend()) return false;
    const BodyDescription* const added = bodyAddedBy(last->action);
    if (added != nullptr && added->fixtures.size() <= change->body.fixtures.size()) {
        if (auto* spawn = std::get_if<SpawnAction>(&last->action))
            spawn->body = change->body;
        else
            last->action = *change;
        return true;
    }
    const auto isSpawned = [&](const LiveInput& input) {
        return isAnyOf<SpawnAction>(input.action) && bodyName(input.action) == change->body.name;
    };
    if (!isRemoveAction(last->action) || std::ranges::none_of(inputs, isSpawned)) return false;
    // the spawn may have been dropped as one of the oldest
    inputs.push_back({inputs.back().timeSeconds, SpawnAction{change->body, {}}});
    return true;
}

void InputCheck::addIfNeeded(LiveInput input) {
    if (mergeInput(input.action) || !affectsLaterInputs(scene_.inputs, input.action)) return;
    scene_.inputs.push_back(std::move(input));
    if (maxInputs_ == unlimited) dropOldestRemovals();
}

void InputCheck::dropOldestRemovals() {
    auto& inputs = scene_.inputs;
    while (static_cast<std::size_t>(std::ranges::count_if(inputs, isRemoveAction, &LiveInput::action)) >
           maxRemembered) {
        const auto oldest = std::ranges::find_if(inputs, isRemoveAction, &LiveInput::action);
        const std::string body = bodyName(oldest->action);
        const auto isAffected = [&](const LiveInput& input) { return bodyName(input.action) == body; };
        const auto next = std::find_if(oldest, inputs.end(), [&](const LiveInput& input) {
            return isAnyOf<SpawnAction>(input.action) && isAffected(input);
        });
        // inputs from the next spawn on refer to another body of that name
        inputs.erase(std::remove_if(inputs.begin(), next, isAffected), next);
        if (const auto scripted = scriptedBodies(scene_); findNamed(scripted, body) == nullptr)
            std::erase_if(inputs, [&](const LiveInput& input) {
                const auto* join = std::get_if<JoinAction>(&input.action);
                return join != nullptr && (join->joint.bodyA == body || join->joint.bodyB == body);
            });
    }
}

std::string InputCheck::accept(std::span<const Action> actions) {
    if (actions.size() > maxInputs_ - acceptedCount_)
        return "expected at most " + std::to_string(maxInputs_) + " inputs";
    auto& inputs = scene_.inputs;
    const double lastSeconds = inputs.empty() ? 0.0 : inputs.back().timeSeconds;
    const std::size_t oldCount = inputs.size();
    for (const Action& action : actions) inputs.push_back({lastSeconds, action});
    const std::string error = validate(scene_);
    const auto first = inputs.end() - std::ssize(actions);
    std::vector<LiveInput> newInputs{std::move_iterator{first}, std::move_iterator{inputs.end()}};
    inputs.erase(first, inputs.end());
    for (std::size_t i = oldCount; !error.empty() && i < oldCount + actions.size(); ++i)
        if (const auto prefix = detail::itemPath("inputs", i) + "."; error.starts_with(prefix))
            return error.substr(prefix.size());
    if (!error.empty()) return error;
    acceptedCount_ += actions.size();
    for (LiveInput& input : newInputs) addIfNeeded(std::move(input));
    return {};
}

} // namespace physvib
