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

/// A contact of a body, or one that is near: `at` on the body and `there` on the other, m; unit normal.
struct Surface {
    Vector at, there, normal;
    double gap; ///< m; below 0: the bodies overlap
    bool isOne; ///< false: Godot gave no normal
};

/// A body, or another object with collision shapes, that the world observes.
struct Watched {
    std::uint64_t id;                   ///< of Godot's object, or derived from the RID if it has none
    int number;                         ///< of the body in physvib.h
    Value body = {};                    ///< Godot's object; nil: it has none
    std::uint64_t rid = 0;              ///< 0: several, as of a TileMapLayer
    const HapticBody* values = nullptr; ///< its HapticBody; null: it only touches others
    bool isNode = false;
    bool isRigid = false, slides = false; ///< rigid body; CharacterBody
    bool isMet = false;                   ///< touched in the last tick; others than nodes are kept only then
    BodyState state = {};                 ///< of this tick
    physvib_body described = {};          ///< what physvib.h was told last
    std::uint64_t revision = 0;           ///< of properties when it was described; 0: never
    const HapticBody* describedBy = nullptr;
    Vector before = {};            ///< velocity before the solver, m/s, with this tick's gravity
    Vector spin = {}, centre = {}; ///< rad/s and m, before the solver
    Vector gravity = {};           ///< m/s^2, where it is
    Vector pull = {};              ///< gravity, m/s^2; 0 if the body does not fall
    Vector change = {};            ///< of the velocity by the solver, m/s
    Surface under = {};            ///< its slowest contact in the last tick
    Vector at = {}, step = {};     ///< of a CharacterBody: position and travel of the last tick
    bool wasAt = false;            ///< of a CharacterBody: `at` is known
};

/// A contact of two bodies whose strength is known only after the next tick.
struct Doubt {
    std::uint64_t a, b; ///< of Watched
    Vector normal;      ///< from a to b
    physvib_contact contact;
    double left; ///< approach speed that remains, m/s
    int ticks = 0;
};

class HapticWorld final : public Instance {
public:
    HapticWorld(GDExtensionObjectPtr object, bool isSpace);
    ~HapticWorld() override;
    void notified(int what) override;
    void changed() override { isStale = areOutputsStale = true; }
    std::vector<std::string> warnings() const override;

    void beginStep();              ///< called after all scripts, before the solver
    void solved();                 ///< called after the solver, before signals and scripts
    void finishStep();             ///< called at the start of the next tick, before its scripts
    void added(const Value& node); ///< called for each node that enters the tree
    Value explain() const;         ///< why nothing is felt, in one sentence
    Value left() const;            ///< peak sent to each actuator in the last second
    Value timeSeconds() const;
    Value actuatorPlaces(); ///< in units of the scene, also in the editor

private:
    void enter();
    void leave();
    bool isFirst() const; ///< first world of its space; the others wait
    void configure();
    void configureOutputs();
    void mapField();
    std::string findLayout(physvib_layout& layout) const; ///< returns the error, or empty
    void watchAll();
    void watchStrikers();
    bool isThere(const Watched& watched) const;
    Watched* watch(std::uint64_t id, std::uint64_t rid, const HapticBody* values);
    void forget(); ///< all bodies; ends an open step
    void describe(Watched& watched);
    Value materialOf(const Watched& watched) const; ///< by its PhysicsMaterial; nil: none
    void moveBefore(Watched& watched);
    void moveAfter(Watched& watched);
    void touchAll(Watched& watched);
    double approach(const Watched& watched, const Surface& surface, int contact) const;
    bool isOfInterest(const Watched& watched, int contact) const;
    static bool isOtherThere(const Watched& watched, int contact);
    void touch(const Watched& watched, int contact);
    Surface surfaceOf(const Watched& watched, int contact) const;
    Surface overSeams(const Watched& watched, const Watched& met, int contact,
                      std::optional<double>& doubt) const;
    double pushOf(const Watched& watched, const Vector& normal) const;
    void strikeDoubtful(const Watched& watched, const Watched& met, physvib_contact contact,
                        const Vector& normal, double known);
    void decide(); ///< reports contacts that the last tick deferred
    bool getsThere(const Watched& watched, const Watched& met, const Surface& surface) const;
    Watched* other(const Watched& watched, int contact, const Vector& place);
    Watched* moving(std::uint64_t id, std::uint64_t rid, const Vector& velocity, const Vector& place);
    void slideAll(Watched& watched);
    double bounceOf(std::uint64_t rid);
    void emitAll();
    physvib_event asSeen(const physvib_event& event) const;
    Vector inScene(const physvib_event& event) const;
    Vector place(const Vector& v) const;
    Vector direction(const Vector& v) const;
    Vector turn(const Vector& spin) const;
    Value hitOf(const physvib_event& event) const;
    Value objectOf(int number) const; ///< nil: it was freed
    Value server() const;

    double seconds = 0.0; ///< duration of the step
    bool isSpace, isStale = true, areOutputsStale = true, isOpen = false, isSolved = false;
    physvib_world world = nullptr;
    double unit = 1.0;
    Vector corner{};         ///< lower left one of the field, in Godot's units
    std::uint64_t space = 0; ///< RID of the physics server's space
    std::map<std::uint64_t, Watched> watched;
    std::map<int, std::uint64_t> objects; ///< instance ids by body number
    std::set<std::uint64_t> rigidBodies;  ///< of the space, whether they have a HapticBody or not
    std::unordered_map<std::uint64_t, double> bounces; ///< of this tick, by RID
    std::vector<Doubt> doubts, decided;                ///< of this tick, of the last
    int next = 0;
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
const std::vector<Property>& worldProperties(bool isSpace);
extern const Class hapticWorld2dClass, hapticWorld3dClass;

/// A contact at a place of the field, m, with a unit normal from `a` to `b`; other members have defaults.
inline physvib_contact contactOf(const Watched& a, const Watched& b, const Vector& at, const Vector& normal) {
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = a.number, contact.b = b.number;
    contact.x_m = at[0], contact.y_m = at[1], contact.z_m = at[2];
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
inline void checkWorld(int code) {
    if (code < 0) report(std::string("HapticWorld: ") + physvib_error());
}

} // namespace physvib::godot
