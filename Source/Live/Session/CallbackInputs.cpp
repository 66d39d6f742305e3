// SPDX-License-Identifier: MIT
// Gives inputs of the render call their session time and queues them for the renderer and the world.
#include "Live/Session/CallbackInputs.h"
#include <utility>
#include <variant>

namespace physvib {

bool CallbackInputs::strike(CollisionEvent event, int frame, std::int64_t afterNs) noexcept {
    event = shaping_(event);
    event.timeNs = time_.nextInputNs(frame) + afterNs;
    return strikes_.push(event);
}

bool CallbackInputs::control(RenderControl control, int frame) noexcept {
    control.timeNs = time_.nextInputNs(frame);
    return controls_.push(control);
}

bool CallbackInputs::silence(int frame) noexcept {
    RenderControl control;
    control.kind = RenderControl::Kind::silence;
    control.timeNs = time_.nextRenderedNs(frame); // the samples that leave now
    control.untilNs = time_.nextNs(frame);
    // then events of the render call are earlier in session time than the world's events of the same frame
    control.value = time_.isDirectFromStart() ? 1.0f : 0.0f;
    return controls_.push(control);
}

bool CallbackInputs::perform(RenderInput input, int frame) noexcept {
    if (!hasWorld_) return true; // nobody would ever take it from the queue
    input.timeNs = time_.nextNs(frame);
    return inputs_.push(input);
}

void CallbackInputs::forget() noexcept {
    for (CollisionEvent unplayed; strikes_.pop(unplayed);) {
    }
    controls_.clear();
    for (RenderInput undone; inputs_.pop(undone);) {
    }
    spawns_ = 0;
    names_.fill({});
}

void CallbackInputs::handTo(SessionWorld& world) {
    for (RenderInput input; inputs_.pop(input);) {
        if (input.group == RenderInput::script) world.pace(input.timeNs, input.scriptSeconds, input.scale);
        if (input.group == RenderInput::device) world.addInput(input.timeNs, input.hold);
        if (input.group < 0 || input.group >= static_cast<int>(groups_.size())) continue;
        for (Action action : groups_[static_cast<std::size_t>(input.group)]) {
            const auto scale = [&input](Vector& v) { v = {v.x * input.scale, v.y * input.scale}; };
            if (auto* impulse = std::get_if<ImpulseAction>(&action)) scale(impulse->newtonSeconds);
            if (auto* spawn = std::get_if<SpawnAction>(&action)) {
                scale(spawn->body.velocityMetresPerSecond);
                addBody(world, input.timeNs, *spawn);
            } else {
                world.addInput(input.timeNs, std::move(action));
            }
        }
    }
}

// Each spawned body has a new name; the oldest is removed when there are too many.
void CallbackInputs::addBody(SessionWorld& world, std::int64_t timeNs, SpawnAction action) {
    std::string& name = names_[spawns_ % names_.size()];
    if (!name.empty()) world.addInput(timeNs, RemoveAction{name});
    name = action.body.name += " #" + std::to_string(++spawns_);
    world.addInput(timeNs, std::move(action));
}

} // namespace physvib
