// SPDX-License-Identifier: MIT
// Godot's state of a rigid body (PhysicsDirectBodyState2D or 3D), of which dozens of values are read per body
// and tick: by pointer. In Godot's units, y as Godot has it. For Godot's main thread.
#pragma once

#include "Api/Godot/Binding.h"

namespace physvib::godot {

/// False: this Godot lacks a method. Once, before the rest.
bool findStateMethods();

class BodyState {
public:
    BodyState() = default; ///< of no body
    /// `rid` of a body in a scene tree. Valid until the next call of its kind, and while the body is there.
    static BodyState of(std::uint64_t rid, bool isSpace);
    explicit operator bool() const { return object != nullptr; }

    double inverseMass() const;
    bool sleeps() const;
    Vector centre() const; ///< of mass, in the scene
    Vector velocity() const;
    Vector spin() const; ///< in the plane about z, as Godot turns there: clockwise as seen
    Vector gravity() const;
    double linearDamp() const;
    double angularDamp() const;
    /// xx, yy, zz, xy, xz, yz; in the plane zz alone.
    std::array<double, 6> inverseInertia() const;

    int contacts() const;
    Vector contactPlace(int i) const;      ///< on this body
    Vector contactOtherPlace(int i) const; ///< on the other body
    Vector contactNormal(int i) const;     ///< towards this body
    Vector contactOtherVelocity(int i) const;
    std::uint64_t contactObject(int i) const; ///< id of the other's node; 0: it has none
    std::uint64_t contactBody(int i) const;   ///< RID of the other body

private:
    Vector ofContact(int which, int i) const;
    GDExtensionObjectPtr object = nullptr;
    bool isSpace = false;
};

/// Godot lists at least that many contacts of the body in each tick from now on. Its motion stays, and its
/// node's own `contact_monitor` too.
void reportContacts(std::uint64_t rid, bool isSpace, int count);
/// Of a Node.
bool isInTree(GDExtensionObjectPtr node);

} // namespace physvib::godot
