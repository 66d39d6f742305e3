// SPDX-License-Identifier: MIT
// A world as data: what a simulation is built from, and what a picture of it is drawn from. No Box2D here.
#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace physvib {

/// What a fixture is made of; frequency and decay are those of its contact sound (thesis 5.2.1, Table 5.1).
struct Material {
    std::string name;
    double densityKgPerSquareMetre = 0.0; ///< 2-D: per area
    double friction = 0.0;
    double restitution = 0.0;
    double frequencyHz = 0.0; ///< 0: never vibrates (allowed only without a camera)
    double decayPerSecond = 0.0;
};

struct Point {
    double xMetres = 0.0;
    double yMetres = 0.0;
};
struct CircleShape {
    double radiusMetres = 0.0;
};
struct BoxShape {
    double widthMetres = 0.0;
    double heightMetres = 0.0;
};
using Shape = std::variant<CircleShape, BoxShape>;

/// One body with one fixture, centred on `position` at the start.
struct BodyDescription {
    std::string name;
    Shape shape;
    int material = 0; ///< index into Scene::materials
    Point position;
    double angleRadians = 0.0;
    bool isStatic = false;
    bool isCamera = false;     ///< camera-focused: collisions of this fixture are felt (thesis 5.1.1)
    double staticMassKg = 0.0; ///< a static body has no mass in Box2D; Eq. 5.4 needs one if it is a camera
};

/// From `timeSeconds` on, gravity is this vector (m/s^2): a tilt or a shake of the device.
struct GravityInput {
    double timeSeconds = 0.0;
    double xMetresPerSecond2 = 0.0;
    double yMetresPerSecond2 = 0.0;
};

/// A reproducible world: same scene, same seed, same step rate give the same events.
struct Scene {
    std::string name;
    std::string description; ///< one line, for `physvib scenes`
    double fieldWidthMetres = 0.0;
    double fieldHeightMetres = 0.0;
    double driveGain = 1.0; ///< on top of Eq. 5.7, which leaves most hits near -40 dBFS (SPEC erratum 15)
    std::vector<Material> materials;
    std::vector<BodyDescription> bodies; ///< the index is the fixture id in events and CSV
    std::vector<GravityInput> script;    ///< in time order; before the first input there is no gravity
    double scriptPeriodSeconds = 0.0;    ///< the script repeats after this time; 0: it does not
};

} // namespace physvib
