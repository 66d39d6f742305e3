// SPDX-License-Identifier: MIT
// Properties of HapticBody and HapticMaterial, and what the editor warns of.
#include "Api/Godot/Bodies.h"
#include "Api/Godot/Outputs.h"

#include <algorithm>

namespace physvib::godot {
namespace {
std::vector<HapticBody*> bodiesInTree;
enum BodyProperty { material, felt, gain, staticMass, part, controller };
enum MaterialProperty { preset, frequency, decay, grain, roughness };

constexpr int hintRange = 1, hintEnumSuggestion = 3, hintResource = 17; // Godot's PropertyHint

const std::vector<Property>& bodyProperties() {
    static const std::vector<Property> all{
        {"material", type::object, [] { return Variant(); }, 0, 0, "", hintResource, "HapticMaterial"},
        {"felt", type::boolean, [] { return Variant(true); }, 0, 0, ""},
        {"gain", type::real, [] { return Variant(1.0); }, 0, 10'000, "", hintRange, "0,10,0.01,or_greater"},
        {"static_mass_kg", type::real, [] { return Variant(1.0); }, 1e-6, 1e6, "Without Mass", hintRange,
         "0.001,100,0.001,or_greater,exp,suffix:kg"},
        {"part", type::text, [] { return Variant(""); }, 0, 0, "Player"},
        {"controller", type::integer, [] { return Variant(-1); }, -1, 7, "Player", hintRange, "-1,7,1"}};
    return all;
}

const char* presetNames() {
    static const std::string list = [] {
        std::string names;
        for (int i = 0; const char* name = physvib_material_name(i); ++i) {
            if (i > 0) names += ',';
            names += name;
        }
        return names;
    }();
    return list.c_str();
}

const std::vector<Property>& materialProperties() {
    static const std::vector<Property> all{
        {"preset", type::text, [] { return Variant(""); }, 0, 0, "", hintEnumSuggestion, presetNames()},
        {"frequency_hz", type::real, [] { return Variant(200.0); }, 1.0, 20'000, "Without Preset", hintRange,
         "1,1000,0.1,or_greater,exp,suffix:Hz"},
        {"decay_per_s", type::real, [] { return Variant(30.0); }, 0.1, 2'000, "Without Preset", hintRange,
         "0.1,2000,0.1,exp,suffix:1/s"},
        {"grain_m", type::real, [] { return Variant(0.0); }, 0.0, 1.0, "Without Preset", hintRange,
         "0,1,0.0001,suffix:m"},
        {"roughness", type::real, [] { return Variant(1.0); }, 0.0, 1'000, "Without Preset", hintRange,
         "0,10,0.01,or_greater"}};
    return all;
}

std::string pathOf(const Variant& node) {
    const bool isNode = node.object() != nullptr && node.call("is_class", "Node").isTrue();
    return isNode ? node.call("get_path").text() : "a body without a node";
}
bool isPhysicsBody(const Variant& node) {
    return node.call("is_class", "PhysicsBody2D").isTrue() || node.call("is_class", "PhysicsBody3D").isTrue();
}
} // namespace

const std::vector<HapticBody*>& hapticBodies() { return bodiesInTree; }

HapticBody::HapticBody(GDExtensionObjectPtr godotObject)
    : Instance(godotObject, bodyProperties()) {}
HapticBody::~HapticBody() { std::erase(bodiesInTree, this); }

void HapticBody::onNotification(int what) {
    if (what == notifiedExitTree) {
        std::erase(bodiesInTree, this);
        parentId = 0;
    }
    if (what != notifiedEnterTree || isInEditor()) return;
    const Variant parent = self().call("get_parent");
    if (!isPhysicsBody(parent)) return warn("HapticBody: expected a physics body as parent");
    parentId = api.objectId(parent.object());
    space = readSpaceRid(parent, parent.call("is_class", "PhysicsBody3D").isTrue());
    bodiesInTree.push_back(this);
}

std::uint64_t readSpaceRid(const Variant& node, bool is3d) {
    const Variant world = node.call(is3d ? "get_world_3d" : "get_world_2d");
    return world.object() == nullptr ? 0 : world.call("get_space").rid();
}

bool HapticBody::isFelt() const { return get(felt).isTrue(); }

std::vector<Variant> findNodes(const Variant& scene, const char* kind) {
    std::vector<Variant> all = scene.call("find_children", "*", kind, true, false).elements();
    if (scene.call("is_class", kind).isTrue()) all.push_back(scene);
    return all;
}

namespace {
int partNumber(const std::string& part) { return part.empty() ? 0 : physvib_part(part.c_str()); }
bool applyPreset(physvib_body& body, const Variant& material) {
    const std::string name =
        material.object() == nullptr ? std::string() : material.call("get_preset").text();
    return name.empty() || physvib_material(name.c_str(), &body) == PHYSVIB_OK;
}
bool hasPart(const Variant& world, int part) {
    physvib_layout worldLayout{};
    worldLayout.size = sizeof worldLayout;
    if (world.call("get_actuators").elements().empty())
        physvib_layout_preset(world.call("get_layout").text().c_str(), &worldLayout);
    const auto isHand = [&](const char* name) { return part == physvib_part(name); };
    if (world.call("get_outputs").call("has", "xr").isTrue() && std::ranges::any_of(XrHands::names, isHand))
        return true;
    return part == 0 || std::ranges::find(worldLayout.part, part) != std::end(worldLayout.part);
}
} // namespace

void HapticBody::onPropertyChanged() {
    if (isInEditor()) self().call("update_configuration_warnings");
}

std::vector<std::string> HapticBody::warnings() const {
    const Variant parent = self().call("get_parent");
    if (!isPhysicsBody(parent))
        return {
            "It makes its parent felt: make it a child of a RigidBody2D, RigidBody3D or other physics body."};
    std::vector<std::string> all;
    const Variant scene = self().call("get_tree").call("get_edited_scene_root");
    const char* const kind =
        parent.call("is_class", "PhysicsBody3D").isTrue() ? "HapticWorld3D" : "HapticWorld2D";
    const std::vector<Variant> worlds = findNodes(scene, kind);
    if (worlds.empty() && scene.object() != parent.object())
        all.push_back(std::string("Nothing is felt without a ") + kind + " in the scene: add one.");
    const std::string name = get(part).text();
    if (!worlds.empty() && !hasPart(worlds.front(), partNumber(name)))
        all.push_back("No actuator of the layout is on the part \"" + name + "\", so all play it.");
    if (parent.call("find_children", "*", "HapticBody", false, false).elements().size() > 1)
        all.emplace_back("Its body has another HapticBody, and one counts: remove one.");
    physvib_body body{};
    body.size = sizeof body;
    if (!applyPreset(body, get(material))) all.emplace_back(physvib_error());
    return all;
}

void HapticBody::applyTo(physvib_body& body, const Variant& defaultMaterial) const {
    body.is_camera = isFelt() ? 1 : 0;
    body.gain = get(gain).real();
    body.static_mass_kg = get(staticMass).real();
    body.device = static_cast<int>(get(controller).integer()) + 1; // 0: all
    body.part = partNumber(get(part).text());
    body.frequency_hz = 200.0, body.decay_per_s = 30.0;
    applyMaterial(body, get(material).object() != nullptr ? get(material) : defaultMaterial,
                  self().call("get_parent"));
}

void applyMaterial(physvib_body& body, const Variant& material, const Variant& node) {
    if (material.object() == nullptr) return;
    body.frequency_hz = material.call("get_frequency_hz").real();
    body.decay_per_s = material.call("get_decay_per_s").real();
    body.grain_m = material.call("get_grain_m").real();
    body.roughness = material.call("get_roughness").real();
    if (!applyPreset(body, material)) warn("HapticMaterial of " + pathOf(node) + ": " + physvib_error());
}

const ClassTable hapticBodyClass{
    "HapticBody", "Node",  &bodyProperties(),
    {},           nullptr, [](GDExtensionObjectPtr object) -> Instance* { return new HapticBody(object); }};
const ClassTable hapticMaterialClass{
    "HapticMaterial",
    "Resource",
    &materialProperties(),
    {},
    nullptr,
    [](GDExtensionObjectPtr object) -> Instance* { return new Instance(object, materialProperties()); }};

} // namespace physvib::godot
