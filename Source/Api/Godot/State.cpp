// SPDX-License-Identifier: MIT
#include "Api/Godot/State.h"

namespace physvib::godot {
namespace {
using Triple = std::array<float, 3>; // a Vector2, or a Vector3
using Whole = std::int64_t;

enum Which {
    transform,
    centreOfMass,
    sleeping,
    linearVelocity,
    angularVelocity,
    totalGravity,
    totalLinearDamp,
    totalAngularDamp,
    inverseOfInertia,
    inverseOfMass,
    contactCount,
    contactLocalPosition,
    contactColliderPosition,
    contactLocalNormal,
    contactColliderVelocity,
    contactColliderId,
    contactCollider,
    countOfMethods
};
struct Described {
    const char* name;
    Whole planeHash, spaceHash;
};
// In the order of Which; hashes from extension_api.json, of types unchanged since Godot 4.4.
const std::array<Described, countOfMethods> methods{{
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

struct Space {
    std::array<Direct, countOfMethods> state;
    Direct stateOfBody, listedContacts, listContacts;
    GDExtensionObjectPtr server = nullptr;
};
std::array<Space, 2> spaces; // the plane, space

Direct inTree;

Space& spaceOf(bool isSpace) { return spaces[isSpace ? 1 : 0]; }
GDExtensionObjectPtr serverOf(bool isSpace) {
    GDExtensionObjectPtr& server = spaceOf(isSpace).server;
    if (server == nullptr) server = singleton(isSpace ? "PhysicsServer3D" : "PhysicsServer2D").object();
    return server;
}
Vector vectorOf(const Triple& t) { return {t[0], t[1], t[2]}; }

template <class Result, class... Arguments>
Result get(Which which, bool isSpace, GDExtensionObjectPtr object, const Arguments&... arguments) {
    return spaceOf(isSpace).state[which].call<Result>(object, arguments...);
}
} // namespace

bool findStateMethods() {
    bool all = inTree.find("Node", "is_inside_tree", 36'873'697);
    for (const bool isSpace : {false, true}) {
        Space& its = spaceOf(isSpace);
        const char* const state = isSpace ? "PhysicsDirectBodyState3D" : "PhysicsDirectBodyState2D";
        const char* const server = isSpace ? "PhysicsServer3D" : "PhysicsServer2D";
        for (std::size_t i = 0; i < countOfMethods; ++i)
            all &= its.state[i].find(
                state, isSpace && i == inverseOfInertia ? "get_inverse_inertia_tensor" : methods[i].name,
                isSpace ? methods[i].spaceHash : methods[i].planeHash);
        all &= its.stateOfBody.find(server, "body_get_direct_state", isSpace ? 3'029'727'957 : 1'191'931'871);
        all &= its.listedContacts.find(server, "body_get_max_contacts_reported", 2'198'884'583);
        all &= its.listContacts.find(server, "body_set_max_contacts_reported", 3'411'492'887);
    }
    return all;
}

BodyState BodyState::of(std::uint64_t rid, bool isSpace) {
    BodyState state;
    state.object = spaceOf(isSpace).stateOfBody.call<GDExtensionObjectPtr>(serverOf(isSpace), rid);
    state.isSpace = isSpace;
    return state;
}

void reportContacts(std::uint64_t rid, bool isSpace, int count) {
    const Space& its = spaceOf(isSpace);
    if (its.listedContacts.call<Whole>(serverOf(isSpace), rid) < count)
        its.listContacts.call<Whole>(serverOf(isSpace), rid, Whole{count});
}

bool isInTree(GDExtensionObjectPtr node) { return inTree.call<unsigned char>(node) != 0; }

double BodyState::inverseMass() const { return get<double>(inverseOfMass, isSpace, object); }
bool BodyState::sleeps() const { return get<unsigned char>(sleeping, isSpace, object) != 0; }
Vector BodyState::velocity() const { return vectorOf(get<Triple>(linearVelocity, isSpace, object)); }
Vector BodyState::gravity() const { return vectorOf(get<Triple>(totalGravity, isSpace, object)); }
double BodyState::linearDamp() const { return get<double>(totalLinearDamp, isSpace, object); }
double BodyState::angularDamp() const { return get<double>(totalAngularDamp, isSpace, object); }

Vector BodyState::centre() const {
    const auto t = get<std::array<float, 12>>(transform, isSpace, object); // its origin is last
    const Vector offset = vectorOf(get<Triple>(centreOfMass, isSpace, object));
    const std::size_t origin = isSpace ? 9 : 4;
    return {t[origin] + offset[0], t[origin + 1] + offset[1], isSpace ? t[11] + offset[2] : 0.0};
}

Vector BodyState::spin() const {
    if (isSpace) return vectorOf(get<Triple>(angularVelocity, isSpace, object));
    return {0.0, 0.0, get<double>(angularVelocity, isSpace, object)};
}

std::array<double, 6> BodyState::inverseInertia() const {
    if (!isSpace) return {0.0, 0.0, get<double>(inverseOfInertia, isSpace, object), 0.0, 0.0, 0.0};
    const auto m = get<std::array<float, 9>>(inverseOfInertia, isSpace, object); // by rows
    return {m[0], m[4], m[8], m[1], m[2], m[5]};
}

int BodyState::contacts() const { return static_cast<int>(get<Whole>(contactCount, isSpace, object)); }
Vector BodyState::ofContact(int which, int i) const {
    return vectorOf(get<Triple>(static_cast<Which>(which), isSpace, object, Whole{i}));
}
Vector BodyState::contactPlace(int i) const { return ofContact(contactLocalPosition, i); }
Vector BodyState::contactOtherPlace(int i) const { return ofContact(contactColliderPosition, i); }
Vector BodyState::contactNormal(int i) const { return ofContact(contactLocalNormal, i); }
Vector BodyState::contactOtherVelocity(int i) const { return ofContact(contactColliderVelocity, i); }
std::uint64_t BodyState::contactObject(int i) const {
    return static_cast<std::uint64_t>(get<Whole>(contactColliderId, isSpace, object, Whole{i}));
}
std::uint64_t BodyState::contactBody(int i) const {
    return get<std::uint64_t>(contactCollider, isSpace, object, Whole{i});
}

} // namespace physvib::godot
