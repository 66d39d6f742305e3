// SPDX-License-Identifier: MIT
// The same drop, bounce and row of five for every engine, against pencil and paper and the engine's motion.
#pragma once
#include "Kit.h"
#include <cmath>
#include <cstdio>
#include <string_view>

namespace scenes {

constexpr double massKg = 1.0;
constexpr double allowedMs = 0.1, allowedPart = 0.02; ///< of onsets and of amplitudes, against pencil and
                                                      ///< paper and against its own motion

/// A drop of 0.8 m and the bounce after it.
inline bool drop(const char* name, Engine& engine, int rate) {
    const double dt = 1.0 / rate, h = 0.8, v = std::sqrt(2.0 * gravity * h), t = std::sqrt(2.0 * h / gravity);
    engine.world = plainWorld();
    engine.begin(dt, gravity, engine.restitution, 0.0);
    engine.floor();
    // ends of steps lie on the parabola
    engine.add({.y = radius + h,
                .vy = (engine.movesFirst ? -0.5 : 0.5) * gravity * dt / engine.subSteps,
                .isSource = true});
    double onsets[2] = {}, speeds[2] = {};
    int hits = 0;
    for (int step = 0; step < 2 * rate && hits < 2; ++step) {
        const double gap = engine.motion(1).y - radius, now = -engine.motion(1).vy,
                     atFloor = std::sqrt(std::fmax(0.0, now * now + 2.0 * gravity * gap));
        // on the way to the floor; a path of sub-steps is that of a body faster by half a sub-step's gravity
        const double first = now + 0.5 * gravity * dt / engine.subSteps,
                     falling =
                         engine.subSteps > 1
                             ? 0.5 * (first + std::sqrt(std::fmax(0.0, first * first + 2.0 * gravity * gap)))
                             : (engine.movesFirst ? 0.0 : gravity * dt) + now;
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
    // a contact that damps has no bounce
    bool isFine = hits > 0 && events.size() >= static_cast<std::size_t>(hits);
    if (!isFine)
        return std::printf("%s,%d,%d hits,%zu events,FAILED\n", name, rate, hits, events.size()), false;
    double onsetMs = 0.0, ofMotion = 0.0;
    for (int i = 0; i < hits; ++i) {
        const double impulse = massKg * speeds[i] * (1.0 + engine.restitution);
        onsetMs = std::fmax(onsetMs, std::fabs(msOf(events[static_cast<std::size_t>(i)]) - onsets[i] * 1e3));
        const double later = engine.landsLate ? impulse * (1.0 + gravity * dt / speeds[i]) : impulse,
                     felt = events[static_cast<std::size_t>(i)].amplitude;
        ofMotion =
            std::fmax(ofMotion, std::fmin(std::fabs(felt / impulse - 1.0), std::fabs(felt / later - 1.0)));
    }
    const double paperMs = std::fabs(msOf(events[0]) - t * 1e3);
    const double ofPaper = std::fabs(events[0].amplitude / (massKg * v * (1.0 + engine.restitution)) - 1.0);
    isFine =
        onsetMs <= allowedMs && paperMs <= allowedMs && ofMotion <= allowedPart && ofPaper <= allowedPart;
    std::printf("%s,%d,%d hits,%.3f ms,%.1f %%,%.3f ms,%.1f %%%s\n", name, rate, hits, onsetMs,
                100.0 * ofMotion, paperMs, 100.0 * ofPaper, isFine ? "" : ",FAILED");
    return isFine;
}

/// A ball at 3 m/s strikes a row of four that touch; the last one is the camera.
inline bool row(const char* name, Engine& engine, int rate) {
    engine.world = plainWorld();
    engine.begin(1.0 / rate, 0.0, 0.0, 0.0);
    for (int i = 0; i < 5; ++i)
        engine.add({.id = i + 1,
                    .x = i == 0 ? -4.0 / rate : 1.9999 * radius * i,
                    .vx = i == 0 ? 3.0 : 0.0,
                    .isSource = i == 4});
    for (int step = 0; step < rate / 2; ++step) engine.step();
    const auto events = engine.take();
    physvib_world_free(engine.world);
    const double own = massKg * engine.motion(5).vx;
    const double off = events.empty() ? 1.0 : std::fabs(events[0].impulse_n_s / own - 1.0);
    const bool isFine = events.size() == 1 && off <= engine.handedOnPart && own > 0.3;
    std::printf("%s,%d,row of five: %zu events, %.1f %% of its own %.3f N s%s\n", name, rate, events.size(),
                100.0 * off, own, isFine ? "" : ",FAILED");
    return isFine;
}

/// A pole of 2 m that stands, and is pushed over: felt where its head comes down, once, as hard as a rigid
/// one that holds at its foot (m/3 of the head's speed), by the speed that the engine gives it.
inline bool pole(const char* name, Engine& engine, int rate) {
    engine.world = plainWorld();
    engine.begin(1.0 / rate, gravity, 0.0, 1.0);
    engine.floor();
    engine.add({.isBox = true,
                .y = 1.0,
                .width = 0.1,
                .height = 2.0,
                .massKg = 3.0,
                .vx = 0.3,
                .spin = -0.3,
                .isSource = true});
    double fastest = 0.0, landsAt = 0.0, before = 0.0;
    for (int step = 0; step < 4 * rate; ++step) {
        before = std::fabs(engine.motion(1).spin);
        engine.step();
        fastest = std::fmax(fastest, std::fabs(engine.motion(1).spin));
        if (landsAt == 0.0 && before > 2.0 && std::fabs(engine.motion(1).spin) < 0.5 * before)
            landsAt = static_cast<double>(step) / rate;
    }
    const auto events = engine.take();
    physvib_world_free(engine.world);
    double sum = 0.0, onset = 0.0, place = 0.0, other = 0.0;
    for (const auto& event : events) {
        if (event.x_m < 1.5)
            other = std::fmax(other, event.impulse_n_s);
        else if (sum == 0.0 || msOf(event) < onset + 30.0)
            sum += event.impulse_n_s, place = event.x_m, onset = onset == 0.0 ? msOf(event) : onset;
    }
    const double rigid = 3.0 / 3.0 * 2.0 * fastest, off = std::fabs(sum / rigid - 1.0),
                 offMs = onset - 1e3 * landsAt;
    // an engine with sub-steps pushes up to a sub-step before the head is down
    const double lateMs = 1e3 / rate * (engine.subSteps > 1 ? 1.0 + 1.0 / engine.subSteps : 1.0);
    const bool isFine = sum > 0.0 && off <= 0.2 && offMs > -1e3 / rate - 0.1 && offMs < lateMs + 0.1;
    std::printf("%s,%d,pole: head at %.2f m/s, %zu events, %.2f of %.2f N s at %.2f m, %+.1f ms from the "
                "engine's own, elsewhere %.2f%s\n",
                name, rate, 2.0 * fastest, events.size(), sum, rigid, place, offMs, other,
                isFine ? "" : ",FAILED");
    return isFine;
}

/// A box rests on a plank, which is shot up under it: felt once, as hard as the box gains, not before.
inline bool kick(const char* name, Engine& engine, int rate) {
    engine.world = plainWorld();
    engine.begin(1.0 / rate, gravity, 0.0, 0.5);
    engine.floor();
    engine.add({.id = 1, .isBox = true, .y = 0.05, .width = 2.0, .height = 0.1, .massKg = 2.0});
    engine.add(
        {.id = 2, .isBox = true, .y = 0.35, .width = 0.5, .height = 0.5, .massKg = 1.0, .isSource = true});
    for (int step = 0; step < rate / 2; ++step) engine.step();
    engine.take(); // Chipmunk drops a stack that is made at rest
    for (int step = 0; step < rate / 2; ++step) engine.step();
    const std::size_t atRest = engine.take().size();
    engine.act("fling", 1, 0.0, 4.7, 0.0);
    double gained = 0.0;
    for (int step = 0; step < rate / 20 + 1; ++step) {
        engine.step();
        gained = std::fmax(gained, engine.motion(2).vy);
    }
    const auto events = engine.take();
    physvib_world_free(engine.world);
    const double off = events.size() == 1 ? std::fabs(events[0].impulse_n_s / gained - 1.0) : 1.0;
    const bool isFine = atRest == 0 && off <= 0.2;
    std::printf("%s,%d,kick: %zu events before, %zu, %.1f %% from its own %.2f N s%s\n", name, rate, atRest,
                events.size(), 100.0 * off, gained, isFine ? "" : ",FAILED");
    return isFine;
}

/// The first word is --plane: of an engine in space, its adapter for games in the plane.
inline bool isPlane(int count, char** words) { return count > 1 && std::string_view{words[1]} == "--plane"; }

/// The scenes; or, of a program that is given a world (worlds.py writes it), its trace.
inline int run(const char* name, Engine& engine, int count, char** words) {
    if (count > 1 && std::string_view{words[1]} == "--kit") return kit(engine);
    if (count > 1) return trace(engine, words[1]);
    bool isFine = true;
    for (const int rate : {engine.slowest, 100, 240, 1000}) isFine &= drop(name, engine, rate);
    if (engine.isRigid)
        for (const int rate : {100, 1000}) isFine &= row(name, engine, rate);
    if (engine.isRigid)
        for (const int rate : {60, 240})
            isFine &= pole(name, engine, rate) & (!engine.isKicked || kick(name, engine, rate));
    return isFine ? 0 : 1;
}

} // namespace scenes
