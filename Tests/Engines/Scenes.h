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
    /// Body 1: a box of 3 kg, so wide and high, friction 1, no bounce; false: this engine is not asked.
    virtual bool box(double, double, double /*width*/, double /*height*/, double /*spin*/) { return false; }
    virtual double spin() const { return 0.0; } ///< of that box, rad/s
    virtual void step() = 0;
    virtual double height(int ball) const = 0; ///< of its centre
    virtual double speed(int ball) const = 0;  ///< upwards, or to the right without gravity
    virtual std::vector<physvib_event> take(); ///< all of them
    int camera = 0;                            ///< the body that feels
    bool movesFirst = false;                   ///< by the velocity that it has, before gravity changes it
    bool landsLate = false;                    ///< by its slop, so perhaps a step later, and faster by what gravity adds
    int slowest = 50;                          ///< steps/s
    double handedOnPart = 0.02;                ///< of what a row hands on
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
    const bool isFine = events.size() == 1 && off <= engine.handedOnPart && own > 0.3;
    std::printf("%s,%d,row of five: %zu events, %.1f %% of its own %.3f N s%s\n", name, rate, events.size(), 100.0 * off, own, isFine ? "" : ",FAILED");
    return isFine;
}

/// A pole of 2 m that stands, and is pushed over: felt where its head comes down, once, as hard as a rigid one that holds at its foot
/// (m/3 of the head's speed), by the speed that the engine gives it.
inline bool pole(const char* name, Engine& engine, int rate) {
    engine.world = worldOf(1, engine.camera = 1);
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    body.mass_kg = 3.0, body.inertia_kg_m2 = 3.0 * (4.0 + 0.01) / 12.0, body.is_camera = 1, body.frequency_hz = 200.0, body.decay_per_s = 30.0;
    physvib_world_set_body(engine.world, 1, &body);
    engine.begin(1.0 / rate, gravity, 0.0, true);
    if (!engine.box(0.0, 1.0, 0.1, 2.0, -0.3)) return physvib_world_free(engine.world), true;
    double fastest = 0.0, landsAt = 0.0, before = 0.0;
    for (int step = 0; step < 4 * rate; ++step) {
        before = std::fabs(engine.spin());
        engine.step();
        fastest = std::fmax(fastest, std::fabs(engine.spin()));
        if (landsAt == 0.0 && before > 2.0 && std::fabs(engine.spin()) < 0.5 * before) landsAt = static_cast<double>(step) / rate;
    }
    const auto events = engine.take();
    physvib_world_free(engine.world);
    double sum = 0.0, onset = 0.0, place = 0.0, other = 0.0;
    for (const auto& event : events) {
        if (event.x_m < 1.5) other = std::fmax(other, event.impulse_n_s);
        else if (sum == 0.0 || msOf(event) < onset + 30.0) sum += event.impulse_n_s, place = event.x_m, onset = onset == 0.0 ? msOf(event) : onset;
    }
    const double rigid = 3.0 / 3.0 * 2.0 * fastest, off = std::fabs(sum / rigid - 1.0), offMs = onset - 1e3 * landsAt;
    const bool isFine = sum > 0.0 && off <= 0.2 && offMs > -1e3 / rate - 0.1 && offMs < 1e3 / rate + 0.1;
    std::printf("%s,%d,pole: head at %.2f m/s, %zu events, %.2f of %.2f N s at %.2f m, %+.1f ms from the engine's own, elsewhere %.2f%s\n", name, rate, 2.0 * fastest, events.size(), sum, rigid,
                place, offMs, other, isFine ? "" : ",FAILED");
    return isFine;
}

/// `handsOn`: a blow goes through a row at once, and not over many steps.
inline int run(const char* name, Engine& engine, bool handsOn) {
    bool isFine = true;
    for (const int rate : {engine.slowest, 100, 240, 1000}) isFine &= drop(name, engine, rate);
    if (handsOn)
        for (const int rate : {100, 1000}) isFine &= row(name, engine, rate);
    for (const int rate : {60, 240}) isFine &= pole(name, engine, rate);
    return isFine ? 0 : 1;
}

} // namespace scenes
