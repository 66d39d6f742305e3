// SPDX-License-Identifier: MIT
// The thesis' collision catcher (5.1.3): copies what Box2D tells during a step, and makes events of it
// afterwards.
#pragma once
#include "Core/CollisionEvent.h"
#include "Physics/BodySweeps.h"
#include "Physics/EventSorter.h"
#include "Physics/HapticFixture.h"
#include "Physics/ImpactModel.h"
#include "Physics/StepClock.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace physvib {

/// Listens to one b2World. A contact strikes when it begins, with the solver's impulse of that same step
/// (`onset` timing); PostSolve also reports resting contacts, in every step, which therefore never strike.
/// Fixtures are known by a side table, so the world's user data stay free. Allocates in its constructor and
/// in add(). M only.
class CollisionCatcher final : public b2ContactListener {
public:
    /// Contacts of cameras that may begin in one step; a world that has more of them is a noise, not a touch.
    static constexpr std::size_t maxRecords = 1024;

    /// Hits that change the velocity of the lighter body by less than this are no strikes. A body at rest
    /// gets g / stepsPerSecond = 0.098 m/s in every step (100 steps/s); a contact that trembles open and shut
    /// gives this impulse again and again. 0.15 m/s is a landing from about a millimetre.
    static constexpr double defaultThresholdMetresPerSecond = 0.15;

    explicit CollisionCatcher(double thresholdMetresPerSecond = defaultThresholdMetresPerSecond);

    /// Makes a fixture known; returns its index in events: 0, 1, 2... It must outlive the catcher's use.
    std::int32_t add(const b2Fixture& fixture, const HapticFixture& values);

    /// m_max of Eq. 5.7: the largest mass of the known fixtures' bodies, kg, static ones with the mass given.
    double largestMassKg() const noexcept;

    /// To be called right before b2World::Step, with the time it is given.
    void beginStep(double stepSeconds) noexcept;

    /// To be called right after the step that began at clock.timeNs(step): one event per camera fixture and
    /// contact that began, from one step before that time to its end.
    void collect(const StepClock& clock, std::int64_t step, const ImpactModel& model,
                 EventSorter& events) const;

    /// Contacts that found no room so far.
    std::uint64_t drops() const noexcept { return drops_; }

    void BeginContact(b2Contact* contact) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

private:
    static constexpr std::int32_t unknown = -1;
    struct Known {
        const b2Body* body;
        HapticFixture values;
    };
    struct Record {
        const b2Contact* contact; // valid within its step only, and only compared
        std::int32_t fixtureA, fixtureB;
        b2Vec2 point, normal;           // world; the normal points from A to B
        double separationMetres;        // of the deepest point, negative: inside each other
        double approachMetresPerSecond; // before the solver
        double lighterMassKg;           // of the bodies that can move
        double stepFraction;            // moment of touch in steps after the start of this step, -1 to 1
        double normalImpulse, tangentialImpulse; // N s, summed over the points and passes of the step
    };

    std::int32_t indexOf(const b2Fixture& fixture) const noexcept;
    bool isCamera(std::int32_t index) const noexcept;
    double massKg(std::int32_t index) const noexcept;
    /// The first record of a contact gets all its impulses: one that opens and closes again between the
    /// passes of a step is still one hit.
    Record* find(const b2Contact& contact) noexcept;
    Record describe(const b2Contact& contact) const noexcept;
    CollisionEvent toEvent(const Record& record, std::int32_t fixture, std::int32_t other) const noexcept;

    double threshold_;
    double stepSeconds_ = 0.0;
    std::uint64_t drops_ = 0;
    BodySweeps sweeps_;
    std::vector<Known> known_;
    std::unordered_map<const b2Fixture*, std::int32_t> indices_; // looked up, never walked through
    std::vector<Record> records_;                                // of the present step
};

} // namespace physvib
