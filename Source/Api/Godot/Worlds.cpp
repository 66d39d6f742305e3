// SPDX-License-Identifier: MIT
// HapticWorld: steps, field, outputs, and the list of observed bodies. beginStep() reads motions between the
// last script and the solver, finishStep() those after it, and contacts. Godot's physics is only read.
#include "Api/Godot/Worlds.h"
#include "Api/Godot/Explanation.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace physvib::godot {
Value HapticWorld::server() const { return singleton(isSpace ? "PhysicsServer3D" : "PhysicsServer2D"); }

Vector HapticWorld::direction(const Vector& v) const {
    return {v[0] * unit, isSpace ? v[1] * unit : -v[1] * unit, v[2] * unit};
}
// In 2D, y points down and spin is about z alone.
Vector HapticWorld::turn(const Vector& spin) const { return isSpace ? spin : Vector{0.0, 0.0, -spin[2]}; }
Vector HapticWorld::place(const Vector& v) const { return direction(minus(v, corner)); }

void HapticWorld::beginStep() {
    if (isOpen) finishStep();
    if (!isFirst()) return forget();
    if (isStale) configure();
    seconds = self().call("get_physics_process_delta_time").real();
    if (world == nullptr || !(seconds > 0.0)) return;
    watchAll();
    double gravity = 0.0;
    for (auto& [id, each] : watched) {
        if (each.slides)
            each.gravity = direction(each.body.call("get_gravity").vector());
        else
            each.gravity = each.state ? direction(each.state.gravity()) : Vector{};
        gravity = std::max(gravity, std::sqrt(dot(each.gravity, each.gravity)));
    }
    checkWorld(physvib_world_begin_step(world, seconds, gravity));
    isOpen = true;
    for (auto& [id, each] : watched)
        if (each.state) moveBefore(each);
    std::vector<Watched*> sliding; // a list, since slideAll() may add bodies
    for (auto& [id, each] : watched)
        if (each.slides && each.values != nullptr) sliding.push_back(&each);
    for (Watched* each : sliding) slideAll(*each);
}

void HapticWorld::moveBefore(Watched& each) {
    const BodyState& state = each.state;
    each.centre = place(state.centre());
    const bool falls = each.described.mass_kg > 0.0 && !state.sleeps();
    const Vector velocity = direction(state.velocity());
    each.pull = falls ? each.gravity : Vector{};
    const double keeps = std::max(0.0, 1.0 - seconds * state.linearDamp());
    const double keepsSpin = std::max(0.0, 1.0 - seconds * state.angularDamp());
    for (std::size_t i = 0; i < 3; ++i) each.before[i] = velocity[i] * keeps + each.pull[i] * seconds;
    each.spin = turn(state.spin());
    for (double& rate : each.spin) rate *= keepsSpin;
    std::array<double, 6> inverse = state.inverseInertia();
    for (double& each6 : inverse) each6 /= unit * unit;
    checkWorld(physvib_world_move_in_space(world, each.number, each.centre.data(), each.before.data(),
                                           each.spin.data(), inverse.data()));
}

// All velocities are read before body_entered and _integrate_forces, which may set them.
void HapticWorld::solved() {
    if (!isOpen || std::exchange(isSolved, true)) return;
    for (auto& [id, each] : watched) {
        each.state = {};
        if (each.isRigid && isThere(each)) moveAfter(each);
    }
}

void HapticWorld::finishStep() {
    solved();
    if (!isOpen) return;
    isOpen = isSolved = false;
    bounces.clear();
    std::vector<Watched*> rigid; // contacts may add bodies; these pointers stay valid
    for (auto& [id, each] : watched) {
        if (!each.isRigid || !isThere(each)) each.state = {};
        each.isMet = false;
        if (each.state) rigid.push_back(&each);
    }
    decide();
    for (Watched* each : rigid) touchAll(*each);
    checkWorld(physvib_world_end_step(world));
    emitAll();
}

void HapticWorld::moveAfter(Watched& each) {
    each.state = BodyState::of(each.rid, isSpace);
    if (!each.state) return;
    const Vector velocity = direction(each.state.velocity());
    const Vector spin = turn(each.state.spin());
    each.change = minus(velocity, each.before);
    checkWorld(physvib_world_moved_in_space(world, each.number, velocity.data(), spin.data()));
}

namespace {
std::vector<const HapticWorld*> worldsInTree; // in the order of their entry
} // namespace

HapticWorld::HapticWorld(GDExtensionObjectPtr itsObject, bool isItSpace)
    : Instance(itsObject, worldProperties(isItSpace))
    , isSpace(isItSpace)
    , outputs(itsObject) {}

HapticWorld::~HapticWorld() {
    std::erase(worldsInTree, this);
    if (world != nullptr) physvib_world_free(world);
}

void HapticWorld::notified(int what) {
    if (what == notifiedPhysicsProcess) // deferred, to follow calls that scripts deferred
        return (void)self().call("call_deferred", "_begin_step");
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
    const char* const kind = isSpace ? "PhysicsBody3D" : "RigidBody2D";
    for (const Value& body : tree.call("get_root").call("find_children", "*", kind, true, false).elements())
        added(body);
    tree.call("connect", "physics_frame", Value::callable(object, "_finish_step"));
    tree.call("connect", "node_added", Value::callable(object, "_added"));
    self().call("set_process", true);
    self().call("set_physics_process", true);
    constexpr int afterAllScripts = std::numeric_limits<std::int32_t>::max();
    self().call("set_physics_process_priority", afterAllScripts);
}

// The world may enter a tree again: its bodies are removed, its time continues.
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

// Called once per frame, since a script may set ten properties in a tick and devices open slowly.
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
    std::vector<std::string> all;
    if (nodesIn(root, isSpace ? "HapticWorld3D" : "HapticWorld2D").size() > 1)
        all.emplace_back("One haptic world is enough for a scene: the others wait until it leaves.");
    if (nodesIn(root, "HapticBody").empty())
        all.emplace_back("Nothing in this scene is felt: add a HapticBody as a child of a physics body.");
    return all;
}

Value HapticWorld::explain() const {
    std::array<char, 512> sentence{};
    if (world == nullptr) return Value("The world is not in a scene that plays.");
    if (!isFirst()) return Value("Another haptic world of this kind is in the scene, and this one waits.");
    const auto isHere = [&](const HapticBody* each) { return each->spaceId() == space; };
    if (!hapticBodies().empty() && std::ranges::none_of(hapticBodies(), isHere))
        return Value("No HapticBody is in its space: 2D needs a HapticWorld2D, 3D a HapticWorld3D.");
    physvib_output_facts facts;
    physvib_output_facts_init(&facts, sizeof facts);
    facts.is_missing = get(godot::outputs).elements().empty() ? 1 : 0;
    facts.is_silent = get(silent).isTrue() ? 1 : 0;
    physvib_world_explain_output(world, &facts, sentence.data(), sentence.size());
    return Value(inGodotsWords(sentence.data()).c_str());
}

Value HapticWorld::left() const {
    Value peaks = Value::empty(type::dictionary);
    int actuator = 0;
    for (const double peak : outputs.left()) peaks.set(actuator++, peak);
    return peaks;
}

Value HapticWorld::timeSeconds() const {
    return Value(world == nullptr ? 0.0 : static_cast<double>(physvib_world_time_ns(world)) * 1e-9);
}

void HapticWorld::mapField() {
    unit = get(metresPerUnit).real();
    corner = get(fieldCorner).vector();
    if (!isSpace) corner[1] += get(fieldSize).vector()[1]; // y points down in 2D: a lower y is larger
}

std::string HapticWorld::findLayout(physvib_layout& found) const {
    const std::vector<Value> own = get(actuators).elements();
    found = {}, found.size = sizeof found;
    if (own.empty())
        return physvib_layout_preset(get(layout).text().c_str(), &found) == PHYSVIB_OK ? "" : physvib_error();
    if (own.size() > PHYSVIB_MAX_ENCHANTERS)
        return "actuators: expected at most 64 places, found " + std::to_string(own.size());
    const Vector size = get(fieldSize).vector();
    found.extent_width_m = size[0] * unit, found.extent_height_m = size[1] * unit;
    for (const Value& each : own) {
        const Vector at = place(each.vector());
        found.x_m[found.count] = at[0], found.y_m[found.count++] = at[1];
    }
    return "";
}

Value HapticWorld::actuatorPlaces() {
    mapField();
    physvib_layout found{};
    Value list = Value::empty(type::places);
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

// A function connected to the signal may free this world, so its existence is checked before each event.
void HapticWorld::emitAll() {
    std::vector<physvib_event> events(64);
    events.front().size = sizeof events.front();
    std::vector<Value> hits;
    physvib_int64 count = 0;
    do {
        count = physvib_world_take(world, events.data(), static_cast<physvib_int64>(events.size()), 1);
        for (physvib_int64 i = 0; i < count; ++i) {
            const physvib_event& event = events[static_cast<std::size_t>(i)];
            outputs.play(world, asSeen(event));
            if (event.kind == PHYSVIB_HIT) hits.push_back(hitOf(event)); // grains may be thousands
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
    Value hit = Value::empty(type::dictionary);
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

// With field_from_camera, the screen is the whole field: events move to their place on the screen.
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
        if (camera.call("is_position_behind", place).isTrue()) // unproject_position mirrors it then
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

namespace {
constexpr int listed = 16; // contacts per body and tick, unless the game wants more
// A key for a body without a node: ids of nodes never have the highest bit set.
std::uint64_t idOfRid(std::uint64_t rid) { return rid | std::uint64_t{1} << 63U; }
bool isRigidBody(const Value& node, bool isSpace) {
    if (!isSpace) return node.call("is_class", "RigidBody2D").isTrue();
    return node.call("is_class", "RigidBody3D").isTrue() || // or of a ragdoll
           node.call("is_class", "PhysicalBone3D").isTrue();
}
} // namespace

void HapticWorld::added(const Value& node) {
    if (!isRigidBody(node, isSpace)) return;
    if (isInTree(node.object()) && spaceOf(node, isSpace) == space)
        rigidBodies.insert(api.instanceId(node.object()));
}

bool HapticWorld::isThere(const Watched& each) const {
    const GDExtensionObjectPtr there = each.isNode ? api.instanceFromId(each.id) : nullptr;
    return each.isNode ? there != nullptr && isInTree(there) : each.isMet;
}

// Adds the bodies of new HapticBody nodes, removes freed ones, and updates masses.
void HapticWorld::watchAll() {
    for (auto& [id, each] : watched) each.values = nullptr;
    for (const HapticBody* haptic : hapticBodies())
        if (haptic->spaceId() == space && api.instanceFromId(haptic->bodyId()) != nullptr)
            watch(haptic->bodyId(), 0, haptic);
    watchStrikers();
    for (auto it = watched.begin(); it != watched.end();) {
        if (isThere(it->second)) {
            describe(it->second);
            ++it;
            continue;
        }
        physvib_world_remove_body(world, it->second.number);
        objects.erase(it->second.number);
        it = watched.erase(it);
    }
}

// Only rigid bodies list contacts, so if a haptic source is of another kind, all rigid bodies are observed.
void HapticWorld::watchStrikers() {
    const bool isWanted = std::any_of(watched.begin(), watched.end(), [](const auto& each) {
        return each.second.values != nullptr && !each.second.isRigid && each.second.values->isFelt();
    });
    for (auto it = rigidBodies.begin(); it != rigidBodies.end();) {
        const GDExtensionObjectPtr there = api.instanceFromId(*it);
        if (there == nullptr || !isInTree(there)) { // node_added adds it again
            it = rigidBodies.erase(it);
            continue;
        }
        if (isWanted) watch(*it, 0, nullptr);
        ++it;
    }
}

Watched* HapticWorld::watch(std::uint64_t id, std::uint64_t rid, const HapticBody* values) {
    const GDExtensionObjectPtr there = id != 0 ? api.instanceFromId(id) : nullptr;
    const std::uint64_t key = there != nullptr ? id : idOfRid(rid);
    if (there == nullptr && rid == 0) return nullptr;
    if (const auto known = watched.find(key); known != watched.end()) {
        if (values != nullptr) known->second.values = values;
        known->second.isMet = true;
        return &known->second;
    }
    Watched& added = watched.emplace(key, Watched{key, next++}).first->second;
    added.values = values;
    added.isMet = true;
    if (there != nullptr) added.body = Value(there);
    added.isNode = added.body.call("is_class", "Node").isTrue();
    added.isRigid = isRigidBody(added.body, isSpace);
    added.slides = added.body.call("is_class", isSpace ? "CharacterBody3D" : "CharacterBody2D").isTrue();
    if (added.isRigid) {
        added.rid = added.body.call("get_rid").rid();
        server().call("body_set_force_integration_callback", Value(type::rid, &added.rid),
                      Value::callable(object, "_solved"));
    }
    objects[added.number] = key;
    describe(added);
    return &added;
}

void HapticWorld::forget() {
    if (world == nullptr) return;
    if (isOpen) checkWorld(physvib_world_end_step(world));
    isOpen = false;
    physvib_event ignored{};
    ignored.size = sizeof ignored;
    while (physvib_world_take(world, &ignored, 1, 1) > 0) {
    }
    for (const auto& [id, each] : watched) physvib_world_remove_body(world, each.number);
    watched.clear();
    objects.clear();
    doubts.clear();
}

// A body is described again only if something has changed.
void HapticWorld::describe(Watched& each) {
    double mass = 0.0;
    if (each.isRigid) {
        reportContacts(each.rid, isSpace, listed);
        each.state = BodyState::of(each.rid, isSpace);
        const double inverse = each.state ? each.state.inverseMass() : 0.0;
        mass = inverse > 0.0 ? 1.0 / inverse : 0.0;
    }
    const bool isSame = each.revision == revision() + 1 && each.describedBy == each.values;
    if (isSame && (each.slides || mass == each.described.mass_kg)) return;
    each.revision = revision() + 1;
    each.describedBy = each.values;
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    const Value material = materialOf(each);
    if (each.values != nullptr)
        each.values->describe(body, material);
    else
        describeMaterial(body, material, each.body);
    body.mass_kg = each.slides ? body.static_mass_kg : mass;
    each.described = body;
    checkWorld(physvib_world_set_body(world, each.number, &body));
}

Value HapticWorld::materialOf(const Watched& each) const {
    const Value byPhysics = get(physicsMaterials);
    if (!byPhysics.call("size").isTrue() || each.body.object() == nullptr) return {};
    const Value physics = each.body.member("physics_material_override");
    return physics.object() == nullptr ? Value() : byPhysics.call("get", physics);
}

} // namespace physvib::godot
