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
Variant HapticWorld::server() const { return singleton(is3d ? "PhysicsServer3D" : "PhysicsServer2D"); }

Vector HapticWorld::toFieldVector(const Vector& v) const {
    return {v[0] * unitMetres, is3d ? v[1] * unitMetres : -v[1] * unitMetres, v[2] * unitMetres};
}
// In 2D, y points down and spin is about z alone.
Vector HapticWorld::toFieldSpin(const Vector& spin) const { return is3d ? spin : Vector{0.0, 0.0, -spin[2]}; }
Vector HapticWorld::toField(const Vector& v) const { return toFieldVector(minus(v, fieldOrigin)); }

void HapticWorld::beginStep() {
    if (isStepOpen) finishStep();
    if (!isActive()) return removeBodies();
    if (isStale) configure();
    stepSeconds = self().call("get_physics_process_delta_time").real();
    if (world == nullptr || !(stepSeconds > 0.0)) return;
    updateBodies();
    double gravity = 0.0;
    for (auto& [id, body] : bodies) {
        if (body.isCharacter)
            body.gravity = toFieldVector(body.object.call("get_gravity").vector());
        else
            body.gravity = body.state ? toFieldVector(body.state.gravity()) : Vector{};
        gravity = std::max(gravity, std::sqrt(dot(body.gravity, body.gravity)));
    }
    reportIfError(physvib_world_begin_step(world, stepSeconds, gravity));
    isStepOpen = true;
    for (auto& [id, body] : bodies)
        if (body.state) reportMotion(body);
    std::vector<ObservedBody*> sliding; // a list, since reportSlides() may add bodies
    for (auto& [id, body] : bodies)
        if (body.isCharacter && body.hapticBody != nullptr) sliding.push_back(&body);
    for (ObservedBody* body : sliding) reportSlides(*body);
}

void HapticWorld::reportMotion(ObservedBody& body) {
    const BodyState& state = body.state;
    body.centre = toField(state.centre());
    const bool isFalling = body.description.mass_kg > 0.0 && !state.isSleeping();
    const Vector velocity = toFieldVector(state.velocity());
    body.acceleration = isFalling ? body.gravity : Vector{};
    const double velocityShare = std::max(0.0, 1.0 - stepSeconds * state.linearDamp());
    const double spinShare = std::max(0.0, 1.0 - stepSeconds * state.angularDamp());
    for (std::size_t i = 0; i < 3; ++i)
        body.velocityBefore[i] = velocity[i] * velocityShare + body.acceleration[i] * stepSeconds;
    body.spin = toFieldSpin(state.spin());
    for (double& rate : body.spin) rate *= spinShare;
    std::array<double, 6> inverse = state.inverseInertia();
    for (double& entry : inverse) entry /= unitMetres * unitMetres;
    reportIfError(physvib_world_move_in_space(world, body.number, body.centre.data(),
                                              body.velocityBefore.data(), body.spin.data(), inverse.data()));
}

// All velocities are read before body_entered and _integrate_forces, which may set them.
void HapticWorld::onSolved() {
    if (!isStepOpen || std::exchange(isSolved, true)) return;
    for (auto& [id, body] : bodies) {
        body.state = {};
        if (body.isRigid && exists(body)) reportSolvedVelocity(body);
    }
}

void HapticWorld::finishStep() {
    onSolved();
    if (!isStepOpen) return;
    isStepOpen = isSolved = false;
    restitutions.clear();
    std::vector<ObservedBody*> rigid; // contacts may add bodies; these pointers stay valid
    for (auto& [id, body] : bodies) {
        if (!body.isRigid || !exists(body)) body.state = {};
        body.wasTouched = false;
        if (body.state) rigid.push_back(&body);
    }
    resolvePending();
    for (ObservedBody* body : rigid) reportTouches(*body);
    reportIfError(physvib_world_end_step(world));
    emitEvents();
}

void HapticWorld::reportSolvedVelocity(ObservedBody& body) {
    body.state = BodyState::find(body.rid, is3d);
    if (!body.state) return;
    const Vector velocity = toFieldVector(body.state.velocity());
    const Vector spin = toFieldSpin(body.state.spin());
    body.velocityChange = minus(velocity, body.velocityBefore);
    reportIfError(physvib_world_moved_in_space(world, body.number, velocity.data(), spin.data()));
}

namespace {
std::vector<const HapticWorld*> worldsInTree; // in the order of their entry
} // namespace

HapticWorld::HapticWorld(GDExtensionObjectPtr godotObject, bool is3dWorld)
    : Instance(godotObject, worldProperties(is3dWorld))
    , is3d(is3dWorld)
    , outputs(godotObject) {}

HapticWorld::~HapticWorld() {
    std::erase(worldsInTree, this);
    if (world != nullptr) physvib_world_free(world);
}

void HapticWorld::onNotification(int what) {
    if (what == notifiedPhysicsProcess) // deferred, to follow calls that scripts deferred
        return (void)self().call("call_deferred", "_begin_step");
    if (what == notifiedPaused) return outputs.pause();
    if (what == notifiedProcess) {
        if (areOutputsStale) configureOutputs();
        return outputs.update(self().call("get_process_delta_time").real());
    }
    if ((what != notifiedEnterTree && what != notifiedExitTree) || isInEditor()) return;
    what == notifiedEnterTree ? enterTree() : leaveTree();
}

void HapticWorld::enterTree() {
    const Variant viewport = self().call("get_viewport"), tree = self().call("get_tree");
    const Variant physicsWorld = viewport.call(is3d ? "find_world_3d" : "find_world_2d");
    space = physicsWorld.object() == nullptr ? 0 : physicsWorld.call("get_space").rid();
    worldsInTree.push_back(this);
    if (!isActive())
        warn("HapticWorld: another one of this kind is in the scene; this one begins when that one leaves");
    configure();
    configureOutputs();
    const char* const kind = is3d ? "PhysicsBody3D" : "RigidBody2D";
    for (const Variant& body : tree.call("get_root").call("find_children", "*", kind, true, false).elements())
        onNodeAdded(body);
    tree.call("connect", "physics_frame", Variant::callable(object, "_finish_step"));
    tree.call("connect", "node_added", Variant::callable(object, "_added"));
    self().call("set_process", true);
    self().call("set_physics_process", true);
    constexpr int afterAllScripts = std::numeric_limits<std::int32_t>::max();
    self().call("set_physics_process_priority", afterAllScripts);
}

// The world may enter a tree again: its bodies are removed, its time continues.
void HapticWorld::leaveTree() {
    removeBodies();
    outputs.close();
    areOutputsStale = true;
    std::erase(worldsInTree, this);
    rigidBodies.clear();
    const Variant tree = self().call("get_tree");
    tree.call("disconnect", "physics_frame", Variant::callable(object, "_finish_step"));
    tree.call("disconnect", "node_added", Variant::callable(object, "_added"));
}

bool HapticWorld::isActive() const {
    for (const HapticWorld* candidate : worldsInTree)
        if (candidate->is3d == is3d && candidate->space == space) return candidate == this;
    return false;
}

void HapticWorld::configure() {
    isStale = false;
    updateFieldMapping();
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.field_width_m = get(fieldSize).vector()[0] * unitMetres;
    settings.full_scale_impulse_n_s = get(fullScale).real() < 0 ? PHYSVIB_AUTOMATIC : get(fullScale).real();
    settings.threshold_m_per_s = get(threshold).real();
    const int code = world == nullptr ? physvib_world_create(&settings, &world)
                                      : physvib_world_configure(world, &settings);
    if (code != PHYSVIB_OK) warn(std::string("HapticWorld: ") + physvib_error());
}

// Called once per frame, since a script may set ten properties in a tick and devices open slowly.
void HapticWorld::configureOutputs() {
    areOutputsStale = false;
    updateFieldMapping();
    physvib_layout geometry{};
    if (const std::string error = readLayout(geometry); !error.empty()) warn("HapticWorld: " + error);
    const Vector size = get(fieldSize).vector();
    OutputSettings settings{
        {}, get(silent).isTrue(), geometry, get(levelDb).real(), size[0] * unitMetres, size[1] * unitMetres,
        {}};
    if (const std::string file = get(sessionFile).text(); !file.empty()) // user:// and res://
        settings.sessionFile = singleton("ProjectSettings").call("globalize_path", file.c_str()).text();
    for (const Variant& name : get(godot::outputs).elements()) settings.names.push_back(name.text());
    outputs.configure(settings);
}

std::vector<std::string> HapticWorld::warnings() const {
    const Variant root = self().call("is_inside_tree").isTrue()
                             ? self().call("get_tree").call("get_edited_scene_root")
                             : Variant();
    if (root.object() == nullptr) return {};
    std::vector<std::string> all;
    if (findNodes(root, is3d ? "HapticWorld3D" : "HapticWorld2D").size() > 1)
        all.emplace_back("One haptic world is enough for a scene: the others wait until it leaves.");
    if (findNodes(root, "HapticBody").empty())
        all.emplace_back("Nothing in this scene is felt: add a HapticBody as a child of a physics body.");
    return all;
}

Variant HapticWorld::explain() const {
    std::array<char, 512> sentence{};
    if (world == nullptr) return Variant("The world is not in a scene that plays.");
    if (!isActive()) return Variant("Another haptic world of this kind is in the scene, and this one waits.");
    const auto isHere = [&](const HapticBody* body) { return body->spaceRid() == space; };
    if (!hapticBodies().empty() && std::ranges::none_of(hapticBodies(), isHere))
        return Variant("No HapticBody is in its space: 2D needs a HapticWorld2D, 3D a HapticWorld3D.");
    physvib_output_facts facts;
    physvib_output_facts_init(&facts, sizeof facts);
    facts.is_missing = get(godot::outputs).elements().empty() ? 1 : 0;
    facts.is_silent = get(silent).isTrue() ? 1 : 0;
    physvib_world_explain_output(world, &facts, sentence.data(), sentence.size());
    return Variant(translateForGodot(sentence.data()).c_str());
}

Variant HapticWorld::recentPeaks() const {
    Variant peaks = Variant::empty(type::dictionary);
    int actuator = 0;
    for (const double peak : outputs.recentPeaks()) peaks.set(actuator++, peak);
    return peaks;
}

Variant HapticWorld::timeSeconds() const {
    return Variant(world == nullptr ? 0.0 : static_cast<double>(physvib_world_time_ns(world)) * 1e-9);
}

void HapticWorld::updateFieldMapping() {
    unitMetres = get(metresPerUnit).real();
    fieldOrigin = get(fieldCorner).vector();
    if (!is3d) fieldOrigin[1] += get(fieldSize).vector()[1]; // y points down in 2D: a lower y is larger
}

std::string HapticWorld::readLayout(physvib_layout& found) const {
    const std::vector<Variant> places = get(actuators).elements();
    found = {}, found.size = sizeof found;
    if (places.empty())
        return physvib_layout_preset(get(layout).text().c_str(), &found) == PHYSVIB_OK ? "" : physvib_error();
    if (places.size() > PHYSVIB_MAX_ENCHANTERS)
        return "actuators: expected at most 64 places, found " + std::to_string(places.size());
    const Vector size = get(fieldSize).vector();
    found.extent_width_m = size[0] * unitMetres, found.extent_height_m = size[1] * unitMetres;
    for (const Variant& place : places) {
        const Vector at = toField(place.vector());
        found.x_m[found.count] = at[0], found.y_m[found.count++] = at[1];
    }
    return "";
}

Variant HapticWorld::actuatorPlaces() {
    updateFieldMapping();
    physvib_layout found{};
    Variant list = Variant::empty(type::vector2Array);
    if (!readLayout(found).empty()) return list;
    const Vector size = get(fieldSize).vector();
    for (int j = 0; j < found.count; ++j) {
        const double right = found.x_m[j] / found.extent_width_m, up = found.y_m[j] / found.extent_height_m;
        list.call("append", Variant::vector({fieldOrigin[0] + right * size[0],
                                             fieldOrigin[1] + (is3d ? up : -up) * size[1], 0},
                                            false));
    }
    return list;
}

// A function connected to the signal may free this world, so its existence is checked before each event.
void HapticWorld::emitEvents() {
    std::vector<physvib_event> events(64);
    events.front().size = sizeof events.front();
    std::vector<Variant> hits;
    physvib_int64 count = 0;
    do {
        count = physvib_world_take(world, events.data(), static_cast<physvib_int64>(events.size()), 1);
        for (physvib_int64 i = 0; i < count; ++i) {
            const physvib_event& event = events[static_cast<std::size_t>(i)];
            outputs.play(world, toScreen(event));
            if (event.kind == PHYSVIB_HIT) hits.push_back(describeHit(event)); // grains may be thousands
        }
    } while (count == static_cast<physvib_int64>(events.size()));
    const std::uint64_t id = api.objectId(object);
    for (const Variant& hit : hits) {
        const GDExtensionObjectPtr godotObject = api.objectFromId(id);
        if (godotObject == nullptr) return;
        Variant(godotObject).call("emit_signal", "felt", hit);
    }
}

Variant HapticWorld::describeHit(const physvib_event& event) const {
    Variant hit = Variant::empty(type::dictionary);
    hit.set("position", Variant::vector(scenePosition(event), is3d));
    hit.set("strength_n_s", event.impulse_n_s);
    hit.set("speed_m_per_s", event.mass_kg > 0.0 ? event.impulse_n_s / event.mass_kg : 0.0);
    hit.set("amplitude", event.amplitude);
    hit.set("time_s", static_cast<double>(event.time_ns) * 1e-9);
    hit.set("frequency_hz", event.frequency_hz);
    hit.set("body", findObject(event.fixture));
    hit.set("other", findObject(event.other));
    return hit;
}

Variant HapticWorld::findObject(int number) const {
    const auto found = objectIds.find(number);
    return found == objectIds.end() ? Variant() : Variant(api.objectFromId(found->second));
}

Vector HapticWorld::scenePosition(const physvib_event& event) const {
    return {fieldOrigin[0] + event.x_m / unitMetres,
            fieldOrigin[1] + (is3d ? 1.0 : -1.0) * event.y_m / unitMetres,
            fieldOrigin[2] + event.z_m / unitMetres};
}

// With field_from_camera, the screen is the whole field: events move to their place on the screen.
physvib_event HapticWorld::toScreen(const physvib_event& event) const {
    physvib_event onScreen = event;
    const Variant viewport = get(fieldFromCamera).isTrue() ? self().call("get_viewport") : Variant();
    if (viewport.object() == nullptr) return onScreen;
    const Vector size = viewport.call("get_visible_rect").member("size").vector(), at = scenePosition(event);
    Vector pixel{};
    if (is3d) {
        const Variant camera = viewport.call("get_camera_3d"), place = Variant::vector(at, true);
        if (camera.object() == nullptr) return onScreen;
        pixel = camera.call("unproject_position", place).vector();
        if (camera.call("is_position_behind", place).isTrue()) // unproject_position mirrors it then
            pixel = {size[0] - pixel[0], size[1], 0.0};
    } else {
        const Variant view = viewport.call("get_canvas_transform");
        const Vector x = view.member("x").vector(), y = view.member("y").vector(),
                     origin = view.member("origin").vector();
        for (std::size_t i = 0; i < 2; ++i) pixel[i] = origin[i] + at[0] * x[i] + at[1] * y[i];
    }
    const auto share = [&](std::size_t i) { return std::clamp(pixel[i] / std::max(1.0, size[i]), 0.0, 1.0); };
    const Vector field = get(fieldSize).vector();
    onScreen.x_m = share(0) * field[0] * unitMetres, onScreen.y_m = (1.0 - share(1)) * field[1] * unitMetres,
    onScreen.z_m = 0.0;
    return onScreen;
}

namespace {
constexpr int minListedContacts = 16; // contacts per body and tick, unless the game wants more
// A key for a body without a node: ids of nodes never have the highest bit set.
std::uint64_t toBodyKey(std::uint64_t rid) { return rid | std::uint64_t{1} << 63U; }
bool isRigidBody(const Variant& node, bool is3d) {
    if (!is3d) return node.call("is_class", "RigidBody2D").isTrue();
    return node.call("is_class", "RigidBody3D").isTrue() || // or of a ragdoll
           node.call("is_class", "PhysicalBone3D").isTrue();
}
} // namespace

void HapticWorld::onNodeAdded(const Variant& node) {
    if (!isRigidBody(node, is3d)) return;
    if (isInTree(node.object()) && readSpaceRid(node, is3d) == space)
        rigidBodies.insert(api.objectId(node.object()));
}

bool HapticWorld::exists(const ObservedBody& body) const {
    const GDExtensionObjectPtr godotObject = body.isNode ? api.objectFromId(body.id) : nullptr;
    return body.isNode ? godotObject != nullptr && isInTree(godotObject) : body.wasTouched;
}

// Adds the bodies of new HapticBody nodes, removes freed ones, and updates masses.
void HapticWorld::updateBodies() {
    for (auto& [id, body] : bodies) body.hapticBody = nullptr;
    for (const HapticBody* hapticBody : hapticBodies())
        if (hapticBody->spaceRid() == space && api.objectFromId(hapticBody->parentBodyId()) != nullptr)
            findOrAdd(hapticBody->parentBodyId(), 0, hapticBody);
    observeRigidBodies();
    for (auto it = bodies.begin(); it != bodies.end();) {
        if (exists(it->second)) {
            updateDescription(it->second);
            ++it;
            continue;
        }
        physvib_world_remove_body(world, it->second.number);
        objectIds.erase(it->second.number);
        it = bodies.erase(it);
    }
}

// Only rigid bodies list contacts, so if a haptic source is of another kind, all rigid bodies are observed.
void HapticWorld::observeRigidBodies() {
    const bool isNeeded = std::any_of(bodies.begin(), bodies.end(), [](const auto& body) {
        return body.second.hapticBody != nullptr && !body.second.isRigid && body.second.hapticBody->isFelt();
    });
    for (auto it = rigidBodies.begin(); it != rigidBodies.end();) {
        const GDExtensionObjectPtr godotObject = api.objectFromId(*it);
        if (godotObject == nullptr || !isInTree(godotObject)) { // node_added adds it again
            it = rigidBodies.erase(it);
            continue;
        }
        if (isNeeded) findOrAdd(*it, 0, nullptr);
        ++it;
    }
}

ObservedBody* HapticWorld::findOrAdd(std::uint64_t id, std::uint64_t rid, const HapticBody* hapticBody) {
    const GDExtensionObjectPtr godotObject = id != 0 ? api.objectFromId(id) : nullptr;
    const std::uint64_t key = godotObject != nullptr ? id : toBodyKey(rid);
    if (godotObject == nullptr && rid == 0) return nullptr;
    if (const auto existing = bodies.find(key); existing != bodies.end()) {
        if (hapticBody != nullptr) existing->second.hapticBody = hapticBody;
        existing->second.wasTouched = true;
        return &existing->second;
    }
    ObservedBody& added = bodies.emplace(key, ObservedBody{key, nextBodyNumber++}).first->second;
    added.hapticBody = hapticBody;
    added.wasTouched = true;
    if (godotObject != nullptr) added.object = Variant(godotObject);
    added.isNode = added.object.call("is_class", "Node").isTrue();
    added.isRigid = isRigidBody(added.object, is3d);
    added.isCharacter = added.object.call("is_class", is3d ? "CharacterBody3D" : "CharacterBody2D").isTrue();
    if (added.isRigid) {
        added.rid = added.object.call("get_rid").rid();
        server().call("body_set_force_integration_callback", Variant(type::rid, &added.rid),
                      Variant::callable(object, "_solved"));
    }
    objectIds[added.number] = key;
    updateDescription(added);
    return &added;
}

void HapticWorld::removeBodies() {
    if (world == nullptr) return;
    if (isStepOpen) reportIfError(physvib_world_end_step(world));
    isStepOpen = false;
    physvib_event ignored{};
    ignored.size = sizeof ignored;
    while (physvib_world_take(world, &ignored, 1, 1) > 0) {
    }
    for (const auto& [id, body] : bodies) physvib_world_remove_body(world, body.number);
    bodies.clear();
    objectIds.clear();
    pendingContacts.clear();
}

// A body is described again only if something has changed.
void HapticWorld::updateDescription(ObservedBody& body) {
    double massKg = 0.0;
    if (body.isRigid) {
        requestContactReports(body.rid, is3d, minListedContacts);
        body.state = BodyState::find(body.rid, is3d);
        const double inverse = body.state ? body.state.inverseMass() : 0.0;
        massKg = inverse > 0.0 ? 1.0 / inverse : 0.0;
    }
    const bool isSame = body.revision == changeCount() + 1 && body.describedHapticBody == body.hapticBody;
    if (isSame && (body.isCharacter || massKg == body.description.mass_kg)) return;
    body.revision = changeCount() + 1;
    body.describedHapticBody = body.hapticBody;
    physvib_body description;
    physvib_body_init(&description, sizeof description);
    const Variant material = findMaterial(body);
    if (body.hapticBody != nullptr)
        body.hapticBody->applyTo(description, material);
    else
        applyMaterial(description, material, body.object);
    description.mass_kg = body.isCharacter ? description.static_mass_kg : massKg;
    body.description = description;
    reportIfError(physvib_world_set_body(world, body.number, &description));
}

Variant HapticWorld::findMaterial(const ObservedBody& body) const {
    const Variant byPhysics = get(physicsMaterials);
    if (!byPhysics.call("size").isTrue() || body.object.object() == nullptr) return {};
    const Variant physics = body.object.member("physics_material_override");
    return physics.object() == nullptr ? Variant() : byPhysics.call("get", physics);
}

} // namespace physvib::godot
