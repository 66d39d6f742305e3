// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel solver for the impulses at a few contact points of two bodies.
#include "Contacts/ReportedContacts.h"
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

// Gauss-Seidel sweeps over all contact points of a step.

namespace {

constexpr int mostMomentumSweeps = 60;
constexpr double enough = 1.0e-4; // convergence: change in a sweep, relative to the strongest impulse

} // namespace

void MomentumImpulses::clear() {
    bodies_.clear();
    bodyOf_.clear();
    points_.clear();
    isInPlane_ = true;
}

std::int32_t MomentumImpulses::know(const ReportedBodies& bodies, std::int32_t id) {
    const FedBody& told = bodies.told(id);
    if (!(told.massKg > 0.0)) return none;
    if (const std::int32_t known = bodyOf_.find(ReportedBodies::idOf(id)); known != none) return known;
    bodies_.push_back({1.0 / told.massKg, bodies.inverseInertia(id)});
    bodyOf_.set(ReportedBodies::idOf(id), static_cast<std::int32_t>(bodies_.size()) - 1);
    return static_cast<std::int32_t>(bodies_.size()) - 1;
}

std::size_t MomentumImpulses::add(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
                                  Vector3 normal) {
    Point made{know(bodies, a),
               know(bodies, b),
               normal,
               bodies.lever(a, point, normal),
               bodies.lever(b, point, normal),
               0.0,
               0.0,
               0.0};
    const auto ease = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return 0.0;
        const Body& of = bodies_[static_cast<std::size_t>(body)];
        return of.perKg + of.turning.between(lever, lever);
    };
    made.perNewtonSecond = ease(made.a, made.leverA) + ease(made.b, made.leverB);
    made.change = bodies.approach(a, b, point, normal) - bodies.approach(a, b, point, normal, true);
    isInPlane_ = isInPlane_ && isInPlane(made);
    points_.push_back(made);
    return points_.size() - 1;
}

bool MomentumImpulses::isInPlane(const Point& point) const {
    const auto turnsInPlane = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return true;
        const InverseInertia& turning = bodies_[static_cast<std::size_t>(body)].turning;
        return lever.x == 0.0F && lever.y == 0.0F && turning.xz == 0.0 && turning.yz == 0.0;
    };
    return point.normal.z == 0.0F && turnsInPlane(point.a, point.leverA) &&
           turnsInPlane(point.b, point.leverB);
}

// Speed of the body's point along the normal.
template <bool inPlane>
double MomentumImpulses::along(const Body& body, Vector3 normal, Vector3 lever) noexcept {
    const auto& v = body.velocity;
    const auto& w = body.spin;
    const double sideways = v[0] * static_cast<double>(normal.x) + v[1] * static_cast<double>(normal.y);
    const double turned = w[2] * static_cast<double>(lever.z);
    if constexpr (inPlane) return sideways + turned;
    return sideways + v[2] * static_cast<double>(normal.z) +
           (w[0] * static_cast<double>(lever.x) + w[1] * static_cast<double>(lever.y) + turned);
}

template <bool inPlane>
double MomentumImpulses::found(const Point& point) const {
    const auto of = [&](std::int32_t body, Vector3 lever) {
        return along<inPlane>(bodies_[static_cast<std::size_t>(body)], point.normal, lever);
    };
    double sum = 0.0;
    if (point.a != none) sum -= of(point.a, point.leverA);
    if (point.b != none) sum += of(point.b, point.leverB);
    return sum;
}

template <bool inPlane>
void MomentumImpulses::push(const Point& point, double newtonSeconds) {
    const auto on = [&](std::int32_t which, double impulse, Vector3 lever) {
        if (which == none) return;
        Body& body = bodies_[static_cast<std::size_t>(which)];
        body.velocity[0] += impulse * body.perKg * static_cast<double>(point.normal.x);
        body.velocity[1] += impulse * body.perKg * static_cast<double>(point.normal.y);
        if constexpr (inPlane) {
            body.spin[2] += impulse * body.turning.zz * static_cast<double>(lever.z);
        } else {
            body.velocity[2] += impulse * body.perKg * static_cast<double>(point.normal.z);
            const std::array<double, 3> spin = body.turning.spin(impulse, lever);
            for (std::size_t axis = 0; axis < 3; ++axis) body.spin[axis] += spin[axis];
        }
    };
    on(point.a, -newtonSeconds, point.leverA);
    on(point.b, newtonSeconds, point.leverB);
}

void MomentumImpulses::solve() {
    if (isInPlane_)
        sweep<true>();
    else
        sweep<false>();
}

template <bool inPlane>
void MomentumImpulses::sweep() {
    for (int sweep = 0; sweep < mostMomentumSweeps; ++sweep) {
        double change = 0.0, strongest = 0.0;
        for (Point& point : points_) {
            if (!(point.perNewtonSecond > 0.0)) continue;
            const double before = point.newtonSeconds;
            point.newtonSeconds =
                std::max(0.0, before + (point.change - found<inPlane>(point)) / point.perNewtonSecond);
            push<inPlane>(point, point.newtonSeconds - before);
            change = std::max(change, std::abs(point.newtonSeconds - before));
            strongest = std::max(strongest, point.newtonSeconds);
        }
        if (change <= enough * strongest) return;
    }
}

} // namespace physvib
