// SPDX-License-Identifier: MIT
// Bullet 3: construct PhysVibBullet, number the bodies (setUserIndex, from 0), and call stepSimulation as
// usual. The field is the x, y plane. C++17 and later.
#pragma once
#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <physvib/physvib.h>
#include <string>

/// Must exist while the world steps. Bullet has one tick callback of each kind; programs with callbacks of
/// their own call begin() and end() from them.
class PhysVibBullet {
public:
    /// Both arguments outlive this object; bodies have the same numbers in both.
    PhysVibBullet(btDynamicsWorld& world, physvib_world name)
        : name_(name) {
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar dt) { self(w).begin(*w, dt); }, this,
                                      true);
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar) { self(w).end(*w); }, this, false);
    }
    /// The first error so far, e.g. a touching body without a number; empty: none.
    const std::string& error() const { return error_; }

    /// Before Bullet's step: reports the velocities at which surfaces meet.
    void begin(btDynamicsWorld& world, double dt) {
        check(physvib_world_begin_step(name_, dt, world.getGravity().length()));
        for (int i = 0; i < world.getNumCollisionObjects(); ++i)
            if (const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[i]);
                body != nullptr && body->getUserIndex() >= 0) {
                const btVector3 &at = body->getCenterOfMassPosition(), &v = body->getLinearVelocity();
                check(physvib_world_move(name_, body->getUserIndex(), at.x(), at.y(), v.x(), v.y(),
                                         body->getAngularVelocity().z()));
            }
    }
    /// After Bullet's step: reports the contacts.
    void end(btDynamicsWorld& world) {
        for (int i = 0; i < world.getDispatcher()->getNumManifolds(); ++i) {
            const btPersistentManifold& manifold = *world.getDispatcher()->getManifoldByIndexInternal(i);
            // a trigger volume
            if (!manifold.getBody0()->hasContactResponse() || !manifold.getBody1()->hasContactResponse())
                continue;
            for (int p = 0; p < manifold.getNumContacts(); ++p) {
                const btManifoldPoint& point = manifold.getContactPoint(p);
                // near, but not touching yet
                if (point.getDistance() > 0 && point.getAppliedImpulse() <= 0) continue;
                physvib_contact contact;
                physvib_contact_init(&contact, sizeof contact);
                contact.a = manifold.getBody0()->getUserIndex(),
                contact.b = manifold.getBody1()->getUserIndex();
                contact.x_m = point.getPositionWorldOnB().x(), contact.y_m = point.getPositionWorldOnB().y();
                const btVector3 normal = inPlane(-point.m_normalWorldOnB);
                if (normal.isZero()) continue; // the normal is across the field
                contact.normal_x = normal.x(), contact.normal_y = normal.y();
                contact.impulse_n_s = point.getAppliedImpulse();
                contact.restitution = std::clamp(static_cast<double>(point.m_combinedRestitution), 0.0, 1.0);
                contact.gap_m = point.getDistance();  // at the start of the step
                contact.is_soft = PHYSVIB_SOFT_WHOLE; // the impulse also separates overlaps, or lets gaps
                                                      // close
                contact.point_id = PHYSVIB_POINT_BY_PLACE;
                check(physvib_world_touch(name_, &contact));
            }
        }
        check(physvib_world_end_step(name_));
    }
    /// Why nothing is felt since the last call, in one sentence: error(), or what physvib_world_explain says
    /// after a look at all bodies.
    std::string explain(const btDynamicsWorld& world) const {
        if (!error_.empty()) return error_;
        for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
            const btCollisionObject& body = *world.getCollisionObjectArray()[i];
            const int note = noteOf(world, body);
            if (note >= 0 && body.getUserIndex() >= 0) physvib_world_note(name_, body.getUserIndex(), note);
        }
        char text[512] = "";
        physvib_world_explain(name_, text, sizeof text);
        return text;
    }

private:
    // PHYSVIB_NOTE_..., or -1
    static int noteOf(const btDynamicsWorld& world, const btCollisionObject& body) {
        if (body.getActivationState() == DISABLE_SIMULATION) return PHYSVIB_NOTE_DISABLED;
        if (!body.hasContactResponse()) return PHYSVIB_NOTE_SENSOR;
        bool hasOthers = false, mayTouch = false;
        const btBroadphaseProxy* const own = body.getBroadphaseHandle();
        for (int i = 0; i < world.getNumCollisionObjects() && own != nullptr; ++i) {
            const btBroadphaseProxy* const other = world.getCollisionObjectArray()[i]->getBroadphaseHandle();
            if (other == nullptr || other == own) continue;
            hasOthers = true;
            mayTouch |= (own->m_collisionFilterGroup & other->m_collisionFilterMask) != 0 &&
                        (other->m_collisionFilterGroup & own->m_collisionFilterMask) != 0;
        }
        if (hasOthers && !mayTouch) return PHYSVIB_NOTE_FILTERED;
        return body.getActivationState() == ISLAND_SLEEPING && !body.isStaticObject() ? PHYSVIB_NOTE_ASLEEP
                                                                                      : -1;
    }
    static PhysVibBullet& self(btDynamicsWorld* world) {
        return *static_cast<PhysVibBullet*>(world->getWorldUserInfo());
    }
    static btVector3 inPlane(const btVector3& normal) {
        const btVector3 flat(normal.x(), normal.y(), 0);
        return flat.length2() < btScalar(0.25) ? btVector3(0, 0, 0) : flat.normalized();
    }
    void check(int code) {
        if (code < 0 && error_.empty()) error_ = physvib_error();
    }
    physvib_world name_;
    std::string error_;
};
