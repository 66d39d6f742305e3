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
    bodies_.push_back(
        {1.0 / told.massKg, told.inertiaKgSquareMetres > 0.0 ? 1.0 / told.inertiaKgSquareMetres : 0.0});
    bodyOf_.set(FedBodies::nameOf(id), static_cast<std::int32_t>(bodies_.size()) - 1);
    return static_cast<std::int32_t>(bodies_.size()) - 1;
}

std::size_t MomentumImpulses::add(const FedBodies& bodies, std::int32_t a, std::int32_t b, Vector2 point,
                                  Vector2 normal) {
    const auto lever = [&](std::int32_t id) {
        return dot((point - bodies.centre(FedBodies::nameOf(id))).turnedLeft(), normal);
    };
    Point made{know(bodies, a),
               know(bodies, b),
               static_cast<double>(normal.x),
               static_cast<double>(normal.y),
               lever(a),
               lever(b),
               0.0,
               0.0,
               0.0};
    const auto ease = [&](std::int32_t body, double arm) {
        if (body == none) return 0.0;
        const Body& of = bodies_[static_cast<std::size_t>(body)];
        return of.perKg + arm * arm * of.perInertia;
    };
    made.perNewtonSecond = ease(made.a, made.leverA) + ease(made.b, made.leverB);
    made.change = bodies.approach(a, b, point, normal) - bodies.approachAfter(a, b, point, normal);
    points_.push_back(made);
    return points_.size() - 1;
}

double MomentumImpulses::found(const Point& point) const {
    double sum = 0.0;
    if (point.a != none) {
        const Body& a = bodies_[static_cast<std::size_t>(point.a)];
        sum -= a.x * point.nx + a.y * point.ny + a.spin * point.leverA;
    }
    if (point.b != none) {
        const Body& b = bodies_[static_cast<std::size_t>(point.b)];
        sum += b.x * point.nx + b.y * point.ny + b.spin * point.leverB;
    }
    return sum;
}

void MomentumImpulses::push(const Point& point, double newtonSeconds) {
    const auto on = [&](std::int32_t which, double impulse, double lever) {
        if (which == none) return;
        Body& body = bodies_[static_cast<std::size_t>(which)];
        body.x += impulse * body.perKg * point.nx;
        body.y += impulse * body.perKg * point.ny;
        body.spin += impulse * body.perInertia * lever;
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
