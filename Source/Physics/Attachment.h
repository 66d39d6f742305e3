// SPDX-License-Identifier: MIT
// PhysVib for anybody's b2World: attach, set three values per fixture, step, take events.
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"
#include "Core/CollisionEvent.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Turns the collisions of one world into events. The world stays its owner's: user data are not touched, its
/// motion is the same to the bit, and its contact and destruction listeners are called as before, also those
/// that are set, or taken away, while the attachment is there. Bodies and fixtures may come and go between
/// steps, or between the parts of one. Only a fixture destroyed by b2Body::DestroyFixture should be named to
/// remove() first: Box2D tells nobody, and the next fixture of that body may take its address, and so its
/// values. Who forgets that loses values, and no memory.
///
/// World and attachment may end in any order. A world outlived by its attachment is not touched any more; an
/// attachment outlived by its world leaves a listener there that hands on calls, unless it has been detached.
///
/// All methods: the world's thread (M), not inside a step. None allocates once it has seen as much as it
/// will, but where the caller's vector grows. What a step costs follows what moves, touches and strikes, not
/// the size of the map.
class Attachment final {
public:
    /// Throws std::invalid_argument if a setting is out of range.
    explicit Attachment(b2World& world, const ImpactSettings& settings = {});
    ~Attachment();
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

    /// Leaves the world, which must still be there, with the listeners it had; nothing is felt any more.
    void detach();

    /// Takes effect with the next step; with another timing, what is under way is lost. Throws as the
    /// constructor does.
    void configure(const ImpactSettings& settings);
    /// Any thread but while it steps.
    const ImpactSettings& settings() const noexcept;

    static constexpr std::int32_t nextId = -1; ///< no number of the game's own

    /// Gives a fixture its values, at first or again (the camera may come and go). Its id in events is `id`
    /// (>= 0), if given (a number of the game's own for it), else 0, 1, 2... in order of first calls, never
    /// used twice. Refused, told by the result, are values that cannot be played, a fixture of another world,
    /// an id below 0, and one that another fixture has.
    SetResult set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id = nextId);

    /// How two kinds of surfaces sound together (HapticFixture::surface), in any order, whatever the voice of
    /// the camera is. What is wrong with it, and nothing is changed; empty: it is set.
    std::string_view setPair(int surface, int other, const PairSound& sound);

    /// The values of a fixture; nullptr if it has none. Valid until the next call of anything.
    const HapticFixture* find(const b2Fixture& fixture) const noexcept;

    /// Takes a fixture's values away, and its events that have not been handed out.
    void remove(const b2Fixture& fixture);

    /// One step of the world with everything around it. No time: as Box2D has it, contacts are found, and
    /// nothing moves. Negative times do nothing.
    void step(float stepSeconds, int velocityIterations = 8, int positionIterations = 3);

    /// The same around a b2World::Step of the user's own. Step lengths may differ; time is the sum of their
    /// nanoseconds, each rounded. What happens in steps that are not told is felt at the start of the next
    /// one that is.
    void beginStep(double stepSeconds);
    /// For worlds whose clock is a step count: the step ends at `endNs` (not before timeNs()).
    void beginStepUntil(std::int64_t endNs);
    void endStep(); ///< Behind the world's own step.

    /// World time after the steps done, and the time before which all events are final: one step earlier,
    /// since a contact is noticed up to one step after it was made.
    std::int64_t timeNs() const noexcept;
    /// No event before it is still to come.
    std::int64_t settledNs() const noexcept;

    /// Appends the events that are final now, in the order of their times.
    void take(std::vector<CollisionEvent>& events);

    /// Appends all events at once, for those who would rather have them a step earlier than in order.
    void flush(std::vector<CollisionEvent>& events);

    /// b2World::ShiftOrigin, with what PhysVib knows of places: events stay where they are in the field.
    void shiftOrigin(b2Vec2 newOrigin);

    /// Hits and events lost so far because more came than there is room for. The weakest events go first.
    std::uint64_t drops() const noexcept;

    /// Hits left out so far because they were more than ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept;

    /// What became of all contacts so far, and why nothing is felt, in one sentence.
    ContactCounts counts() const noexcept;
    std::string explain() const { return physvib::explain(counts()); } ///< The most likely reason.

    /// The constants of Eq. 5.4 in the last step begun.
    const ImpactModel& impactModel() const noexcept;

private:
    void releaseUnseen();
    void finishStep();

    struct Parts;
    b2World* world_;               // nullptr: detached
    std::unique_ptr<Parts> parts_; // what it is made of, which is not installed
};

} // namespace physvib
