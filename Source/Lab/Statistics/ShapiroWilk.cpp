// SPDX-License-Identifier: MIT
// Algorithm AS R94: weights from normal scores, p from polynomials in the sample size.
#include "Lab/Statistics/ShapiroWilk.h"
#include "Lab/Statistics/Distributions.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace physvib {
namespace {

double polynomial(std::initializer_list<double> coefficients, double x) {
    double sum = 0.0, power = 1.0;
    for (const double c : coefficients) {
        sum += c * power;
        power *= x;
    }
    return sum;
}

/// Weights of largest minus smallest value, second largest minus second smallest, and so on.
std::vector<double> shapiroWeights(std::size_t size) {
    const auto n = static_cast<double>(size);
    std::vector<double> a(size / 2);
    if (size == 3) return {std::numbers::sqrt2 / 2.0};
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = -normalQuantile((static_cast<double>(i) + 1.0 - 0.375) / (n + 0.25));
        squares += 2.0 * a[i] * a[i];
    }
    const double root = std::sqrt(squares), inverse = 1.0 / std::sqrt(n);
    const double first =
        a[0] / root + polynomial({0.0, 0.221157, -0.147981, -2.07119, 4.434685, -2.706056}, inverse);
    double left = squares - 2.0 * a[0] * a[0], used = 1.0 - 2.0 * first * first;
    double second = 0.0;
    if (size > 5) {
        second =
            a[1] / root + polynomial({0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633}, inverse);
        left -= 2.0 * a[1] * a[1];
        used -= 2.0 * second * second;
    }
    for (double& weight : a) weight /= std::sqrt(left / used);
    a[0] = first;
    if (size > 5) a[1] = second;
    return a;
}

double shapiroP(double w, std::size_t size) {
    const auto n = static_cast<double>(size);
    if (size == 3)
        return std::max(0.0, 6.0 / std::numbers::pi * (std::asin(std::sqrt(w)) - std::asin(std::sqrt(0.75))));
    double y = std::log(1.0 - w), mean = 0.0, deviation = 1.0;
    if (size <= 11) {
        const double gamma = polynomial({-2.273, 0.459}, n);
        if (y >= gamma) return 1e-99; // as in AS R94
        y = -std::log(gamma - y);
        mean = polynomial({0.544, -0.39978, 0.025054, -6.714e-4}, n);
        deviation = std::exp(polynomial({1.3822, -0.77857, 0.062767, -0.0020322}, n));
    } else {
        mean = polynomial({-1.5861, -0.31082, -0.083751, 0.0038915}, std::log(n));
        deviation = std::exp(polynomial({-0.4803, -0.082676, 0.0030302}, std::log(n)));
    }
    return normalUpper((y - mean) / deviation);
}

} // namespace

TestLine shapiroWilk(std::span<const double> values) {
    std::vector<double> x{values.begin(), values.end()};
    std::ranges::sort(x);
    const double range = x.back() - x.front();
    for (double& v : x) v /= range;
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
    const auto a = shapiroWeights(x.size());
    double spread = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) spread += a[i] * (x[x.size() - 1 - i] - x[i]);
    for (const double v : x) squares += (v - mean) * (v - mean);
    const double w = std::min(1.0 - 1e-16, spread * spread / squares);
    TestLine line;
    line.statistic = w;
    line.p = std::min(1.0, shapiroP(w, x.size()));
    line.n = x.size();
    return line;
}

namespace {

/// "group=b:law=linear", or the parts of it that the design has.
std::string cellName(const Design& design, std::size_t group, std::size_t cell) {
    if (!design.between) return design.cellName(cell);
    std::string name = design.between->name;
    name.append("=").append(design.between->levels[group]);
    if (!design.within.empty()) name.append(":").append(design.cellName(cell));
    return name;
}

} // namespace

TestReport shapiroByCell(const Design& design) {
    if (!design.fault.empty()) return {design.fault};
    TestReport report{{}, "W"};
    for (std::size_t group = 0; group < design.groupCount(); ++group)
        for (std::size_t cell = 0; cell < design.cells(); ++cell) {
            std::vector<double> values;
            for (std::size_t p = 0; p < design.participants.size(); ++p)
                if (design.groups[p] == group) values.push_back(design.value(p, cell));
            const std::string name = cellName(design, group, cell);
            if (values.size() < fewestForShapiro || values.size() > mostForShapiro)
                return {name + ": expected " + std::to_string(fewestForShapiro) + " to " +
                        std::to_string(mostForShapiro) + " participants, found " +
                        std::to_string(values.size())};
            const auto [least, most] = std::ranges::minmax(values);
            if (!(most - least > 1e-14 * std::max(std::abs(least), std::abs(most))))
                return {name + ": expected values that differ, found the same for every participant"};
            report.lines.push_back(shapiroWilk(values));
            report.lines.back().effect = name;
        }
    return report;
}

} // namespace physvib
