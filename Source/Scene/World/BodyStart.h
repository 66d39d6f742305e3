// SPDX-License-Identifier: MIT
// Start state of a body: as described, or with the small jitter that a seed adds.
#pragma once
#include "Scene/Scene.h"
#include <random>

namespace physvib {

struct BodyStart {
    Vector positionMetres;
    double angleRadians = 0.0;
    Vector velocityMetresPerSecond;
};

inline BodyStart describedStart(const BodyDescription& body) noexcept {
    return {body.positionMetres, body.angleRadians, body.velocityMetresPerSecond};
}

/// Five uniform draws, up to 1 mm, 1 mrad and 1 mm/s each way: a fall from 1 m shifts by at most 0.33 ms,
/// while a box full of bodies diverges after some impacts.
inline BodyStart jitteredStart(const BodyDescription& body, std::mt19937& random) noexcept {
    constexpr double reach = 1.0e-3;
    const auto draw = [&random] { return (static_cast<double>(random()) * 0x1p-31 - 1.0) * reach; };
    BodyStart start = describedStart(body);
    start.positionMetres.x += draw();
    start.positionMetres.y += draw();
    start.angleRadians += draw();
    start.velocityMetresPerSecond.x += draw();
    start.velocityMetresPerSecond.y += draw();
    return start;
}

} // namespace physvib
