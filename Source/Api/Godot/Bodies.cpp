// SPDX-License-Identifier: MIT
#include "Api/Godot/Bodies.h"

#include <algorithm>

namespace physvib::godot {

namespace {
std::vector<HapticBody*> bodiesInTree;
constexpr int reported = 16; // contacts of a body that Godot keeps per tick, unless the game wants more

enum BodyProperty { material, isFelt, gain, staticMass, part, controller };
enum MaterialProperty { preset, frequency, decay, grain, roughness };

constexpr auto real = GDEXTENSION_VARIANT_TYPE_FLOAT;
constexpr int hintEnumSuggestion = 3, hintResource = 17;

const std::vector<Property>& bodyProperties() {
    static const std::vector<Property> all{
        {"material", GDEXTENSION_VARIANT_TYPE_OBJECT, [] { return Value(); }, 0, 0, "", hintResource,
         "HapticMaterial"},
        {"felt", GDEXTENSION_VARIANT_TYPE_BOOL, [] { return Value(true); }, 0, 0, ""},
        {"gain", real, [] { return Value(1.0); }, 0, 10'000, ""},
        {"static_mass_kg", real, [] { return Value(1.0); }, 1e-6, 1e6, "Static bodies"},
        {"part", GDEXTENSION_VARIANT_TYPE_STRING, [] { return Value(""); }, 0, 0, "Player"},
        {"controller", GDEXTENSION_VARIANT_TYPE_INT, [] { return Value(-1); }, -1, 7, "Player"}};
    return all;
}

const char* presets() {
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
        {"preset", GDEXTENSION_VARIANT_TYPE_STRING, [] { return Value(""); }, 0, 0, "", hintEnumSuggestion,
         presets()},
        {"frequency_hz", real, [] { return Value(200.0); }, 1.0, 20'000, "Without preset"},
        {"decay_per_s", real, [] { return Value(30.0); }, 0.1, 2'000, "Without preset"},
        {"grain_m", real, [] { return Value(0.0); }, 0.0, 1.0, "Without preset"},
        {"roughness", real, [] { return Value(1.0); }, 0.0, 1'000, "Without preset"}};
    return all;
}

bool isPhysicsBody(const Value& node) {
    return node.call("is_class", "PhysicsBody2D").isTrue() || node.call("is_class", "PhysicsBody3D").isTrue();
}
bool isRigid(const Value& node) {
    return node.call("is_class", "RigidBody2D").isTrue() || node.call("is_class", "RigidBody3D").isTrue();
}
} // namespace

const std::vector<HapticBody*>& hapticBodies() { return bodiesInTree; }

HapticBody::HapticBody(GDExtensionObjectPtr itsObject)
    : Instance(itsObject, bodyProperties()) {}
HapticBody::~HapticBody() { std::erase(bodiesInTree, this); }

void HapticBody::notified(int what) {
    if (what == notifiedExitTree) {
        std::erase(bodiesInTree, this);
        parentId = 0;
    }
    if (what != notifiedEnterTree || isInEditor()) return;
    const Value parent = self().call("get_parent");
    if (!isPhysicsBody(parent)) return report("HapticBody: expected a physics body as parent");
    parentId = api.instanceId(parent.object());
    bodiesInTree.push_back(this);
    if (!isRigid(parent)) return;
    parent.call("set_contact_monitor", true); // Godot lists contacts only of bodies that ask; motion stays
    if (parent.call("get_max_contacts_reported").whole() < reported)
        parent.call("set_max_contacts_reported", reported);
}

std::vector<std::string> HapticBody::warnings() const {
    const Value parent = self().call("get_parent");
    if (!isPhysicsBody(parent))
        return {
            "A HapticBody makes its parent felt: make it a child of a RigidBody2D, RigidBody3D or another "
            "physics body."};
    return {};
}

bool HapticBody::describe(physvib_body& body) const {
    body.is_camera = get(isFelt).isTrue() ? 1 : 0;
    body.gain = get(gain).real();
    body.static_mass_kg = get(staticMass).real();
    body.device = static_cast<int>(get(controller).whole()) + 1; // 0: all
    const std::string itsPart = get(part).text();
    body.part = itsPart.empty() ? 0 : std::max(0, physvib_part(itsPart.c_str()));
    body.frequency_hz = 200.0, body.decay_per_s = 30.0;
    const Value its = get(material);
    if (its.object() == nullptr) return true;
    const std::string name = its.call("get_preset").text();
    body.frequency_hz = its.call("get_frequency_hz").real();
    body.decay_per_s = its.call("get_decay_per_s").real();
    body.grain_m = its.call("get_grain_m").real();
    body.roughness = its.call("get_roughness").real();
    if (name.empty() || physvib_material(name.c_str(), &body) == PHYSVIB_OK) return true;
    report(std::string("HapticMaterial: ") + physvib_error());
    return false;
}

namespace {
class HapticMaterial final : public Instance {
public:
    explicit HapticMaterial(GDExtensionObjectPtr itsObject)
        : Instance(itsObject, materialProperties()) {}
};
} // namespace

const Class hapticBodyClass{
    "HapticBody", "Node",  &bodyProperties(),
    {},           nullptr, [](GDExtensionObjectPtr object) -> Instance* { return new HapticBody(object); }};
const Class hapticMaterialClass{
    "HapticMaterial",
    "Resource",
    &materialProperties(),
    {},
    nullptr,
    [](GDExtensionObjectPtr object) -> Instance* { return new HapticMaterial(object); }};

} // namespace physvib::godot
