// SPDX-License-Identifier: MIT
// A haptic world in the scene tree: it comes, waits if there is another one, has other properties, and goes.
#include "Api/Godot/Explanation.h"
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"

#include <algorithm>
#include <limits>

namespace physvib::godot {

namespace {
std::vector<const HapticWorld*> worldsInTree; // in the order in which they came
} // namespace

HapticWorld::HapticWorld(GDExtensionObjectPtr itsObject, bool isItSpace)
    : Instance(itsObject, worldProperties(isItSpace))
    , isSpace(isItSpace) {}

HapticWorld::~HapticWorld() {
    std::erase(worldsInTree, this);
    if (world != nullptr) physvib_world_free(world);
}

void HapticWorld::notified(int what) {
    if (what == notifiedPhysicsProcess) return beginStep();
    if (what == notifiedPaused) return outputs.rest();
    if (what == notifiedProcess) {
        if (areOutputsStale) configureOutputs();
        return outputs.update(self().call("get_process_delta_time").real());
    }
    if ((what != notifiedEnterTree && what != notifiedExitTree) || isInEditor()) return;
    what == notifiedEnterTree ? enter() : leave();
}

void HapticWorld::enter() {
    const Value viewport = self().call("get_viewport"), tree = self().call("get_tree");
    const Value its = viewport.call(isSpace ? "find_world_3d" : "find_world_2d");
    space = its.object() == nullptr ? 0 : its.call("get_space").rid();
    worldsInTree.push_back(this);
    if (!isFirst())
        report("HapticWorld: another one of this kind is in the scene; this one begins when that one leaves");
    configure();
    configureOutputs();
    const char* const kind = isSpace ? "RigidBody3D" : "RigidBody2D";
    for (const Value& body : tree.call("get_root").call("find_children", "*", kind, true, false).elements())
        added(body);
    tree.call("connect", "physics_frame", Value::callable(object, "_finish_step"));
    tree.call("connect", "node_added", Value::callable(object, "_added"));
    self().call("set_process", true);
    self().call("set_physics_process", true);
    constexpr int afterAllScripts = std::numeric_limits<std::int32_t>::max();
    self().call("set_physics_process_priority", afterAllScripts);
}

// It may come back, in another place and time: nothing is left of its bodies, and its time goes on.
void HapticWorld::leave() {
    forget();
    outputs.close();
    areOutputsStale = true;
    std::erase(worldsInTree, this);
    rigidBodies.clear();
    const Value tree = self().call("get_tree");
    tree.call("disconnect", "physics_frame", Value::callable(object, "_finish_step"));
    tree.call("disconnect", "node_added", Value::callable(object, "_added"));
}

bool HapticWorld::isFirst() const {
    for (const HapticWorld* each : worldsInTree)
        if (each->isSpace == isSpace && each->space == space) return each == this;
    return false;
}

void HapticWorld::configure() {
    isStale = false;
    mapField();
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.field_width_m = get(fieldSize).vector()[0] * unit;
    settings.full_scale_impulse_n_s = get(fullScale).real() < 0 ? PHYSVIB_AUTOMATIC : get(fullScale).real();
    settings.threshold_m_per_s = get(threshold).real();
    const int code = world == nullptr ? physvib_world_create(&settings, &world)
                                      : physvib_world_configure(world, &settings);
    if (code != PHYSVIB_OK) report(std::string("HapticWorld: ") + physvib_error());
}

// Not within a tick: a script may set ten properties in one, and a device takes its time.
void HapticWorld::configureOutputs() {
    areOutputsStale = false;
    mapField();
    physvib_layout placed{};
    if (const std::string error = findLayout(placed); !error.empty()) report("HapticWorld: " + error);
    const Vector size = get(fieldSize).vector();
    OutputSettings settings{
        {}, get(silent).isTrue(), placed, get(levelDb).real(), size[0] * unit, size[1] * unit, {}};
    if (const std::string file = get(sessionFile).text(); !file.empty()) // user:// and res://
        settings.sessionFile = singleton("ProjectSettings").call("globalize_path", file.c_str()).text();
    for (const Value& name : get(godot::outputs).elements()) settings.names.push_back(name.text());
    outputs.configure(settings);
}

std::vector<std::string> HapticWorld::warnings() const {
    const Value root = self().call("is_inside_tree").isTrue()
                           ? self().call("get_tree").call("get_edited_scene_root")
                           : Value();
    if (root.object() == nullptr) return {};
    const auto count = [&](const char* kind) {
        return root.call("find_children", "*", kind, true, false).elements().size() +
               (root.call("is_class", kind).isTrue() ? 1 : 0);
    };
    std::vector<std::string> all;
    if (count(isSpace ? "HapticWorld3D" : "HapticWorld2D") > 1)
        all.emplace_back("One haptic world is enough for a scene: the others wait until it leaves.");
    if (count("HapticBody") == 0)
        all.emplace_back("Nothing in this scene is felt: add a HapticBody as a child of a physics body.");
    return all;
}

Value HapticWorld::explain() const {
    std::array<char, 512> sentence{};
    if (world == nullptr) return Value("The world is not in a scene that plays.");
    if (!isFirst()) return Value("Another haptic world of this kind is in the scene, and this one waits.");
    physvib_output_facts facts;
    physvib_output_facts_init(&facts, sizeof facts);
    facts.is_missing = get(godot::outputs).elements().empty() ? 1 : 0;
    facts.is_silent = get(silent).isTrue() ? 1 : 0;
    physvib_world_explain_output(world, &facts, sentence.data(), sentence.size());
    return Value(inGodotsWords(sentence.data()).c_str());
}

Value HapticWorld::left() const {
    Value peaks = Value::empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY);
    int actuator = 0;
    for (const double peak : outputs.left()) peaks.set(actuator++, peak);
    return peaks;
}

Value HapticWorld::timeSeconds() const {
    return Value(world == nullptr ? 0.0 : static_cast<double>(physvib_world_time_ns(world)) * 1e-9);
}

} // namespace physvib::godot
