// SPDX-License-Identifier: MIT
// A brick that is turned somehow strikes a wall that is turned otherwise with a corner: what is felt, against
// the closed form. It needs the inertia about every axis.
#pragma once
#include "Trace.h"
#include <algorithm>
#include <array>
#include <utility>

// A ball bounces without gravity between six walls of a box that is turned somehow in space: what is felt,
// against the closed form and against the engine's own motion.
namespace tilted {

using Vector = std::array<double, 3>;

constexpr double radius = 0.05, massKg = 0.7, restitution = 0.8, secondsToPlay = 3.0;
constexpr Vector half{0.5, 0.4, 0.3}, startAt{0.12, -0.05, 0.07}, startSpeed{1.9, -1.3, 0.8}; ///< box's axes
constexpr int ball = 7; ///< walls are 1 to 6: of each axis the lower one, then the upper one
constexpr int rate = 240;

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The box's axes in the world.
struct Box {
    std::array<Vector, 3> axis{Vector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    Vector toWorld(const Vector& v) const {
        Vector sum{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) sum[k] += v[i] * axis[i][k];
        return sum;
    }
    Vector toBox(const Vector& v) const { return {dot(v, axis[0]), dot(v, axis[1]), dot(v, axis[2])}; }
    /// About z, then x, then y.
    static Box turned(double z, double x, double y) {
        Box box;
        const auto turn = [&box](double angle, std::size_t a, std::size_t b) {
            for (Vector& v : box.axis) {
                const double p = v[a], q = v[b];
                v[a] = std::cos(angle) * p - std::sin(angle) * q;
                v[b] = std::sin(angle) * p + std::cos(angle) * q;
            }
        };
        turn(z, 0, 1), turn(x, 1, 2), turn(y, 2, 0);
        return box;
    }
};

/// One engine with its adapter, or none.
struct Engine {
    virtual ~Engine() = default;
    virtual void begin(double stepSeconds) = 0;
    /// A wall at this place; the normal points into the box.
    virtual void wall(int id, const Vector& place, const Vector& normal) = 0;
    virtual void drop(const Vector& centre, const Vector& velocity) = 0;
    virtual void step() = 0;
    virtual Vector centre() const = 0;
    virtual Vector velocity() const = 0;
    physvib_world world = nullptr;
    bool isExact = false; ///< it follows the closed form
};

struct Hit {
    int wall = 0;
    double seconds = 0, impulse = 0;
    Vector place{}; ///< world
    bool isFirst = false;
};

/// The next hit along one axis of a free path, in the box's axes.
inline Hit hitOf(std::size_t axis, const Vector& at, const Vector& v) {
    const bool isUp = v[axis] > 0;
    const double gap = half[axis] - radius - (isUp ? at[axis] : -at[axis]), speed = std::fabs(v[axis]);
    Hit hit{.wall = static_cast<int>(2 * axis) + (isUp ? 2 : 1),
            .seconds = gap / speed,
            .impulse = massKg * speed * (1.0 + restitution)};
    for (std::size_t k = 0; k < 3; ++k) hit.place[k] = at[k] + v[k] * hit.seconds;
    hit.place[axis] = isUp ? half[axis] : -half[axis];
    return hit;
}

inline physvib_world newWorld() {
    const physvib_world world = scenes::plainWorld();
    const physvib_body still = scenes::valuesOf(false);
    for (int wall = 1; wall <= 6; ++wall) physvib_world_set_body(world, wall, &still);
    physvib_body body = scenes::valuesOf(true);
    body.mass_kg = massKg;
    physvib_world_set_body(world, ball, &body);
    return world;
}

struct Worst {
    double ms = 0, part = 0, metres = 0;
    void add(const Hit& hit, const physvib_event& event) {
        ms = std::fmax(ms, std::fabs(static_cast<double>(event.time_ns) * 1e-6 - hit.seconds * 1e3));
        part = std::fmax(part, std::fabs(event.impulse_n_s / hit.impulse - 1.0));
        metres = std::fmax(metres, std::hypot(event.x_m - hit.place[0], event.y_m - hit.place[1]));
    }
};

/// The hits of the engine's own motion: from place and velocity before each step.
inline std::vector<Hit> play(Engine& engine, const Box& box) {
    engine.world = newWorld();
    const double dt = 1.0 / rate;
    engine.begin(dt);
    for (int id = 1; id <= 6; ++id) {
        const auto axis = static_cast<std::size_t>((id - 1) / 2);
        Vector place{}, normal{};
        place[axis] = id % 2 == 0 ? half[axis] : -half[axis];
        normal[axis] = id % 2 == 0 ? -1.0 : 1.0;
        engine.wall(id, box.toWorld(place), box.toWorld(normal));
    }
    engine.drop(box.toWorld(startAt), box.toWorld(startSpeed));
    std::vector<Hit> hits;
    std::array<double, 7> last{};
    std::array<bool, 3> hasHit{};
    for (int step = 0; step < static_cast<int>(secondsToPlay * rate); ++step) {
        const Vector at = box.toBox(engine.centre()), v = box.toBox(engine.velocity());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Hit hit = hitOf(axis, at, v);
            const auto wall = static_cast<std::size_t>(hit.wall);
            constexpr double again = 0.05; // some engines land in two steps
            if (hit.seconds < 0.0 || hit.seconds >= dt ||
                (last[wall] > 0.0 && step * dt < last[wall] + again))
                continue;
            hit.seconds += step * dt;
            hit.isFirst = !std::exchange(hasHit[axis], true);
            last[wall] = hit.seconds;
            hit.place = box.toWorld(hit.place);
            hits.push_back(hit);
        }
        engine.step();
    }
    for (int step = 0; step < 3; ++step) engine.step(); // soft contacts take their time
    return hits;
}

/// A row of the table. False if an event is missing, or too many are there, or one is too far off.
inline bool judge(const char* name, Engine& engine, int index, const Box& box) {
    const std::vector<Hit> hits = play(engine, box);
    const std::vector<physvib_event> events = scenes::eventsOf(engine.world);
    physvib_world_free(engine.world);
    Worst own, paper;
    std::size_t found = 0;
    for (const Hit& hit : hits) {
        const auto event = std::ranges::find_if(events, [&hit](const physvib_event& e) {
            return e.other == hit.wall &&
                   std::fabs(static_cast<double>(e.time_ns) * 1e-9 - hit.seconds) < 0.01;
        });
        if (event == events.end()) continue;
        ++found;
        own.add(hit, *event);
        if (!hit.isFirst) continue;
        const auto axis = static_cast<std::size_t>((hit.wall - 1) / 2); // walls of other axes change nothing
        Hit first = hitOf(axis, startAt, startSpeed);
        first.place = hit.place;
        paper.add(first, *event);
    }
    const double allowedMs = engine.isExact ? 0.001 : 0.1, allowedPart = engine.isExact ? 1e-5 : 0.02,
                 allowedMetres = engine.isExact ? 1e-5 : 0.01; // a look a step: 2.4 m/s in 1/240 s
    const std::size_t late =
        static_cast<std::size_t>(std::ranges::count_if(events, [](const physvib_event& e) {
            return static_cast<double>(e.time_ns) * 1e-9 >= secondsToPlay;
        }));
    const bool isFine = hits.size() >= 10 && found == hits.size() && events.size() - late == hits.size() &&
                        own.ms <= allowedMs && own.part <= allowedPart && own.metres <= allowedMetres &&
                        paper.ms <= allowedMs && paper.part <= allowedPart;
    std::printf("| %s | %d | %zu of %zu | %.4f ms, %.4f %%, %.2f mm | %.4f ms, %.4f %% |%s\n", name, index,
                found, hits.size(), own.ms, 100 * own.part, 1e3 * own.metres, paper.ms, 100 * paper.part,
                isFine ? "" : " FAILED");
    if (events.size() - late != hits.size()) std::printf("%zu events\n", events.size());
    return isFine;
}

inline int run(const char* name, Engine& engine) {
    std::puts(
        "| engine | rotation | hits felt | worst from its own motion | first hits from the closed form |");
    std::puts("| --- | --- | --- | --- | --- |");
    bool isFine = true;
    int index = 0;
    for (const Vector& turn : {Vector{0, 0, 0},
                               {0.5, 0, 0},
                               {0, 1.5707963267948966, 0},
                               {0.4, 1.1, -0.7},
                               {-2.1, 0.3, 2.9},
                               {1.0, -2.2, 0.6}})
        isFine &= judge(name, engine, index++, Box::turned(turn[0], turn[1], turn[2]));
    return isFine ? 0 : 1;
}

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
    const std::vector<physvib_event> events = scenes::eventsOf(engine.world);
    const physvib_event event = events.empty() ? physvib_event{} : events.front();
    physvib_world_free(engine.world);
    const double ms = static_cast<double>(event.time_ns) * 1e-6 - seconds * 1e3,
                 part = event.impulse_n_s / impulse - 1.0,
                 metres = std::hypot(event.x_m - place[0], event.y_m - place[1], event.z_m - place[2]);
    const bool isFine = !events.empty() && std::fabs(ms) <= (engine.isExact ? 0.001 : 0.1) &&
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
