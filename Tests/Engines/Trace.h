// SPDX-License-Identifier: MIT
// A world that was written as text, through an engine: its motion and its events, as text. worlds.py writes
// the one and judges the other.
#pragma once
#include "Engine.h"
#include <cstdio>
#include <fstream>
#include <map>

namespace scenes {

/// Impulses are amplitudes: A* is 1, and no hand; or by full scale, where masses do not matter.
inline physvib_world plainWorld(double fullScaleImpulse = 0.0) {
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.normalisation_s_per_m = 1.0;
    settings.hand_mass_kg = 0.0;
    settings.full_scale_impulse_n_s = fullScaleImpulse;
    physvib_world world = nullptr;
    physvib_world_create(&settings, &world);
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    physvib_world_set_body(world, floorBody, &body);
    return world;
}

inline void printMotions(const Engine& engine, const std::map<int, Body>& moving, int step) {
    for (const auto& [id, body] : moving) {
        const Motion now = engine.motion(id);
        std::printf("m %d %d %.7g %.7g %.7g %.7g %.7g %.7g\n", step, id, now.x, now.y, now.vx, now.vy,
                    now.spin, now.angle);
    }
}

/// `m STEP BODY x y vx vy spin angle` behind each step (step 0: at first), then `e SECONDS BODY OTHER IMPULSE
/// x y KIND` for each event.
inline int trace(Engine& engine, const char* path) {
    std::ifstream file(path);
    std::map<int, Body> moving;
    std::string word;
    int steps = 0;
    bool isWeightless = false;
    double grain = 0.0;
    double late = 0.0;                     // s, half a step: ends of steps lie on the exact path
    double ax = 0.0, ay = 0.0, turn = 0.0; // accelerations at first
    while (file >> word) {
        if (word == "world") {
            double rate = 0, friction = 0, elasticity = 0, seconds = 0;
            file >> rate >> elasticity >> friction >> seconds;
            steps = static_cast<int>(rate * seconds);
            engine.world = plainWorld();
            engine.begin(1.0 / rate, isWeightless ? 0.0 : gravity, elasticity, friction);
            late = (engine.movesFirst ? -0.5 : 0.5) / rate / engine.subSteps;
        } else if (word == "ball" || word == "box") {
            Body body;
            body.isBox = word == "box";
            file >> body.id >> body.x >> body.y >> body.angle >> body.width >> body.height >> body.massKg >>
                body.vx >> body.vy >> body.spin >> body.isSource;
            body.vx -= late * ax, body.vy -= late * ay, body.spin -= late * turn;
            body.grain = grain;
            engine.add(body);
            if (body.massKg > 0) moving.emplace(body.id, body);
        } else if (word == "pin") {
            int a = 0, b = 0;
            double x = 0, y = 0;
            file >> a >> b >> x >> y;
            engine.pin(a, b, x, y);
        } else if (word == "oneway") {
            int body = 0;
            file >> body;
            engine.oneWay(body);
        } else if (word == "falling") { // those that follow
            ay = -gravity;
        } else if (word == "starting") { // the same of others
            file >> ax >> ay >> turn;
        } else if (word == "weightless") { // before the world
            isWeightless = true;
        } else if (word == "grain") { // of still bodies that follow; what rolls there speaks with their voice
            file >> grain;
        } else if (word == "floor") {
            engine.floor();
        } else if (word == "tiles") {
            double left = 0, right = 0;
            int count = 0;
            file >> left >> right >> count;
            engine.tiles(left, right, count);
        } else {
            return std::fprintf(
                       stderr,
                       "%s: %s: expected weightless, world, ball, box, pin, oneway, falling, starting, "
                       "grain, floor or tiles\n",
                       path, word.c_str()),
                   1;
        }
    }
    printMotions(engine, moving, 0);
    for (int step = 1; step <= steps; ++step) {
        engine.step();
        printMotions(engine, moving, step);
    }
    for (const auto& event : engine.take())
        std::printf("e %.9f %d %d %.7g %.7g %.7g %d\n", static_cast<double>(event.time_ns) * 1e-9,
                    event.fixture, event.other, event.impulse_n_s, event.x_m, event.y_m, event.kind);
    return 0;
}

} // namespace scenes
