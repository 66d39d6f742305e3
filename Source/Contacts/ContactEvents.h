// SPDX-License-Identifier: MIT
// From the contacts of any physics engine to collision events: the whole way, but for the engine.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/LastingContacts.h"
#include "Contacts/OnsetImpacts.h"
#include "Contacts/PairSounds.h"
#include "Contacts/ReleaseImpacts.h"
#include "Core/CollisionEvent.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// An engine's attachment feeds one of these: `know` a fixture when it gets values or touches another; each
/// step `beginStep`, what the engine tells of its contacts to `catcher()`, `endStep`; then the events are
/// taken.
///
/// All methods: the world's thread (M). None allocates once it has seen as much as it will, but where the
/// caller's vector grows.
class ContactEvents {
public:
    /// `bodies` must outlive it. Throws std::invalid_argument if a setting is out of range.
    ContactEvents(const BodyReader& bodies, const ImpactSettings& settings);
    ContactEvents(const ContactEvents&) = delete;
    ContactEvents& operator=(const ContactEvents&) = delete;

    /// Takes effect with the next step; with another timing, what is under way is lost. Throws as the
    /// constructor does.
    void configure(const ImpactSettings& settings);
    const ImpactSettings& settings() const noexcept { return settings_; }

    /// Gives values to a fixture, now with this body and with its centre of mass there in the body's frame;
    /// see FixtureTable::set. Values that faultOf() finds fault with, and an id that another has, are
    /// refused.
    SetResult set(std::uint64_t fixture, const BodyFacts& body, Vector2 centre, const HapticFixture& values,
                  std::int32_t id);

    /// How two kinds of surfaces sound together (HapticFixture::surface); what is wrong with it, empty: it is
    /// set.
    std::string_view setPair(int surface, int other, const PairSound& sound) {
        return pairs_.set(surface, other, sound);
    }

    const FixtureTable& fixtures() const noexcept { return table_; }
    CollisionCatcher& catcher() noexcept { return catcher_; }
    LastingContacts& lasting() noexcept { return lasting_; }

    /// Takes the values of a fixture away, and its events that have not been handed out.
    void remove(std::int32_t slot);

    /// A contact of two slots is cut while the engine does not step: one of them is about to go.
    void cut(std::int32_t a, std::int32_t b, const BodyMotion& motionA, const BodyMotion& motionB);

    /// A fixture that is about to go, while it is still there: what it felt and gave so far stays, or not
    /// (see ImpactSettings::keepsHitsOfDestroyed). Not while the engine steps.
    void vanish(std::int32_t slot);

    /// A fixture that has gone: its slot is free.
    void release(std::int32_t slot);

    /// A fixture, now with this body: its slot. Call it at least when a contact of it begins.
    std::int32_t know(std::uint64_t fixture, const BodyFacts& body);
    std::int32_t know(std::int32_t slot, const BodyFacts& body); ///< of one that is known

    /// The step ends at `endNs` (not before timeNs()); gravity in m/s^2; the largest mass of a dynamic body,
    /// kg (Eq. 5.7).
    void beginStep(std::int64_t endNs, Vector2 gravity, double largestMassKg);

    /// The engine's step is over: what it told becomes events. An attachment that learns of a destruction
    /// after the engine's step, and before endStep, calls it while everything is still there. Does nothing if
    /// nothing was told, or a second time.
    void conclude();
    void endStep();

    /// World time after the steps done, and the time before which all events are final: one step earlier,
    /// since a contact is noticed up to one step after it was made.
    std::int64_t timeNs() const noexcept { return span_.endNs; }
    std::int64_t settledNs() const noexcept { return span_.startNs; }
    double stepSeconds() const noexcept { return span_.seconds(); }

    /// Appends the events that are final now, in the order of their times.
    void take(std::vector<CollisionEvent>& events);

    /// Appends all events, final or not, for those who need them at once rather than in order: what comes
    /// later may lie up to a step before them.
    void flush(std::vector<CollisionEvent>& events);

    /// The engine has moved all places by this much (its origin is another): what is under way moves along,
    /// and the field, so that events stay where they are in it.
    void shift(Vector2 by) noexcept;

    /// Contacts and events lost so far because more came in one step than there is room for.
    std::uint64_t drops() const noexcept { return catcher_.drops() + release_.drops() + held_.drops(); }

    /// Hits left out so far because they were more than ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept { return overBudget_; }

    /// Grains of rough surfaces that were passed and left out so far, their power being in the others.
    std::uint64_t thinned() const noexcept { return lasting_.thinned(); }

    /// What became of all contacts so far; see explain().
    ContactCounts counts() const noexcept;

    /// The constants of Eq. 5.4 in the last step begun.
    const ImpactModel& impactModel() const noexcept { return model_; }

private:
    void finish();
    void addImpacts();
    void keepStrongest(std::size_t count);
    void forget(std::int32_t slot, bool isWithdrawn, bool othersToo);
    static void name(std::vector<CollisionEvent>& events, std::size_t first);

    const BodyReader& bodies_;
    ImpactSettings settings_;
    ImpactModel model_;
    FixtureTable table_;
    ContactGraph graph_;
    CollisionCatcher catcher_;
    OnsetImpacts onset_;
    ReleaseImpacts release_;
    LastingContacts lasting_;
    EventSorter held_;
    StepSpan span_;
    std::vector<Impact> impacts_;
    PairSounds pairs_;
    std::uint64_t overBudget_ = 0;
    ContactCounts counts_; // as far as others do not count
    bool isConcluded_ = true;
};

} // namespace physvib
