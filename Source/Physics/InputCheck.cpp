// SPDX-License-Identifier: MIT
// The scene with one more input must be a valid scene.
#include "Physics/InputCheck.h"
#include "Physics/SceneLimits.h"
#include "Physics/SceneRanges.h"
#include "Physics/SceneValidation.h"
#include <variant>

namespace physvib {

InputCheck::InputCheck(const Scene& scene)
    : scene_(scene)
    , taken_(scene.inputs.size()) {
    keepWhatMatters();
}

// Pushes and tilts change nothing that later inputs are checked against, and they are most of a long list.
void InputCheck::keepWhatMatters() {
    std::erase_if(scene_.inputs, [](const LiveInput& input) {
        const Action& action = input.action;
        return !std::holds_alternative<SpawnAction>(action) && !std::holds_alternative<CameraAction>(action) &&
               !std::holds_alternative<MaterialAction>(action);
    });
}

std::string InputCheck::take(const Action& action) {
    if (taken_ == sceneLimits::maxLiveInputs)
        return "expected at most " + std::to_string(sceneLimits::maxLiveInputs) + " inputs";
    const double now = scene_.inputs.empty() ? 0.0 : scene_.inputs.back().timeSeconds;
    scene_.inputs.push_back({now, action});
    if (std::string fault = validate(scene_); !fault.empty()) {
        scene_.inputs.pop_back();
        const std::string place = detail::itemPath("inputs", scene_.inputs.size()) + ".";
        return fault.starts_with(place) ? fault.substr(place.size()) : fault;
    }
    ++taken_;
    keepWhatMatters();
    return {};
}

} // namespace physvib
