// SPDX-License-Identifier: MIT
// The implementation of ContactFeed (ReportedContacts) and its parts: reported bodies, points of pairs,
// solvers for impulses that the engine does not report, and slides.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Contacts/ContactFeed.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include "Contacts/LastingContacts.h"
#include "Contacts/Vectors.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace physvib {

/// Points of pairs, of this step and of the last: decides by their numbers or places which are new. World
/// thread (M). Allocates only to grow.
class ReportedPoints {
public:
    static constexpr std::int32_t none = -1; ///< no point: the chain ends, or is empty

    /// The points of one pair; the pair stores it.
    struct Chain {
        std::int32_t now = none, before = none;
    };

    /// Records a point of this step. True if the pair did not have it in the last step: no point of that
    /// number, or none within `withinMetres` across the normal. Distance along the normal does not count,
    /// because surfaces sink into each other, by several centimetres where contacts are springs.
    bool isNew(Chain& chain, std::int32_t id, Vector3 place, Vector3 normal, double withinMetres) {
        bool isOld = false;
        for (std::int32_t index = chain.before; index != none && !isOld;
             index = before_[static_cast<std::size_t>(index)].next) {
            const Point& point = before_[static_cast<std::size_t>(index)];
            isOld = id == FedContact::byPlace ? distanceAcross(point.place - place, normal) <= withinMetres
                                              : point.id == id;
        }
        now_.push_back({place, id, chain.now});
        chain.now = static_cast<std::int32_t>(now_.size()) - 1;
        return !isOld;
    }

    /// This step's points become those of the last; the owner of each chain updates it likewise.
    void endStep() {
        std::swap(before_, now_);
        now_.clear();
    }

private:
    static double distanceAcross(Vector3 direction, Vector3 normal) noexcept {
        return lengthOf(cross(direction, normal));
    }

    struct Point {
        Vector3 place;
        std::int32_t id, next;
    };
    std::vector<Point> now_, before_;
};

/// Bodies of a world whose engine PhysVib cannot read, as the caller reports them, by numbers (>= 0) of the
/// engine's side. World thread (M).
class ReportedBodies final : public BodyReader {
public:
    /// The number by which contacts and later stages identify that body.
    static std::uint64_t idOf(std::int32_t id) noexcept { return static_cast<std::uint64_t>(id) + 1; }

    void set(std::int32_t id, const FedBody& body) { set(id, body, body.massKg); }
    /// `inertiaMassKg`: the mass that its inertia belongs to; 0: not known.
    void set(std::int32_t id, const FedBody& body, double inertiaMassKg);
    /// `inverse`: in the world's axes; without it, FedBody's moment of inertia counts about every axis.
    void move(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
              const std::optional<InverseInertia>& inverse = {});
    void remove(std::int32_t id);
    /// The motion after the engine's solver, in this step.
    void setMotionAfter(std::int32_t id, const SpaceMotion& motion);
    /// True if that motion was reported in this step, or is not needed.
    bool hasMotionAfter(std::int32_t id) const;
    bool hasAnyMotionAfter() const noexcept { return hasAnyMotionAfter_; }
    void endStep() noexcept { hasAnyMotionAfter_ = false, ++age_; }
    const FedBody& reported(std::int32_t id) const { return at(idOf(id)).reported; }
    double inertiaMassKg(std::int32_t id) const { return at(idOf(id)).inertiaMassKg; }
    bool has(std::int32_t id) const noexcept { return slots_.find(idOf(id)) != IntegerMap::none; }
    /// True if the body is immovable and at rest, as ground is.
    bool isFixedAtRest(std::int32_t id) const;

    /// The largest mass of a movable body, kg (m_max of Eq. 5.7).
    double largestMassKg();

    /// Speed at which B approaches A at a point, m/s, from the reported motions before or after the solver;
    /// the normal points from A to B.
    double approach(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                    bool isAfter = false) const;

    /// Upper bound of the speed at which the contact point moves along the two surfaces, m/s: the sum of each
    /// body's motion and rotation across the normal.
    double slide(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const;

    /// Change of the speed along `otherNormal` at `otherPoint` by an impulse of 1 N s along `normal` at
    /// `point`, 1/kg. Both normals point from A to B.
    double coupling(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal, Vector3 otherPoint,
                    Vector3 otherNormal) const;

    /// The body's inverse inertia; all 0 if it is not movable, or its moment of inertia is not known.
    InverseInertia inverseInertia(std::int32_t id) const;
    /// Lever of a force along `normal` at `point`, about the body's centre of mass, m.
    Vector3 lever(std::int32_t id, Vector3 point, Vector3 normal) const {
        return cross(point - at(idOf(id)).centre, normal);
    }

    /// Effective mass at a contact point, kg: impulse per change of the approach speed. Infinite if neither
    /// body is movable.
    double effectiveMassKg(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                           Vector3 drag = {}) const;
    /// The part of a drag (friction on B per N s along the normal) that suffices to stop the point across it.
    Vector3 limitedDrag(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal, Vector3 drag) const;

    BodyFacts facts(std::uint64_t body) const override;
    // Only the part in the plane: release timing alone asks for motions, and feeds do not support it.
    BodyMotion motion(std::uint64_t body) const override {
        const SpaceMotion& motion = at(body).motion;
        return {inPlane(motion.metresPerSecond), motion.radiansPerSecond.z};
    }
    BodyMotion motionBefore(std::uint64_t body) const override { return motion(body); }
    Vector2 centre(std::uint64_t body) const override { return inPlane(at(body).centre); }
    Vector3 toWorld(std::uint64_t body, Vector2 local) const override { return at(body).centre + local; }
    double inertia(std::uint64_t body) const override { return at(body).reported.inertiaKgSquareMetres; }

private:
    struct Body {
        std::int32_t id;
        FedBody reported;
        Vector3 centre;
        SpaceMotion motion, motionAfter;
        std::optional<InverseInertia> inverse{};
        std::uint64_t motionAfterAge = 0; // the step in which `motionAfter` was reported
        double inertiaMassKg = 0.0;       // as of set()
    };
    const Body& at(std::uint64_t body) const { return bodies_[static_cast<std::size_t>(slots_.find(body))]; }
    static double angularCoupling(const Body& body, Vector3 lever, Vector3 other) noexcept;
    void invalidateLargestMass(const Body& body) noexcept;

    std::vector<Body> bodies_;
    IntegerMap slots_; // by idOf()
    double largestMassKg_ = 0.0;
    bool isLargestKnown_ = true;
    std::uint64_t age_ = 1;
    bool hasAnyMotionAfter_ = false;
};

/// One contact point. New points are to separate at `restitution` times their approach speed; old ones only
/// stay closed.
struct SolverPoint {
    Vector3 point, normal; ///< normal: from A to B, of length 1
    double approach = 0.0; ///< m/s, before the engine's solver
    double restitution = 0.0;
    bool isNew = false;
    double newtonSeconds = 0.0; ///< result of solve
    Vector3 drag{};             ///< friction on B for each N s along the normal
};

/// Computes the impulses along the normals such that none pulls, no surfaces approach, and none is larger
/// than necessary (the linear complementarity problem of a rigid impact, by projected Gauss-Seidel). Where
/// the masses leave the distribution open, all points get equal impulses. The bodies must be registered.
/// World thread (M); no allocation.
void solve(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<SolverPoint> points);

/// For engines that do not report impulses: finds those along the normals, none of them pulling, that
/// together explain the bodies' change of momentum (least kinetic energy of the remainder, by projected
/// Gauss-Seidel), and then what friction explains of the rest. Joints are not known; their effects are
/// attributed to the contacts as far as they act along the normals. A body between two others has the
/// impulses on both sides, so a row transmits an impact, and a landing on a supported body counts the whole.
/// World thread (M); allocates only to grow.
class MomentumImpulses {
public:
    void clear();
    /// Adds a point of two bodies whose velocities are known (ReportedBodies::hasMotionAfter). Returns its
    /// number, from 0 on.
    std::size_t add(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
                    Vector3 normal);
    void solve();                       ///< Finds the impulses along the normals.
    void markStruck(std::size_t point); ///< Its bodies have an impact there.
    /// Call after solve() and markStruck(). Friction is at most 1.5 times the impulse along the normal.
    void solveFriction(const ReportedBodies& bodies);
    double newtonSeconds(std::size_t point) const { return rows_[point].newtonSeconds; }
    Vector3 friction(std::size_t point) const; ///< N s on B

private:
    static constexpr std::int32_t none = IntegerMap::none;
    struct Body {
        double perKg;
        // changes by the impulses found so far, m/s and rad/s
        std::array<double, 3> velocity{}, spin{};
        InverseInertia inverseInertia;
        int hops = 0;              // 1: struck; 2 and 3: its neighbours, and theirs
        std::size_t nextBatch = 0; // the first batch that has none of its rows
    };
    struct Row {                           // the impulse in one direction
        std::int32_t a, b;                 // bodies, or none: immovable
        Vector3 direction, leverA, leverB; // on B; m
        double targetChange = 0.0; // m/s by which the contact has changed the speed of A along it, seen from
                                   // B
        double effectiveKg = 0.0, newtonSeconds = 0.0, minNewtonSeconds = 0.0, maxNewtonSeconds = HUGE_VAL;
        std::size_t batch = 0; // rows of one batch have no body in common
    };
    struct PlaneBody { // the values of a body that count in the plane
        double x, y, spin, perKg, inverseInertia;
    };
    struct PlaneRow {
        PlaneBody *a, *b;
        double x, y, leverA, leverB, targetChange, effectiveKg, newtonSeconds, minNewtonSeconds,
            maxNewtonSeconds;
    };
    struct Point {
        std::int32_t idA, idB, a, b; // engine's numbers; bodies as in Row
        Vector3 place;
        std::size_t frictionRow = 0; // the first of two rows of friction; 0: none
        bool isStruck = false;
    };
    std::int32_t findOrAdd(const ReportedBodies& bodies, std::int32_t id);
    Row makeRow(const ReportedBodies& bodies, const Point& point, Vector3 direction) const;
    Row& addRow(const ReportedBodies& bodies, const Point& point, Vector3 direction);
    void addFriction(const ReportedBodies& bodies, std::size_t point);
    bool isInPlane(const Row& row) const;
    double explainedChange(const Row& row) const; // the part of row.targetChange that is explained so far,
                                                  // m/s
    void applyImpulse(const Row& row, double newtonSeconds);
    void sortByBatch();
    void sweep();
    void sweepInPlane();

    bool isInPlane_ = true; // all normals lie in the plane, all spins are about z: sweepInPlane() suffices
    std::vector<Body> bodies_;
    IntegerMap bodyOf_; // by ReportedBodies::idOf()
    std::vector<Point> points_;
    std::vector<Row> rows_; // along the points' normals, then across
    std::vector<std::int32_t> rowOrder_, unsorted_;
    std::vector<std::size_t> batchEnds_; // of each batch in rowOrder_
    std::vector<PlaneBody> planeBodies_;
    std::vector<PlaneRow> planeRows_;
};

/// A pair in contact whose contact point moves. A ball that rolls at v over a floor: v along both. A box that
/// slides at v: v along the floor, 0 along the box.
struct ReportedSlide {
    std::int32_t a = 0, b = 0; ///< slots of the FixtureTable
    double newtonSeconds = 0.0;
    Vector3 point;                     ///< world
    double alongA = 0.0, alongB = 0.0; ///< m/s, speed of the point along each surface; their difference is
                                       ///< the slip
};

/// Follows reported slides, as one point per pair: impulses of several points are summed, the last one's
/// place is used. Positions along the surfaces are integrated from the speeds, starting at 0 with the
/// contact. World thread (M).
class ReportedSlides {
public:
    void report(const ReportedSlide& slide);
    /// Passes the step's points to `lasting`; contacts that were not reported have ended.
    void endStep(double seconds, LastingContacts& lasting);
    void forget(std::int32_t slot); ///< the slot is freed or reassigned

private:
    struct Track {
        std::uint64_t key;
        LastingPoint point;
        Vector3 lastPoint;
        bool isNew, isReported;
    };
    void drop(std::size_t track);

    std::vector<Track> tracks_;
    IntegerMap trackOf_;
};

/// Pairs in contact: decides for each report whether it is a collision or a load. Arguments are valid,
/// because ContactFeed has checked them, and that the call is allowed now. World thread (M).
class ReportedContacts {
public:
    explicit ReportedContacts(const ImpactSettings& settings);
    ReportedContacts(const ReportedContacts&) = delete;
    ReportedContacts& operator=(const ReportedContacts&) = delete;

    ReportedBodies& bodies() noexcept { return bodies_; }
    ContactEvents& events() noexcept { return events_; }
    bool isStepping() noexcept { return events_.recorder().isStepping(); }

    void remove(std::int32_t id);
    void beginStep(std::int64_t endNs, double gravityMetresPerSecond2);
    void touch(const FedContact& contact);
    void begin(const FedContact& contact);
    void push(const FedContact& contact);
    bool end(std::int32_t a, std::int32_t b); ///< False: the pair does not touch.
    void endStep();

private:
    struct Pair {
        std::int32_t a, b; // slots, the lower one first
        bool isListed;     // it was reported by touch(), and ends when touch() leaves it out
        bool isNew, isListedNow;
        double approach = 0.0, lastApproach = 0.0; // m/s, if faster than gravity explains: of this
                                                   // step, of the last ones
        double load = 0.0, lastLoad = 0.0;         // N s along the normal, of this step, of the last one
        ReportedPoints::Chain points{}; // of this step and the one before, if the engine names points
        std::int32_t newestPending = ReportedPoints::none; // its newest contact that is solved at the end
                                                           // of the step
    };
    struct PendingContact {
        FedContact contact;
        bool isNew, isKick; // isKick: an old point was struck
        std::int32_t next;
        std::int32_t momentum; // its number in momentum_, or none
    };
    bool isByMomentum(const FedContact& contact) const {
        return bodies_.hasAnyMotionAfter() && bodies_.hasMotionAfter(contact.a) &&
               bodies_.hasMotionAfter(contact.b);
    }
    void addMomentumCollision();
    FedContact withMomentumImpulse(const PendingContact& item) const;
    using Push = std::pair<double, double>; // N s: of a step, and at most of its impact
    static constexpr Push unboundedPush{0.0, HUGE_VAL};
    Push pushOf(const PendingContact& item) const;
    Vector3 dragOf(const FedContact& contact) const;
    double supportedNewtonSeconds(double bySpeed, Push push, double gainedMetresPerSecond,
                                  double fraction) const;
    static bool isSolvedAtStepEnd(const FedContact& contact) noexcept {
        return contact.isSoft || contact.isImpulseOfPair || !contact.impulseNewtonSeconds;
    }
    bool isNewPoint(Pair& pair, const FedContact& contact);
    bool isKick(Pair& pair, const FedContact& contact, bool isNew);
    bool isOnGround(std::int32_t struck, std::int32_t ground);
    static FedContact withoutLoad(Pair& pair, FedContact contact);
    void addContact(Pair& pair, const FedContact& contact, bool isNew, bool isNewPoint);
    void resolveKicks(Pair& pair);
    void solvePair(Pair& pair);
    void solvePending();
    double speedOf(const FedContact& contact) const;
    float gravityScaleOf(std::int32_t a, std::int32_t b) const; // of two slots
    bool isImpact(std::int32_t a, std::int32_t b, double metresPerSecond);
    std::int32_t slotOf(std::int32_t id) const noexcept {
        return events_.fixtures().find(ReportedBodies::idOf(id));
    }
    TouchingPairs::Handle handleOf(const FedContact& contact);
    Pair& findOrAdd(const FedContact& contact, bool isListed);
    void drop(std::size_t pair);
    void dropPairsOf(std::int32_t slot);
    void addCollision(const FedContact& contact, Push push = unboundedPush);
    void countBelowThreshold(const TouchingPairs::Handle& pair, const FedContact& contact, double speed,
                             double impulse);
    void addSharedCollision();
    double fastestNewSpeed() const;
    static void addFriction(Collision& collision, const FedContact& contact, std::int32_t a,
                            float share) noexcept;
    void addLoad(const FedContact& contact);
    void reportSlide(const FedContact& contact, const TouchingPairs::Handle& pair);
    double fractionOf(const FedContact& contact, double approachMetresPerSecond) const noexcept;

    ReportedBodies bodies_;
    ContactEvents events_;
    ReportedSlides slides_;
    ReportedPoints points_;
    std::vector<PendingContact> pendingContacts_;
    MomentumImpulses momentum_;
    std::vector<const PendingContact*> pairContacts_; // of one pair, in the order in which they were reported
    std::vector<SolverPoint> solverPoints_;           // the same for the solver
    std::vector<Pair> pairs_;
    IntegerMap pairOf_;
    double lastStepSeconds_ = 0.0, gravity_ = 0.0;
};

} // namespace physvib
