// SPDX-License-Identifier: MIT
// Gauss-Seidel sweeps over all contact points of a step.
#include "Contacts/MomentumImpulses.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr int mostMomentumSweeps = 60;
constexpr double enough = 1.0e-4; // convergence: change in a sweep, relative to the strongest impulse

} // namespace

void MomentumImpulses::clear() {
    bodies_.clear();
    bodyOf_.clear();
    points_.clear();
}

std::int32_t MomentumImpulses::know(const FedBodies& bodies, std::int32_t id) {
    const FedBody& told = bodies.told(id);
    if (!(told.massKg > 0.0)) return none;
    if (const std::int32_t known = bodyOf_.find(FedBodies::nameOf(id)); known != none) return known;
    bodies_.push_back({1.0 / told.massKg, bodies.inverseInertia(id)});
    bodyOf_.set(FedBodies::nameOf(id), static_cast<std::int32_t>(bodies_.size()) - 1);
    return static_cast<std::int32_t>(bodies_.size()) - 1;
}

std::size_t MomentumImpulses::add(const FedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
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
    made.change = bodies.approach(a, b, point, normal) - bodies.approachAfter(a, b, point, normal);
    points_.push_back(made);
    return points_.size() - 1;
}

// Speed of the body's point along the normal.
double MomentumImpulses::along(const Body& body, Vector3 normal, Vector3 lever) noexcept {
    const auto product = [](const std::array<double, 3>& of, Vector3 by) {
        return of[0] * static_cast<double>(by.x) + of[1] * static_cast<double>(by.y) +
               of[2] * static_cast<double>(by.z);
    };
    return product(body.velocity, normal) + product(body.spin, lever);
}

double MomentumImpulses::found(const Point& point) const {
    double sum = 0.0;
    if (point.a != none) sum -= along(bodies_[static_cast<std::size_t>(point.a)], point.normal, point.leverA);
    if (point.b != none) sum += along(bodies_[static_cast<std::size_t>(point.b)], point.normal, point.leverB);
    return sum;
}

void MomentumImpulses::push(const Point& point, double newtonSeconds) {
    const auto on = [&](std::int32_t which, double impulse, Vector3 lever) {
        if (which == none) return;
        Body& body = bodies_[static_cast<std::size_t>(which)];
        const float normal[] = {point.normal.x, point.normal.y, point.normal.z};
        const std::array<double, 3> spin = body.turning.spin(impulse, lever);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            body.velocity[axis] += impulse * body.perKg * static_cast<double>(normal[axis]);
            body.spin[axis] += spin[axis];
        }
    };
    on(point.a, -newtonSeconds, point.leverA);
    on(point.b, newtonSeconds, point.leverB);
}

void MomentumImpulses::solve() {
    for (int sweep = 0; sweep < mostMomentumSweeps; ++sweep) {
        double change = 0.0, strongest = 0.0;
        for (Point& point : points_) {
            if (!(point.perNewtonSecond > 0.0)) continue;
            const double before = point.newtonSeconds;
            point.newtonSeconds =
                std::max(0.0, before + (point.change - found(point)) / point.perNewtonSecond);
            push(point, point.newtonSeconds - before);
            change = std::max(change, std::abs(point.newtonSeconds - before));
            strongest = std::max(strongest, point.newtonSeconds);
        }
        if (change <= enough * strongest) return;
    }
}

} // namespace physvib
