// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds of the physics benchmarks and of instructions.sh: a shaken box, and balls that roll to and fro.
#pragma once
#include "Physics/Attachment.h"
#include <cmath>
#include <random>
#include <vector>

namespace physvib::bench {

constexpr float stepSeconds = 0.01F;

/// `bodies` circles and boxes of 0.1 to 0.3 m in a box that they fill to about a third.
class ShakenBox {
public:
    explicit ShakenBox(int bodies)
        : side_(std::sqrt(0.12F * static_cast<float>(bodies))) {
        const b2BodyDef def;
        ground_ = world.CreateBody(&def);
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {side_, 0.0F}, {side_, side_}, {0.0F, side_}};
        for (int i = 0; i < 4; ++i) {
            b2EdgeShape edge;
            edge.SetTwoSided(corners[i], corners[(i + 1) % 4]);
            walls.push_back(ground_->CreateFixture(&edge, 0.0F));
        }
        const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(bodies))));
        for (int i = 0; i < bodies; ++i)
            addBody(i % columns, i / columns, side_ / static_cast<float>(columns));
    }

    /// Gravity of a box that is jerked to and fro.
    void shake(int step) {
        constexpr int stepsPerShake = 25;
        const bool isForth = step / stepsPerShake % 2 == 0;
        world.SetGravity({isForth ? 20.0F : -20.0F, -9.8F});
    }

    /// Gives all fixtures values. `cameras`: 0: none is one, 4: the walls are, more: all bodies as well.
    void setAll(Attachment& attachment, int cameras) const {
        const HapticFixture wall{349.0, 107.0, cameras > 0, 340.0, Voice::own};
        const HapticFixture object{200.0, 30.0, cameras > 4, 0.0, Voice::own};
        for (b2Fixture* fixture : walls) (void)attachment.set(*fixture, wall);
        for (b2Fixture* fixture : objects) (void)attachment.set(*fixture, object);
    }

    int touching() const {
        int count = 0;
        for (const b2Contact* contact = world.GetContactList(); contact != nullptr;
             contact = contact->GetNext())
            count += contact->IsTouching() ? 1 : 0;
        return count;
    }

    b2World world{{0.0F, -9.8F}};
    std::vector<b2Fixture*> walls, objects;

private:
    void addBody(int column, int row, float pitch) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.allowSleep = false;
        def.position = {pitch * (static_cast<float>(column) + 0.5F),
                        pitch * (static_cast<float>(row) + 0.5F)};
        const float size = 0.05F + 0.1F * static_cast<float>(random_() % 1000) / 1000.0F;
        b2CircleShape circle;
        circle.m_radius = size;
        b2PolygonShape box;
        box.SetAsBox(size, size);
        b2FixtureDef fixture;
        fixture.shape = random_() % 2 == 0 ? static_cast<const b2Shape*>(&circle) : &box;
        fixture.density = 500.0F;
        fixture.friction = 0.4F;
        fixture.restitution = 0.5F;
        objects.push_back(world.CreateBody(&def)->CreateFixture(&fixture));
    }

    float side_;
    b2Body* ground_ = nullptr;
    std::mt19937 random_{1};
};

/// Balls that roll to and fro on a floor with grains that are so far apart (0: smooth), at up to 1.3 m/s.
struct RollingBalls {
    /// `grainMetres`: 0: a smooth floor, below 0: Box2D alone.
    RollingBalls(int count, double grainMetres)
        : isAlone{grainMetres < 0.0} {
        const b2BodyDef def;
        b2EdgeShape edge;
        edge.SetTwoSided({-1.0e4F, 0.0F}, {1.0e4F + 2.0F * static_cast<float>(count), 0.0F});
        b2Fixture& floor = *world.CreateBody(&def)->CreateFixture(&edge, 0.0F);
        HapticFixture rough{250.0, 60.0, true, 340.0, Voice::own};
        rough.texture.grainMetres = grainMetres;
        if (isAlone)
            attachment.detach();
        else
            (void)attachment.set(floor, rough);
        for (int i = 0; i < count; ++i) {
            b2BodyDef ball;
            ball.type = b2_dynamicBody;
            ball.allowSleep = false;
            ball.position = {2.0F * static_cast<float>(i), 0.25F};
            b2CircleShape circle;
            circle.m_radius = 0.25F;
            world.CreateBody(&ball)->CreateFixture(&circle, 10.0F)->SetFriction(0.9F);
        }
    }
    void step(int n) {
        world.SetGravity({n / 100 % 2 == 0 ? 2.0F : -2.0F, -9.8F});
        events.clear();
        if (isAlone) return world.Step(stepSeconds, 8, 3);
        attachment.step(stepSeconds);
        attachment.take(events);
    }
    bool isAlone;
    b2World world{{0.0F, -9.8F}};
    Attachment attachment{world};
    std::vector<CollisionEvent> events;
};

} // namespace physvib::bench
