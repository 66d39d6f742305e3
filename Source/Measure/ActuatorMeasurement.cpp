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
constexpr double longestDelaySeconds = 1.0; // SweepSettings::restSeconds

struct Point {
    double hz;
    Complex response;
};

/// sum x[n] e^(-i w n), by a rotating phasor that is recomputed often enough to stay exact.
Complex spectrumAt(const std::vector<float>& x, double radiansPerFrame) {
    Complex sum = 0.0;
    const Complex turn = std::polar(1.0, -radiansPerFrame);
    for (std::size_t first = 0; first < x.size(); first += 4096) {
        Complex phasor =
            std::polar(1.0, -std::remainder(radiansPerFrame * static_cast<double>(first), twoPi));
        for (std::size_t n = first; n < std::min(first + 4096, x.size()); ++n, phasor *= turn)
            sum += static_cast<double>(x[n]) * phasor;
    }
    return sum;
}

/// Adds the transfer function at `count` logarithmically spaced frequencies. The spacing makes the phases
/// agree for the true delay only.
void addPoints(std::vector<Point>& points, const std::vector<float>& played,
               const std::vector<float>& recorded, double rateHz, const FrequencyBand& band, int count) {
    for (int i = 0; i < count; ++i) {
        const double hz = band.lowHz * std::pow(band.highHz / band.lowHz, (i + 0.5) / count),
                     w = twoPi * hz / rateHz;
        points.push_back({hz, spectrumAt(recorded, w) / spectrumAt(played, w)});
    }
}

/// Half-height width of the peak, within `band`.
FrequencyBand peakOf(const Resonator& r, const FrequencyBand& band) {
    const double half = std::max(r.resonanceHz / r.q, 2.0);
    return {std::clamp(r.resonanceHz - half, band.lowHz, band.highHz - 1.0),
            std::clamp(r.resonanceHz + half, band.lowHz + 1.0, band.highHz)};
}

/// In the model f^4 / |H|^2 is a parabola in f^2; weighted so that all points count by their magnitude.
Resonator firstGuess(const std::vector<Point>& points) {
    double strongestHz = 0.0, strongest = -1.0;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Point& p : points) {
        const double power = std::norm(p.response), square = p.hz * p.hz, target = square * square / power,
                     weight = power * power / (square * square);
        if (power > strongest) strongest = power, strongestHz = p.hz;
        const Eigen::Vector3d basis{1.0, square, square * square};
        matrix += weight * basis * basis.transpose();
        right += weight * target * basis;
    }
    const Eigen::Vector3d c = matrix.ldlt().solve(right);
    // c2 (f0^4 + (f0^2 / Q^2 - 2 f0^2) f^2 + f^4)
    const double square = std::sqrt(c[0] / c[2]), loss = c[1] / (c[2] * square) + 2.0;
    if (!(square > 0.0) || !(loss > 0.0)) return {strongestHz, 3.0};
    return {std::sqrt(square), 1.0 / std::sqrt(loss)};
}

/// Trial parameters of the fit. The best gain follows linearly, so only three numbers are searched.
struct Trial {
    std::array<double, 3> at; ///< log f0, log Q, delay
    Complex gain;
    double error;

    static Complex model(const std::array<double, 3>& at, double hz) {
        return Resonator{std::exp(at[0]), std::exp(at[1])}.at(hz) * std::polar(1.0, -twoPi * hz * at[2]);
    }
    Trial(const std::vector<Point>& points, const std::array<double, 3>& wanted)
        : at{wanted} {
        Complex product = 0.0;
        double power = 0.0;
        for (const Point& p : points) {
            const Complex m = model(at, p.hz);
            product += std::conj(m) * p.response;
            power += std::norm(m);
        }
        gain = (product / power).real(); // real: polarity may be inverted, but phase belongs to the delay
        error = 0.0;
        for (const Point& p : points) error += std::norm(p.response - gain * model(at, p.hz));
    }
};

/// The delay at which the phases agree best with guess(hz): coarse steps, then a golden-section search.
template <class Guess>
double delayOf(const std::vector<Point>& points, Guess guess) {
    const auto agreement = [&](double seconds) {
        Complex sum = 0.0;
        for (const Point& p : points)
            sum += p.response * std::conj(guess(p.hz)) * std::polar(1.0, twoPi * p.hz * seconds);
        return std::abs(sum.real());
    };
    const double step = 0.1 / points.back().hz;
    double best = 0.0;
    for (double seconds = 0.0; seconds < longestDelaySeconds; seconds += step)
        if (agreement(seconds) > agreement(best)) best = seconds;
    double low = best - step, high = best + step;
    for (int i = 0; i < 40; ++i) {
        const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
        (agreement(a) > agreement(b) ? high : low) = agreement(a) > agreement(b) ? b : a;
    }
    return 0.5 * (low + high);
}

/// A pattern search with shrinking steps along the axes and their combination. Unlike Gauss-Newton it needs
/// no derivatives of the projected gain, and three numbers are few.
Trial refine(const std::vector<Point>& points, Trial best) {
    std::array<double, 3> step{0.02, 0.2, 1e-4};
    for (int round = 0; round < 400 && *std::ranges::max_element(step) > 1e-9; ++round) {
        const Trial before = best;
        for (std::size_t i = 0; i < 3; ++i) {
            bool moved = false;
            for (const double sign : {1.0, -1.0}) {
                auto at = best.at;
                at[i] += sign * step[i];
                if (const Trial next{points, at}; next.error < best.error) best = next, moved = true;
                if (moved) break;
            }
            step[i] *= moved ? 1.3 : 0.5;
        }
        auto ahead = best.at; // along the direction of progress
        for (std::size_t i = 0; i < 3; ++i) ahead[i] += best.at[i] - before.at[i];
        if (const Trial next{points, ahead}; next.error < best.error) best = next;
    }
    return best;
}

double energyOf(const std::vector<Point>& points) {
    double energy = 0.0;
    for (const Point& p : points) energy += std::norm(p.response);
    return energy;
}
// the spectrum's energy is not finite
constexpr const char* unswept = "what was played: expected a sweep through the whole band";

std::string faultOf(const std::vector<float>& played, const std::vector<float>& recorded, double rateHz,
                    const FrequencyBand& band) {
    if (!band.isKnown() || band.highHz >= 0.5 * rateHz || band.highHz < band.lowHz + 10.0)
        return "expected a band of at least 10 Hz below half the rate";
    constexpr double shortestSeconds = 0.1;
    if (auto fault = recordingFault(played, rateHz, shortestSeconds); !fault.empty())
        return "what was played: " + fault;
    if (auto fault = recordingFault(recorded, rateHz, shortestSeconds); !fault.empty())
        return "what was recorded: " + fault;
    if (isSilent(played)) return "what was played: expected a sweep, found silence";
    if (isSilent(recorded)) return "what was recorded: expected the sweep, found silence";
    const std::string clipped = clippingFault(recorded, rateHz);
    return clipped.empty() ? clipped : "what was recorded: " + clipped;
}

} // namespace

std::vector<float> sweepOf(const SweepSettings& s, double rateHz) {
    const auto frames = static_cast<std::size_t>(s.seconds * rateHz);
    std::vector<float> samples(frames + static_cast<std::size_t>(s.restSeconds * rateHz));
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

FrequencyBand MeasuredActuator::bandWithin(double decibels, const FrequencyBand& swept) const {
    // relative to the peak or the plateau
    const double least = fromDecibels(-decibels) * std::max(1.0, 1.0 / resonator.q);
    FrequencyBand band{};
    for (double hz = std::ceil(swept.lowHz); hz <= swept.highHz; hz += 1.0) {
        if (std::abs(resonator.at(hz)) < least) continue;
        if (band.lowHz == 0.0) band.lowHz = hz;
        band.highHz = hz;
    }
    return band;
}

Result<MeasuredActuator> fitActuator(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band) {
    if (auto fault = faultOf(played, recorded, rateHz, band); !fault.empty()) return Failure{fault};
    std::vector<Point> points;
    addPoints(points, played, recorded, rateHz, band, 240);
    const Resonator guess = firstGuess(points);
    const Trial rough = refine(points, {points,
                                        {std::log(guess.resonanceHz), std::log(guess.q),
                                         delayOf(points, [&guess](double hz) { return guess.at(hz); })}});
    // around the peak, which determines resonance and Q
    addPoints(points, played, recorded, rateHz, peakOf({std::exp(rough.at[0]), std::exp(rough.at[1])}, band),
              120);
    const double energy = energyOf(points);
    if (!std::isfinite(energy)) return Failure{unswept};
    const Trial best = refine(points, {points, rough.at});
    MeasuredActuator measured{{std::exp(best.at[0]), std::exp(best.at[1])},
                              best.gain.real(),
                              best.at[2],
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
    if (auto fault = faultOf(played, recorded, rateHz, band); !fault.empty()) return Failure{fault};
    std::vector<Point> points;
    addPoints(points, played, recorded, rateHz, band, 240);
    const double energy = energyOf(points);
    if (!std::isfinite(energy)) return Failure{unswept};
    MeasuredLoopback m;
    m.delaySeconds = delayOf(points, [](double) { return Complex{1.0}; });
    Complex sum = 0.0;
    for (const Point& p : points) sum += p.response * std::polar(1.0, twoPi * p.hz * m.delaySeconds);
    const double count = static_cast<double>(points.size());
    m.gain = sum.real() / count;
    m.residualShare = 1.0 - m.gain * m.gain * count / energy;
    if (!(m.residualShare < 0.1))
        return Failure{
            "expected a cable from the output to the input, found a response that one explains by " +
            fixedNumber(100.0 * (1.0 - m.residualShare), 0) + " %"};
    return m;
}

} // namespace physvib
