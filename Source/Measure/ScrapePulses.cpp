// SPDX-License-Identifier: MIT
// Smoothing by a cos^4 kernel and its derivatives; the resonance by weighted least squares with past values
// as instrumental variables.
#include "Measure/ScrapePulses.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace physvib {
namespace {

constexpr std::size_t fewestSamples = 4; // half width below which derivatives are inaccurate

/// cos^4 kernel of area 1 over 2 reach + 1 samples, and its first two derivatives in time.
struct Smoothing {
    Smoothing(std::size_t samples, double rateHz)
        : reach{samples} {
        const auto steps = static_cast<double>(reach + 1);
        const double turn = 0.5 * std::numbers::pi / steps, perSecond = turn * rateHz;
        double area = 0.0;
        for (std::size_t i = 0; i <= 2 * reach; ++i) {
            const double phase = turn * (static_cast<double>(i) - static_cast<double>(reach)),
                         c = std::cos(phase), s = std::sin(phase);
            value.push_back(c * c * c * c);
            slope.push_back(-4.0 * perSecond * c * c * c * s);
            bend.push_back(perSecond * perSecond * (12.0 * c * c * s * s - 4.0 * c * c * c * c));
            area += value.back();
        }
        for (auto* kernel : {&value, &slope, &bend})
            for (double& x : *kernel) x /= area;
    }
    std::size_t reach;
    std::vector<double> value, slope, bend;
};

/// `kernel` * x at every `step`-th sample, where the kernel fits completely.
std::vector<double> convolved(std::span<const double> x, const std::vector<double>& kernel,
                              std::size_t step) {
    std::vector<double> all;
    for (std::size_t n = kernel.size(); n <= x.size(); n += step) {
        double sum = 0.0;
        for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * x[n - 1 - k];
        all.push_back(sum);
    }
    return all;
}

Eigen::Map<const Eigen::ArrayXd> mapped(const std::vector<double>& x) {
    return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// Finds c = {2 tau, omega^2 + tau^2, minus the mean of the excitation} such that bend + c[0] slope + c[1]
/// value + c[2] is small most of the time. Noise in the regressors would make the decay look faster; values
/// `lag` earlier have independent noise and do not depend on later impacts.
std::optional<Eigen::Vector3d> ringing(const std::vector<double>& value, const std::vector<double>& slope,
                                       const std::vector<double>& bend, Eigen::Index lag) {
    constexpr int rounds = 20;
    constexpr double least = 0.02; // of the rms: limits the weight of small residuals
    const Eigen::Index rows = static_cast<Eigen::Index>(value.size()) - lag;
    if (rows < 100) return std::nullopt;
    Eigen::MatrixX3d all(rows + lag, 3);
    all << mapped(slope), mapped(value), Eigen::ArrayXd::Ones(rows + lag);
    Eigen::RowVector3d scale = (all.colwise().squaredNorm() / static_cast<double>(rows)).cwiseSqrt();
    if (!(scale.minCoeff() > 0.0)) return std::nullopt;
    all.array().rowwise() /= scale.array();
    const Eigen::VectorXd target = -mapped(bend).tail(rows);
    Eigen::ArrayXd weights = Eigen::ArrayXd::Ones(rows);
    Eigen::Vector3d found;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::Matrix3Xd past = (all.topRows(rows).array().colwise() * weights).matrix().transpose();
        found = (past * all.bottomRows(rows)).fullPivLu().solve(past * target);
        const Eigen::ArrayXd left = (target - all.bottomRows(rows) * found).array().abs();
        weights = 1.0 / left.max(least * std::sqrt(left.square().mean()));
        if (!weights.allFinite()) return std::nullopt;
    }
    return (found.array() / scale.transpose().array()).matrix();
}

double skewnessOf(const std::vector<double>& x) {
    const auto from = mapped(x) - mapped(x).mean();
    return from.cube().mean() / std::pow(from.square().mean(), 1.5);
}

} // namespace

std::optional<ScrapePulses> scrapePulses(std::span<const double> samples, double rateHz,
                                         double halfWidthSeconds) {
    const auto reach = static_cast<std::size_t>(std::lround(halfWidthSeconds * rateHz));
    if (reach < fewestSamples || samples.size() < 100 * reach) return std::nullopt;
    const Smoothing smoothing{reach, rateHz};
    const std::size_t step = std::max<std::size_t>(1, reach / 8);
    const auto value = convolved(samples, smoothing.value, step),
               slope = convolved(samples, smoothing.slope, step),
               bend = convolved(samples, smoothing.bend, step);
    const auto found = ringing(value, slope, bend, static_cast<Eigen::Index>(2 * reach / step + 2));
    if (!found) return std::nullopt;
    const double tau = 0.5 * (*found)[0], omega2 = (*found)[1] - tau * tau;
    if (!(tau > 0.0) || !(omega2 > tau * tau)) return std::nullopt;
    ScrapePulses pulses;
    pulses.frequencyHz = std::sqrt(omega2) / (2.0 * std::numbers::pi);
    pulses.decayPerSecond = tau;
    pulses.heightsPerSecond = rateHz / static_cast<double>(step);
    const double highest = smoothing.value[reach] * rateHz * std::sqrt(omega2);
    for (std::size_t n = 0; n < value.size(); ++n)
        pulses.heights.push_back((bend[n] + (*found)[0] * slope[n] + (*found)[1] * value[n] + (*found)[2]) /
                                 highest);
    pulses.skewness = skewnessOf(pulses.heights);
    if (pulses.skewness < 0.0) { // recorded with inverted polarity
        for (double& height : pulses.heights) height = -height;
        pulses.skewness = -pulses.skewness;
    }
    return pulses;
}

std::vector<double> smoothSlope(std::span<const double> samples, double rateHz, double halfWidthSeconds) {
    const auto reach = static_cast<std::size_t>(std::lround(halfWidthSeconds * rateHz));
    return convolved(samples, Smoothing{std::max(reach, fewestSamples), rateHz}.slope, 1);
}

} // namespace physvib
