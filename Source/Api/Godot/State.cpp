// SPDX-License-Identifier: MIT
// The methods of Godot that BodyState reads, found by name and hash, and called by pointer.
#include "Api/Godot/State.h"

namespace physvib::godot {
namespace {
using FloatVector = std::array<float, 3>; // a Vector2, or a Vector3
using Int64 = std::int64_t;

enum StateMethod {
    transform,
    centreOfMass,
    sleeping,
    linearVelocity,
    angularVelocity,
    totalGravity,
    totalLinearDamp,
    totalAngularDamp,
    inverseInertiaMethod,
    inverseMassMethod,
    contactCount,
    contactLocalPosition,
    contactColliderPosition,
    contactLocalNormal,
    contactColliderVelocity,
    contactColliderId,
    contactCollider,
    methodCount
};
struct MethodHashes {
    const char* name;
    Int64 hash2d, hash3d;
};
// In the order of StateMethod; hashes from extension_api.json, of types unchanged since Godot 4.4.
const std::array<MethodHashes, methodCount> methods{{
    {"get_transform", 3'814'499'831, 3'229'777'777},
    {"get_center_of_mass", 3'341'600'327, 3'360'562'783},
    {"is_sleeping", 36'873'697, 36'873'697},
    {"get_linear_velocity", 3'341'600'327, 3'360'562'783},
    {"get_angular_velocity", 1'740'695'150, 3'360'562'783},
    {"get_total_gravity", 3'341'600'327, 3'360'562'783},
    {"get_total_linear_damp", 1'740'695'150, 1'740'695'150},
    {"get_total_angular_damp", 1'740'695'150, 1'740'695'150},
    {"get_inverse_inertia", 1'740'695'150, 2'716'978'435},
    {"get_inverse_mass", 1'740'695'150, 1'740'695'150},
    {"get_contact_count", 3'905'245'786, 3'905'245'786},
    {"get_contact_local_position", 2'299'179'447, 711'720'468},
    {"get_contact_collider_position", 2'299'179'447, 711'720'468},
    {"get_contact_local_normal", 2'299'179'447, 711'720'468},
    {"get_contact_collider_velocity_at_position", 2'299'179'447, 711'720'468},
    {"get_contact_collider_id", 923'996'154, 923'996'154},
    {"get_contact_collider", 495'598'643, 495'598'643},
}};

struct PhysicsMethods {
    std::array<MethodBind, methodCount> state;
    MethodBind getDirectState, getMaxContacts, setMaxContacts;
    GDExtensionObjectPtr server = nullptr;
};
std::array<PhysicsMethods, 2> physicsMethods; // the plane, space

MethodBind isInsideTree;

PhysicsMethods& methodsOf(bool is3d) { return physicsMethods[is3d ? 1 : 0]; }
GDExtensionObjectPtr serverOf(bool is3d) {
    GDExtensionObjectPtr& server = methodsOf(is3d).server;
    if (server == nullptr) server = singleton(is3d ? "PhysicsServer3D" : "PhysicsServer2D").object();
    return server;
}
Vector toVector(const FloatVector& t) { return {t[0], t[1], t[2]}; }

template <class Result, class... Arguments>
Result get(StateMethod method, bool is3d, GDExtensionObjectPtr object, const Arguments&... arguments) {
    return methodsOf(is3d).state[method].call<Result>(object, arguments...);
}
} // namespace

bool findStateMethods() {
    bool isComplete = isInsideTree.find("Node", "is_inside_tree", 36'873'697);
    for (const bool is3d : {false, true}) {
        PhysicsMethods& found = methodsOf(is3d);
        const char* const state = is3d ? "PhysicsDirectBodyState3D" : "PhysicsDirectBodyState2D";
        const char* const server = is3d ? "PhysicsServer3D" : "PhysicsServer2D";
        for (std::size_t i = 0; i < methodCount; ++i)
            isComplete &= found.state[i].find(
                state, is3d && i == inverseInertiaMethod ? "get_inverse_inertia_tensor" : methods[i].name,
                is3d ? methods[i].hash3d : methods[i].hash2d);
        isComplete &=
            found.getDirectState.find(server, "body_get_direct_state", is3d ? 3'029'727'957 : 1'191'931'871);
        isComplete &= found.getMaxContacts.find(server, "body_get_max_contacts_reported", 2'198'884'583);
        isComplete &= found.setMaxContacts.find(server, "body_set_max_contacts_reported", 3'411'492'887);
    }
    return isComplete;
}

BodyState BodyState::find(std::uint64_t rid, bool is3d) {
    BodyState state;
    state.object = methodsOf(is3d).getDirectState.call<GDExtensionObjectPtr>(serverOf(is3d), rid);
    state.is3d = is3d;
    return state;
}

void requestContactReports(std::uint64_t rid, bool is3d, int count) {
    const PhysicsMethods& found = methodsOf(is3d);
    if (found.getMaxContacts.call<Int64>(serverOf(is3d), rid) < count)
        found.setMaxContacts.call<Int64>(serverOf(is3d), rid, Int64{count});
}

bool isInTree(GDExtensionObjectPtr node) { return isInsideTree.call<unsigned char>(node) != 0; }

double BodyState::inverseMass() const { return get<double>(inverseMassMethod, is3d, object); }
bool BodyState::isSleeping() const { return get<unsigned char>(sleeping, is3d, object) != 0; }
Vector BodyState::velocity() const { return toVector(get<FloatVector>(linearVelocity, is3d, object)); }
Vector BodyState::gravity() const { return toVector(get<FloatVector>(totalGravity, is3d, object)); }
double BodyState::linearDamp() const { return get<double>(totalLinearDamp, is3d, object); }
double BodyState::angularDamp() const { return get<double>(totalAngularDamp, is3d, object); }

Vector BodyState::centre() const {
    const auto t = get<std::array<float, 12>>(transform, is3d, object); // its origin is last
    const Vector offset = toVector(get<FloatVector>(centreOfMass, is3d, object));
    const std::size_t origin = is3d ? 9 : 4;
    return {t[origin] + offset[0], t[origin + 1] + offset[1], is3d ? t[11] + offset[2] : 0.0};
}

Vector BodyState::spin() const {
    if (is3d) return toVector(get<FloatVector>(angularVelocity, is3d, object));
    return {0.0, 0.0, get<double>(angularVelocity, is3d, object)};
}

std::array<double, 6> BodyState::inverseInertia() const {
    if (!is3d) return {0.0, 0.0, get<double>(inverseInertiaMethod, is3d, object), 0.0, 0.0, 0.0};
    const auto m = get<std::array<float, 9>>(inverseInertiaMethod, is3d, object); // by rows
    return {m[0], m[4], m[8], m[1], m[2], m[5]};
}

int BodyState::contacts() const { return static_cast<int>(get<Int64>(contactCount, is3d, object)); }
Vector BodyState::contactVector(int method, int i) const {
    return toVector(get<FloatVector>(static_cast<StateMethod>(method), is3d, object, Int64{i}));
}
Vector BodyState::contactPosition(int i) const { return contactVector(contactLocalPosition, i); }
Vector BodyState::contactOtherPosition(int i) const { return contactVector(contactColliderPosition, i); }
Vector BodyState::contactNormal(int i) const { return contactVector(contactLocalNormal, i); }
Vector BodyState::contactOtherVelocity(int i) const { return contactVector(contactColliderVelocity, i); }
std::uint64_t BodyState::contactOtherId(int i) const {
    return static_cast<std::uint64_t>(get<Int64>(contactColliderId, is3d, object, Int64{i}));
}
std::uint64_t BodyState::contactRid(int i) const {
    return get<std::uint64_t>(contactCollider, is3d, object, Int64{i});
}

} // namespace physvib::godot
