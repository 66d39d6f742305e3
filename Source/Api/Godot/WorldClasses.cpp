// SPDX-License-Identifier: MIT
// Properties and methods of HapticWorld2D and HapticWorld3D.
#include "Api/Godot/Worlds.h"
#include <type_traits>

namespace physvib::godot {
namespace {
constexpr int hintRange = 1, hintEnumSuggestion = 3, hintElements = 23, hintKeys = 38,
              hintSaveFile = 28; // Godot's PropertyHint

Variant defaultOutputs() {
    const Variant list = Variant::empty(type::stringArray);
    list.call("append", "controllers");
    return list;
}

// In the order of WorldProperty. Lengths of the field are Godot's: pixels in 2D, metres in 3D.
std::vector<Property> makeProperties(bool is3d) {
    return {
        {"metres_per_unit", type::real, is3d ? [] { return Variant(1.0); } : [] { return Variant(0.01); },
         1e-6, 1e6, "Field", hintRange, "0.0001,10,0.0001,or_greater,exp,suffix:m"},
        {"field_corner", is3d ? type::vector3 : type::vector2,
         is3d ? [] { return Variant::vector({-5, 0, 0}, true); } : [] { return Variant::vector({}, false); },
         0, 0, "Field"},
        {"field_size", type::vector2,
         is3d ? [] { return Variant::vector({10, 5, 0}, false); }
              : [] { return Variant::vector({1152, 648, 0}, false); },
         1e-3, 1e6, "Field"},
        {"field_from_camera", type::boolean, [] { return Variant(false); }, 0, 0, "Field"},
        {"full_scale_n_s", type::real, [] { return Variant(-1.0); }, -1, 1e6, "Strength", hintRange,
         "-1,100,0.001,or_greater,suffix:N s"},
        {"threshold_m_per_s", type::real, [] { return Variant(0.15); }, 0, 100, "Strength", hintRange,
         "0,10,0.01,or_greater,suffix:m/s"},
        {"physics_materials", type::dictionary, [] { return Variant::empty(type::dictionary); }, 0, 0,
         "Strength", hintKeys, "24/17:PhysicsMaterial;24/17:HapticMaterial"},
        {"outputs", type::stringArray, [] { return defaultOutputs(); }, 0, 0, "Output", hintElements,
         "4/3:controllers,phone,xr,sound,osc:127.0.0.1:9000,JACK:system,BOARD:auto"}, // suggestions
        {"layout", type::text, [] { return Variant("phone4"); }, 0, 0, "Output", hintEnumSuggestion,
         "phone1,phone2,phone3,phone4,ring4,cabinet4,pico4,pico8,glove5,sleeve8,vest16"},
        {"actuators", type::vector2Array, [] { return Variant::empty(type::vector2Array); }, 0, 0, "Output"},
        {"level_db", type::real, [] { return Variant(-12.0); }, -90, 0, "Output", hintRange,
         "-90,0,0.1,suffix:dB"},
        {"silent", type::boolean, [] { return Variant(false); }, 0, 0, "Output"},
        {"session_file", type::text, [] { return Variant(""); }, 0, 0, "Output", hintSaveFile, "*.json"}};
}
} // namespace

const std::vector<Property>& worldProperties(bool is3d) {
    static const std::vector<Property> plane = makeProperties(false), space = makeProperties(true);
    return is3d ? space : plane;
}

namespace {
template <auto member>
Variant callMember(Instance& instance, const Variant&) {
    auto& world = static_cast<HapticWorld&>(instance);
    if constexpr (std::is_void_v<decltype((world.*member)())>)
        return (world.*member)(), Variant();
    else
        return (world.*member)();
}
Variant addNode(Instance& instance, const Variant& node) {
    return static_cast<HapticWorld&>(instance).onNodeAdded(node), Variant();
}

const std::vector<Method> methods{
    {"explain", type::text, callMember<&HapticWorld::explain>},
    {"left", type::dictionary, callMember<&HapticWorld::recentPeaks>},
    {"actuator_places", type::vector2Array, callMember<&HapticWorld::actuatorPlaces>},
    {"time_s", type::real, callMember<&HapticWorld::timeSeconds>},
    {"_begin_step", type::nil, callMember<&HapticWorld::beginStep>},
    {"_finish_step", type::nil, callMember<&HapticWorld::finishStep>},
    {"_solved", type::nil, callMember<&HapticWorld::onSolved>, "Object"},
    {"_added", type::nil, addNode, "Node"}};
} // namespace

const ClassTable hapticWorld2dClass{
    "HapticWorld2D",
    "Node",
    &worldProperties(false),
    methods,
    "felt",
    [](GDExtensionObjectPtr object) -> Instance* { return new HapticWorld(object, false); }};
const ClassTable hapticWorld3dClass{
    "HapticWorld3D",
    "Node",
    &worldProperties(true),
    methods,
    "felt",
    [](GDExtensionObjectPtr object) -> Instance* { return new HapticWorld(object, true); }};

} // namespace physvib::godot
