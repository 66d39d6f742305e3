// SPDX-License-Identifier: MIT
// The nodes HapticWorld2D and HapticWorld3D, which turn contacts of Godot's physics into events, and what
// they know of bodies and contacts. For Godot's main thread.
#pragma once
#include "Api/Godot/Binding.h"
#include "Api/Godot/Bodies.h"
#include "Api/Godot/Outputs.h"
#include "Api/Godot/State.h"
#include <map>
#include <optional>
#include <physvib/physvib.h>
#include <set>
#include <unordered_map>

namespace physvib::godot {

/// A contact or a near point of two bodies: `place` is on one and `otherPlace` on the other, in m of the
/// field; the normal has length 1.
struct Surface {
    Vector place, otherPlace, normal;
    double gapMetres; ///< below 0: the bodies overlap
    bool hasNormal;   ///< false: Godot gave no normal
};

/// A body, or another object with collision shapes, that the world observes.
struct ObservedBody {
    std::uint64_t id;      ///< Godot's id of the object, or derived from the RID if it has none
    int number;            ///< the body's number in physvib.h
    Variant object = {};   ///< Godot's object; nil: it has none
    std::uint64_t rid = 0; ///< of the physics server's body; 0: several, as in a TileMapLayer
    const HapticBody* hapticBody = nullptr; ///< null: only its contacts with haptic bodies count
    bool isNode = false;
    bool isRigid = false, isCharacter = false; ///< rigid body; CharacterBody
    bool wasTouched = false;       ///< touched in the last tick; bodies without a node are dropped otherwise
    BodyState state = {};          ///< Godot's physics state in this tick
    physvib_body description = {}; ///< as last given to physvib_world_set_body
    std::uint64_t revision = 0;    ///< count of property changes at the last description; 0: none
    const HapticBody* describedHapticBody = nullptr;
    Vector velocityBefore = {};                ///< velocity before the solver, m/s, with this tick's gravity
    Vector spin = {}, centre = {};             ///< rad/s and m, before the solver
    Vector gravity = {};                       ///< at its place, m/s^2
    Vector acceleration = {};                  ///< by gravity, m/s^2; 0 if the body does not fall
    Vector velocityChange = {};                ///< by the solver, m/s
    Surface support = {};                      ///< its slowest contact in the last tick
    Vector lastPosition = {}, lastTravel = {}; ///< of a CharacterBody in the last tick, m
    bool hasLastPosition = false;              ///< true if `lastPosition` is known
};

/// A contact of two bodies whose strength is known only after the next tick.
struct PendingContact {
    std::uint64_t a, b; ///< ids of the two ObservedBody
    Vector normal;      ///< from a to b
    physvib_contact contact;
    double remainingSpeed; ///< approach speed that remains, m/s
    int ticks = 0;
};

/// A node HapticWorld2D or HapticWorld3D. Each physics tick calls beginStep(), onSolved(), finishStep().
class HapticWorld final : public Instance {
public:
    HapticWorld(GDExtensionObjectPtr object, bool is3d);
    ~HapticWorld() override;
    void onNotification(int what) override;
    void onPropertyChanged() override { isStale = areOutputsStale = true; }
    std::vector<std::string> warnings() const override;

    void beginStep();                      ///< called after all scripts, before the solver
    void onSolved();                       ///< called after the solver, before signals and scripts
    void finishStep();                     ///< called at the start of the next tick, before its scripts
    void onNodeAdded(const Variant& node); ///< called for each node that enters the tree
    Variant explain() const;               ///< why no output vibrates, in one sentence
    Variant recentPeaks() const;           ///< peak sent to each actuator in the last second
    Variant timeSeconds() const;
    Variant actuatorPlaces(); ///< in units of the scene, also in the editor

private:
    void enterTree();
    void leaveTree();
    bool isActive() const; ///< the first world in its physics space; others wait
    void configure();
    void configureOutputs();
    void updateFieldMapping();
    std::string readLayout(physvib_layout& layout) const; ///< returns the error, or empty
    void updateBodies();
    void observeRigidBodies();
    bool exists(const ObservedBody& body) const;
    ObservedBody* findOrAdd(std::uint64_t id, std::uint64_t rid, const HapticBody* hapticBody);
    void removeBodies(); ///< removes all bodies, after ending an open step
    void updateDescription(ObservedBody& body);
    Variant findMaterial(const ObservedBody& body) const; ///< for its PhysicsMaterial; nil: none
    void reportMotion(ObservedBody& body);
    void reportSolvedVelocity(ObservedBody& body);
    void reportTouches(ObservedBody& body);
    double approachSpeed(const ObservedBody& body, const Surface& surface, int contact) const;
    bool involvesHapticBody(const ObservedBody& body, int contact) const;
    static bool doesOtherExist(const ObservedBody& body, int contact);
    void reportTouch(const ObservedBody& body, int contact);
    Surface contactSurface(const ObservedBody& body, int contact) const;
    Surface surfaceAcrossSeams(const ObservedBody& body, const ObservedBody& other, int contact,
                               std::optional<double>& supportSpeed) const;
    double lostSpeed(const ObservedBody& body, const Vector& normal) const;
    void reportOrDefer(const ObservedBody& body, const ObservedBody& other, physvib_contact contact,
                       const Vector& normal, double supportSpeed);
    void resolvePending(); ///< reports contacts that the last tick deferred
    bool reachesSurface(const ObservedBody& body, const ObservedBody& other, const Surface& surface) const;
    ObservedBody* otherBody(const ObservedBody& body, int contact, const Vector& place);
    ObservedBody* addOther(std::uint64_t id, std::uint64_t rid, const Vector& velocity, const Vector& place);
    void reportSlides(ObservedBody& body);
    double readRestitution(std::uint64_t rid);
    void emitEvents();
    physvib_event toScreen(const physvib_event& event) const;
    Vector scenePosition(const physvib_event& event) const;
    Vector toField(const Vector& v) const;
    Vector toFieldVector(const Vector& v) const;
    Vector toFieldSpin(const Vector& spin) const;
    Variant describeHit(const physvib_event& event) const;
    Variant findObject(int number) const; ///< Godot's object of a body; nil: it was freed
    Variant server() const;

    double stepSeconds = 0.0;
    bool is3d, isStale = true, areOutputsStale = true, isStepOpen = false, isSolved = false;
    physvib_world world = nullptr;
    double unitMetres = 1.0;
    Vector fieldOrigin{};    ///< lower left corner of the field, in Godot's units
    std::uint64_t space = 0; ///< RID of the physics server's space
    std::map<std::uint64_t, ObservedBody> bodies;
    std::map<int, std::uint64_t> objectIds;                 ///< instance ids by body number
    std::set<std::uint64_t> rigidBodies;                    ///< all of the space, with or without HapticBody
    std::unordered_map<std::uint64_t, double> restitutions; ///< restitutions read in this tick, by RID
    std::vector<PendingContact> pendingContacts, previousContacts; ///< of this tick, and of the last one
    int nextBodyNumber = 0;
    Outputs outputs;
};

/// Indices of the properties in worldProperties().
enum WorldProperty {
    metresPerUnit,
    fieldCorner,
    fieldSize,
    fieldFromCamera,
    fullScale,
    threshold,
    physicsMaterials,
    outputs,
    layout,
    actuators,
    levelDb,
    silent,
    sessionFile
};
const std::vector<Property>& worldProperties(bool is3d);
extern const ClassTable hapticWorld2dClass, hapticWorld3dClass;

/// A contact at a place of the field, m, with a unit normal from `a` to `b`; other members have defaults.
inline physvib_contact makeContact(const ObservedBody& a, const ObservedBody& b, const Vector& place,
                                   const Vector& normal) {
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = a.number, contact.b = b.number;
    contact.x_m = place[0], contact.y_m = place[1], contact.z_m = place[2];
    contact.normal_x = normal[0], contact.normal_y = normal[1], contact.normal_z = normal[2];
    contact.point_id = PHYSVIB_POINT_BY_PLACE;
    return contact;
}

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Prints the error text of physvib.h in Godot if `code` is an error.
inline void reportIfError(int code) {
    if (code < 0) warn(std::string("HapticWorld: ") + physvib_error());
}

} // namespace physvib::godot
