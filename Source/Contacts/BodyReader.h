// SPDX-License-Identifier: MIT
// What the stages ask of the physics engine, whichever it is.
#pragma once
#include "Contacts/Vector2.h"
#include <cstdint>

namespace physvib {

/// What the engine says of a body. Fixtures and bodies are named by numbers of the engine's choice
/// (addresses, ids): not 0, and different for those that are in the world at the same time.
struct BodyFacts {
    std::uint64_t body = 0;
    double massKg = 0.0;       ///< of a dynamic body
    float gravityScale = 1.0F; ///< how much of the world's gravity pulls it
    bool isDynamic = false;
    bool isEnabled = true;
};

/// Asked for few bodies, and only when something has happened to them, so nothing is copied for those at
/// rest. Each method: M, within a step or right after it, for a body that is in the world.
class BodyReader {
public:
    virtual ~BodyReader() = default;

    virtual BodyFacts facts(std::uint64_t body) const = 0;

    /// As it is now, and as it was when the step began.
    virtual BodyMotion motion(std::uint64_t body) const = 0;
    virtual BodyMotion motionBefore(std::uint64_t body) const = 0;

    /// Centre of mass, m, world; and where a point of the body's own frame is in the world.
    virtual Vector2 centre(std::uint64_t body) const = 0;
    virtual Vector2 toWorld(std::uint64_t body, Vector2 ofBody) const = 0;

    /// Moment of inertia about the centre of mass, kg m^2.
    virtual double inertia(std::uint64_t body) const = 0;
};

} // namespace physvib
