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
constexpr int maxImpactSweeps = 200;
constexpr int maxMomentumSweeps = 60;
constexpr double maxFrictionRatio = 1.5;     // friction per normal impulse, of rubber
constexpr double relativeTolerance = 1.0e-4; // convergence: change in a sweep, relative to the strongest
                                             // impulse

/// Target speed of each point, and the coupling between points.
struct Problem {
    std::size_t count;
    std::array<double, maxPoints> targetMetresPerSecond, impulse;  // m/s, N s
    std::array<std::array<double, maxPoints>, maxPoints> coupling; // 1/kg

    double couplingSum(std::size_t point) const noexcept {
        double sum = 0.0;
        for (std::size_t other = 0; other < count; ++other) sum += coupling[point][other];
        return sum;
    }
    double missingSpeed(std::size_t point) const noexcept {
        double missing = targetMetresPerSecond[point];
        for (std::size_t other = 0; other < count; ++other)
            missing -= coupling[point][other] * impulse[other];
        return missing;
    }
    double sweep() noexcept {
        double change = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double before = impulse[i];
            impulse[i] = std::max(0.0, before + missingSpeed(i) / coupling[i][i]);
            change = std::max(change, std::abs(impulse[i] - before));
        }
        return change;
    }
    // Corrects the sum of impulses. Long levers (a thin pole, corners of a crate) couple points so strongly
    // that sweeps alone hardly change the sum, which determines the amplitude.
    void correctSum() noexcept {
        double missing = 0.0, perNewtonSecond = 0.0, smallest = 1.0e300;
        for (std::size_t i = 0; i < count; ++i) {
            if (!(impulse[i] > 0.0)) continue;
            missing += missingSpeed(i);
            smallest = std::min(smallest, impulse[i]);
            for (std::size_t j = 0; j < count; ++j)
                perNewtonSecond += impulse[j] > 0.0 ? coupling[i][j] : 0.0;
        }
        if (!(perNewtonSecond > 0.0)) return;
        const double correction = std::max(-smallest, missing / perNewtonSecond);
        for (std::size_t i = 0; i < count; ++i)
            if (impulse[i] > 0.0) impulse[i] += correction;
    }
};

double targetSpeedOf(const SolverPoint& point) noexcept {
    return point.isNew && point.approach > 0.0 ? (1.0 + point.restitution) * point.approach : point.approach;
}

// False if it does not converge, or neither body is movable.
bool solveNormals(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<SolverPoint> points,
                  bool isDragged) {
    Problem problem{};
    problem.count = std::min(points.size(), maxPoints);
    for (std::size_t i = 0; i < problem.count; ++i) {
        problem.targetMetresPerSecond[i] = targetSpeedOf(points[i]);
        for (std::size_t j = 0; j < problem.count; ++j) {
            const Vector3 pushDirection = isDragged ? points[j].normal + points[j].drag : points[j].normal;
            problem.coupling[i][j] =
                bodies.coupling(a, b, points[j].point, pushDirection, points[i].point, points[i].normal);
        }
        if (!(problem.coupling[i][i] > 0.0)) return false;
    }
    for (std::size_t i = 0; i < problem.count; ++i) // this start is exact if all points behave alike
        if (const double sum = problem.couplingSum(i); sum > 0.0)
            problem.impulse[i] = std::max(0.0, problem.targetMetresPerSecond[i] / sum);
    double change = 0.0, total = 0.0;
    for (int sweep = 0; sweep < maxImpactSweeps; ++sweep) {
        problem.correctSum();
        change = problem.sweep();
        total = 0.0;
        for (std::size_t i = 0; i < problem.count; ++i) total += problem.impulse[i];
        if (change <= 1.0e-9 * total) break;
    }
    for (std::size_t i = 0; i < problem.count; ++i) points[i].newtonSeconds = problem.impulse[i];
    return change <= 1.0e-3 * total;
}

} // namespace

void solve(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<SolverPoint> points) {
    for (SolverPoint& point : points) point.newtonSeconds = 0.0;
    const auto isDragged = [](const SolverPoint& point) { return point.drag.lengthSquared() > 0.0F; };
    if (std::ranges::any_of(points, isDragged) && solveNormals(bodies, a, b, points, true)) return;
    solveNormals(bodies, a, b, points, false);
}

// Gauss-Seidel sweeps over all contact points of a step.
void MomentumImpulses::clear() {
    bodies_.clear();
    bodyOf_.clear();
    points_.clear();
    rows_.clear();
    isInPlane_ = true;
}

std::int32_t MomentumImpulses::findOrAdd(const ReportedBodies& bodies, std::int32_t id) {
    const FedBody& reported = bodies.reported(id);
    if (!(reported.massKg > 0.0)) return none;
    if (const std::int32_t known = bodyOf_.find(ReportedBodies::idOf(id)); known != none) return known;
    bodies_.push_back({.perKg = 1.0 / reported.massKg, .inverseInertia = bodies.inverseInertia(id)});
    bodyOf_.set(ReportedBodies::idOf(id), static_cast<std::int32_t>(bodies_.size()) - 1);
    return static_cast<std::int32_t>(bodies_.size()) - 1;
}

MomentumImpulses::Row MomentumImpulses::makeRow(const ReportedBodies& bodies, const Point& point,
                                                Vector3 direction) const {
    Row row{.a = point.a,
            .b = point.b,
            .direction = direction,
            .leverA = bodies.lever(point.idA, point.place, direction),
            .leverB = bodies.lever(point.idB, point.place, direction)};
    const auto inverseMassAt = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return 0.0;
        const Body& known = bodies_[static_cast<std::size_t>(body)];
        return known.perKg + known.inverseInertia.coupling(lever, lever);
    };
    const double perKg = inverseMassAt(row.a, row.leverA) + inverseMassAt(row.b, row.leverB);
    row.effectiveKg = perKg > 0.0 ? 1.0 / perKg : 0.0;
    row.targetChange = bodies.approach(point.idA, point.idB, point.place, direction) -
                       bodies.approach(point.idA, point.idB, point.place, direction, true);
    return row;
}

MomentumImpulses::Row& MomentumImpulses::addRow(const ReportedBodies& bodies, const Point& point,
                                                Vector3 direction) {
    rows_.push_back(makeRow(bodies, point, direction));
    return rows_.back();
}

std::size_t MomentumImpulses::add(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
                                  Vector3 normal) {
    points_.push_back({a, b, findOrAdd(bodies, a), findOrAdd(bodies, b), point});
    const Row& row = addRow(bodies, points_.back(), normal);
    isInPlane_ = isInPlane_ && isInPlane(row);
    return points_.size() - 1;
}

bool MomentumImpulses::isInPlane(const Row& row) const {
    const auto turnsInPlane = [&](std::int32_t body, Vector3 lever) {
        if (body == none) return true;
        const InverseInertia& inverseInertia = bodies_[static_cast<std::size_t>(body)].inverseInertia;
        return lever.x == 0.0F && lever.y == 0.0F && inverseInertia.xz == 0.0 && inverseInertia.yz == 0.0;
    };
    return row.direction.z == 0.0F && turnsInPlane(row.a, row.leverA) && turnsInPlane(row.b, row.leverB);
}

[[gnu::always_inline]] inline double MomentumImpulses::explainedChange(const Row& row) const {
    const auto speedOf = [&](std::int32_t index, Vector3 lever) __attribute__((always_inline)) {
        if (index == none) return 0.0;
        const Body& body = bodies_[static_cast<std::size_t>(index)];
        const auto &v = body.velocity, &w = body.spin;
        return v[0] * static_cast<double>(row.direction.x) + v[1] * static_cast<double>(row.direction.y) +
               v[2] * static_cast<double>(row.direction.z) +
               (w[0] * static_cast<double>(lever.x) + w[1] * static_cast<double>(lever.y) +
                w[2] * static_cast<double>(lever.z));
    };
    return speedOf(row.b, row.leverB) - speedOf(row.a, row.leverA);
}

[[gnu::always_inline]] inline void MomentumImpulses::applyImpulse(const Row& row, double newtonSeconds) {
    const auto addTo = [&](std::int32_t index, double impulse, Vector3 lever) __attribute__((always_inline)) {
        if (index == none) return;
        Body& body = bodies_[static_cast<std::size_t>(index)];
        body.velocity[0] += impulse * body.perKg * static_cast<double>(row.direction.x);
        body.velocity[1] += impulse * body.perKg * static_cast<double>(row.direction.y);
        body.velocity[2] += impulse * body.perKg * static_cast<double>(row.direction.z);
        const std::array<double, 3> spin = body.inverseInertia.spin(impulse, lever);
        for (std::size_t axis = 0; axis < 3; ++axis) body.spin[axis] += spin[axis];
    };
    addTo(row.a, -newtonSeconds, row.leverA);
    addTo(row.b, newtonSeconds, row.leverB);
}

void MomentumImpulses::solve() {
    rowOrder_.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) rowOrder_.push_back(static_cast<std::int32_t>(i));
    sweep();
}

void MomentumImpulses::markStruck(std::size_t point) {
    points_[point].isStruck = true;
    for (const std::int32_t body : {rows_[point].a, rows_[point].b})
        if (body != none) bodies_[static_cast<std::size_t>(body)].hops = 1;
}

// Adds friction for struck bodies, what they stand on, and what that stands on. Struck points are solved
// first: else the floor would seem to push a ball that a wall lifts by friction.
void MomentumImpulses::solveFriction(const ReportedBodies& bodies) {
    const auto hopsOf = [&](std::int32_t body) {
        return body == none ? 0 : bodies_[static_cast<std::size_t>(body)].hops;
    };
    const std::span<const Row> normals{rows_.data(), points_.size()};
    for (int hop = 1; hop < 3; ++hop)
        for (const Row& row : normals)
            for (const auto& [body, neighbour] : {std::pair{row.a, row.b}, std::pair{row.b, row.a}})
                if (hopsOf(body) == hop && neighbour != none && hopsOf(neighbour) == 0)
                    bodies_[static_cast<std::size_t>(neighbour)].hops = hop + 1;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (hopsOf(rows_[i].a) + hopsOf(rows_[i].b) > 0) addFriction(bodies, i);
    rowOrder_.clear();
    for (const bool isStruck : {true, false})
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const std::size_t frictionRow = points_[i].frictionRow;
            if (frictionRow == 0 || points_[i].isStruck != isStruck) continue;
            for (const std::size_t row : {i, frictionRow, frictionRow + 1})
                rowOrder_.push_back(static_cast<std::int32_t>(row));
        }
    sweep();
}

// The bounds stay fixed: friction and the impulse that bounds it would increase each other without end.
void MomentumImpulses::addFriction(const ReportedBodies& bodies, std::size_t point) {
    Vector3 unexplained;
    for (const Vector3 axis : {Vector3{1.0F}, Vector3{0.0F, 1.0F}, Vector3{0.0F, 0.0F, 1.0F}}) {
        const Row row = makeRow(bodies, points_[point], axis);
        unexplained += static_cast<float>(row.targetChange - explainedChange(row)) * axis;
    }
    const Vector3 normal = rows_[point].direction;
    const Vector3 slide = unexplained - static_cast<float>(dot(unexplained, normal)) * normal;
    const float length = slide.length();
    const Vector3 along = length > 0.0F ? 1.0F / length * slide : Vector3{};
    points_[point].frictionRow = rows_.size();
    for (const Vector3 direction : {along, cross(normal, along)}) {
        Row& row = addRow(bodies, points_[point], direction);
        row.maxNewtonSeconds = maxFrictionRatio * rows_[point].newtonSeconds;
        row.minNewtonSeconds = -row.maxNewtonSeconds;
    }
}

Vector3 MomentumImpulses::friction(std::size_t point) const {
    Vector3 sum;
    if (const std::size_t frictionRow = points_[point].frictionRow; frictionRow > 0)
        for (const Row& row : std::span{rows_}.subspan(frictionRow, 2))
            sum += static_cast<float>(row.newtonSeconds) * row.direction;
    return sum;
}

// Sorts rows into batches without a common body, so that a processor need not wait for one row before it
// begins the next. Rows of one body keep their order, so bits stay the same. Rows that stay 0 are left out.
void MomentumImpulses::sortByBatch() {
    batchEnds_.assign(1, 0);
    for (Body& body : bodies_) body.nextBatch = 0;
    std::erase_if(rowOrder_, [this](std::int32_t index) {
        Row& row = rows_[static_cast<std::size_t>(index)];
        const bool isOffPlane = row.direction.x == 0.0F && row.direction.y == 0.0F && row.targetChange == 0.0;
        if (!(row.effectiveKg > 0.0) || isOffPlane) return true;
        row.batch = 0;
        for (const std::int32_t body : {row.a, row.b})
            if (body != none)
                row.batch = std::max(row.batch, bodies_[static_cast<std::size_t>(body)].nextBatch);
        for (const std::int32_t body : {row.a, row.b})
            if (body != none) bodies_[static_cast<std::size_t>(body)].nextBatch = row.batch + 1;
        batchEnds_.resize(std::max(batchEnds_.size(), row.batch + 2));
        ++batchEnds_[row.batch + 1];
        return false;
    });
    for (std::size_t i = 1; i < batchEnds_.size(); ++i) batchEnds_[i] += batchEnds_[i - 1];
    unsorted_.swap(rowOrder_);
    rowOrder_.resize(unsorted_.size());
    for (const std::int32_t index : unsorted_)
        rowOrder_[batchEnds_[rows_[static_cast<std::size_t>(index)].batch]++] = index;
}

void MomentumImpulses::sweep() {
    if (isInPlane_) return sweepInPlane();
    double change = 1.0, strongest = 0.0;
    for (int sweep = 0; sweep < maxMomentumSweeps && !(change <= relativeTolerance * strongest); ++sweep) {
        change = strongest = 0.0;
        for (const std::int32_t index : rowOrder_) {
            Row& row = rows_[static_cast<std::size_t>(index)];
            const double before = row.newtonSeconds;
            row.newtonSeconds =
                std::clamp(before + (row.targetChange - explainedChange(row)) * row.effectiveKg,
                           row.minNewtonSeconds, row.maxNewtonSeconds);
            if (row.newtonSeconds != before) applyImpulse(row, row.newtonSeconds - before);
            change = std::max(change, std::abs(row.newtonSeconds - before));
            strongest = std::max(strongest, std::abs(row.newtonSeconds));
        }
    }
}

// sweep() for points in the plane, with less data. The last body stands for all immovable ones.
void MomentumImpulses::sweepInPlane() {
    sortByBatch();
    planeBodies_.clear();
    for (const Body& body : bodies_)
        planeBodies_.push_back(
            {body.velocity[0], body.velocity[1], body.spin[2], body.perKg, body.inverseInertia.zz});
    planeBodies_.push_back({});
    planeRows_.clear();
    const auto bodyOf = [this](std::int32_t body) {
        return planeBodies_.data() + (body == none ? bodies_.size() : static_cast<std::size_t>(body));
    };
    for (const std::int32_t index : rowOrder_) {
        const Row& row = rows_[static_cast<std::size_t>(index)];
        planeRows_.push_back({bodyOf(row.a), bodyOf(row.b), static_cast<double>(row.direction.x),
                              static_cast<double>(row.direction.y), static_cast<double>(row.leverA.z),
                              static_cast<double>(row.leverB.z), row.targetChange, row.effectiveKg,
                              row.newtonSeconds, row.minNewtonSeconds, row.maxNewtonSeconds});
    }
    double change = 1.0, strongest = 0.0;
    for (int sweep = 0; sweep < maxMomentumSweeps && !(change <= relativeTolerance * strongest); ++sweep) {
        change = strongest = 0.0;
        for (PlaneRow& row : planeRows_) {
            PlaneBody &a = *row.a, &b = *row.b;
            const double explained = (b.x * row.x + b.y * row.y + b.spin * row.leverB) -
                                     (a.x * row.x + a.y * row.y + a.spin * row.leverA);
            const double next =
                std::clamp(row.newtonSeconds + (row.targetChange - explained) * row.effectiveKg,
                           row.minNewtonSeconds, row.maxNewtonSeconds);
            const double push = next - row.newtonSeconds, onA = push * a.perKg, onB = push * b.perKg;
            strongest = std::max(strongest, std::abs(next));
            if (push == 0.0) continue;
            change = std::max(change, std::abs(push));
            row.newtonSeconds = next;
            a.x -= onA * row.x;
            a.y -= onA * row.y;
            a.spin -= push * a.inverseInertia * row.leverA;
            b.x += onB * row.x;
            b.y += onB * row.y;
            b.spin += push * b.inverseInertia * row.leverB;
        }
    }
    for (std::size_t i = 0; i < rowOrder_.size(); ++i)
        rows_[static_cast<std::size_t>(rowOrder_[i])].newtonSeconds = planeRows_[i].newtonSeconds;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_[i].velocity = {planeBodies_[i].x, planeBodies_[i].y, 0.0};
        bodies_[i].spin[2] = planeBodies_[i].spin;
    }
}

} // namespace physvib
