// SPDX-License-Identifier: MIT
// Tracks contact points along surfaces and generates the impacts of the grains that they pass.
#include "Contacts/LastingContacts.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace physvib {
/// The results of FaceMotion, as arrays with one number per point.
struct FaceMoves {
    std::array<double, faceLanes> faceMetres, faceMetresPerSecond, slipMetresPerSecond;
    std::array<float, faceLanes> x, y, xMetresPerSecond, yMetresPerSecond;
};
} // namespace physvib

// GrainLanes.inc is compiled once for any processor, and once for those with AVX2.
namespace physvib::plain {
#define LANES 1
#include "Contacts/GrainLanes.inc"
#undef LANES
} // namespace physvib::plain
#ifdef __SSE2__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace physvib::wide {
#define LANES 4
#include "Contacts/GrainLanes.inc"
#undef LANES
} // namespace physvib::wide
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#define PHYSVIB_LANES(name) (isWide ? wide::name : plain::name)
#else
#define PHYSVIB_LANES(name) plain::name
#endif

namespace physvib {

#ifdef __SSE2__
static const bool isWide = __builtin_cpu_supports("avx2") != 0;
#endif
void GrainRuns::compute() noexcept { PHYSVIB_LANES(compute)(*this); }
void GrainRuns::write(std::size_t first, std::size_t last, const CollisionEvent& model,
                      CollisionEvent* target) const noexcept {
    PHYSVIB_LANES(write)(*this, first, last, model, target);
}

LastingContacts::LastingContacts(const FixtureTable& table)
    : table_{table} {}

void LastingContacts::collect(const StepSpan& span, std::vector<Impact>& impacts) {
    computePassages(span.seconds());
    const ImpactSink list{
        [](void* dest, const Impact& impact) { static_cast<std::vector<Impact>*>(dest)->push_back(impact); },
        &impacts};
    for (const Passage& passage : std::span{passages_.data(), passageCount_})
        if (const GrainGap* gap = nullptr; passage.every > 0 && !staysInGap(passage, span.seconds(), gap))
            addGrainImpacts(passage, span, gap, list);
}

// As pass(), but one grain after the other: for passages that cannot become a run.
void LastingContacts::addGrainImpacts(const Passage& passage, const StepSpan& span, const GrainGap* gap,
                                      ImpactSink sink) {
    TrackedPoint& tracked = *passage.tracked;
    const SurfaceMotion motion = passage.motion(span.seconds());
    const LastingPoint& point = tracked.point;
    const FixtureEntry& surface = table_[passage.surface];
    const Texture& texture = surface.values.texture;
    const Grains grains{static_cast<std::uint64_t>(surface.id), texture};
    const bool isSourceA = table_.isSource(point.a), isSourceB = table_.isSource(point.b);
    const std::int32_t source = isSourceA ? point.a : point.b, other = isSourceA ? point.b : point.a;
    struct Constants {
        double power, perSecond, backSeconds, slipping, perSpeed, rolling;
        Vector3 from, velocity;
    } constants; // computed at the first grain: many points pass none
    std::size_t count = 0;
    tracked.gap = grains.visit(
        motion, passage.every, gap, [&](std::int64_t index, double t) __attribute__((always_inline)) {
            if (count++ == 0)
                constants = {std::sqrt(static_cast<double>(passage.every)),
                             1.0 / motion.seconds,
                             1.5 * motion.seconds,
                             std::abs(point.slipMetresPerSecond),
                             grainImpulse(texture.roughness, passage.loadNewtons, 1.0),
                             texture.rolling,
                             point.point,
                             point.velocity};
            const double speed = std::abs(motion.speedAt(t));
            if (speed < minMetresPerSecond || !(isSourceA || isSourceB)) return;
            const double slip = std::min(speed, constants.slipping);
            const Impact grain{source,
                               other,
                               span.timeNsAfterStart(t * constants.perSecond),
                               constants.power * grains.strengthOf(index) *
                                   (constants.perSpeed * (slip + constants.rolling * (speed - slip))),
                               constants.from +
                                   static_cast<float>(t - constants.backSeconds) * constants.velocity,
                               slip > 0.5 * speed ? ContactKind::slide : ContactKind::roll};
            sink.add(sink.dest, grain);
            if (isSourceA && isSourceB) // in turn, which matters if there is no room for all
                sink.add(sink.dest,
                         {other, source, grain.timeNs, grain.newtonSeconds, grain.point, grain.kind});
        });
    thinned_ += count * static_cast<std::uint64_t>(passage.every - 1);
}

namespace {

/// On the circumference of a disc that touches a face.
SurfacePath rimPath(const FacePoint& p) noexcept {
    return discPath(p.touch.otherRadius, p.touch.other.turnedBack(-p.touch.face.turned(p.touch.normal)),
                    p.faceRadiansPerSecond - p.otherRadiansPerSecond);
}

} // namespace

void LastingContacts::computeFaces(LastingContacts& contacts) {
    const std::size_t count = std::exchange(contacts.faceCount_, 0);
    // the results of rows behind the last are not used
    FaceMoves moves;
    for (std::size_t first = 0; first < count; first += faceLanes) {
        PHYSVIB_LANES(moveFaces)(&contacts.faces_[first], moves);
        for (std::size_t i = 0; i < std::min(faceLanes, count - first); ++i) {
            const FacePoint& point = contacts.faces_[first + i];
            const SurfacePath face{moves.faceMetres[i], moves.faceMetresPerSecond[i]},
                other = point.isDiscRough ? rimPath(point) : SurfacePath{};
            if (!isResolvable(face) || (point.isDiscRough && !isResolvable(other))) continue;
            contacts.add({point.a, point.b, point.feature, static_cast<double>(point.normalNewtonSeconds),
                          moves.slipMetresPerSecond[i], Vector2{moves.x[i], moves.y[i]},
                          Vector2{moves.xMetresPerSecond[i], moves.yMetresPerSecond[i]},
                          point.isFaceOfB ? other : face, point.isFaceOfB ? face : other},
                         point.pairsKey);
        }
    }
}

/// Adds the point's passage along a surface.
template <SurfacePath LastingPoint::*path>
inline void LastingContacts::addPassage(TrackedPoint& tracked, std::int32_t surface, double seconds) {
    const double newtons = pairs_[tracked.pair].steadyShare * tracked.point.normalNewtonSeconds / seconds;
    if (newtons <= 0.0) return;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const SurfacePath now = tracked.point.*path, before = tracked.before != StepRecords<TrackedPoint>::none
                                                              ? points_.before(tracked.before).point.*path
                                                              : SurfacePath{unknown, unknown};
    passages_[passageCount_++] = {before.metres,
                                  before.metresPerSecond,
                                  now.metres,
                                  now.metresPerSecond,
                                  newtons,
                                  table_[surface].values.texture.grainMetres,
                                  0.0,
                                  0.0,
                                  &tracked,
                                  surface,
                                  1};
}

// Finds what each point passes in the step, and thins the grains of all points together.
void LastingContacts::computePassages(double seconds) {
    passageCount_ = 0;
    computePending();
    if (!hasReports()) return;
    if (!(seconds > 0.0) || seconds > longestStepSeconds) return dropStep();
    for (Pair& pair : pairs_.now()) updateLoad(pair, seconds);
    if (const std::size_t slots = 2 * points_.count() + 3; passages_.size() < slots) passages_.resize(slots);
    for (TrackedPoint& tracked : points_.now()) {
        if (table_.isRough(tracked.point.a))
            addPassage<&LastingPoint::onA>(tracked, tracked.point.a, seconds);
        if (table_.isRough(tracked.point.b))
            addPassage<&LastingPoint::onB>(tracked, tracked.point.b, seconds);
    }
    PHYSVIB_LANES(moveAlong)(&passages_.data()->startMetres, sizeof(Passage), passageCount_, seconds);
    double grains = 0.0;
    for (Passage& passage : std::span{passages_.data(), passageCount_}) {
        const double fastest = std::abs(passage.fastest), perSecond = fastest / passage.grainMetres;
        if (fastest < minMetresPerSecond) {
            passage.every = 0;
            continue;
        }
        if (perSecond > maxGrainsPerSecond) {
            const std::uint64_t every =
                std::bit_ceil(static_cast<std::uint64_t>(std::ceil(perSecond / maxGrainsPerSecond)));
            passage.every = static_cast<std::int64_t>(every);
            passage.grains /= static_cast<double>(passage.every);
        }
        grains += passage.grains;
    }
    const double allowed = maxTotalGrainsPerSecond * seconds;
    if (!(grains > allowed)) return;
    const auto times = std::bit_ceil(static_cast<std::uint64_t>(std::ceil(grains / allowed)));
    for (Passage& passage : std::span{passages_.data(), passageCount_})
        passage.every *= static_cast<std::int64_t>(times);
}

void LastingContacts::updateLoad(Pair& pair, double seconds) const noexcept {
    pair.newtons = pair.newtonSeconds / seconds;
    pair.steadyShare = pair.before == StepRecords<Pair>::none || !(pair.newtons > 0.0)
                           ? 0.0
                           : std::min(1.0, pairs_.before(pair.before).newtons / pair.newtons);
}

void LastingContacts::endStep() {
    computePending();
    points_.endStep();
    pairs_.endStep();
}

void LastingContacts::dropStep() noexcept {
    points_.dropStep();
    pairs_.dropStep();
}

void LastingContacts::forget(std::int32_t slot) {
    computePending();
    points_.changeAll([slot](TrackedPoint& tracked) {
        if (tracked.point.a != slot && tracked.point.b != slot) return;
        tracked.point.onA.metres = tracked.point.onB.metres = farMetres; // so that a new contact at this key
                                                                         // counts as a jump
        tracked.point.normalNewtonSeconds = 0.0; // so that this step's points give no impacts
    });
}

void LastingContacts::reset() noexcept {
    faceCount_ = 0;
    points_.reset();
    pairs_.reset();
}

} // namespace physvib
