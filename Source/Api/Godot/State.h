// SPDX-License-Identifier: MIT
// Reads Godot's state of a rigid body (PhysicsDirectBodyState2D or 3D) by pointer, since dozens of values are
// read per body and tick. Units and axes are Godot's. For Godot's main thread.
#pragma once
#include "Api/Godot/Binding.h"

namespace physvib::godot {
/// Looks up the methods, once, before all other calls. False: this Godot lacks a method.
bool findStateMethods();

/// What Godot's physics says of a rigid body in this tick, and of its contacts 0 to contacts() - 1.
class BodyState {
public:
    BodyState() = default; ///< no body: converts to false
    /// `rid`: a body in a scene tree. The result is valid until the next call, and as long as the body is.
    static BodyState find(std::uint64_t rid, bool is3d);
    explicit operator bool() const { return object != nullptr; }

    double inverseMass() const;
    bool isSleeping() const;
    Vector centre() const; ///< of mass, in the scene
    Vector velocity() const;
    Vector spin() const; ///< rad/s; in 2D about z, clockwise as seen
    Vector gravity() const;
    double linearDamp() const;
    double angularDamp() const;
    /// xx, yy, zz, xy, xz, yz; in 2D only zz is not 0.
    std::array<double, 6> inverseInertia() const;

    int contacts() const;
    Vector contactPosition(int i) const;      ///< on this body
    Vector contactOtherPosition(int i) const; ///< on the other body
    Vector contactNormal(int i) const;        ///< towards this body
    Vector contactOtherVelocity(int i) const;
    std::uint64_t contactOtherId(int i) const; ///< id of the other's node; 0: it has none
    std::uint64_t contactRid(int i) const;     ///< RID of the other body

private:
    Vector contactVector(int method, int i) const;
    GDExtensionObjectPtr object = nullptr;
    bool is3d = false;
};

/// Makes Godot list at least `count` contacts of the body per tick from now on. This changes neither its
/// motion nor the `contact_monitor` of its node.
void requestContactReports(std::uint64_t rid, bool is3d, int count);
/// True if `node`, a Node, is in a scene tree.
bool isInTree(GDExtensionObjectPtr node);

} // namespace physvib::godot
