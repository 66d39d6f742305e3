// SPDX-License-Identifier: MIT
// Properties, methods and life of HapticWorld2D and HapticWorld3D.
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"

#include <algorithm>
#include <limits>

namespace physvib::godot {

namespace {
constexpr auto real = GDEXTENSION_VARIANT_TYPE_FLOAT, vector2 = GDEXTENSION_VARIANT_TYPE_VECTOR2;
constexpr auto text = GDEXTENSION_VARIANT_TYPE_STRING, boolean = GDEXTENSION_VARIANT_TYPE_BOOL;
constexpr auto texts = GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY;
constexpr auto places = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY;
constexpr int hintElements = 23; // PROPERTY_HINT_TYPE_STRING

Value controllersAlone() {
    const Value list = Value::empty(texts);
    list.call("append", "controllers");
    return list;
}

// In the order of WorldProperty. Lengths of the field are Godot's: pixels in 2D, metres in 3D.
std::vector<Property> propertiesOf(bool isSpace) {
    return {{"metres_per_unit", real, isSpace ? [] { return Value(1.0); } : [] { return Value(0.01); }, 1e-6,
             1e6, "Field"},
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
             0, 0, "Field"},
            {"full_scale_n_s", real, [] { return Value(-1.0); }, -1, 1e6, "Strength"},
            {"threshold_m_per_s", real, [] { return Value(0.15); }, 0, 100, "Strength"},
            {"outputs", texts, [] { return controllersAlone(); }, 0, 0, "Output", hintElements,
             "4/3:controllers,phone,osc:127.0.0.1:9000,JACK:system,BOARD:auto"}, // texts with suggestions
            {"layout", text, [] { return Value("phone4"); }, 0, 0, "Output"},
            {"actuators", places, [] { return Value::empty(places); }, 0, 0, "Output"},
            {"level_db", real, [] { return Value(-12.0); }, -90, 0, "Output"},
            {"silent", boolean, [] { return Value(false); }, 0, 0, "Output"}};
}
const std::vector<Property>& worldProperties(bool isSpace) {
    static const std::vector<Property> plane = propertiesOf(false), space = propertiesOf(true);
    return isSpace ? space : plane;
}
HapticWorld& worldOf(Instance& instance) { return static_cast<HapticWorld&>(instance); }

const std::vector<Method> methods{
    {"explain", text, [](Instance& instance) { return worldOf(instance).explain(); }},
    {"actuator_places", places, [](Instance& instance) { return worldOf(instance).actuatorPlaces(); }},
    {"time_s", real, [](Instance& instance) { return worldOf(instance).timeSeconds(); }},
    {"_finish_step", GDEXTENSION_VARIANT_TYPE_NIL, [](Instance& instance) {
         worldOf(instance).finishStep();
         return Value();
     }}};
} // namespace

HapticWorld::HapticWorld(GDExtensionObjectPtr itsObject, bool isItSpace)
    : Instance(itsObject, worldProperties(isItSpace))
    , isSpace(isItSpace) {}

HapticWorld::~HapticWorld() {
    if (world != nullptr) physvib_world_free(world);
}

void HapticWorld::notified(int what) {
    if (what == notifiedPhysicsProcess) return beginStep();
    if (what == notifiedProcess) return outputs.update(world);
    const bool enters = what == notifiedEnterTree;
    if ((!enters && what != notifiedExitTree) || isInEditor()) return;
    const Value tree = self().call("get_tree");
    Value finish = Value::callable(object, "_finish_step");
    if (!enters) {
        outputs.close();
        tree.call("disconnect", "physics_frame", finish);
        return;
    }
    configure();
    tree.call("connect", "physics_frame", finish);
    self().call("set_process", true);
    self().call("set_physics_process", true);
    self().call("set_physics_process_priority", std::numeric_limits<std::int32_t>::max()); // after all
                                                                                           // scripts
}

void HapticWorld::configure() {
    isStale = false;
    mapField();
    const Vector size = get(fieldSize).vector();
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.field_width_m = std::max(0.001, size[0] * unit);
    settings.full_scale_impulse_n_s = get(fullScale).real() < 0 ? PHYSVIB_AUTOMATIC : get(fullScale).real();
    settings.threshold_m_per_s = get(threshold).real();
    const int code = world == nullptr ? physvib_world_create(&settings, &world)
                                      : physvib_world_configure(world, &settings);
    if (code != PHYSVIB_OK) report(std::string("HapticWorld: ") + physvib_error());
    physvib_layout placed{};
    if (const std::string error = findLayout(placed); !error.empty()) report("HapticWorld: " + error);
    outputs.configure({get(godot::outputs).elements(), get(silent).isTrue(), placed, get(levelDb).real(),
                       std::max(0.001, size[0] * unit), std::max(0.001, size[1] * unit)});
}

std::vector<std::string> HapticWorld::warnings() const {
    const Vector size = get(fieldSize).vector();
    if (size[0] > 0 && size[1] > 0) return {};
    return {"field_size: expected a width and a height above 0; the field is mapped on the actuators."};
}

Value HapticWorld::explain() const {
    std::array<char, 512> sentence{};
    if (world == nullptr) return Value("The world is not in a scene that plays.");
    physvib_world_explain(world, sentence.data(), sentence.size());
    return Value(sentence.data());
}

Value HapticWorld::timeSeconds() const {
    return Value(world == nullptr ? 0.0 : static_cast<double>(physvib_world_time_ns(world)) * 1e-9);
}

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
