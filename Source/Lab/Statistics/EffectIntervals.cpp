// SPDX-License-Identifier: MIT
// Inverts noncentral distributions of Boost.Math by bisection.
#include "Lab/Statistics/EffectIntervals.h"
#include "Lab/Statistics/Distributions.h"
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <exception>

namespace physvib {
namespace {

constexpr double largestT = 100.0; // beyond it the mean's own error counts as nothing

/// Where `falling` is `target`, between `least` and `most`.
template <class Function>
double crossing(Function falling, double target, double least, double most) {
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (least + most);
        (falling(middle) > target ? least : most) = middle;
    }
    return 0.5 * (least + most);
}

} // namespace

std::optional<Interval95> noncentralityOfT(double t, double df) {
    if (std::abs(t) > largestT) {
        const auto share = [&](double p) {
            return std::sqrt(boost::math::gamma_p_inv(0.5 * df, p) * 2.0 / df);
        };
        return t > 0.0 ? Interval95{t * share(0.025), t * share(0.975)}
                       : Interval95{t * share(0.975), t * share(0.025)};
    }
    const auto below = [&](double noncentrality) {
        return boost::math::cdf(boost::math::non_central_t{df, noncentrality}, t);
    };
    const double reach = 10.0 * std::sqrt(1.0 + t * t / (2.0 * df));
    try {
        return Interval95{crossing(below, 0.975, t - reach, t + reach),
                          crossing(below, 0.025, t - reach, t + reach)};
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::optional<Interval95> intervalOfR(double r, double variance) {
    if (!(std::abs(r) < 1.0)) return std::nullopt;
    const double half = normalQuantile(0.975) * std::sqrt(variance);
    return Interval95{std::tanh(std::atanh(r) - half), std::tanh(std::atanh(r) + half)};
}

} // namespace physvib
