// SPDX-License-Identifier: MIT
// PhysVib for anybody's b2World: attach, set three values per fixture, step, take events.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/ImpactSettings.h"
#include "Core/CollisionEvent.h"
#include "Physics/WorldBodies.h"
#include "Physics/WorldListener.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <vector>

namespace physvib {

/// Turns the collisions of one world into events. The world stays its owner's: user data are not touched, and
/// the contact and destruction listeners it has at that time are called as before, and put back at the end.
/// (A listener that is set later takes the attachment's place; set it first.) Bodies and fixtures may come
/// and go between steps; they are noticed. Only a fixture destroyed by b2Body::DestroyFixture should be named
/// to remove() first: Box2D tells nobody, and a new fixture at the same address would inherit its values.
///
/// All methods: the world's thread (M), not inside a step. After warm-up none allocates, but where the world
/// or the caller's vector grows.
class Attachment final : private b2DestructionListener {
public:
    /// The world must outlive the attachment. Attachments of the same world must end in reverse order. Throws
    /// std::invalid_argument if a setting is out of range.
    explicit Attachment(b2World& world, const ImpactSettings& settings = {});
    ~Attachment() override;
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

    /// Takes effect with the next step; with another timing, what is under way is lost. Throws as the
    /// constructor does.
    void configure(const ImpactSettings& settings) { events_.configure(settings); }
    const ImpactSettings& settings() const noexcept { return events_.settings(); }

    /// Gives a fixture its values, at first or again (the camera may come and go); returns its id in events,
    /// 0, 1, 2... in order of first calls, never used twice. Throws std::invalid_argument if it is of another
    /// world.
    std::int32_t set(const b2Fixture& fixture, const HapticFixture& values);

    /// The same with an id (>= 0) of the caller's choice.
    void set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id);

    /// The values of a fixture; nullptr if it has none. Valid until the next call of anything.
    const HapticFixture* find(const b2Fixture& fixture) const noexcept;

    /// Takes a fixture's values away, and its events that have not been handed out.
    void remove(const b2Fixture& fixture);

    /// One step of the world with everything around it. Zero or negative times do nothing.
    void step(float stepSeconds, int velocityIterations = 8, int positionIterations = 3);

    /// The same around a b2World::Step of the user's own. Step lengths may differ; time is the sum of their
    /// nanoseconds, each rounded.
    void beginStep(double stepSeconds);
    /// For worlds whose clock is a step count: the step ends at `endNs` (later than timeNs()).
    void beginStepUntil(std::int64_t endNs);
    void endStep();

    /// World time after the steps done, and the time before which all events are final: one step earlier,
    /// since a contact is noticed up to one step after it was made.
    std::int64_t timeNs() const noexcept { return events_.timeNs(); }
    std::int64_t settledNs() const noexcept { return events_.settledNs(); }

    /// Appends the events that are final now, in the order of their times.
    void take(std::vector<CollisionEvent>& events) { events_.take(events); }

    /// Contacts and events lost so far because more came in one step than there is room for.
    std::uint64_t drops() const noexcept { return events_.drops(); }

    /// The constants of Eq. 5.4 in the last step begun.
    const ImpactModel& impactModel() const noexcept { return events_.impactModel(); }

private:
    void SayGoodbye(b2Joint* joint) override;
    void SayGoodbye(b2Fixture* fixture) override;
    void look();
    std::int32_t slotOf(const b2Fixture& fixture) const noexcept;
    void check(const b2Fixture& fixture) const;

    b2World& world_;
    b2DestructionListener* chained_;
    BodySweeps sweeps_;
    WorldBodies bodies_;
    ContactEvents events_;
    WorldListener listener_;
};

} // namespace physvib
