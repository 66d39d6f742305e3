// SPDX-License-Identifier: MIT
// Which bodies a haptic world observes, and what they are to physvib.
#include "Api/Godot/Vectors.h"
#include "Api/Godot/WorldProperties.h"
#include "Api/Godot/Worlds.h"

#include <algorithm>

namespace physvib::godot {

namespace {
constexpr int listed = 16; // contacts of a body that Godot lists per tick, unless the game wants more
// Ids of nodes have no highest bit.
std::uint64_t idOfRid(std::uint64_t rid) { return rid | std::uint64_t{1} << 63U; }
} // namespace

void HapticWorld::added(const Value& node) {
    if (!node.call("is_class", isSpace ? "RigidBody3D" : "RigidBody2D").isTrue()) return;
    if (isInTree(node.object()) && spaceOf(node, isSpace) == space)
        rigidBodies.insert(api.instanceId(node.object()));
}

bool HapticWorld::isThere(const Watched& each) const {
    const GDExtensionObjectPtr there = each.isNode ? api.instanceFromId(each.id) : nullptr;
    return each.isNode ? there != nullptr && isInTree(there) : each.isMet;
}

// Bodies that were freed go, those of new HapticBody nodes come, masses are as they are now.
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

// Only rigid bodies have lists of contacts. So what strikes a felt body of another kind is asked for its
// list.
void HapticWorld::watchStrikers() {
    const bool isWanted = std::any_of(watched.begin(), watched.end(), [](const auto& each) {
        return each.second.values != nullptr && !each.second.isRigid && each.second.values->isFelt();
    });
    for (auto it = rigidBodies.begin(); it != rigidBodies.end();) {
        const GDExtensionObjectPtr there = api.instanceFromId(*it);
        if (there == nullptr || !isInTree(there)) { // it is added again with the tree
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
    added.isRigid = added.body.call("is_class", isSpace ? "RigidBody3D" : "RigidBody2D").isTrue();
    added.slides = added.body.call("is_class", isSpace ? "CharacterBody3D" : "CharacterBody2D").isTrue();
    if (added.isRigid) added.rid = added.body.call("get_rid").rid();
    objects[added.number] = key;
    describe(added);
    return &added;
}

void HapticWorld::forget() {
    if (world == nullptr) return;
    if (isOpen) checkWorld(physvib_world_end_step(world));
    isOpen = false;
    physvib_event ignored;
    while (physvib_world_take(world, &ignored, 1, 1) > 0) {
    }
    for (const auto& [id, each] : watched) physvib_world_remove_body(world, each.number);
    watched.clear();
    objects.clear();
}

// What did not change since is not described again.
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
    const bool isRight =
        each.values != nullptr ? each.values->describe(body, material) : describeMaterial(body, material);
    if (!isRight) body.is_camera = 0;
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
