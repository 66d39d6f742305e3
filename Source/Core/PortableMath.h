// SPDX-License-Identifier: MIT
// Exponentials, logarithms, powers and angles with the same bits on every machine: C libraries differ in the
// last place, and some choose by the processor. Only operations that IEEE 754 rounds, in a fixed order; to be
// compiled without contracted multiply-adds. Any thread, wait-free.
//
// Errors, in units in the last place (PortableMathTest): 1, and 2 for atan2, cosh, expm1, hypot and tan;
// where results are normal numbers, and for angles up to a million.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>

namespace physvib::portable {
namespace detail {
/// A value as a sum of two doubles, the second at most half a unit in the last place of the first.
struct Pair {
    double high = 0.0, low = 0.0;
};

/// a + b, exactly (Knuth 1969).
constexpr Pair sumOf(double a, double b) noexcept {
    const double sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

/// a * b, exactly (Dekker 1971).
constexpr Pair productOf(double a, double b) noexcept {
    constexpr double splitter = 134217729.0; // 2^27 + 1
    const double bigA = splitter * a, bigB = splitter * b, a1 = bigA - (bigA - a), b1 = bigB - (bigB - b),
                 a2 = a - a1, b2 = b - b1, product = a * b;
    return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// sum of c[k] x^k.
template <std::size_t count>
constexpr double polynomial(const std::array<double, count>& c, double x) noexcept {
    double sum = c.back();
    for (std::size_t k = count - 1; k > 0; --k) sum = sum * x + c[k - 1];
    return sum;
}

/// The series' coefficients +-1 / (first + step k)!, or without the factorial.
template <std::size_t count>
constexpr std::array<double, count> terms(int first, int step, double sign, bool factorial) noexcept {
    std::array<double, count> all{};
    for (std::size_t k = 0; k < count; ++k) {
        const int n = first + step * static_cast<int>(k);
        double divisor = factorial ? 1.0 : n;
        for (int i = 2; factorial && i <= n; ++i) divisor *= i;
        all[k] = (k % 2 == 1 ? sign : 1.0) / divisor;
    }
    return all;
}

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 none = std::numeric_limits<double>::quiet_NaN(), ln2High = 0x1.62e42feep-1,
                 ln2Low = 0x1.a39ef35793c76p-33; // the first has 32 bits

/// exp(r) - 1 - r of |r| <= log(2) / 2.
inline double exponentialTail(double r) noexcept {
    static constexpr auto c = terms<12>(2, 1, 1.0, true);
    return r * r * polynomial(c, r);
}

inline double exponential(Pair x) noexcept {
    if (!(x.high < 709.79)) return x.high >= 709.79 ? infinity : x.high;
    if (x.high < -746.0) return 0.0;
    const double whole = std::floor(x.high * std::numbers::log2e + 0.5), first = x.high - whole * ln2High,
                 low = x.low - whole * ln2Low, r = first + low;
    const Pair power = sumOf(1.0, r);
    const double mantissa = power.high + (power.low + (exponentialTail(r) + ((first - r) + low)));
    const auto exponent = static_cast<std::int64_t>(whole), half = exponent / 2;
    const auto twoTo = [](std::int64_t n) {
        return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52);
    };
    return mantissa * twoTo(half) * twoTo(exponent - half);
}

/// The natural logarithm of a positive number.
inline Pair logarithm(double x) noexcept {
    int exponent = 0;
    double m = std::frexp(x, &exponent); // exact
    if (m < 0.5 * std::numbers::sqrt2) {
        m *= 2.0;
        --exponent;
    }
    // log(1 + f) = 2 atanh(s), s = f / (2 + f)
    static constexpr auto c = terms<11>(3, 2, 1.0, false);
    const double f = m - 1.0;
    const Pair g = sumOf(2.0, f);
    const double s = f / g.high, q = s * s;
    const Pair back = productOf(s, g.high);
    const double low = ((f - back.high) - back.low - s * g.low) / g.high;
    const Pair sum = sumOf(exponent * ln2High, 2.0 * s);
    return sumOf(sum.high, sum.low + (2.0 * (low + s * q * polynomial(c, q)) + exponent * ln2Low));
}

/// The logarithm times `perNatural`.
inline double logarithmTimes(Pair perNatural, double x) noexcept {
    if (!(x > 0.0 && x < infinity)) return x == 0.0 ? -infinity : x > 0.0 ? x : none;
    const Pair natural = logarithm(x), product = productOf(natural.high, perNatural.high);
    return product.high + (product.low + (natural.high * perNatural.low + natural.low * perNatural.high));
}

struct SineCosine {
    double sine = 0.0, cosine = 0.0;
};

/// Of an angle in radians: subtracts quarter turns (pi / 2 in 33 + 33 + 53 bits), then uses both series.
inline SineCosine sineCosine(double x) noexcept {
    if (!(std::abs(x) < 1.0e6)) x = std::remainder(x, 2.0 * std::numbers::pi);
    if (std::isnan(x)) return {none, none};
    const double quarters = std::floor(x * (2.0 / std::numbers::pi) + 0.5);
    const Pair first = sumOf(x - quarters * 0x1.921fb544p+0, -quarters * 0x1.0b4611a6p-34);
    const double last = first.low - quarters * 0x1.3198a2e037073p-69, r = first.high + last,
                 tail = (first.high - r) + last, q = r * r, half = 0.5 * q, cosineHead = 1.0 - half;
    static constexpr auto s = terms<8>(3, 2, -1.0, true), c = terms<8>(4, 2, -1.0, true);
    const double sine = r + (tail * cosineHead - r * q * polynomial(s, q)),
                 cosine = cosineHead + (((1.0 - cosineHead) - half) + (q * q * polynomial(c, q) - r * tail));
    switch (static_cast<std::int64_t>(quarters) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
    }
}

/// `turn` plus or minus atan(minor / major), 0 <= minor <= major: from the nearest tangent of 0, sqrt(2) - 1
/// and 1.
inline double arcTangent(double minor, double major, Pair turn, double sign) noexcept {
    struct Near {
        double tangent;
        Pair angle; ///< its arc tangent
    };
    static constexpr std::array<Near, 3> all{
        {{0.0, {}},
         {0x1.a827999fcef32p-2, {0x1.921fb54442d18p-2, 0x1.c398861b78b55p-59}},
         {1.0, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}}};
    const Near& near = all[minor > 0.6681786 * major ? 2 : minor > 0.1989124 * major ? 1 : 0];
    const Pair across = productOf(near.tangent, major), whole = sumOf(turn.high, sign * near.angle.high);
    const double t = ((minor - across.high) - across.low) / (major + near.tangent * minor), q = t * t;
    static constexpr auto c = terms<13>(3, 2, -1.0, false);
    const double tail = near.angle.low + (t - t * q * polynomial(c, q));
    return whole.high + (whole.low + (turn.low + sign * tail));
}

/// A power of two that brings a magnitude to where its square is a normal number.
inline double scaleOf(double magnitude) noexcept {
    return magnitude > 0x1p500 ? 0x1p-600 : magnitude < 0x1p-400 ? 0x1p600 : 1.0;
}
} // namespace detail

inline double exp(double x) noexcept { return detail::exponential({x, 0.0}); }
inline double expm1(double x) noexcept {
    return std::abs(x) < 0.34 ? x + detail::exponentialTail(x) : exp(x) - 1.0;
}
inline double cosh(double x) noexcept { return 0.5 * (exp(x) + exp(-x)); }

inline double log(double x) noexcept { return detail::logarithmTimes({1.0, 0.0}, x); }
inline double log2(double x) noexcept {
    return detail::logarithmTimes({0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56}, x);
}
inline double log10(double x) noexcept {
    return detail::logarithmTimes({0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57}, x);
}

/// x^y of x >= 0.
inline double pow(double x, double y) noexcept {
    using namespace detail;
    if (y == 0.0 || x == 1.0) return 1.0;
    if (!(x > 0.0 && x < infinity))
        return x == 0.0 ? (y > 0.0 ? 0.0 : infinity) : x > 0.0 ? (y > 0.0 ? x : 0.0) : none;
    const Pair natural = logarithm(x);
    if (!(std::abs(natural.high * y) < 1000.0)) return exp(natural.high * y);
    const Pair product = productOf(natural.high, y);
    return exponential(sumOf(product.high, product.low + natural.low * y));
}

inline double sin(double x) noexcept { return detail::sineCosine(x).sine; }
inline double cos(double x) noexcept { return detail::sineCosine(x).cosine; }
/// The length of a vector.
inline double hypot(double x, double y) noexcept {
    const double scale = detail::scaleOf(std::max(std::abs(x), std::abs(y)));
    x *= scale;
    y *= scale;
    return std::sqrt(x * x + y * y) / scale;
}

inline double abs(std::complex<double> z) noexcept { return hypot(z.real(), z.imag()); }
inline std::complex<double> quotient(std::complex<double> a, std::complex<double> b) noexcept {
    return a * std::conj(b) / (b.real() * b.real() + b.imag() * b.imag());
}
inline std::complex<double> exp(std::complex<double> z) noexcept {
    const auto circle = detail::sineCosine(z.imag());
    return exp(z.real()) * std::complex<double>{circle.cosine, circle.sine};
}
inline double tan(double x) noexcept {
    const auto circle = detail::sineCosine(x);
    return circle.sine / circle.cosine;
}

/// From -pi to pi.
inline double atan2(double y, double x) noexcept {
    double a = std::abs(x), b = std::abs(y);
    if (std::isnan(a) || std::isnan(b)) return detail::none;
    const double scale = detail::scaleOf(std::max(a, b));
    a *= scale;
    b *= scale;
    if (a > 0x1p1000 || b > 0x1p1000) { // infinite
        a = a > 0x1p1000 ? 1.0 : 0.0;
        b = b > 0x1p1000 ? 1.0 : 0.0;
    }
    // Angles near an axis are computed back from a quarter or half a turn.
    constexpr detail::Pair quarter{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
        half{2.0 * quarter.high, 2.0 * quarter.low};
    const bool isSteep = b > a, isLeft = std::signbit(x);
    const double angle = detail::arcTangent(std::min(a, b), a == 0.0 && b == 0.0 ? 1.0 : std::max(a, b),
                                            isSteep  ? quarter
                                            : isLeft ? half
                                                     : detail::Pair{},
                                            isSteep == isLeft ? 1.0 : -1.0);
    return std::copysign(angle, y);
}

} // namespace physvib::portable
