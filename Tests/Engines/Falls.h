// SPDX-License-Identifier: MIT
// When falls and bullets are felt, against pencil and paper: heights, speeds, rates, shapes, and phases of
// the step in which they land.
#pragma once
#include "Engine.h"
#include "Trace.h"
#include <array>
#include <cmath>
#include <cstdio>

namespace scenes {

constexpr double allowedFallMs = 0.15;
constexpr std::array fallRates{60, 100, 240, 500, 1000};
constexpr int phases = 9; // of a step

/// The first event's onset, ms; NaN: none.
inline double firstOnset(Engine& engine, double seconds, double dt) {
    for (double t = 0.0; t < seconds + 3.0 * dt; t += dt) engine.step();
    const auto events = engine.take();
    physvib_world_free(engine.world);
    return events.empty() ? NAN : msOf(events[0]);
}

/// Of two deviations the one that is farther from 0; NaN is farther than any number.
inline double worse(double a, double b) { return std::fabs(a) >= std::fabs(b) || std::isnan(a) ? a : b; }

/// How far the lowest point of a box of 0.2 m lies below its centre.
inline double reachOf(double angle) {
    return 0.1 * (std::fabs(std::cos(angle)) + std::fabs(std::sin(angle)));
}

/// When a box that falls from so high and turns has its first corner on the floor.
inline double meetsTurning(double height, double angle, double spin) {
    const double y = height + reachOf(angle);
    double t = 0.0;
    while (y - 0.5 * gravity * t * t > reachOf(angle + spin * t)) t += 1e-6;
    return t;
}

/// How many ms late a ball and three boxes are felt, which land flat, on a corner, and turning: the worst.
inline double fall(Engine& engine, double height, int rate) {
    const double dt = 1.0 / rate;
    double off = 0.0;
    struct Shape {
        bool isBox;
        double angle, spin;
    };
    for (int phase = 0; phase < phases; ++phase)
        for (const auto& [isBox, angle, spin] :
             {Shape{false, 0.0, 0.0}, Shape{true, 0.0, 0.0}, Shape{true, 0.4, 0.0}, Shape{true, 0.2, 3.0}}) {
            const double h = height + 0.3 * std::sqrt(2.0 * gravity * height) * dt * phase / phases,
                         paper = spin != 0.0 ? meetsTurning(h, angle, spin) : std::sqrt(2.0 * h / gravity);
            engine.world = plainWorld();
            engine.begin(dt, gravity, 0.5, 0.5);
            engine.floor();
            engine.add({.isBox = isBox,
                        .y = h + (isBox ? reachOf(angle) : radius),
                        .angle = angle,
                        .vy = 0.5 * gravity * dt / engine.subSteps, // ends of steps lie on the parabola
                        .spin = spin,
                        .isSource = true});
            off = worse(firstOnset(engine, paper, dt) - 1e3 * paper, off);
        }
    return off;
}

/// What a bullet strikes.
enum class Target { wall, sheet, box, oncoming };
constexpr std::array<const char*, 4> targetNames{"wall", "sheet", "box", "oncoming box"};

/// The same of a ball that flies at so many m/s, without gravity.
inline double shot(Engine& engine, double speed, int rate, Target target, bool isBullet) {
    const double dt = 1.0 / rate, width = target == Target::sheet ? 0.02 : 1.0,
                 meets = target == Target::oncoming ? -3.0 : 0.0;
    double off = 0.0;
    for (int phase = 0; phase < phases; ++phase) {
        const double gap = speed * dt * (3.0 + static_cast<double>(phase) / phases),
                     paper = gap / (speed - meets);
        engine.world = plainWorld();
        engine.begin(dt, 0.0, 0.5, 0.5);
        engine.add({.id = 2,
                    .isBox = true,
                    .x = 0.5 * width,
                    .width = width,
                    .height = 4.0,
                    .massKg = target == Target::box || target == Target::oncoming ? 5.0 : 0.0,
                    .vx = meets});
        engine.add({.x = -radius - gap, .vx = speed, .isSource = true, .isBullet = isBullet});
        off = worse(firstOnset(engine, paper, dt) - 1e3 * paper, off);
    }
    return off;
}

inline bool tell(double off) {
    std::printf(std::isnan(off) ? ",      -" : ",%+7.2f", off);
    return std::fabs(off) <= allowedFallMs;
}

/// A table, ms: continuous collision or not, height or speed, and a column for each rate.
inline bool falls(const char* name, Engine& engine) {
    bool isFine = true;
    const auto row = [&](auto figure) {
        bool isRowFine = true;
        for (const int rate : fallRates) isRowFine &= tell(figure(rate));
        std::printf("%s\n", isRowFine ? "" : ",FAILED");
        isFine &= isRowFine;
    };
    std::printf("%s: ms late at 60, 100, 240, 500, 1000 steps/s\n", name);
    for (const bool isContinuous : {false, true}) {
        engine.isContinuous = isContinuous;
        for (const double height : {0.05, 0.1, 0.2, 0.4, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0}) {
            std::printf("%s,fall of %5.2f m", isContinuous ? "continuous" : "discrete  ", height);
            row([&](int rate) { return fall(engine, height, rate); });
        }
    }
    for (const Target target : {Target::wall, Target::sheet, Target::box, Target::oncoming})
        for (const double speed : {5.0, 10.0, 20.0, 40.0, 70.0, 100.0}) {
            std::printf("bullet of %3.0f m/s,%s", speed, targetNames[static_cast<std::size_t>(target)]);
            row([&](int rate) { return shot(engine, speed, rate, target, true); });
        }
    return isFine;
}

} // namespace scenes
