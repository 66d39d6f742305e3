// SPDX-License-Identifier: MIT
// A brick that is turned somehow strikes a wall that is turned otherwise with a corner: what is felt, against
// the closed form. It needs the inertia about every axis.
#pragma once
#include "TiltedBox.h"

namespace tilted {

inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector plus(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

struct Brick {
    Box box; ///< its axes
    static constexpr Vector halfMetres{0.12, 0.05, 0.03};

    /// From the centre to the corner that is furthest against the normal.
    Vector corner(const Vector& normal) const {
        Vector sum{};
        for (std::size_t i = 0; i < 3; ++i)
            sum = plus(sum, std::copysign(halfMetres[i], -dot(box.axis[i], normal)), box.axis[i]);
        return sum;
    }
    /// About one of its own axes.
    static double inertia(std::size_t axis) {
        const double a = halfMetres[(axis + 1) % 3], b = halfMetres[(axis + 2) % 3];
        return massKg * (a * a + b * b) / 3.0;
    }
    /// xx, yy, zz, xy, xz, yz of the inverse, in the world's axes.
    std::array<double, 6> inverse() const {
        std::array<double, 6> sum{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector& v = box.axis[i];
            const std::array<double, 6> products{v[0] * v[0], v[1] * v[1], v[2] * v[2],
                                                 v[0] * v[1], v[0] * v[2], v[1] * v[2]};
            for (std::size_t k = 0; k < 6; ++k) sum[k] += products[k] / inertia(i);
        }
        return sum;
    }
    /// By how much an impulse of 1 N s along the normal changes the speed of the corner.
    double speedPerImpulse(const Vector& normal) const {
        const Vector turns = cross(corner(normal), normal);
        double sum = 1.0 / massKg;
        for (std::size_t i = 0; i < 3; ++i) sum += std::pow(dot(turns, box.axis[i]), 2) / inertia(i);
        return sum;
    }
};

/// An engine that has bricks, too.
struct BrickEngine : Engine {
    virtual void throwBrick(const Brick& brick, const Vector& centre, const Vector& velocity) = 0;
};

/// A row of the table. False if the impact is not felt, or too far off.
inline bool strike(const char* name, BrickEngine& engine, int index, const Brick& brick, const Box& turned) {
    const Vector& normal = turned.axis[1];
    const Vector corner = brick.corner(normal);
    constexpr double gapMetres = 0.31, speed = 2.0, aside = 0.7;
    const Vector centre = plus({}, gapMetres - dot(corner, normal), normal),
                 velocity = plus(plus({}, -speed, normal), aside, turned.axis[0]);
    const double seconds = gapMetres / speed,
                 impulse = speed * (1.0 + restitution) / brick.speedPerImpulse(normal);
    const Vector place = plus(plus(centre, 1.0, corner), seconds, velocity);
    engine.world = newWorld();
    engine.begin(1.0 / rate);
    for (int id = 1; id <= 6; ++id) engine.wall(id, plus({}, -5.0 * (id - 1), normal), normal); // one is met
    engine.throwBrick(brick, centre, velocity);
    for (int step = 0; step < rate / 4; ++step) engine.step();
    physvib_event event{};
    event.size = sizeof event;
    const bool isFelt = physvib_world_take(engine.world, &event, 1, 1) == 1;
    physvib_world_free(engine.world);
    const double ms = static_cast<double>(event.time_ns) * 1e-6 - seconds * 1e3,
                 part = event.impulse_n_s / impulse - 1.0,
                 metres = std::hypot(event.x_m - place[0], event.y_m - place[1], event.z_m - place[2]);
    const bool isFine = isFelt && std::fabs(ms) <= (engine.isExact ? 0.001 : 0.1) &&
                        std::fabs(part) <= (engine.isExact ? 1e-5 : 0.02) &&
                        metres <= (engine.isExact ? 1e-5 : 0.01);
    std::printf("| %s | %d | %.4f ms, %.4f %%, %.2f mm |%s\n", name, index, ms, 100 * part, 1e3 * metres,
                isFine ? "" : " FAILED");
    return isFine;
}

/// In all of these the next corner is more than a step away: two that meet in one step are one landing.
inline int runBricks(const char* name, BrickEngine& engine) {
    std::puts("| engine | brick | onset, strength, place from the closed form |");
    std::puts("| --- | --- | --- |");
    bool isFine = true;
    int index = 0;
    for (const Vector& turn : {Vector{0.9, 0.5, 0.4}, {0.4, 1.1, -0.7}, {-2.1, 0.3, 2.9}, {1.0, -2.2, 0.6}})
        for (const Box& wall : {Box{}, Box::turned(-0.6, 0.8, 1.9)})
            isFine &= strike(name, engine, index++, {Box::turned(turn[0], turn[1], turn[2])}, wall);
    return isFine ? 0 : 1;
}

} // namespace tilted
