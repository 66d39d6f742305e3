// SPDX-License-Identifier: MIT
// PhysVib for anybody's b2World: attach, set three values per fixture, step, take events.
#pragma once
#include "Core/CollisionEvent.h"
#include "Physics/AttachmentSettings.h"
#include "Physics/CollisionCatcher.h"
#include "Physics/ContactGraph.h"
#include "Physics/EventSorter.h"
#include "Physics/FixtureTable.h"
#include "Physics/HapticFixture.h"
#include "Physics/Impact.h"
#include "Physics/ImpactModel.h"
#include "Physics/OnsetImpacts.h"
#include "Physics/ReleaseImpacts.h"
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
    explicit Attachment(b2World& world, const AttachmentSettings& settings = {});
    ~Attachment() override;
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

    /// Takes effect with the next step; with another timing, what is under way is lost. Throws as the
    /// constructor does.
    void configure(const AttachmentSettings& settings);
    const AttachmentSettings& settings() const noexcept { return settings_; }

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
    std::int64_t timeNs() const noexcept { return span_.endNs; }
    std::int64_t settledNs() const noexcept { return span_.startNs; }

    /// Appends the events that are final now, in the order of their times.
    void take(std::vector<CollisionEvent>& events);

    /// Contacts and events lost so far because more came in one step than there is room for.
    std::uint64_t drops() const noexcept;

    /// The constants of Eq. 5.4 in the last step begun.
    const ImpactModel& impactModel() const noexcept { return model_; }

private:
    void SayGoodbye(b2Joint* joint) override;
    void SayGoodbye(b2Fixture* fixture) override;
    void refresh();
    void forget(std::int32_t slot);
    void release(std::int32_t slot);
    void check(const b2Fixture& fixture) const;

    b2World& world_;
    b2DestructionListener* chained_;
    AttachmentSettings settings_;
    ImpactModel model_;
    FixtureTable table_;
    ContactGraph graph_;
    CollisionCatcher catcher_;
    OnsetImpacts onset_;
    ReleaseImpacts release_;
    EventSorter held_;
    StepSpan span_;
    std::vector<Impact> impacts_;
    std::vector<std::int32_t> vanished_;
};

} // namespace physvib
