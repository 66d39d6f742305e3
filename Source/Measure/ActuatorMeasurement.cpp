// SPDX-License-Identifier: MIT
// Fits the actuator model: transfer function, a first guess from magnitudes, the delay from phases, then
// least squares of all parameters.
#include "Measure/ActuatorMeasurement.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include "Measure/HitExcerpt.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace physvib {
namespace {

using Complex = std::complex<double>;
constexpr double twoPi = 2.0 * std::numbers::pi;
constexpr double fadeSeconds = 0.02;
constexpr double maxDelaySeconds = 1.0; // SweepSettings::tailSeconds

struct ResponsePoint {
    double hz;
    Complex response;
};

/// sum x[n] e^(-i w n), by a rotating phasor that is recomputed often enough to stay exact.
Complex spectrumAt(const std::vector<float>& x, double radiansPerFrame) {
    Complex sum = 0.0;
    const Complex rotation = std::polar(1.0, -radiansPerFrame);
    for (std::size_t first = 0; first < x.size(); first += 4096) {
        Complex phasor =
            std::polar(1.0, -std::remainder(radiansPerFrame * static_cast<double>(first), twoPi));
        for (std::size_t n = first; n < std::min(first + 4096, x.size()); ++n, phasor *= rotation)
            sum += static_cast<double>(x[n]) * phasor;
    }
    return sum;
}

/// Adds the transfer function at `count` logarithmically spaced frequencies. The spacing makes the phases
/// agree for the true delay only.
void addPoints(std::vector<ResponsePoint>& points, const std::vector<float>& played,
               const std::vector<float>& recorded, double rateHz, const FrequencyBand& band, int count) {
    for (int i = 0; i < count; ++i) {
        const double hz = band.lowHz * std::pow(band.highHz / band.lowHz, (i + 0.5) / count),
                     w = twoPi * hz / rateHz;
        points.push_back({hz, spectrumAt(recorded, w) / spectrumAt(played, w)});
    }
}

/// Half-height width of the peak, within `band`.
FrequencyBand peakBand(const Resonator& r, const FrequencyBand& band) {
    const double half = std::max(r.resonanceHz / r.q, 2.0);
    return {std::clamp(r.resonanceHz - half, band.lowHz, band.highHz - 1.0),
            std::clamp(r.resonanceHz + half, band.lowHz + 1.0, band.highHz)};
}

/// First guess: in the model, f^4 / |H|^2 is a parabola in f^2. Weights make all points count by magnitude.
Resonator firstGuess(const std::vector<ResponsePoint>& points) {
    double maxPowerHz = 0.0, maxPower = -1.0;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rightSide = Eigen::Vector3d::Zero();
    for (const ResponsePoint& p : points) {
        const double power = std::norm(p.response), square = p.hz * p.hz, target = square * square / power,
                     weight = power * power / (square * square);
        if (power > maxPower) maxPower = power, maxPowerHz = p.hz;
        const Eigen::Vector3d basis{1.0, square, square * square};
        matrix += weight * basis * basis.transpose();
        rightSide += weight * target * basis;
    }
    const Eigen::Vector3d c = matrix.ldlt().solve(rightSide);
    // c2 (f0^4 + (f0^2 / Q^2 - 2 f0^2) f^2 + f^4)
    const double square = std::sqrt(c[0] / c[2]), loss = c[1] / (c[2] * square) + 2.0;
    if (!(square > 0.0) || !(loss > 0.0)) return {maxPowerHz, 3.0};
    return {std::sqrt(square), 1.0 / std::sqrt(loss)};
}

/// Candidate parameters of the fit. The best gain follows linearly, so only three numbers are searched.
struct Candidate {
    std::array<double, 3> parameters; ///< log f0, log Q, delay
    Complex gain;
    double error;

    static Complex model(const std::array<double, 3>& p, double hz) {
        return Resonator{std::exp(p[0]), std::exp(p[1])}.at(hz) * std::polar(1.0, -twoPi * hz * p[2]);
    }
    Candidate(const std::vector<ResponsePoint>& points, const std::array<double, 3>& start)
        : parameters{start} {
        Complex product = 0.0;
        double power = 0.0;
        for (const ResponsePoint& p : points) {
            const Complex m = model(parameters, p.hz);
            product += std::conj(m) * p.response;
            power += std::norm(m);
        }
        gain = (product / power).real(); // real: polarity may be inverted, but phase belongs to the delay
        error = 0.0;
        for (const ResponsePoint& p : points) error += std::norm(p.response - gain * model(parameters, p.hz));
    }
};

/// The delay at which the phases agree best with model(hz): coarse steps, then a golden-section search.
template <class Model>
double bestDelaySeconds(const std::vector<ResponsePoint>& points, Model model) {
    const auto agreement = [&](double seconds) {
        Complex sum = 0.0;
        for (const ResponsePoint& p : points)
            sum += p.response * std::conj(model(p.hz)) * std::polar(1.0, twoPi * p.hz * seconds);
        return std::abs(sum.real());
    };
    const double step = 0.1 / points.back().hz;
    double best = 0.0;
    for (double seconds = 0.0; seconds < maxDelaySeconds; seconds += step)
        if (agreement(seconds) > agreement(best)) best = seconds;
    double low = best - step, high = best + step;
    for (int i = 0; i < 40; ++i) {
        const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low); // golden section
        (agreement(a) > agreement(b) ? high : low) = agreement(a) > agreement(b) ? b : a;
    }
    return 0.5 * (low + high);
}

/// A pattern search with shrinking steps along the axes and their combination. Unlike Gauss-Newton it needs
/// no derivatives of the projected gain, and three numbers are few.
Candidate refine(const std::vector<ResponsePoint>& points, Candidate best) {
    std::array<double, 3> steps{0.02, 0.2, 1e-4};
    for (int round = 0; round < 400 && *std::ranges::max_element(steps) > 1e-9; ++round) {
        const Candidate previous = best;
        for (std::size_t i = 0; i < 3; ++i) {
            bool hasMoved = false;
            for (const double sign : {1.0, -1.0}) {
                auto trial = best.parameters;
                trial[i] += sign * steps[i];
                if (const Candidate next{points, trial}; next.error < best.error)
                    best = next, hasMoved = true;
                if (hasMoved) break;
            }
            steps[i] *= hasMoved ? 1.3 : 0.5;
        }
        auto extrapolated = best.parameters; // along the direction of progress
        for (std::size_t i = 0; i < 3; ++i) extrapolated[i] += best.parameters[i] - previous.parameters[i];
        if (const Candidate next{points, extrapolated}; next.error < best.error) best = next;
    }
    return best;
}

double responseEnergy(const std::vector<ResponsePoint>& points) {
    double energy = 0.0;
    for (const ResponsePoint& p : points) energy += std::norm(p.response);
    return energy;
}
// the error if the energy of the transfer function is not finite
constexpr const char* sweepError = "what was played: expected a sweep through the whole band";

std::string inputError(const std::vector<float>& played, const std::vector<float>& recorded, double rateHz,
                       const FrequencyBand& band) {
    if (!band.isKnown() || band.highHz >= 0.5 * rateHz || band.highHz < band.lowHz + 10.0)
        return "expected a band of at least 10 Hz below half the rate";
    constexpr double minSeconds = 0.1;
    if (auto error = recordingError(played, rateHz, minSeconds); !error.empty())
        return "what was played: " + error;
    if (auto error = recordingError(recorded, rateHz, minSeconds); !error.empty())
        return "what was recorded: " + error;
    if (isSilent(played)) return "what was played: expected a sweep, found silence";
    if (isSilent(recorded)) return "what was recorded: expected the sweep, found silence";
    const std::string clipped = clippingError(recorded, rateHz);
    return clipped.empty() ? clipped : "what was recorded: " + clipped;
}

} // namespace

std::vector<float> makeSweep(const SweepSettings& s, double rateHz) {
    const auto frames = static_cast<std::size_t>(s.seconds * rateHz);
    std::vector<float> samples(frames + static_cast<std::size_t>(s.tailSeconds * rateHz));
    const double growth = std::log(s.band.highHz / s.band.lowHz) / s.seconds;
    for (std::size_t n = 0; n < frames; ++n) {
        const double t = static_cast<double>(n) / rateHz,
                     phase = twoPi * s.band.lowHz * std::expm1(growth * t) / growth;
        const double edge = std::clamp(std::min(t, s.seconds - t) / fadeSeconds, 0.0, 1.0);
        samples[n] =
            static_cast<float>(s.level * std::sin(phase) * 0.5 * (1.0 - std::cos(std::numbers::pi * edge)));
    }
    return samples;
}

FrequencyBand MeasuredActuator::bandWithin(double decibels, const FrequencyBand& sweptBand) const {
    // relative to the peak or the plateau
    const double minMagnitude = fromDecibels(-decibels) * std::max(1.0, 1.0 / resonator.q);
    FrequencyBand band{};
    for (double hz = std::ceil(sweptBand.lowHz); hz <= sweptBand.highHz; hz += 1.0) {
        if (std::abs(resonator.at(hz)) < minMagnitude) continue;
        if (band.lowHz == 0.0) band.lowHz = hz;
        band.highHz = hz;
    }
    return band;
}

Result<MeasuredActuator> fitActuator(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band) {
    if (auto error = inputError(played, recorded, rateHz, band); !error.empty()) return Failure{error};
    std::vector<ResponsePoint> points;
    addPoints(points, played, recorded, rateHz, band, 240);
    const Resonator guess = firstGuess(points);
    const Candidate rough =
        refine(points, {points,
                        {std::log(guess.resonanceHz), std::log(guess.q),
                         bestDelaySeconds(points, [&guess](double hz) { return guess.at(hz); })}});
    // around the peak, which determines resonance and Q
    addPoints(points, played, recorded, rateHz,
              peakBand({std::exp(rough.parameters[0]), std::exp(rough.parameters[1])}, band), 120);
    const double energy = responseEnergy(points);
    if (!std::isfinite(energy)) return Failure{sweepError};
    const Candidate best = refine(points, {points, rough.parameters});
    MeasuredActuator measured{{std::exp(best.parameters[0]), std::exp(best.parameters[1])},
                              best.gain.real(),
                              best.parameters[2],
                              best.error / energy,
                              rateHz};
    if (!(measured.residualShare < 0.5))
        return Failure{
            "expected the response of a resonant actuator, found one of which the model explains " +
            fixedNumber(100.0 * (1.0 - measured.residualShare), 0) + " %"};
    if (const double hz = measured.resonator.resonanceHz; hz < band.lowHz || hz > band.highHz)
        return Failure{"expected a resonance from " + numberText(band.lowHz) + " to " +
                       numberText(band.highHz) + " Hz, found none"};
    return measured;
}

Result<MeasuredLoopback> fitLoopback(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band) {
    if (auto error = inputError(played, recorded, rateHz, band); !error.empty()) return Failure{error};
    std::vector<ResponsePoint> points;
    addPoints(points, played, recorded, rateHz, band, 240);
    const double energy = responseEnergy(points);
    if (!std::isfinite(energy)) return Failure{sweepError};
    MeasuredLoopback fit;
    fit.delaySeconds = bestDelaySeconds(points, [](double) { return Complex{1.0}; });
    Complex sum = 0.0;
    for (const ResponsePoint& p : points)
        sum += p.response * std::polar(1.0, twoPi * p.hz * fit.delaySeconds);
    const double count = static_cast<double>(points.size());
    fit.gain = sum.real() / count;
    fit.residualShare = 1.0 - fit.gain * fit.gain * count / energy;
    if (!(fit.residualShare < 0.1))
        return Failure{
            "expected a cable from the output to the input, found a response that one explains by " +
            fixedNumber(100.0 * (1.0 - fit.residualShare), 0) + " %"};
    return fit;
}

} // namespace physvib
