// SPDX-License-Identifier: MIT
// Properties and methods of HapticWorld2D and HapticWorld3D.
#include "Api/Godot/Worlds.h"
#include <type_traits>

namespace physvib::godot {
namespace {
constexpr int hintRange = 1, hintEnumSuggestion = 3, hintElements = 23, hintKeys = 38,
              hintSaveFile = 28; // Godot's PropertyHint

Value controllersAlone() {
    const Value list = Value::empty(type::texts);
    list.call("append", "controllers");
    return list;
}

// In the order of WorldProperty. Lengths of the field are Godot's: pixels in 2D, metres in 3D.
std::vector<Property> propertiesOf(bool isSpace) {
    return {
        {"metres_per_unit", type::real, isSpace ? [] { return Value(1.0); } : [] { return Value(0.01); },
         1e-6, 1e6, "Field", hintRange, "0.0001,10,0.0001,or_greater,exp,suffix:m"},
        {"field_corner", isSpace ? type::vector3 : type::vector2,
         isSpace ? [] { return Value::vector({-5, 0, 0}, true); } : [] { return Value::vector({}, false); },
         0, 0, "Field"},
        {"field_size", type::vector2,
         isSpace ? [] { return Value::vector({10, 5, 0}, false); }
                 : [] { return Value::vector({1152, 648, 0}, false); },
         1e-3, 1e6, "Field"},
        {"field_from_camera", type::boolean, [] { return Value(false); }, 0, 0, "Field"},
        {"full_scale_n_s", type::real, [] { return Value(-1.0); }, -1, 1e6, "Strength", hintRange,
         "-1,100,0.001,or_greater,suffix:N s"},
        {"threshold_m_per_s", type::real, [] { return Value(0.15); }, 0, 100, "Strength", hintRange,
         "0,10,0.01,or_greater,suffix:m/s"},
        {"physics_materials", type::dictionary, [] { return Value::empty(type::dictionary); }, 0, 0,
         "Strength", hintKeys, "24/17:PhysicsMaterial;24/17:HapticMaterial"},
        {"outputs", type::texts, [] { return controllersAlone(); }, 0, 0, "Output", hintElements,
         "4/3:controllers,phone,xr,sound,osc:127.0.0.1:9000,JACK:system,BOARD:auto"}, // texts with
                                                                                      // suggestions
        {"layout", type::text, [] { return Value("phone4"); }, 0, 0, "Output", hintEnumSuggestion,
         "phone1,phone2,phone3,phone4,ring4,cabinet4,pico4,pico8,glove5,sleeve8,vest16"},
        {"actuators", type::places, [] { return Value::empty(type::places); }, 0, 0, "Output"},
        {"level_db", type::real, [] { return Value(-12.0); }, -90, 0, "Output", hintRange,
         "-90,0,0.1,suffix:dB"},
        {"silent", type::boolean, [] { return Value(false); }, 0, 0, "Output"},
        {"session_file", type::text, [] { return Value(""); }, 0, 0, "Output", hintSaveFile, "*.json"}};
}
} // namespace

const std::vector<Property>& worldProperties(bool isSpace) {
    static const std::vector<Property> plane = propertiesOf(false), space = propertiesOf(true);
    return isSpace ? space : plane;
}

namespace {
template <auto member>
Value calls(Instance& instance, const Value&) {
    auto& world = static_cast<HapticWorld&>(instance);
    if constexpr (std::is_void_v<decltype((world.*member)())>)
        return (world.*member)(), Value();
    else
        return (world.*member)();
}
Value added(Instance& instance, const Value& node) {
    return static_cast<HapticWorld&>(instance).added(node), Value();
}

const std::vector<Method> methods{{"explain", type::text, calls<&HapticWorld::explain>},
                                  {"left", type::dictionary, calls<&HapticWorld::left>},
                                  {"actuator_places", type::places, calls<&HapticWorld::actuatorPlaces>},
                                  {"time_s", type::real, calls<&HapticWorld::timeSeconds>},
                                  {"_begin_step", type::nil, calls<&HapticWorld::beginStep>},
                                  {"_finish_step", type::nil, calls<&HapticWorld::finishStep>},
                                  {"_solved", type::nil, calls<&HapticWorld::solved>, "Object"},
                                  {"_added", type::nil, added, "Node"}};
} // namespace

const Class hapticWorld2dClass{
    "HapticWorld2D",
    "Node",
    &worldProperties(false),
    methods,
    "felt",
    [](GDExtensionObjectPtr object) -> Instance* { return new HapticWorld(object, false); }};
const Class hapticWorld3dClass{
    "HapticWorld3D",
    "Node",
    &worldProperties(true),
    methods,
    "felt",
    [](GDExtensionObjectPtr object) -> Instance* { return new HapticWorld(object, true); }};

} // namespace physvib::godot
