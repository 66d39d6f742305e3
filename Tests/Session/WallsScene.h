// SPDX-License-Identifier: MIT
// A ball between two walls, 4 mm of way: each push is one dull hit within the step.
#pragma once
#include "Live/Session/SessionSetup.h"

namespace physvib::test {

inline SessionSetup setupOfWalls() {
    SessionSetup s;
    s.scene.name = "walls";
    s.scene.fieldWidthMetres = s.scene.fieldHeightMetres = 4.0;
    s.scene.normalisation = {0.02, 1.0};
    s.scene.materials = {{"felt", 10.0, 0.0, 0.0, 200.0, 60.0}};
    const auto wall = [&](const char* name, double x) {
        BodyDescription body;
        body.name = name;
        body.type = BodyType::staticBody;
        body.fixtures = {{BoxShape{1.0, 2.0}, {}, 0.0, 0, true}};
        body.positionMetres = {x, 2.0};
        body.massKg = 10.0;
        s.scene.bodies.push_back(body);
    };
    wall("left", 1.298);
    wall("right", 2.702);
    BodyDescription ball;
    ball.name = "ball";
    ball.fixtures = {{CircleShape{0.2}, {}, 0.0, 0}};
    ball.positionMetres = {2.0, 2.0};
    s.scene.bodies.push_back(ball);
    s.seed = 0;
    s.stepsPerSecond = 1000;
    s.longestGapSeconds = driverThreadGapSeconds;
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    s.panner = {layout, PanningLaw::linear, 1, s.scene.fieldWidthMetres, s.scene.fieldHeightMetres};
    return s;
}

/// To the right and to the left in turn.
inline VelocityAction pushOfBall(int i) { return {"ball", {i % 2 == 0 ? 20.0 : -20.0, 0.0}, 0.0}; }

} // namespace physvib::test
