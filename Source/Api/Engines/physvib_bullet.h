// SPDX-License-Identifier: MIT
// Bullet 3: attach, give bodies their numbers (setUserIndex, from 0 on); stepSimulation is as before. The field is the plane x, y.
#pragma once
#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <physvib/physvib.h>

/// For as long as the world steps. One callback of each kind is Bullet's limit: call physvib's from yours.
class PhysVibBullet {
public:
    /// Both outlive it; bodies of `name` have the numbers of theirs.
    PhysVibBullet(btDynamicsWorld& world, physvib_world name)
        : name_(name) {
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar dt) { self(w).begin(*w, dt); }, this, true);
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar) { self(w).end(*w); }, this, false);
    }
    /// Before Bullet's step: velocities with which surfaces have met.
    void begin(btDynamicsWorld& world, double dt) {
        physvib_world_begin_step(name_, dt, world.getGravity().length());
        for (int i = 0; i < world.getNumCollisionObjects(); ++i)
            if (const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[i])) {
                const btVector3 &at = body->getCenterOfMassPosition(), &v = body->getLinearVelocity();
                physvib_world_move(name_, body->getUserIndex(), at.x(), at.y(), v.x(), v.y(), body->getAngularVelocity().z());
            }
    }
    /// Behind it: what touches.
    void end(btDynamicsWorld& world) {
        for (int i = 0; i < world.getDispatcher()->getNumManifolds(); ++i) {
            const btPersistentManifold& manifold = *world.getDispatcher()->getManifoldByIndexInternal(i);
            for (int p = 0; p < manifold.getNumContacts(); ++p) {
                const btManifoldPoint& point = manifold.getContactPoint(p);
                if (point.getDistance() > 0 && point.getAppliedImpulse() <= 0) continue; // near, and not yet there
                physvib_contact contact;
                physvib_contact_init(&contact, sizeof contact);
                contact.a = manifold.getBody0()->getUserIndex(), contact.b = manifold.getBody1()->getUserIndex();
                contact.x_m = point.getPositionWorldOnB().x(), contact.y_m = point.getPositionWorldOnB().y();
                contact.normal_x = -point.m_normalWorldOnB.x(), contact.normal_y = -point.m_normalWorldOnB.y();
                contact.impulse_n_s = point.getAppliedImpulse();
                contact.restitution = std::clamp(static_cast<double>(point.m_combinedRestitution), 0.0, 1.0);
                contact.gap_m = point.getDistance(); // at the start of the step
                contact.is_soft = 1; // its impulse also pushes overlaps apart, or lets gaps be closed
                physvib_world_touch(name_, &contact);
            }
        }
        physvib_world_end_step(name_);
    }

private:
    static PhysVibBullet& self(btDynamicsWorld* world) { return *static_cast<PhysVibBullet*>(world->getWorldUserInfo()); }
    physvib_world name_;
};
