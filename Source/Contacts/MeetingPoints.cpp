// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel solver for the impulses at a few contact points of two bodies.
#include "Contacts/MeetingPoints.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace physvib {

namespace {

constexpr std::size_t maxPoints = 16; // per pair; further ones lie between the others
constexpr int mostLandingSweeps = 200;

/// Target speed of each point, and the coupling between points.
struct Problem {
    std::size_t count;
    std::array<double, maxPoints> wanted, impulse;                 // m/s, N s
    std::array<std::array<double, maxPoints>, maxPoints> coupling; // 1/kg

    double sumOf(std::size_t point) const noexcept {
        double sum = 0.0;
        for (std::size_t other = 0; other < count; ++other) sum += coupling[point][other];
        return sum;
    }
    double lackingOf(std::size_t point) const noexcept {
        double lacks = wanted[point];
        for (std::size_t other = 0; other < count; ++other) lacks -= coupling[point][other] * impulse[other];
        return lacks;
    }
    double sweep() noexcept {
        double change = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double before = impulse[i];
            impulse[i] = std::max(0.0, before + lackingOf(i) / coupling[i][i]);
            change = std::max(change, std::abs(impulse[i] - before));
        }
        return change;
    }
    // Corrects the sum of impulses. Long levers (a thin pole, corners of a crate) couple points so strongly
    // that sweeps alone hardly change the sum, which determines the amplitude.
    void levelSum() noexcept {
        double lacks = 0.0, perNewtonSecond = 0.0, least = 1.0e300;
        for (std::size_t i = 0; i < count; ++i) {
            if (!(impulse[i] > 0.0)) continue;
            lacks += lackingOf(i);
            least = std::min(least, impulse[i]);
            for (std::size_t j = 0; j < count; ++j)
                perNewtonSecond += impulse[j] > 0.0 ? coupling[i][j] : 0.0;
        }
        if (!(perNewtonSecond > 0.0)) return;
        const double more = std::max(-least, lacks / perNewtonSecond);
        for (std::size_t i = 0; i < count; ++i)
            if (impulse[i] > 0.0) impulse[i] += more;
    }
};

double wantedOf(const MeetingPoint& point) noexcept {
    return point.isNew && point.approach > 0.0 ? (1.0 + point.restitution) * point.approach : point.approach;
}

} // namespace

void solve(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<MeetingPoint> points) {
    for (MeetingPoint& point : points) point.newtonSeconds = 0.0;
    Problem problem{};
    problem.count = std::min(points.size(), maxPoints);
    for (std::size_t i = 0; i < problem.count; ++i) {
        problem.wanted[i] = wantedOf(points[i]);
        for (std::size_t j = 0; j < problem.count; ++j)
            problem.coupling[i][j] =
                bodies.coupling(a, b, points[i].point, points[i].normal, points[j].point, points[j].normal);
        if (!(problem.coupling[i][i] > 0.0)) return; // neither body is movable
    }
    for (std::size_t i = 0; i < problem.count; ++i) // exact start if all points behave alike
        if (const double sum = problem.sumOf(i); sum > 0.0)
            problem.impulse[i] = std::max(0.0, problem.wanted[i] / sum);
    double whole = 0.0;
    for (int sweep = 0; sweep < mostLandingSweeps; ++sweep) {
        problem.levelSum();
        const double change = problem.sweep();
        whole = 0.0;
        for (std::size_t i = 0; i < problem.count; ++i) whole += problem.impulse[i];
        if (change <= 1.0e-9 * whole) break;
    }
    for (std::size_t i = 0; i < problem.count; ++i) points[i].newtonSeconds = problem.impulse[i];
}

} // namespace physvib
