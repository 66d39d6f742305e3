// SPDX-License-Identifier: MIT
// HapticWorld2D and HapticWorld3D: contacts of Godot's physics become events. For Godot's main thread.
#pragma once

#include "Api/Godot/Bodies.h"
#include "Api/Godot/Outputs.h"

#include <map>

namespace physvib::godot {

/// One physics body that is told of.
struct Watched {
    std::uint64_t id;              ///< of Godot's object
    int number;                    ///< of physvib's body
    const HapticBody* values;      ///< null: it only touches what is felt
    bool isRigid, slides;          ///< it has contacts and velocities of its own; is a CharacterBody
    Value body = {}, state = {};   ///< Godot's; of this tick
    physvib_body told = {};        ///< last told
    Vector before = {};            ///< velocity before the solver, m/s, with this tick's gravity
    Vector spin = {}, centre = {}; ///< rad/s and m, before the solver
    Vector pull = {};              ///< of gravity, m/s^2; 0 of a body that does not fall
    Vector change = {};            ///< of velocity by the solver
    Vector at = {}, step = {};     ///< of a CharacterBody: after its last tick, and how far it came in it
};

class HapticWorld final : public Instance {
public:
    HapticWorld(GDExtensionObjectPtr object, bool isSpace);
    ~HapticWorld() override;
    void notified(int what) override;
    void changed() override { isStale = true; }
    std::vector<std::string> warnings() const override;

    void finishStep();     ///< at the start of the next tick, before any script: the solver is done
    Value explain() const; ///< why nothing is felt, in one sentence
    Value timeSeconds() const;
    Value actuatorPlaces(); ///< in units of the scene, also in the editor

private:
    void configure();
    void mapField();
    std::string findLayout(physvib_layout& layout) const; ///< the error; empty: it is there
    void beginStep();
    void watchAll();
    Watched* watch(std::uint64_t id, const HapticBody* values);
    void describe(Watched& watched);
    void moveBefore(Watched& watched);
    void moveAfter(Watched& watched);
    void touchAll(const Watched& watched);
    void touch(const Watched& watched, int contact);
    Watched* other(const Watched& watched, int contact, const Vector& place);
    Watched* moving(std::uint64_t id, const Vector& velocity, const Vector& place);
    void slideAll(Watched& watched);
    double bounceOf(const Value& rid) const;
    void emitAll();
    Vector place(const Vector& v) const;
    Vector direction(const Vector& v) const;
    Value hitOf(const physvib_event& event) const;
    Value objectOf(int number) const; ///< nil: it was freed
    Value server() const;

    double seconds = 0.0; ///< of the step
    bool isSpace, isStale = true, isOpen = false;
    physvib_world world = nullptr;
    double unit = 1.0;
    Vector corner{}; ///< the field's lower left one, in Godot's units
    std::map<std::uint64_t, Watched> watched;
    std::map<int, std::uint64_t> objects; ///< by number
    int next = 0;
    Outputs outputs;
};

extern const Class hapticWorld2dClass, hapticWorld3dClass;

} // namespace physvib::godot
