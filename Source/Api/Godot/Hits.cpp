// SPDX-License-Identifier: MIT
// Events of a world, as outputs play them and as the signal `felt` says them.
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"
#include <algorithm>

namespace physvib::godot {

// What the signal calls may free the world: it is looked for before each event.
void HapticWorld::emitAll() {
    std::vector<physvib_event> events(64);
    std::vector<Value> hits;
    physvib_int64 count = 0;
    do {
        count = physvib_world_take(world, events.data(), static_cast<physvib_int64>(events.size()), 0);
        for (physvib_int64 i = 0; i < count; ++i) {
            const physvib_event& event = events[static_cast<std::size_t>(i)];
            outputs.play(world, asSeen(event));
            if (event.kind == PHYSVIB_HIT) hits.push_back(hitOf(event)); // grains would be thousands
        }
    } while (count == static_cast<physvib_int64>(events.size()));
    const std::uint64_t id = api.instanceId(object);
    for (const Value& hit : hits) {
        const GDExtensionObjectPtr there = api.instanceFromId(id);
        if (there == nullptr) return;
        Value(there).call("emit_signal", "felt", hit);
    }
}

Value HapticWorld::hitOf(const physvib_event& event) const {
    Value hit = Value::empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY);
    hit.set("position", Value::vector(inScene(event), isSpace));
    hit.set("strength_n_s", event.impulse_n_s);
    hit.set("speed_m_per_s", event.mass_kg > 0.0 ? event.impulse_n_s / event.mass_kg : 0.0);
    hit.set("amplitude", event.amplitude);
    hit.set("time_s", static_cast<double>(event.time_ns) * 1e-9);
    hit.set("frequency_hz", event.frequency_hz);
    hit.set("body", objectOf(event.fixture));
    hit.set("other", objectOf(event.other));
    return hit;
}

Value HapticWorld::objectOf(int number) const {
    const auto found = objects.find(number);
    return found == objects.end() ? Value() : Value(api.instanceFromId(found->second));
}

Vector HapticWorld::inScene(const physvib_event& event) const {
    return {corner[0] + event.x_m / unit, corner[1] + (isSpace ? 1.0 : -1.0) * event.y_m / unit,
            corner[2] + event.z_m / unit};
}

// With the field of the camera, an event is played where it is on the screen, which is the whole field.
physvib_event HapticWorld::asSeen(const physvib_event& event) const {
    physvib_event seen = event;
    const Value viewport = get(fieldFromCamera).isTrue() ? self().call("get_viewport") : Value();
    if (viewport.object() == nullptr) return seen;
    const Vector size = viewport.call("get_visible_rect").member("size").vector(), at = inScene(event);
    Vector pixel{};
    if (isSpace) {
        const Value camera = viewport.call("get_camera_3d"), place = Value::vector(at, true);
        if (camera.object() == nullptr) return seen;
        pixel = camera.call("unproject_position", place).vector();
        if (camera.call("is_position_behind", place).isTrue()) // where it comes out mirrored
            pixel = {size[0] - pixel[0], size[1], 0.0};
    } else {
        const Value view = viewport.call("get_canvas_transform");
        const Vector x = view.member("x").vector(), y = view.member("y").vector(),
                     origin = view.member("origin").vector();
        for (std::size_t i = 0; i < 2; ++i) pixel[i] = origin[i] + at[0] * x[i] + at[1] * y[i];
    }
    const auto share = [&](std::size_t i) { return std::clamp(pixel[i] / std::max(1.0, size[i]), 0.0, 1.0); };
    const Vector field = get(fieldSize).vector();
    seen.x_m = share(0) * field[0] * unit, seen.y_m = (1.0 - share(1)) * field[1] * unit, seen.z_m = 0.0;
    return seen;
}

} // namespace physvib::godot
