// SPDX-License-Identifier: MIT
// The textbook transform: Cooley and Tukey 1965, radix two, in place.
#include "Measure/Spectrum.h"
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace physvib {
namespace {

using Point = Complex<double>;

void reorder(std::vector<Point>& points) {
    for (std::size_t i = 1, j = 0; i < points.size(); ++i) {
        std::size_t bit = points.size() / 2;
        for (; j & bit; bit /= 2) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(points[i], points[j]);
    }
}

void transform(std::vector<Point>& points) {
    reorder(points);
    std::vector<Point> turns(points.size() / 2);
    for (std::size_t k = 0; k < turns.size(); ++k) {
        const double angle = -2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points.size());
        turns[k] = {std::cos(angle), std::sin(angle)};
    }
    for (std::size_t half = 1; half < points.size(); half *= 2)
        for (std::size_t first = 0; first < points.size(); first += 2 * half)
            for (std::size_t k = 0; k < half; ++k) {
                const Point even = points[first + k], odd = points[first + k + half] * turns[k * (turns.size() / half)];
                points[first + k] = {even.re + odd.re, even.im + odd.im};
                points[first + k + half] = {even.re - odd.re, even.im - odd.im};
            }
}

} // namespace

Point pointOfSpectrum(std::span<const double> samples, double rateHz, double omega, double tau) {
    const double factor = std::exp(-tau / rateHz);
    const Point turn{factor * std::cos(omega / rateHz), -factor * std::sin(omega / rateHz)};
    Point sum, phasor{1.0, 0.0};
    for (const double x : samples) {
        sum += phasor * x;
        phasor = phasor * turn;
    }
    return sum;
}

std::vector<double> magnitudes(std::span<const double> samples) {
    std::vector<Point> points(std::bit_ceil(2 * samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i) points[i].re = samples[i];
    transform(points);
    std::vector<double> all(points.size() / 2 + 1);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = std::hypot(points[k].re, points[k].im);
    return all;
}

} // namespace physvib
