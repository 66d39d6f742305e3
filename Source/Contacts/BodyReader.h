// SPDX-License-Identifier: MIT
// Interface through which the contact stages read bodies from any physics engine.
#pragma once
#include "Contacts/Vector2.h"
#include <cstdint>

namespace physvib {

/// Properties of a body. Fixtures and bodies are identified by numbers of the engine's choice (addresses,
/// ids): not 0, and unique among those that exist at the same time.
struct BodyFacts {
    std::uint64_t body = 0;
    double massKg = 0.0;       ///< of a dynamic body
    float gravityScale = 1.0F; ///< factor on the world's gravity
    bool isDynamic = false;
    bool isEnabled = true;
};

/// Asked for few bodies, and only when something has happened to them, so nothing is copied for those at
/// rest. Each method: M, within a step or right after it, for a body that is in the world.
class BodyReader {
public:
    virtual ~BodyReader() = default;

    virtual BodyFacts facts(std::uint64_t body) const = 0;

    /// The current motion, and the motion at the beginning of the step. These, the centre and the moment of
    /// inertia are those of the plane: `release` timing uses them.
    virtual BodyMotion motion(std::uint64_t body) const = 0;
    virtual BodyMotion motionBefore(std::uint64_t body) const = 0;

    /// Centre of mass, m, world; and the world position of a point given in the body's frame.
    virtual Vector2 centre(std::uint64_t body) const = 0;
    virtual Vector3 toWorld(std::uint64_t body, Vector2 ofBody) const = 0;

    /// Moment of inertia about the centre of mass, kg m^2.
    virtual double inertia(std::uint64_t body) const = 0;
};

} // namespace physvib
