// SPDX-License-Identifier: MIT
// What scenes and worlds ask of an engine: bodies, joints, steps, and the events of its adapter.
#pragma once
#include <cmath>
#include <physvib/physvib.h>
#include <string>
#include <vector>

namespace scenes {

constexpr double gravity = 9.81;
constexpr int floorBody = 100; ///< its number; others are below
constexpr double radius = 0.1; ///< of balls, where nothing else is said

inline double msOf(const physvib_event& event) { return static_cast<double>(event.time_ns) * 1e-6; }

enum class Type { fixed, kinematic, dynamic }; ///< as Box2D, Box3D and Jolt number them

/// A ball or a box.
struct Body {
    int id = 1;
    bool isBox = false;
    double x = 0, y = 0, angle = 0;
    double width = 0.2, height = 0.2; ///< of a ball: both its diameter
    double massKg = 1.0;              ///< 0: it stands still
    double vx = 0, vy = 0, spin = 0;
    bool isSource = false;
    double grain = 0.0;    ///< m, of its surface, where the engine's program knows it
    bool isBullet = false; ///< continuous collision with bodies that move, too, where the engine knows how
    Type type = Type::dynamic; ///< of those that have a mass, which a fixed one may have for later
    bool turns = true, isSensor = false;
    bool moves() const { return massKg > 0 && type == Type::dynamic; }
    Type kind() const { return massKg > 0 || type != Type::dynamic ? type : Type::fixed; }
    double inertia() const {
        return isBox ? massKg * (width * width + height * height) / 12.0 : massKg * width * width / 8.0;
    }
};

struct Motion {
    double x, y, vx, vy, spin, angle;
};

/// Of a body without a mass of its own.
inline physvib_body valuesOf(bool isSource) {
    physvib_body values;
    physvib_body_init(&values, sizeof values);
    values.is_camera = isSource;
    values.frequency_hz = 200.0;
    values.decay_per_s = 30.0;
    return values;
}

/// All that a world has made.
inline std::vector<physvib_event> eventsOf(physvib_world world) {
    std::vector<physvib_event> events(4096);
    events.front().size = sizeof events.front();
    events.resize(static_cast<std::size_t>(physvib_world_take(world, events.data(), 4096, 1)));
    return events;
}

/// One engine and its adapter. Bodies that a pin joins do not touch each other.
struct Engine {
    virtual ~Engine() = default;
    virtual void begin(double stepSeconds, double gravity, double restitution, double friction) = 0;
    virtual void floor() { ///< surface at 0
        add({.id = floorBody, .isBox = true, .y = -1, .width = 40, .height = 2, .massKg = 0});
    }
    virtual void add(const Body& body) = 0;
    virtual void pin(int /*a*/, int /*b; 0: the world*/, double /*x*/, double /*y*/) {}
    virtual void oneWay(int /*body*/) {} ///< see passes()
    /// A floor of so many parts, its surface at 0, without seams if the engine knows how.
    virtual void tiles(double left, double right, int count) {
        const double width = (right - left) / count;
        for (int i = 0; i < count; ++i)
            add({.id = floorBody,
                 .isBox = true,
                 .x = left + (i + 0.5) * width,
                 .y = -0.5,
                 .width = width,
                 .height = 1.0,
                 .massKg = 0.0});
    }
    virtual void step() = 0; ///< of dt
    virtual Motion motion(int body) const = 0;
    /// Of the kit: what `verbs` lists, done to a body. `type x`, `put x y`, `fling vx vy spin`, `moves vx
    /// vy`; `mass`, `gravityScale`, `lockTurn`, `remove`, `sensor`, `passes`, `sleep`, `enable`; `gravity` of
    /// all.
    virtual void act(const std::string& /*verb*/, int /*body*/, double /*x*/, double /*y*/, double /*z*/) {}
    virtual void feel(const Body& body) { tell(body); } ///< it is a source from now on
    virtual std::string explain() {
        char text[512];
        physvib_world_explain(world, text, sizeof text);
        return text;
    }
    virtual std::vector<physvib_event> take() { return eventsOf(world); }
    /// The body's number and values, where the adapter does not give them.
    void tell(const Body& body) const {
        physvib_body values = valuesOf(body.isSource);
        values.mass_kg = body.moves() ? body.massKg : 0.0;
        // a ball's collisions go through its centre
        values.inertia_kg_m2 = body.isBox && body.turns ? body.inertia() : 0.0;
        physvib_world_set_body(world, body.id, &values);
    }
    double dt = 0.0;            ///< s, of the next step
    double fullScale = 0.0;     ///< N s, of the world; 0: by masses
    const char* verbs = "";     ///< that act() knows, with words between them
    bool movesFirst = false;    ///< by the velocity that it has, before gravity changes it
    bool landsLate = false;     ///< by its slop, so perhaps a step later, and faster by what gravity adds
    int slowest = 50;           ///< steps/s
    double handedOnPart = 0.02; ///< of what a row hands on
    int subSteps = 1;           ///< in each of which gravity changes the velocity
    double restitution = 0.5;
    bool isKicked = true;     ///< Box2D 2.4's way is the thesis', without kicks; of Box2D 3 none is asked
    bool isContinuous = true; ///< from the next begin() on, where the engine has the choice
    bool isRigid = true;      ///< a collision goes through a row at once, and not over many steps; boxes and
                              ///< joints are asked for
    physvib_world world = nullptr;
};

/// A platform with its top there lets through what comes from below, or rises.
inline bool passes(double top, double y, double vy) { return vy > 0.01 || y < top; }

} // namespace scenes
