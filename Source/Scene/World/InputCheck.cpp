// SPDX-License-Identifier: MIT
// Checks a live input by validating the scene with that input added.
#include "Scene/World/InputCheck.h"
#include "Scene/SceneRanges.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <utility>
#include <variant>

namespace physvib {

namespace {

constexpr auto isRemoval = isAnyOf<RemoveAction>;

/// The body that one of those actions refers to.
const std::string& bodyOf(const Action& action) {
    static const std::string none;
    if (const BodyDescription* body = bodyPutBy(action)) return body->name;
    if (const auto* removal = std::get_if<RemoveAction>(&action)) return removal->body;
    if (const auto* camera = std::get_if<CameraAction>(&action)) return camera->body;
    if (const auto* material = std::get_if<MaterialAction>(&action)) return material->body;
    return none;
}

/// True if later inputs must be checked against this one. Pushes and tilts, most of a long list, change
/// nothing that others depend on; nor does a repetition.
bool matters(const std::vector<LiveInput>& before, const Action& action) {
    if (isAnyOf<SpawnAction, ChangeAction, JoinAction, UnjoinAction>(action)) return true;
    const bool isSwitch = isAnyOf<CameraAction, MaterialAction>(action);
    if (!isSwitch && !isRemoval(action)) return false;
    for (auto input = before.rbegin(); input != before.rend(); ++input) {
        if (input->action == action) return false;
        if (bodyPutBy(input->action) != nullptr && bodyOf(input->action) == bodyOf(action)) return true;
    }
    return isSwitch; // on the scene's own bodies, which are never removed permanently
}

} // namespace

InputCheck::InputCheck(const Scene& scene, std::size_t most)
    : scene_(scene)
    , taken_(scene.inputs.size())
    , most_(most) {
    for (LiveInput& input : std::exchange(scene_.inputs, {})) keep(std::move(input));
}

// An editor changes the same bodies and joints repeatedly: only the last change of each is kept.
bool InputCheck::fold(const Action& action) {
    auto& inputs = scene_.inputs;
    if (const auto* unjoin = std::get_if<UnjoinAction>(&action)) {
        const auto isOf = [&](const LiveInput& input) {
            const auto* join = std::get_if<JoinAction>(&input.action);
            return join != nullptr && join->joint.name == unjoin->joint;
        };
        return std::erase_if(inputs, isOf) > 0;
    }
    const auto* change = std::get_if<ChangeAction>(&action);
    if (change == nullptr) return false;
    const auto last = std::find_if(inputs.rbegin(), inputs.rend(), [&](const LiveInput& input) {
        return bodyOf(input.action) == change->body.name;
    });
    if (last == inputs.rend()) return false;
    const BodyDescription* const put = bodyPutBy(last->action);
    if (put != nullptr && put->fixtures.size() <= change->body.fixtures.size()) {
        if (auto* before = std::get_if<SpawnAction>(&last->action))
            before->body = change->body;
        else
            last->action = *change;
        return true;
    }
    const auto isSpawned = [&](const LiveInput& input) {
        return isAnyOf<SpawnAction>(input.action) && bodyOf(input.action) == change->body.name;
    };
    if (!isRemoval(last->action) || std::ranges::none_of(inputs, isSpawned)) return false;
    // earlier inputs may have been forgotten
    inputs.push_back({inputs.back().timeSeconds, SpawnAction{change->body, {}}});
    return true;
}

void InputCheck::keep(LiveInput input) {
    if (fold(input.action) || !matters(scene_.inputs, input.action)) return;
    scene_.inputs.push_back(std::move(input));
    if (most_ == endless) forgetOldest();
}

void InputCheck::forgetOldest() {
    auto& inputs = scene_.inputs;
    while (static_cast<std::size_t>(std::ranges::count_if(inputs, isRemoval, &LiveInput::action)) >
           remembered) {
        const auto oldest = std::ranges::find_if(inputs, isRemoval, &LiveInput::action);
        const std::string body = bodyOf(oldest->action);
        const auto isOf = [&](const LiveInput& input) { return bodyOf(input.action) == body; };
        const auto next = std::find_if(oldest, inputs.end(), [&](const LiveInput& input) {
            return isAnyOf<SpawnAction>(input.action) && isOf(input);
        });
        // later inputs refer to another body of that name
        inputs.erase(std::remove_if(inputs.begin(), next, isOf), next);
        if (const auto cast = scriptedCast(scene_); findNamed(cast, body) == nullptr)
            std::erase_if(inputs, [&](const LiveInput& input) {
                const auto* join = std::get_if<JoinAction>(&input.action);
                return join != nullptr && (join->joint.bodyA == body || join->joint.bodyB == body);
            });
    }
}

std::string InputCheck::take(std::span<const Action> actions) {
    if (actions.size() > most_ - taken_) return "expected at most " + std::to_string(most_) + " inputs";
    auto& inputs = scene_.inputs;
    const double now = inputs.empty() ? 0.0 : inputs.back().timeSeconds;
    const std::size_t known = inputs.size();
    for (const Action& action : actions) inputs.push_back({now, action});
    const std::string fault = validate(scene_);
    const auto first = inputs.end() - std::ssize(actions);
    std::vector<LiveInput> taken{std::move_iterator{first}, std::move_iterator{inputs.end()}};
    inputs.erase(first, inputs.end());
    for (std::size_t i = known; !fault.empty() && i < known + actions.size(); ++i)
        if (const auto place = detail::itemPath("inputs", i) + "."; fault.starts_with(place))
            return fault.substr(place.size());
    if (!fault.empty()) return fault;
    taken_ += actions.size();
    for (LiveInput& input : taken) keep(std::move(input));
    return {};
}

} // namespace physvib
