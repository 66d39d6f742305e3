// SPDX-License-Identifier: MIT
// Computes the motion of contact points along surfaces, for a face and a corner or disc, and for two discs.
// Both have a closed form.
#include "Physics/SurfacePaths.h"
#include "Physics/WorldNames.h"

namespace physvib {

namespace {

/// One side of a contact.
struct Side {
    const b2Body& body;
    bool isDisc, isRough;
    float radius;

    Side(const b2Fixture& f, bool rough)
        : body{*f.GetBody()}
        , isDisc{f.GetType() == b2Shape::e_circle}
        , isRough{rough}
        , radius{f.GetShape()->m_radius} {}

    /// Position of the point on a disc's circumference in that direction, and its speed if the direction
    /// rotates at `radiansPerSecond`.
    SurfacePath around(b2Vec2 direction, float radiansPerSecond) const {
        if (!isDisc || !isRough) return {}; // a corner, or a surface without texture
        const b2Vec2 local = body.GetLocalVector(direction);
        return {static_cast<double>(radius * b2Atan2(local.y, local.x)),
                static_cast<double>(radius * (radiansPerSecond - body.GetAngularVelocity()))};
    }
};

/// For the point of `on`, given in its body's frame, that touches `face`.
void describeFace(const Side& face, const Side& on, b2Vec2 normalFromFace, b2Vec2 localPlace,
                  LastingPoint& point, SurfacePath& alongFace, SurfacePath& alongOn) {
    const b2Vec2 place = on.body.GetWorldPoint(localPlace), tangent = b2Cross(normalFromFace, 1.0F);
    const b2Vec2 velocity = on.body.GetLinearVelocityFromWorldPoint(place);
    const float turn = face.body.GetAngularVelocity();
    alongFace = {
        static_cast<double>(b2Dot(face.body.GetLocalPoint(place), face.body.GetLocalVector(tangent))),
        static_cast<double>(b2Dot(velocity - face.body.GetLinearVelocityFromWorldPoint(place), tangent))};
    alongOn = on.around(-normalFromFace, turn);
    point.metresPerSecond = toVector(velocity - on.radius * b2Cross(turn, normalFromFace));
}

/// Two discs, or a disc and a corner: the contact point lies on the line between the centres.
void describeDiscs(const Side& a, const Side& b, b2Vec2 centreA, b2Vec2 centreB, b2Vec2 normal,
                   LastingPoint& point) {
    const b2Vec2 velocityA = a.body.GetLinearVelocityFromWorldPoint(centreA),
                 velocityB = b.body.GetLinearVelocityFromWorldPoint(centreB);
    const float distance = b2Distance(centreA, centreB);
    const float turn = distance > b2_epsilon ? b2Cross(normal, velocityB - velocityA) / distance : 0.0F;
    point.onA = a.around(normal, turn);
    point.onB = b.around(-normal, turn);
    point.metresPerSecond = toVector(velocityA + a.radius * b2Cross(turn, normal));
}

std::uint64_t featureOf(const b2Contact& contact, const b2ManifoldPoint& point) {
    const auto child = [](int index) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(index));
    };
    return (child(contact.GetChildIndexA()) << 40U ^ child(contact.GetChildIndexB()) << 16U) *
               0x9E3779B97F4A7C15U ^
           point.id.key;
}

} // namespace

void tellLasting(const b2Contact& contact, const b2WorldManifold& world, const b2ContactImpulse& impulse,
                 unsigned collisions, std::int32_t a, std::int32_t b, LastingContacts& lasting) {
    const b2Manifold& manifold = *contact.GetManifold();
    const Side sideA{*contact.GetFixtureA(), lasting.isRough(a)},
        sideB{*contact.GetFixtureB(), lasting.isRough(b)};
    const b2Vec2 tangent = b2Cross(world.normal, 1.0F);
    for (int i = 0; i < impulse.count; ++i) {
        if ((collisions >> i & 1U) != 0) continue;
        const b2ManifoldPoint& local = manifold.points[i];
        LastingPoint point;
        switch (manifold.type) {
        case b2Manifold::e_circles:
            describeDiscs(sideA, sideB, sideA.body.GetWorldPoint(manifold.localPoint),
                          sideB.body.GetWorldPoint(local.localPoint), world.normal, point);
            break;
        case b2Manifold::e_faceA:
            describeFace(sideA, sideB, world.normal, local.localPoint, point, point.onA, point.onB);
            break;
        case b2Manifold::e_faceB:
            describeFace(sideB, sideA, -world.normal, local.localPoint, point, point.onB, point.onA);
            break;
        }
        point.a = a;
        point.b = b;
        point.feature = featureOf(contact, local);
        point.normalNewtonSeconds = static_cast<double>(impulse.normalImpulses[i]);
        point.point = toVector(world.points[i]);
        const b2Vec2 at = world.points[i];
        point.slipMetresPerSecond = static_cast<double>(b2Dot(
            sideB.body.GetLinearVelocityFromWorldPoint(at) - sideA.body.GetLinearVelocityFromWorldPoint(at),
            tangent));
        lasting.touch(point);
    }
}

} // namespace physvib
