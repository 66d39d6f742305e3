// SPDX-License-Identifier: MIT
// Our functions against the C library's longest type, and their bits against those of every other machine.
#include "Core/PortableMath.h"
#include "Core/Trigonometry.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace physvib::portable_math_test {

using Long = long double;

/// Arguments of both signs and many sizes.
struct Arguments {
    std::mt19937_64 random{3};
    double within(double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    }
    double anySize(double least, double most) { return std::exp2(within(std::log2(least), std::log2(most))); }
};

/// How far a value lies from the true one, in units in the last place of that.
[[maybe_unused]] double unitsApart(double value, Long truth) {
    const double nearest = static_cast<double>(truth), up = std::nextafter(std::abs(nearest), INFINITY);
    return static_cast<double>(std::abs(static_cast<Long>(value) - truth) / (up - std::abs(nearest)));
}

struct Function {
    const char* name;
    double most; // units in the last place
    std::function<double(double, double)> ours;
    std::function<Long(Long, Long)> theirs;
    std::function<double(Arguments&)> x, y;
};

std::vector<Function> functions() {
    const auto any = [](double least, double most) {
        return [=](Arguments& a) { return a.anySize(least, most); };
    };
    const auto within = [](double low, double high) {
        return [=](Arguments& a) { return a.within(low, high); };
    };
    // of one argument
    const auto of = [&](const char* name, double most, double (*ours)(double), Long (*theirs)(Long), auto x) {
        return Function{name,
                        most,
                        [=](double at, double) { return ours(at); },
                        [=](Long at, Long) { return theirs(at); },
                        x,
                        within(0.0, 1.0)};
    };
    return {
        of("exp", 1, portable::exp, std::exp, within(-700, 700)),
        of("exp", 1, portable::exp, std::exp, within(-2, 2)),
        of(
            "expm1", 2, [](double x) { return portable::expm1(-x); }, [](Long x) { return std::expm1(-x); },
            any(1e-12, 40)),
        of("cosh", 2, portable::cosh, std::cosh, within(0, 50)),
        of("log", 1, portable::log, std::log, any(1e-300, 1e300)),
        of("log", 1, portable::log, std::log, within(0.5, 2)),
        of("log2", 1, portable::log2, std::log2, within(0.5, 2)),
        of("log10", 1, portable::log10, std::log10, any(1e-9, 1e9)),
        {"pow", 1, [](double x, double y) { return portable::pow(x, y); },
         [](Long x, Long y) { return std::pow(x, y); }, any(1e-20, 1e20), within(-10, 10)},
        of("sin", 1, portable::sin, std::sin, within(-10, 10)),
        of("sin", 1, portable::sin, std::sin, within(-1e6, 1e6)),
        of("cos", 1, portable::cos, std::cos, within(-10, 10)),
        of("tan", 2, portable::tan, std::tan, within(0, 1.57)),
        {"atan2", 2, [](double x, double y) { return portable::atan2(x, y); },
         [](Long x, Long y) { return std::atan2(x, y); }, within(-1, 1), within(-1, 1)},
        {"atan2", 2, [](double x, double y) { return portable::atan2(x, y); },
         [](Long x, Long y) { return std::atan2(x, y); }, any(1e-100, 1e100), any(1e-100, 1e100)},
        {"hypot", 2, [](double x, double y) { return portable::hypot(x, y); },
         [](Long x, Long y) { return std::hypot(x, y); }, any(1e-200, 1e200), any(1e-200, 1e200)},
    };
}

#ifndef _WIN32 // whose library is less exact; the bits below are the same there
TEST(PortableMath, IsWithinAUnitOrTwoInTheLastPlace) {
    for (const Function& f : functions()) {
        Arguments arguments;
        double worst = 0.0, at = 0.0;
        for (int i = 0; i < 20'000; ++i) {
            const double x = f.x(arguments), y = f.y(arguments);
            const double apart = unitsApart(f.ours(x, y), f.theirs(x, y));
            if (!(apart <= worst)) worst = apart, at = x;
        }
        // where the longest type is a double, its own rounding is in the difference
        const double more = std::numeric_limits<Long>::digits > 53 ? 0.0 : 1.0;
        EXPECT_LE(worst, f.most + more) << f.name << " of " << at;
    }
}
#endif

// FNV-1a over the bits of many results: one number on every machine.
TEST(PortableMath, HasTheBitsOfEveryOtherMachine) {
    std::uint64_t hash = 14695981039346656037u;
    const std::vector<Function> all = functions();
    std::mt19937_64 random{5};
    for (int i = 0; i < 20'000; ++i) {
        const double x = 0.01 + 30.0 * static_cast<double>(random() >> 11) * 0x1p-53,
                     y = -5.0 + 10.0 * static_cast<double>(random() >> 11) * 0x1p-53;
        for (const Function& f : all)
            hash = (hash ^ std::bit_cast<std::uint64_t>(f.ours(x, y))) * 1099511628211u;
    }
    EXPECT_EQ(hash, 2612934645853174601u);
}

TEST(PortableMath, IsExactWhereOneExpectsIt) {
    namespace p = portable;
    EXPECT_EQ(p::exp(0.0), 1.0);
    EXPECT_EQ(p::log(1.0), 0.0);
    for (int n = -40; n <= 40; ++n) {
        EXPECT_EQ(p::log2(std::ldexp(1.0, n)), n);
        EXPECT_EQ(p::pow(2.0, n), std::ldexp(1.0, n));
    }
    for (int n = -20; n <= 20; ++n) {
        EXPECT_EQ(p::log10(std::stod("1e" + std::to_string(n))), n);
        EXPECT_EQ(p::pow(10.0, n), std::stod("1e" + std::to_string(n)));
    }
    EXPECT_EQ(p::sin(0.0), 0.0);
    EXPECT_EQ(p::cos(0.0), 1.0);
    EXPECT_EQ(p::hypot(3.0, -4.0), 5.0);
    for (const double y : {0.0, -0.0, 1.0, -1.0, double(INFINITY), -double(INFINITY)})
        for (const double x : {0.0, -0.0, 1.0, -1.0, double(INFINITY), -double(INFINITY)})
            EXPECT_EQ(p::atan2(y, x), std::atan2(y, x)) << y << ' ' << x;
}

TEST(PortableMath, IsNoNumberOrInfiniteWhereTheCLibraryIs) {
    namespace p = portable;
    const double no = NAN, far = INFINITY;
    for (const double x : {no, far, -far, 0.0, -1.0, 1e308, -1e308, 5e-324}) {
        const auto alike = [&](double a, double b) {
            return std::isnan(b)   ? std::isnan(a)
                   : std::isinf(b) ? a == b
                                   : std::abs(a - b) <= 1e-15 * std::abs(b);
        };
        EXPECT_TRUE(alike(p::exp(x), std::exp(x))) << x;
        EXPECT_TRUE(alike(p::log(x), std::log(x))) << x;
        EXPECT_TRUE(alike(p::log10(x), std::log10(x))) << x;
        EXPECT_TRUE(alike(p::hypot(x, x), std::hypot(x, x))) << x;
        EXPECT_TRUE(std::abs(x) >= 1e6 || alike(p::sin(x), std::sin(x))) << x;
        EXPECT_EQ(std::isnan(p::cos(x)), std::isnan(std::cos(x))) << x;
        EXPECT_TRUE(alike(p::atan2(x, 1.0), std::atan2(x, 1.0))) << x;
        for (const double y : {-2.5, 0.0, 0.5, 3.0})
            EXPECT_TRUE(x < 0.0 || alike(p::pow(x, y), std::pow(x, y))) << x << " to " << y;
    }
}

// Polynomials against the C library, over whole turns and octaves.

template <class Real>
double worstPhasorError() {
    std::mt19937_64 random{1};
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const std::uint64_t phase = random();
        const double angle = 2.0 * std::numbers::pi * (static_cast<double>(phase) / 18446744073709551616.0);
        const auto p = unitPhasor<Real>(phase);
        worst = std::max(
            {worst, std::abs(double(p.re) - std::cos(angle)), std::abs(double(p.im) - std::sin(angle))});
    }
    return worst;
}

template <class Real>
double worstDecayError() {
    std::mt19937_64 random{2};
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto octaves = static_cast<std::int64_t>(random() >> 1) - (std::int64_t{1} << 62); // +-64
        const double expected = std::exp2(-static_cast<double>(octaves) / octaveUnit);
        worst = std::max(worst, std::abs(double(decayFactor<Real>(octaves)) / expected - 1.0));
    }
    return worst;
}

TEST(Trigonometry, PhasorIsAccurate) {
    EXPECT_LT(worstPhasorError<double>(), 1e-11);
    EXPECT_LT(worstPhasorError<float>(), 1.2e-7);
}

TEST(Trigonometry, PhasorIsExactAtQuarterTurns) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        const auto p = unitPhasor<double>(static_cast<std::uint64_t>(quarter) << 62);
        EXPECT_EQ(p.re, quarter == 0 ? 1.0 : quarter == 2 ? -1.0 : 0.0);
        EXPECT_EQ(p.im, quarter == 1 ? 1.0 : quarter == 3 ? -1.0 : 0.0);
    }
}

TEST(Trigonometry, DecayIsAccurate) {
    EXPECT_LT(worstDecayError<double>(), 2e-11);
    EXPECT_LT(worstDecayError<float>(), 2e-7);
}

TEST(Trigonometry, DecayIsExactAtWholeOctaves) {
    for (const std::int64_t n : {-55, -1, 0, 1, 23, 120})
        EXPECT_EQ(decayFactor<float>(n * (std::int64_t{1} << octaveFractionBits)),
                  std::exp2(static_cast<float>(-n)));
}

} // namespace physvib::portable_math_test
