// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel solvers: of the contact points of two bodies, and of all contact points of a step.
#include "Contacts/ReportedContacts.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t maxPoints = 16; // per pair; further ones lie between the others
constexpr int mostLandingSweeps = 200;
constexpr int mostMomentumSweeps = 60;
constexpr double roughest = 1.5;  // friction per normal impulse, of rubber
constexpr double enough = 1.0e-4; // convergence: change in a sweep, relative to the strongest impulse

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

// False if it does not converge, or neither body is movable.
bool settle(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<MeetingPoint> points,
            bool isDragged) {
    Problem problem{};
    problem.count = std::min(points.size(), maxPoints);
    for (std::size_t i = 0; i < problem.count; ++i) {
        problem.wanted[i] = wantedOf(points[i]);
        for (std::size_t j = 0; j < problem.count; ++j) {
            const Vector3 push = isDragged ? points[j].normal + points[j].drag : points[j].normal;
            problem.coupling[i][j] =
                bodies.coupling(a, b, points[j].point, push, points[i].point, points[i].normal);
        }
        if (!(problem.coupling[i][i] > 0.0)) return false;
    }
    for (std::size_t i = 0; i < problem.count; ++i) // exact start if all points behave alike
        if (const double sum = problem.sumOf(i); sum > 0.0)
            problem.impulse[i] = std::max(0.0, problem.wanted[i] / sum);
    double change = 0.0, whole = 0.0;
    for (int sweep = 0; sweep < mostLandingSweeps; ++sweep) {
        problem.levelSum();
        change = problem.sweep();
        whole = 0.0;
        for (std::size_t i = 0; i < problem.count; ++i) whole += problem.impulse[i];
        if (change <= 1.0e-9 * whole) break;
    }
    for (std::size_t i = 0; i < problem.count; ++i) points[i].newtonSeconds = problem.impulse[i];
    return change <= 1.0e-3 * whole;
}

} // namespace

void solve(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<MeetingPoint> points) {
    for (MeetingPoint& point : points) point.newtonSeconds = 0.0;
    const auto isDragged = [](const MeetingPoint& point) { return point.drag.lengthSquared() > 0.0F; };
    if (std::ranges::any_of(points, isDragged) && settle(bodies, a, b, points, true)) return;
    settle(bodies, a, b, points, false);
}

// Gauss-Seidel sweeps over all contact points of a step.
void MomentumImpulses::clear() {
    bodies_.clear();
    bodyOf_.clear();
    points_.clear();
    rows_.clear();
    isInPlane_ = true;
}

std::int32_t MomentumImpulses::know(const ReportedBodies& bodies, std::int32_t id) {
    const FedBody& told = bodies.told(id);
    if (!(told.massKg > 0.0)) return none;
    if (const std::int32_t known = bodyOf_.find(ReportedBodies::idOf(id)); known != none) return known;
    bodies_.push_back({.perKg = 1.0 / told.massKg, .turning = bodies.inverseInertia(id)});
    bodyOf_.set(ReportedBodies::idOf(id), static_cast<std::int32_t>(bodies_.size()) - 1);
    return static_cast<std::int32_t>(bodies_.size()) - 1;
}

MomentumImpulses::Row MomentumImpulses::rowOf(const ReportedBodies& bodies, const Point& of,
                                              Vector3 way) const {
    Row made{.a = of.a,
             .b = of.b,
             .way = way,
             .leverA = bodies.lever(of.idA, of.place, way),
             .leverB = bodies.lever(of.idB, of.place, way)};
    const auto ease = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return 0.0;
        const Body& its = bodies_[static_cast<std::size_t>(body)];
        return its.perKg + its.turning.between(lever, lever);
    };
    const double perKg = ease(made.a, made.leverA) + ease(made.b, made.leverB);
    made.effectiveKg = perKg > 0.0 ? 1.0 / perKg : 0.0;
    made.change =
        bodies.approach(of.idA, of.idB, of.place, way) - bodies.approach(of.idA, of.idB, of.place, way, true);
    return made;
}

MomentumImpulses::Row& MomentumImpulses::addRow(const ReportedBodies& bodies, const Point& of, Vector3 way) {
    rows_.push_back(rowOf(bodies, of, way));
    return rows_.back();
}

std::size_t MomentumImpulses::add(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
                                  Vector3 normal) {
    points_.push_back({a, b, know(bodies, a), know(bodies, b), point});
    const Row& row = addRow(bodies, points_.back(), normal);
    isInPlane_ = isInPlane_ && isInPlane(row);
    return points_.size() - 1;
}

bool MomentumImpulses::isInPlane(const Row& row) const {
    const auto turnsInPlane = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return true;
        const InverseInertia& turning = bodies_[static_cast<std::size_t>(body)].turning;
        return lever.x == 0.0F && lever.y == 0.0F && turning.xz == 0.0 && turning.yz == 0.0;
    };
    return row.way.z == 0.0F && turnsInPlane(row.a, row.leverA) && turnsInPlane(row.b, row.leverB);
}

[[gnu::always_inline]] inline double MomentumImpulses::found(const Row& row) const {
    const auto of = [&](std::int32_t which, Vector3 lever) __attribute__((always_inline)) {
        if (which == none) return 0.0;
        const Body& body = bodies_[static_cast<std::size_t>(which)];
        const auto &v = body.velocity, &w = body.spin;
        return v[0] * static_cast<double>(row.way.x) + v[1] * static_cast<double>(row.way.y) +
               v[2] * static_cast<double>(row.way.z) +
               (w[0] * static_cast<double>(lever.x) + w[1] * static_cast<double>(lever.y) +
                w[2] * static_cast<double>(lever.z));
    };
    return of(row.b, row.leverB) - of(row.a, row.leverA);
}

[[gnu::always_inline]] inline void MomentumImpulses::push(const Row& row, double newtonSeconds) {
    const auto on = [&](std::int32_t which, double impulse, Vector3 lever) __attribute__((always_inline)) {
        if (which == none) return;
        Body& body = bodies_[static_cast<std::size_t>(which)];
        body.velocity[0] += impulse * body.perKg * static_cast<double>(row.way.x);
        body.velocity[1] += impulse * body.perKg * static_cast<double>(row.way.y);
        body.velocity[2] += impulse * body.perKg * static_cast<double>(row.way.z);
        const std::array<double, 3> spin = body.turning.spin(impulse, lever);
        for (std::size_t axis = 0; axis < 3; ++axis) body.spin[axis] += spin[axis];
    };
    on(row.a, -newtonSeconds, row.leverA);
    on(row.b, newtonSeconds, row.leverB);
}

void MomentumImpulses::solve() {
    swept_.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) swept_.push_back(static_cast<std::int32_t>(i));
    sweep();
}

void MomentumImpulses::strike(std::size_t point) {
    points_[point].isStruck = true;
    for (const std::int32_t body : {rows_[point].a, rows_[point].b})
        if (body != none) bodies_[static_cast<std::size_t>(body)].from = 1;
}

// Adds friction for struck bodies, what they stand on, and what that stands on. Struck points are solved
// first: else the floor would seem to push a ball that a wall lifts by friction.
void MomentumImpulses::solveFriction(const ReportedBodies& bodies) {
    const auto from = [&](std::int32_t body) {
        return body == none ? 0 : bodies_[static_cast<std::size_t>(body)].from;
    };
    const std::span<const Row> normals{rows_.data(), points_.size()};
    for (int hop = 1; hop < 3; ++hop)
        for (const Row& row : normals)
            for (const auto& [one, other] : {std::pair{row.a, row.b}, std::pair{row.b, row.a}})
                if (from(one) == hop && other != none && from(other) == 0)
                    bodies_[static_cast<std::size_t>(other)].from = hop + 1;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (from(rows_[i].a) + from(rows_[i].b) > 0) addFriction(bodies, i);
    swept_.clear();
    for (const bool isStruck : {true, false})
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const std::size_t across = points_[i].across;
            if (across == 0 || points_[i].isStruck != isStruck) continue;
            for (const std::size_t row : {i, across, across + 1})
                swept_.push_back(static_cast<std::int32_t>(row));
        }
    sweep();
}

// The bounds stay fixed: friction and the impulse that bounds it would increase each other without end.
void MomentumImpulses::addFriction(const ReportedBodies& bodies, std::size_t point) {
    Vector3 left;
    for (const Vector3 axis : {Vector3{1.0F}, Vector3{0.0F, 1.0F}, Vector3{0.0F, 0.0F, 1.0F}}) {
        const Row row = rowOf(bodies, points_[point], axis);
        left += static_cast<float>(row.change - found(row)) * axis;
    }
    const Vector3 normal = rows_[point].way;
    const Vector3 slide = left - static_cast<float>(dot(left, normal)) * normal;
    const float length = slide.length();
    const Vector3 along = length > 0.0F ? 1.0F / length * slide : Vector3{};
    points_[point].across = rows_.size();
    for (const Vector3 way : {along, cross(normal, along)}) {
        Row& row = addRow(bodies, points_[point], way);
        row.most = roughest * rows_[point].newtonSeconds;
        row.least = -row.most;
    }
}

Vector3 MomentumImpulses::friction(std::size_t point) const {
    Vector3 sum;
    if (const std::size_t across = points_[point].across; across > 0)
        for (const Row& row : std::span{rows_}.subspan(across, 2))
            sum += static_cast<float>(row.newtonSeconds) * row.way;
    return sum;
}

// Rows of one body stay in their order, and so give the same bits; between them come those of others, so that
// a processor need not wait for a row's end before it begins the next. Those that stay 0 are left out.
void MomentumImpulses::arrange() {
    ends_.assign(1, 0);
    for (Body& body : bodies_) body.turns = 0;
    std::erase_if(swept_, [this](std::int32_t at) {
        Row& row = rows_[static_cast<std::size_t>(at)];
        const bool isAcross = row.way.x == 0.0F && row.way.y == 0.0F && row.change == 0.0;
        if (!(row.effectiveKg > 0.0) || isAcross) return true;
        row.turn = 0;
        for (const std::int32_t body : {row.a, row.b})
            if (body != none) row.turn = std::max(row.turn, bodies_[static_cast<std::size_t>(body)].turns);
        for (const std::int32_t body : {row.a, row.b})
            if (body != none) bodies_[static_cast<std::size_t>(body)].turns = row.turn + 1;
        ends_.resize(std::max(ends_.size(), row.turn + 2));
        ++ends_[row.turn + 1];
        return false;
    });
    for (std::size_t i = 1; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
    unarranged_.swap(swept_);
    swept_.resize(unarranged_.size());
    for (const std::int32_t at : unarranged_) swept_[ends_[rows_[static_cast<std::size_t>(at)].turn]++] = at;
}

void MomentumImpulses::sweep() {
    if (isInPlane_) return sweepInPlane();
    double change = 1.0, strongest = 0.0;
    for (int sweep = 0; sweep < mostMomentumSweeps && !(change <= enough * strongest); ++sweep) {
        change = strongest = 0.0;
        for (const std::int32_t at : swept_) {
            Row& row = rows_[static_cast<std::size_t>(at)];
            const double before = row.newtonSeconds;
            row.newtonSeconds =
                std::clamp(before + (row.change - found(row)) * row.effectiveKg, row.least, row.most);
            if (row.newtonSeconds != before) push(row, row.newtonSeconds - before);
            change = std::max(change, std::abs(row.newtonSeconds - before));
            strongest = std::max(strongest, std::abs(row.newtonSeconds));
        }
    }
}

// The same for points in the plane, with less data, side by side in memory. The last body stands for all that
// are immovable.
void MomentumImpulses::sweepInPlane() {
    arrange();
    planeBodies_.clear();
    for (const Body& body : bodies_)
        planeBodies_.push_back(
            {body.velocity[0], body.velocity[1], body.spin[2], body.perKg, body.turning.zz});
    planeBodies_.push_back({});
    planeRows_.clear();
    const auto bodyOf = [this](std::int32_t body) {
        return planeBodies_.data() + (body == none ? bodies_.size() : static_cast<std::size_t>(body));
    };
    for (const std::int32_t at : swept_) {
        const Row& row = rows_[static_cast<std::size_t>(at)];
        planeRows_.push_back({bodyOf(row.a), bodyOf(row.b), static_cast<double>(row.way.x),
                              static_cast<double>(row.way.y), static_cast<double>(row.leverA.z),
                              static_cast<double>(row.leverB.z), row.change, row.effectiveKg,
                              row.newtonSeconds, row.least, row.most});
    }
    double change = 1.0, strongest = 0.0;
    for (int sweep = 0; sweep < mostMomentumSweeps && !(change <= enough * strongest); ++sweep) {
        change = strongest = 0.0;
        for (PlaneRow& row : planeRows_) {
            PlaneBody &a = *row.a, &b = *row.b;
            const double found = (b.x * row.x + b.y * row.y + b.spin * row.leverB) -
                                 (a.x * row.x + a.y * row.y + a.spin * row.leverA);
            const double next =
                std::clamp(row.newtonSeconds + (row.change - found) * row.effectiveKg, row.least, row.most);
            const double push = next - row.newtonSeconds, onA = push * a.perKg, onB = push * b.perKg;
            strongest = std::max(strongest, std::abs(next));
            if (push == 0.0) continue;
            change = std::max(change, std::abs(push));
            row.newtonSeconds = next;
            a.x -= onA * row.x;
            a.y -= onA * row.y;
            a.spin -= push * a.turning * row.leverA;
            b.x += onB * row.x;
            b.y += onB * row.y;
            b.spin += push * b.turning * row.leverB;
        }
    }
    for (std::size_t i = 0; i < swept_.size(); ++i)
        rows_[static_cast<std::size_t>(swept_[i])].newtonSeconds = planeRows_[i].newtonSeconds;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_[i].velocity = {planeBodies_[i].x, planeBodies_[i].y, 0.0};
        bodies_[i].spin[2] = planeBodies_[i].spin;
    }
}

} // namespace physvib
