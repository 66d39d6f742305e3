// SPDX-License-Identifier: MIT
// The same drop, bounce and row of five for every engine, against pencil and paper and against the engine's own motion.
#pragma once
#include <cmath>
#include <cstdio>
#include <physvib/physvib.h>
#include <vector>

namespace scenes {

constexpr double gravity = 9.81, radius = 0.1, massKg = 1.0;
constexpr int floorBody = 100; ///< where 0 is no number; else it is body 0

/// Balls of 1 kg and 0.1 m; ball i is body i + 1, the floor is body 0 with its surface at 0.
struct Engine {
    virtual ~Engine() = default;
    virtual void begin(double stepSeconds, double gravity, double restitution, bool hasFloor) = 0;
    virtual void ball(double x, double y, double vx, double vy) = 0;
    virtual void step() = 0;
    virtual double height(int ball) const = 0; ///< of its centre
    virtual double speed(int ball) const = 0;  ///< upwards, or to the right without gravity
    virtual std::vector<physvib_event> take(); ///< all of them
    int camera = 0;                            ///< the body that feels
    bool movesFirst = false;                   ///< by the velocity that it has, before gravity changes it
    bool landsLate = false;                    ///< by its slop, so perhaps a step later, and faster by what gravity adds
    int subSteps = 1;                          ///< in each of which gravity changes the velocity
    double restitution = 0.5;
    physvib_world world = nullptr;
};

constexpr double allowedMs = 0.1, allowedPart = 0.02; ///< of onsets and of amplitudes, against pencil and paper and against its own motion

inline physvib_world worldOf(int balls, int camera) {
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.normalisation_s_per_m = 1.0;
    settings.hand_mass_kg = 0.0;
    physvib_world world = nullptr;
    physvib_world_create(&settings, &world);
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    physvib_world_set_body(world, 0, &body);
    physvib_world_set_body(world, floorBody, &body);
    for (int i = 1; i <= balls; ++i) {
        physvib_body_init(&body, sizeof body);
        body.mass_kg = massKg;
        body.is_camera = i == camera;
        body.frequency_hz = 200.0;
        body.decay_per_s = 30.0;
        physvib_world_set_body(world, i, &body);
    }
    return world;
}

inline std::vector<physvib_event> Engine::take() {
    std::vector<physvib_event> events(4096);
    events.resize(static_cast<std::size_t>(physvib_world_take(world, events.data(), 4096, 1)));
    return events;
}

inline double msOf(const physvib_event& event) { return static_cast<double>(event.time_ns) * 1e-6; }

/// A drop of 0.8 m and the bounce after it.
inline bool drop(const char* name, Engine& engine, int rate) {
    const double dt = 1.0 / rate, h = 0.8, v = std::sqrt(2.0 * gravity * h), t = std::sqrt(2.0 * h / gravity);
    engine.world = worldOf(1, engine.camera = 1);
    engine.begin(dt, gravity, engine.restitution, true);
    engine.ball(0.0, radius + h, 0.0, (engine.movesFirst ? -0.5 : 0.5) * gravity * dt / engine.subSteps); // ends of steps lie on the parabola
    double onsets[2] = {}, speeds[2] = {};
    int hits = 0;
    for (int step = 0; step < 2 * rate && hits < 2; ++step) {
        const double gap = engine.height(0) - radius, now = -engine.speed(0), atFloor = std::sqrt(std::fmax(0.0, now * now + 2.0 * gravity * gap));
        const double falling = engine.subSteps > 1 ? 0.5 * (now + atFloor) : (engine.movesFirst ? 0.0 : gravity * dt) + now; // on the way to the floor
        const bool isNext = hits == 0 || step * dt > onsets[0] + 0.05; // some land in two steps
        if (isNext && falling > 1.0 && gap > 0.0 && gap <= falling * dt) {
            onsets[hits] = step * dt + gap / falling;
            speeds[hits++] = engine.subSteps > 1 ? atFloor : falling;
        }
        engine.step();
    }
    for (int step = 0; step < 4; ++step) engine.step(); // soft ones take their time
    const auto events = engine.take();
    physvib_world_free(engine.world);
    bool isFine = hits > 0 && events.size() >= static_cast<std::size_t>(hits); // a contact that damps has no bounce
    if (!isFine) return std::printf("%s,%d,%d hits,%zu events,FAILED\n", name, rate, hits, events.size()), false;
    double onsetMs = 0.0, ofMotion = 0.0;
    for (int i = 0; i < hits; ++i) {
        const double impulse = massKg * speeds[i] * (1.0 + engine.restitution);
        onsetMs = std::fmax(onsetMs, std::fabs(msOf(events[static_cast<std::size_t>(i)]) - onsets[i] * 1e3));
        const double later = engine.landsLate ? impulse * (1.0 + gravity * dt / speeds[i]) : impulse, felt = events[static_cast<std::size_t>(i)].amplitude;
        ofMotion = std::fmax(ofMotion, std::fmin(std::fabs(felt / impulse - 1.0), std::fabs(felt / later - 1.0)));
    }
    const double paperMs = std::fabs(msOf(events[0]) - t * 1e3);
    const double ofPaper = std::fabs(events[0].amplitude / (massKg * v * (1.0 + engine.restitution)) - 1.0);
    isFine = onsetMs <= allowedMs && paperMs <= allowedMs && ofMotion <= allowedPart && ofPaper <= allowedPart;
    std::printf("%s,%d,%d hits,%.3f ms,%.1f %%,%.3f ms,%.1f %%%s\n", name, rate, hits, onsetMs, 100.0 * ofMotion, paperMs, 100.0 * ofPaper, isFine ? "" : ",FAILED");
    return isFine;
}

/// A ball at 3 m/s strikes a row of four that touch; the last one is the camera.
inline bool row(const char* name, Engine& engine, int rate) {
    engine.world = worldOf(5, engine.camera = 5);
    engine.begin(1.0 / rate, 0.0, 0.0, false);
    for (int i = 0; i < 5; ++i) engine.ball(i == 0 ? -4.0 / rate : 1.9999 * radius * i, 0.0, i == 0 ? 3.0 : 0.0, 0.0);
    for (int step = 0; step < rate / 2; ++step) engine.step();
    const auto events = engine.take();
    physvib_world_free(engine.world);
    const double own = massKg * engine.speed(4);
    const double off = events.empty() ? 1.0 : std::fabs(events[0].impulse_n_s / own - 1.0);
    const bool isFine = events.size() == 1 && off <= allowedPart && own > 0.3;
    std::printf("%s,%d,row of five: %zu events, %.1f %% of its own %.3f N s%s\n", name, rate, events.size(), 100.0 * off, own, isFine ? "" : ",FAILED");
    return isFine;
}

/// `handsOn`: a blow goes through a row at once, and not over many steps.
inline int run(const char* name, Engine& engine, bool handsOn) {
    bool isFine = true;
    for (const int rate : {50, 100, 240, 1000}) isFine &= drop(name, engine, rate);
    if (handsOn)
        for (const int rate : {100, 1000}) isFine &= row(name, engine, rate);
    return isFine ? 0 : 1;
}

} // namespace scenes
