// SPDX-License-Identifier: MIT
// Events of a world, as outputs play them and as the signal `felt` says them.
#include "Api/Godot/Worlds.h"

namespace physvib::godot {

// What the signal calls may free the world: it is looked for before each event.
void HapticWorld::emitAll() {
    std::vector<physvib_event> events(64);
    std::vector<Value> hits;
    physvib_int64 count = 0;
    do {
        count = physvib_world_take(world, events.data(), static_cast<physvib_int64>(events.size()), 0);
        for (physvib_int64 i = 0; i < count; ++i) {
            outputs.play(world, events[static_cast<std::size_t>(i)]);
            if (events[static_cast<std::size_t>(i)].kind == PHYSVIB_HIT) // grains would be thousands
                hits.push_back(hitOf(events[static_cast<std::size_t>(i)]));
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
    const Vector moved{event.x_m / unit, (isSpace ? 1.0 : -1.0) * event.y_m / unit, event.z_m / unit};
    hit.set("position",
            Value::vector({corner[0] + moved[0], corner[1] + moved[1], corner[2] + moved[2]}, isSpace));
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

} // namespace physvib::godot
