// SPDX-License-Identifier: MIT
// Properties and methods of HapticWorld2D and HapticWorld3D.
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"

namespace physvib::godot {

namespace {
constexpr auto real = GDEXTENSION_VARIANT_TYPE_FLOAT, vector2 = GDEXTENSION_VARIANT_TYPE_VECTOR2;
constexpr auto text = GDEXTENSION_VARIANT_TYPE_STRING, boolean = GDEXTENSION_VARIANT_TYPE_BOOL;
constexpr auto texts = GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY;
constexpr auto places = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY;
constexpr auto dictionary = GDEXTENSION_VARIANT_TYPE_DICTIONARY;
constexpr int hintRange = 1, hintEnumSuggestion = 3, hintElements = 23, hintKeys = 38,
              hintSaveFile = 28; // Godot's PropertyHint

Value controllersAlone() {
    const Value list = Value::empty(texts);
    list.call("append", "controllers");
    return list;
}

// In the order of WorldProperty. Lengths of the field are Godot's: pixels in 2D, metres in 3D.
std::vector<Property> propertiesOf(bool isSpace) {
    return {
        {"metres_per_unit", real, isSpace ? [] { return Value(1.0); } : [] { return Value(0.01); }, 1e-6, 1e6,
         "Field", hintRange, "0.0001,10,0.0001,or_greater,exp,suffix:m"},
        isSpace ? Property{"field_corner", GDEXTENSION_VARIANT_TYPE_VECTOR3,
                           [] {
                               return Value::vector({-5, 0, 0}, true);
                           },
                           0, 0, "Field"}
                : Property{"field_corner", vector2,
                           [] {
                               return Value::vector({0, 0, 0}, false);
                           },
                           0, 0, "Field"},
        {"field_size", vector2,
         isSpace ? [] { return Value::vector({10, 5, 0}, false); }
                 : [] { return Value::vector({1152, 648, 0}, false); },
         1e-3, 1e6, "Field"},
        {"field_from_camera", boolean, [] { return Value(false); }, 0, 0, "Field"},
        {"full_scale_n_s", real, [] { return Value(-1.0); }, -1, 1e6, "Strength", hintRange,
         "-1,100,0.001,or_greater,suffix:N s"},
        {"threshold_m_per_s", real, [] { return Value(0.15); }, 0, 100, "Strength", hintRange,
         "0,10,0.01,or_greater,suffix:m/s"},
        {"physics_materials", dictionary, [] { return Value::empty(dictionary); }, 0, 0, "Strength", hintKeys,
         "24/17:PhysicsMaterial;24/17:HapticMaterial"}, // from a resource to a resource
        {"outputs", texts, [] { return controllersAlone(); }, 0, 0, "Output", hintElements,
         "4/3:controllers,phone,osc:127.0.0.1:9000,JACK:system,BOARD:auto"}, // texts with suggestions
        {"layout", text, [] { return Value("phone4"); }, 0, 0, "Output", hintEnumSuggestion,
         "phone1,phone2,phone3,phone4,ring4,cabinet4,pico4,pico8,glove5,sleeve8,vest16"},
        {"actuators", places, [] { return Value::empty(places); }, 0, 0, "Output"},
        {"level_db", real, [] { return Value(-12.0); }, -90, 0, "Output", hintRange, "-90,0,0.1,suffix:dB"},
        {"silent", boolean, [] { return Value(false); }, 0, 0, "Output"},
        {"session_file", text, [] { return Value(""); }, 0, 0, "Output", hintSaveFile, "*.json"}};
}
} // namespace

const std::vector<Property>& worldProperties(bool isSpace) {
    static const std::vector<Property> plane = propertiesOf(false), space = propertiesOf(true);
    return isSpace ? space : plane;
}

namespace {
HapticWorld& worldOf(Instance& instance) { return static_cast<HapticWorld&>(instance); }

const std::vector<Method> methods{
    {"explain", text, [](Instance& instance, const Value&) { return worldOf(instance).explain(); }},
    {"left", dictionary, [](Instance& instance, const Value&) { return worldOf(instance).left(); }},
    {"actuator_places", places,
     [](Instance& instance, const Value&) { return worldOf(instance).actuatorPlaces(); }},
    {"time_s", real, [](Instance& instance, const Value&) { return worldOf(instance).timeSeconds(); }},
    {"_finish_step", GDEXTENSION_VARIANT_TYPE_NIL,
     [](Instance& instance, const Value&) {
         worldOf(instance).finishStep();
         return Value();
     }},
    {"_solved", GDEXTENSION_VARIANT_TYPE_NIL,
     [](Instance& instance, const Value&) {
         worldOf(instance).solved();
         return Value();
     },
     "Object"},
    {"_added", GDEXTENSION_VARIANT_TYPE_NIL,
     [](Instance& instance, const Value& node) {
         worldOf(instance).added(node);
         return Value();
     },
     "Node"}};
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
