// SPDX-License-Identifier: MIT
// Quantiles by Boost.Math.
#include "Lab/Statistics/Distributions.h"
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <numbers>

namespace physvib {

double studentQuantile(double probability, double df) {
    return boost::math::quantile(boost::math::students_t{df}, probability);
}

double normalQuantile(double probability) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability);
}

} // namespace physvib
