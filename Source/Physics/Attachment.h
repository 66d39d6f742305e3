// SPDX-License-Identifier: MIT
// PhysVib for a Box2D world: attach it, set values per fixture, step the world, take events.
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/ImpactSettings.h"
#include "Core/CollisionEvent.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Turns the collisions of one world into events. It changes nothing in the world: user data stay, motion is
/// the same to the bit, and the world's contact and destruction listeners are called as before, also those
/// that are set or removed while the attachment exists. Bodies and fixtures may be created and destroyed
/// between steps, or between beginStep and endStep. Call remove() before b2Body::DestroyFixture: Box2D
/// reports that to no listener, and the next fixture of that body may get the address, and so the values.
/// Without the call values are wrong, and no memory is lost.
///
/// World and attachment may end in any order. After the world has ended the attachment does not access it.
/// After the attachment has ended its listener stays in the world and forwards calls, unless detach() was
/// called.
///
/// All methods: world thread (M), not inside a step. None allocates after a step with as many bodies
/// and contacts, except where the caller's vector grows. The cost of a step follows what moves, touches and
/// collides, not the size of the map.
class Attachment final {
public:
    /// Throws std::invalid_argument if a setting is out of range.
    explicit Attachment(b2World& world, const ImpactSettings& settings = {});
    ~Attachment();
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

    /// Restores the listeners of the world, which must still exist. There are no events from now on.
    void detach();

    /// Takes effect with the next step. Another timing drops contacts that have begun. Throws as the
    /// constructor does.
    void configure(const ImpactSettings& settings);
    /// Any thread, but not while the attachment steps.
    const ImpactSettings& settings() const noexcept;

    static constexpr std::int32_t nextId = -1; ///< passed to set() as `id`: the next free one

    /// Gives a fixture its values, or changes them (it may become or stop being a haptic source). Its id in
    /// events is `id` (>= 0), a number of the game's own, or else 0, 1, 2... in order of first calls, never
    /// used twice. Refused, with the reason in the result, are values that cannot be played, a fixture of
    /// another world, an id below 0, and one that another fixture has.
    SetResult set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id = nextId);

    /// The sound of impacts between two kinds of surfaces (HapticFixture::surface), in any order. It replaces
    /// the sound that the haptic source's voice selects. Returns the error, in which case nothing has
    /// changed, or an empty text.
    std::string_view setPair(int surface, int other, const PairSound& sound);

    /// The values of a fixture; nullptr if it has none. Valid until the next call of any method.
    const HapticFixture* find(const b2Fixture& fixture) const noexcept;

    /// Removes a fixture's values, and its events that were not taken yet.
    void remove(const b2Fixture& fixture);

    /// Calls beginStep, b2World::Step and endStep. A step of 0 s finds contacts and moves nothing, as in
    /// Box2D; one below 0 does nothing.
    void step(float stepSeconds, int velocityIterations = 8, int positionIterations = 3);

    /// Call it before your own b2World::Step. Step lengths may differ; time is the sum of their
    /// nanoseconds, each rounded. Collisions in steps without these calls become events at the start of the
    /// next step that has them.
    void beginStep(double stepSeconds);
    /// For worlds whose clock is a step count: the step ends at `endNs` (not before timeNs()).
    void beginStepUntil(std::int64_t endNs);
    void endStep(); ///< Call it after your own b2World::Step.

    /// World time after the steps so far, ns.
    std::int64_t timeNs() const noexcept;
    /// Time before which all events are final, ns: one step before timeNs(), since a contact is noticed up to
    /// one step after it was made.
    std::int64_t settledNs() const noexcept;

    /// Appends the events that are final now, in time order.
    void take(std::vector<CollisionEvent>& events);

    /// Appends all events, a step earlier than take(), but not always in time order.
    void flush(std::vector<CollisionEvent>& events);

    /// Calls b2World::ShiftOrigin and moves PhysVib's places with it: events keep their places in the field.
    void shiftOrigin(b2Vec2 newOrigin);

    /// Contacts and events lost so far for lack of room. The weakest are dropped first.
    std::uint64_t drops() const noexcept;

    /// Impacts left out so far because they were more than ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept;

    /// Counts of all contacts so far.
    ContactCounts counts() const noexcept;
    /// Why nothing, or not everything, is felt of what happened since the last call, in a sentence; see
    /// physvib::explain. It looks at all fixtures of the world. `output`: what plays the events; null:
    /// unknown.
    std::string explain(const OutputFacts* output = nullptr);

    /// The constants of Eq. 5.4 in the current or last step.
    const ImpactModel& impactModel() const noexcept;

private:
    void releaseDestroyedFixtures();
    void finishStep();

    struct Parts;
    b2World* world_;               // nullptr: detached
    std::unique_ptr<Parts> parts_; // the implementation, whose headers are not installed
};

} // namespace physvib
