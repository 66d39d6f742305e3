// SPDX-License-Identifier: MIT
// Transform of points that move with a body, for edits of places and joints. Any thread.
#pragma once
#include "Core/PortableMath.h"
#include "Scene/Drawing/BodyEdits.h"
#include <cmath>

namespace physvib::detail {

inline Vector turned(const Vector& v, double angle) {
    const double c = portable::cos(angle), s = portable::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Transform from one place of a body to another.
class Motion {
public:
    Motion(const BodyPlace& from, const BodyPlace& to)
        : from_{from}
        , to_{to} {}
    double angle() const { return to_.angleRadians - from_.angleRadians; }
    Vector way(const Vector& axis) const { return turned(axis, angle()); }
    Vector operator()(const Vector& place) const {
        const Vector at = turned({place.x - from_.metres.x, place.y - from_.metres.y}, angle());
        return {to_.metres.x + at.x, to_.metres.y + at.y};
    }

private:
    BodyPlace from_, to_;
};

inline BodyPlace placeOf(const BodyDescription& body) { return {body.positionMetres, body.angleRadians}; }

} // namespace physvib::detail
