// SPDX-License-Identifier: MIT
// An engine in the hands of the kit (Tests/JavaScript/kit.mjs), which writes lines and reads answers: first
// the verbs that the engine knows, then what is asked for. Lengths are metres, y points up.
#pragma once
#include "Trace.h"
#include <cstdlib>
#include <iostream>
#include <string>

namespace scenes {

/// A number, NaN too.
inline double number() {
    std::string word;
    std::cin >> word;
    return std::strtod(word.c_str(), nullptr);
}
inline int whole() { return static_cast<int>(number()); }

inline Body bodyOfKit() {
    Body body;
    body.id = whole(), body.isBox = whole() != 0;
    for (double* value : {&body.x, &body.y, &body.angle, &body.width, &body.height, &body.massKg, &body.vx,
                          &body.vy, &body.spin})
        *value = number();
    body.type = static_cast<Type>(whole()), body.turns = whole() == 0;
    body.isSensor = whole() != 0, body.isBullet = whole() != 0;
    return body;
}

/// `world g restitution friction rate`, `body`, `feel ID`, `step SECONDS`, `get ID`, `take`, `explain`,
/// `pin A B x y`, and act()'s `VERB ID x y z`.
inline int kit(Engine& engine) {
    std::cout << "> " << engine.verbs << std::endl;
    std::map<int, Body> bodies;
    std::cout.precision(12);
    for (std::string word; std::cin >> word;) {
        if (word == "world") {
            const double g = number(), restitution = number(), friction = number();
            engine.world = plainWorld(engine.fullScale = 1.0);
            engine.begin(1.0 / number(), g, restitution, friction);
        } else if (word == "body") {
            const Body body = bodyOfKit();
            engine.add(bodies[body.id] = body);
        } else if (word == "feel") {
            Body& body = bodies[whole()];
            body.isSource = true;
            engine.feel(body);
        } else if (word == "step") {
            engine.dt = number();
            engine.step();
        } else if (word == "get") {
            const Motion now = engine.motion(whole());
            std::cout << "> ";
            for (const double value : {now.x, now.y, now.vx, now.vy, now.angle, now.spin})
                std::cout << value << ' ';
            std::cout << std::endl;
        } else if (word == "take") {
            const auto events = engine.take();
            std::cout << "> ";
            for (const auto& e : events)
                std::cout << e.time_ns << ' ' << e.fixture << ' ' << e.impulse_n_s << ' ' << e.kind << ' ';
            std::cout << std::endl;
        } else if (word == "explain") {
            std::cout << "> " << engine.explain() << std::endl;
        } else if (word == "pin") {
            const int a = whole(), b = whole();
            const double x = number();
            engine.pin(a, b, x, number());
        } else {
            const int id = whole();
            const double x = number(), y = number();
            engine.act(word, id, x, y, number());
        }
    }
    return 0;
}

} // namespace scenes
