// SPDX-License-Identifier: MIT
// Stands for <box2d/box2d.h> of Box2D 3.1 where there is none: what physvib_box2d3.h asks of it, answered
// from a recording of a ball (body 2) that falls onto a floor (body 1). Names and meanings are Box2D's.
#pragma once
#include <cstdint>

struct b2Vec2 {
    float x, y;
};
struct b2WorldId {
    std::uint16_t index1, generation;
};
struct b2BodyId {
    std::int32_t index1;
    std::uint16_t world0, generation;
};
struct b2ShapeId {
    std::int32_t index1;
    std::uint16_t world0, generation;
};
enum b2BodyType { b2_staticBody = 0, b2_kinematicBody = 1, b2_dynamicBody = 2 };
struct b2ManifoldPoint {
    b2Vec2 point, anchorA, anchorB;
    float separation, totalNormalImpulse, normalVelocity;
    std::uint16_t id;
};
struct b2Manifold {
    b2Vec2 normal;
    b2ManifoldPoint points[2];
    int pointCount;
};
struct b2ContactData {
    b2ShapeId shapeIdA, shapeIdB;
    b2Manifold manifold;
};
struct b2BodyMoveEvent {
    b2BodyId bodyId;
};
struct b2BodyEvents {
    b2BodyMoveEvent* moveEvents;
    int moveCount;
};
#define B2_ID_EQUALS(one, other) ((one).index1 == (other).index1 && (one).generation == (other).generation)

/// One step: the ball's height and speed before it, its speed after it, and its contact.
struct RecordedStep {
    float height, before, after;
    int isTouching;
    float separation, normalVelocity, pushed;
    int id, shapeA;
};
extern const RecordedStep* recordedStep; ///< that is under way; another one follows it
extern bool hasRecordedStepped;          ///< and whether its solver is done
extern int recordedCopies;               ///< how often Box2D lists the contact, each time as another point

constexpr b2BodyId recordedFloor{1, 0, 1}, recordedBall{2, 0, 1};
inline bool isBall(b2BodyId body) { return body.index1 == 2; }
inline b2BodyType b2Body_GetType(b2BodyId body) { return isBall(body) ? b2_dynamicBody : b2_staticBody; }
inline float b2Body_GetMass(b2BodyId body) { return isBall(body) ? 1.0F : 0.0F; }
inline float b2Body_GetRotationalInertia(b2BodyId body) { return isBall(body) ? 0.005F : 0.0F; }
inline float b2Body_GetGravityScale(b2BodyId) { return 1.0F; }
inline bool b2Body_IsAwake(b2BodyId body) { return isBall(body); }
inline bool b2Body_IsValid(b2BodyId body) { return body.generation == 1; }
inline b2Vec2 b2Body_GetWorldCenterOfMass(b2BodyId body) {
    return isBall(body) ? b2Vec2{0.25F, recordedStep[hasRecordedStepped ? 1 : 0].height}
                        : b2Vec2{0.0F, -1.0F};
}
inline b2Vec2 b2Body_GetLinearVelocity(b2BodyId body) {
    return {0.0F, !isBall(body) ? 0.0F : hasRecordedStepped ? recordedStep->after : recordedStep->before};
}
inline float b2Body_GetAngularVelocity(b2BodyId) { return 0.0F; }
inline b2BodyId b2Shape_GetBody(b2ShapeId shape) { return shape.index1 == 1 ? recordedFloor : recordedBall; }
inline float b2Shape_GetRestitution(b2ShapeId) { return 0.5F; }
inline b2Vec2 b2World_GetGravity(b2WorldId) { return {0.0F, -9.81F}; }
inline void b2World_Step(b2WorldId, float, int) { hasRecordedStepped = true; }
inline b2BodyEvents b2World_GetBodyEvents(b2WorldId) {
    static b2BodyMoveEvent moved[] = {{recordedBall}};
    return {moved, 1};
}
struct b2Filter {
    std::uint64_t categoryBits, maskBits;
    int groupIndex;
};
inline bool b2Body_IsEnabled(b2BodyId) { return true; }
inline bool b2Shape_IsSensor(b2ShapeId) { return false; }
inline b2Filter b2Shape_GetFilter(b2ShapeId) { return {1, 1, 0}; }
inline int b2Body_GetShapes(b2BodyId body, b2ShapeId* shapes, int) {
    shapes[0] = {body.index1, 0, 1};
    return 1;
}
inline int b2Body_GetContactCapacity(b2BodyId) { return recordedCopies; }
inline int b2Body_GetContactData(b2BodyId body, b2ContactData* found, int capacity) {
    if (!isBall(body) || recordedStep->isTouching == 0) return 0;
    const int count = recordedCopies < capacity ? recordedCopies : capacity;
    for (int i = 0; i < count; ++i)
        found[i] = {{1, 0, 1},
                    {2, 0, 1},
                    {{0.0F, 1.0F},
                     {{{0.25F, 0.0F},
                       {0.25F, 1.0F},
                       {0.0F, -0.1F},
                       recordedStep->separation,
                       recordedStep->pushed,
                       recordedStep->normalVelocity,
                       static_cast<std::uint16_t>(recordedStep->id + i)},
                      {}},
                     1}};
    return count;
}
