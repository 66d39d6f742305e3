// SPDX-License-Identifier: MIT
// The scene with one more input must be a valid scene.
#include "Scene/World/InputCheck.h"
#include "Scene/SceneRanges.h"
#include "Scene/SceneValidation.h"
#include <algorithm>
#include <utility>
#include <variant>

namespace physvib {

namespace {

bool isSpawn(const Action& action) { return std::holds_alternative<SpawnAction>(action); }
bool isRemoval(const Action& action) { return std::holds_alternative<RemoveAction>(action); }
bool isSwitch(const Action& action) { return std::holds_alternative<CameraAction>(action) || std::holds_alternative<MaterialAction>(action); }

/// Of those four.
const std::string& bodyOf(const Action& action) {
    static const std::string none;
    if (const auto* spawn = std::get_if<SpawnAction>(&action)) return spawn->body.name;
    if (const auto* removal = std::get_if<RemoveAction>(&action)) return removal->body;
    if (const auto* camera = std::get_if<CameraAction>(&action)) return camera->body;
    if (const auto* material = std::get_if<MaterialAction>(&action)) return material->body;
    return none;
}

/// Whether it matters, after what was done before, for what comes later. Pushes and tilts change nothing that others are checked
/// against, and they are most of a long list; nor does saying something twice.
bool matters(const std::vector<LiveInput>& before, const Action& action) {
    if (isSpawn(action)) return true;
    if (!isSwitch(action) && !isRemoval(action)) return false;
    for (auto input = before.rbegin(); input != before.rend(); ++input) {
        if (input->action == action) return false;
        if (isSpawn(input->action) && bodyOf(input->action) == bodyOf(action)) return true;
    }
    return isSwitch(action); // of the scene's own bodies; they never go for good
}

} // namespace

InputCheck::InputCheck(const Scene& scene, std::size_t most)
    : scene_(scene)
    , taken_(scene.inputs.size())
    , most_(most) {
    for (LiveInput& input : std::exchange(scene_.inputs, {})) keep(std::move(input));
}

void InputCheck::keep(LiveInput input) {
    if (!matters(scene_.inputs, input.action)) return;
    scene_.inputs.push_back(std::move(input));
    if (most_ == endless) forgetOldest();
}

void InputCheck::forgetOldest() {
    auto& inputs = scene_.inputs;
    while (static_cast<std::size_t>(std::ranges::count_if(inputs, isRemoval, &LiveInput::action)) > remembered) {
        const auto oldest = std::ranges::find_if(inputs, isRemoval, &LiveInput::action);
        const std::string body = bodyOf(oldest->action);
        const auto isOf = [&](const LiveInput& input) { return bodyOf(input.action) == body; };
        const auto next = std::find_if(oldest, inputs.end(), [&](const LiveInput& input) { return isSpawn(input.action) && isOf(input); });
        inputs.erase(std::remove_if(inputs.begin(), next, isOf), next); // what comes then is said of another body of that name
    }
}

std::string InputCheck::take(const Action& action) {
    if (taken_ >= most_) return "expected at most " + std::to_string(most_) + " inputs";
    const double now = scene_.inputs.empty() ? 0.0 : scene_.inputs.back().timeSeconds;
    scene_.inputs.push_back({now, action});
    if (std::string fault = validate(scene_); !fault.empty()) {
        scene_.inputs.pop_back();
        const std::string place = detail::itemPath("inputs", scene_.inputs.size()) + ".";
        return fault.starts_with(place) ? fault.substr(place.size()) : fault;
    }
    ++taken_;
    LiveInput taken = std::move(scene_.inputs.back());
    scene_.inputs.pop_back();
    keep(std::move(taken));
    return {};
}

} // namespace physvib
