// SPDX-License-Identifier: MIT
// Arithmetic of places in space. Any thread.
#pragma once
#include "Core/EnchanterLayout.h"
#include <cmath>

namespace physvib {

/// The way from a to b.
inline ActuatorPlace vectorFrom(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return {b.xMetres - a.xMetres, b.yMetres - a.yMetres, b.zMetres - a.zMetres};
}

/// a, and b so many times.
inline ActuatorPlace sumOf(const ActuatorPlace& a, const ActuatorPlace& b, double times) noexcept {
    return {a.xMetres + times * b.xMetres, a.yMetres + times * b.yMetres, a.zMetres + times * b.zMetres};
}

inline double scalarProduct(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return a.xMetres * b.xMetres + a.yMetres * b.yMetres + a.zMetres * b.zMetres;
}

inline ActuatorPlace vectorProduct(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return {a.yMetres * b.zMetres - a.zMetres * b.yMetres, a.zMetres * b.xMetres - a.xMetres * b.zMetres,
            a.xMetres * b.yMetres - a.yMetres * b.xMetres};
}

/// The same direction with the length 1; not of a vector without length.
inline ActuatorPlace directionOf(const ActuatorPlace& vector) noexcept {
    return sumOf({}, vector, 1.0 / std::sqrt(scalarProduct(vector, vector)));
}

} // namespace physvib
