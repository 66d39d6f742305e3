// SPDX-License-Identifier: MIT
// Bullet 3: construct PhysVibBullet, number the bodies (setUserIndex, from 0), and call stepSimulation as
// usual. Contacts are those in space; the field is the x, y plane, and z goes across it. C++17 and later.
#pragma once
#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <physvib/physvib.h>
#include <string>

/// Must exist while the world steps. Bullet has one tick callback of each kind; programs with callbacks of
/// their own call begin() and end() from them.
class PhysVibBullet {
public:
    /// Of a game whose bodies stay in the x, y plane (setLinearFactor, setAngularFactor): all contacts count
    /// at z = 0, normals are projected onto the plane; more than 60 degrees out of it, a contact is left out.
    enum Contacts { inSpace, inPlane };

    /// Both arguments outlive this object; bodies have the same numbers in both.
    PhysVibBullet(btDynamicsWorld& world, physvib_world name, Contacts contacts = inSpace)
        : name_(name)
        , isPlane_(contacts == inPlane) {
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar dt) { self(w).begin(*w, dt); }, this,
                                      true);
        world.setInternalTickCallback([](btDynamicsWorld* w, btScalar) { self(w).end(*w); }, this, false);
    }
    /// The first error so far, e.g. a touching body without a number; empty: none.
    const std::string& error() const { return error_; }

    /// Before Bullet's step: reports the velocities at which surfaces meet.
    void begin(btDynamicsWorld& world, double dt) {
        check(physvib_world_begin_step(name_, dt, world.getGravity().length()));
        seconds_ = dt;
        for (int i = 0; i < world.getNumCollisionObjects(); ++i)
            if (const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[i]);
                body != nullptr && body->getUserIndex() >= 0)
                move(*body);
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
                contact.a = manifold.getBody0()->getUserIndex();
                contact.b = manifold.getBody1()->getUserIndex();
                contact.x_m = point.getPositionWorldOnB().x(), contact.y_m = point.getPositionWorldOnB().y();
                const btVector3 normal = isPlane_ ? flat(-point.m_normalWorldOnB) : -point.m_normalWorldOnB;
                if (normal.isZero()) continue; // the normal is across the field
                contact.normal_x = normal.x(), contact.normal_y = normal.y(), contact.normal_z = normal.z();
                contact.z_m = isPlane_ ? 0 : point.getPositionWorldOnB().z();
                contact.impulse_n_s = point.getAppliedImpulse();
                contact.restitution = bounce(manifold, point);
                // at the start of the step, to which kinematic bodies have come already
                contact.gap_m = point.getDistance() + ahead(*manifold.getBody0(), point, -1) +
                                ahead(*manifold.getBody1(), point, 1);
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
    // A contact that continuous collision predicts has restitution 0: the rest of the speed bounces a step
    // later.
    static double bounce(const btPersistentManifold& of, const btManifoldPoint& point) {
        const btRigidBody *a = btRigidBody::upcast(of.getBody0()), *b = btRigidBody::upcast(of.getBody1());
        const double told = std::clamp(double(point.m_combinedRestitution), 0.0, 1.0);
        if (a == nullptr || b == nullptr || told > 0 || point.getDistance() <= 0) return told;
        const btVector3 &at = point.getPositionWorldOnB(), &n = point.m_normalWorldOnB;
        const double left = n.dot(b->getVelocityInLocalPoint(at - b->getCenterOfMassPosition()) -
                                  a->getVelocityInLocalPoint(at - a->getCenterOfMassPosition()));
        const double was = left + point.getAppliedImpulse() * (a->computeImpulseDenominator(at, n) +
                                                               b->computeImpulseDenominator(at, n));
        return was > left ? std::clamp(a->getRestitution() * b->getRestitution() * left / was, 0.0, 1.0) : 0;
    }
    void move(const btRigidBody& body) {
        const btVector3 &at = body.getCenterOfMassPosition(), &v = body.getLinearVelocity(),
                        &spin = body.getAngularVelocity(), &free = body.getAngularFactor();
        const int id = body.getUserIndex();
        check(
            physvib_world_set_mass(name_, id, body.isStaticOrKinematicObject() ? 0 : 1 / body.getInvMass()));
        if (isPlane_) return check(physvib_world_move(name_, id, at.x(), at.y(), v.x(), v.y(), spin.z()));
        const btMatrix3x3& inverse = body.getInvInertiaTensorWorld();
        const double centre[] = {at.x(), at.y(), at.z()}, velocity[] = {v.x(), v.y(), v.z()},
                     turns[] = {spin.x(), spin.y(), spin.z()};
        const auto of = [&](int i, int j) { return double(inverse[i][j] * free[i] * free[j]); };
        const double turning[] = {of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2)};
        check(physvib_world_move_in_space(name_, id, centre, velocity, turns, turning));
    }
    // How far it went in this step towards the other, before Bullet looked for contacts.
    double ahead(const btCollisionObject& of, const btManifoldPoint& at, btScalar sign) const {
        const btRigidBody* body = btRigidBody::upcast(&of);
        if (body == nullptr || !body->isKinematicObject()) return 0;
        const btVector3 arm = at.getPositionWorldOnB() - body->getCenterOfMassPosition();
        return seconds_ * double(sign * at.m_normalWorldOnB.dot(body->getVelocityInLocalPoint(arm)));
    }
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
    static btVector3 flat(const btVector3& normal) {
        const btVector3 part(normal.x(), normal.y(), 0);
        return part.length2() < btScalar(0.25) ? btVector3(0, 0, 0) : part.normalized();
    }
    void check(int code) {
        if (code < 0 && error_.empty()) error_ = physvib_error();
    }
    physvib_world name_;
    bool isPlane_;
    double seconds_ = 0;
    std::string error_;
};
