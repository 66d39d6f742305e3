// SPDX-License-Identifier: MIT
// How easily a body turns about each axis through its centre of mass.
#pragma once
#include "Contacts/Vector3.h"
#include <array>
#include <cmath>

namespace physvib {

/// The inverse of the moments of inertia about the centre of mass, 1/(kg m^2): a symmetric matrix in the
/// world's axes. All 0: nothing turns the body. Any thread.
struct InverseInertia {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

    /// The same about every axis, as of a ball.
    static InverseInertia ofBall(double perKgSquareMetre) noexcept {
        return {perKgSquareMetre, perKgSquareMetre, perKgSquareMetre, 0.0, 0.0, 0.0};
    }

    /// Change of spin, rad/s, by `newtonSeconds` that act with this lever (arm x direction), m.
    std::array<double, 3> spin(double newtonSeconds, Vector3 lever) const noexcept {
        const auto x = static_cast<double>(lever.x), y = static_cast<double>(lever.y),
                   z = static_cast<double>(lever.z), s = newtonSeconds;
        return {s * xx * x + s * xy * y + s * xz * z, s * xy * x + s * yy * y + s * yz * z,
                s * xz * x + s * yz * y + s * zz * z};
    }

    /// Change of speed at one lever by 1 N s at the other, 1/kg.
    double between(Vector3 one, Vector3 other) const noexcept {
        const auto product = [](float a, float b) { return static_cast<double>(a) * static_cast<double>(b); };
        return product(one.x, other.x) * xx + product(one.y, other.y) * yy + product(one.z, other.z) * zz +
               (product(one.x, other.y) + product(one.y, other.x)) * xy +
               (product(one.x, other.z) + product(one.z, other.x)) * xz +
               (product(one.y, other.z) + product(one.z, other.y)) * yz;
    }

    /// Numbers that some body has: 0 or more about every axis, also about those between x, y and z. A matrix
    /// that turns about one or two axes only (singular) is valid; false of NaN. Else an impulse could push a
    /// body towards what struck it.
    bool isValid() const noexcept {
        constexpr double most = 1.0e18;
        for (const double about : {xx, yy, zz})
            if (!(about >= 0.0 && about <= most)) return false;
        // no product of inertia is larger than the root of its two moments' product; engines round
        const auto isWithin = [](double product, double one, double other) {
            return std::abs(product) <= 1.0001 * std::sqrt(one * other);
        };
        return isWithin(xy, xx, yy) && isWithin(xz, xx, zz) && isWithin(yz, yy, zz) && isAboveZero();
    }

private:
    /// The last pivot of Cholesky's factors, where each axis has a moment: with those of the pairs above, it
    /// tells a positive semi-definite matrix. In parts of the moments, since a rod's differ a lot.
    bool isAboveZero() const noexcept {
        if (!(xx > 0.0 && yy > 0.0 && zz > 0.0)) return true; // the pairs are all there is
        const double a = xy / std::sqrt(xx * yy), b = xz / std::sqrt(xx * zz), c = yz / std::sqrt(yy * zz);
        return 1.0 + 2.0 * a * b * c - a * a - b * b - c * c >= -1e-3;
    }
};

} // namespace physvib
