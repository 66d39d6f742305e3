// SPDX-License-Identifier: MIT
// The field of a haptic world, and where the actuators are in it.
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"

namespace physvib::godot {

void HapticWorld::mapField() {
    unit = get(metresPerUnit).real();
    corner = get(fieldCorner).vector();
    if (!isSpace)
        corner[1] += get(fieldSize).vector()[1]; // Godot's y points down in 2D: the lower left one is larger
}

std::string HapticWorld::findLayout(physvib_layout& found) const {
    const std::vector<Value> own = get(actuators).elements();
    if (own.empty())
        return physvib_layout_preset(get(layout).text().c_str(), &found) == PHYSVIB_OK ? "" : physvib_error();
    if (own.size() > PHYSVIB_MAX_ENCHANTERS)
        return "actuators: expected at most 64 places, found " + std::to_string(own.size());
    const Vector size = get(fieldSize).vector();
    found = {}, found.extent_width_m = size[0] * unit, found.extent_height_m = size[1] * unit;
    for (const Value& each : own) {
        const Vector at = place(each.vector());
        found.x_m[found.count] = at[0], found.y_m[found.count++] = at[1];
    }
    return "";
}

Value HapticWorld::actuatorPlaces() {
    mapField();
    physvib_layout found{};
    Value list = Value::empty(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY);
    if (!findLayout(found).empty()) return list;
    const Vector size = get(fieldSize).vector();
    for (int j = 0; j < found.count; ++j) {
        const double right = found.x_m[j] / found.extent_width_m, up = found.y_m[j] / found.extent_height_m;
        list.call("append",
                  Value::vector({corner[0] + right * size[0], corner[1] + (isSpace ? up : -up) * size[1], 0},
                                false));
    }
    return list;
}

} // namespace physvib::godot
