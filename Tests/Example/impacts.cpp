// SPDX-License-Identifier: MIT
#include <cstdio>
#include <physvib/Physics/Attachment.h>

int main() {
    b2World world({0.0f, -9.81f}); // a Box2D world of your own: a ball falls on the ground
    b2BodyDef body;
    b2PolygonShape slab;
    slab.SetAsBox(1.0f, 0.1f);
    world.CreateBody(&body)->CreateFixture(&slab, 0.0f);
    body.type = b2_dynamicBody;
    body.position.Set(0.3f, 0.9f);
    b2CircleShape disc;
    disc.m_radius = 0.1f;
    b2Fixture* ball = world.CreateBody(&body)->CreateFixture(&disc, 1.0f);
    ball->SetRestitution(0.6f);

    physvib::Attachment haptics(world); // PhysVib: attach, say how the ball vibrates, step
    if (!haptics.set(*ball, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true})) return 1;
    std::vector<physvib::CollisionEvent> impacts;
    for (int step = 0; step < 200; ++step) haptics.step(0.01f);
    haptics.take(impacts);
    for (const auto& hit : impacts) std::printf("%.3f s: amplitude %.2f\n", hit.timeNs * 1e-9, hit.amplitude);
}
