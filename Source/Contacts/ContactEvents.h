// SPDX-License-Identifier: MIT
// Engine-independent pipeline from physics contacts to collision events: it owns the stages and calls them.
#pragma once
#include "Contacts/CollisionRecorder.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/EventMaker.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/ImpactTimings.h"
#include "Contacts/LastingContacts.h"
#include "Core/CollisionEvent.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A physics engine's attachment drives it. `findOrAdd` registers a fixture when it gets values or touches
/// another. Each step: `beginStep`, contact reports to `recorder()`, `endStep`; then appendFinal() or
/// flush().
///
/// All methods: world thread (M). After its buffers have grown to the world's size it does not
/// allocate, except in the caller's vector.
class ContactEvents {
public:
    /// `bodies` must outlive it. Throws std::invalid_argument if a setting is out of range.
    ContactEvents(const BodyReader& bodies, const ImpactSettings& settings);
    ContactEvents(const ContactEvents&) = delete;
    ContactEvents& operator=(const ContactEvents&) = delete;

    /// Takes effect with the next step. If the timing changes, pending impacts are lost. Throws as the
    /// constructor does.
    void configure(const ImpactSettings& settings);
    const ImpactSettings& settings() const noexcept { return settings_; }

    /// Assigns haptic values to a fixture of that body, whose centre of mass is at `centre` in the body's
    /// frame; see FixtureTable::set. Refuses values that errorOf() rejects, and an id that another fixture
    /// has.
    SetResult set(std::uint64_t fixture, const BodyFacts& body, Vector2 centre, const HapticFixture& values,
                  std::int32_t id);

    /// Sets the common sound of two kinds of surfaces (HapticFixture::surface). Returns the error, or empty.
    std::string_view setPair(int surface, int other, const PairSound& sound) {
        return pairSounds_.set(surface, other, sound);
    }

    const FixtureTable& fixtures() const noexcept { return table_; }
    CollisionRecorder& recorder() noexcept { return recorder_; }
    LastingContacts& lasting() noexcept { return lasting_; }

    /// Removes the values of a fixture, and its events that have not been taken.
    void remove(std::int32_t slot);

    /// Ends a contact of two slots outside a step, because one of them is about to be destroyed.
    void endOutsideStep(std::int32_t a, std::int32_t b, const BodyMotion& motionA, const BodyMotion& motionB);

    /// Call before a fixture is destroyed, not while the engine steps. Its impacts so far are kept or dropped
    /// (ImpactSettings::keepsHitsOfDestroyed).
    void handleDestruction(std::int32_t slot);

    void release(std::int32_t slot); ///< Frees the slot of a destroyed fixture.

    /// Registers a fixture and returns its slot. Call it before the fixture's first contact is reported.
    std::int32_t findOrAdd(std::uint64_t fixture, const BodyFacts& body);
    std::int32_t updateBody(std::int32_t slot, const BodyFacts& body); ///< updates a registered fixture

    /// The step ends at `endNs` (not before timeNs()). Gravity in m/s^2; the largest mass of a dynamic body
    /// in kg (Eq. 5.7).
    void beginStep(std::int64_t endNs, Vector2 gravity, double largestMassKg);

    /// Turns the reports of the engine's step into events. An attachment that learns of a destruction after
    /// the engine's step and before endStep calls it while all fixtures still exist. No effect without
    /// reports, or if called again.
    void processReports();
    void endStep();

    /// World time after the last step; and the time before which all events are final: one step earlier,
    /// because a contact may be reported up to one step late. The latter stays until a step's reports have
    /// become events.
    std::int64_t timeNs() const noexcept { return span_.endNs; }
    std::int64_t settledNs() const noexcept { return isProcessed_ ? span_.startNs : span_.earliestNs; }
    double stepSeconds() const noexcept { return span_.seconds(); }

    /// Appends the final events in time order.
    void appendFinal(std::vector<CollisionEvent>& events) { pendingEvents_.release(settledNs(), events); }

    /// Appends all events, final or not, for immediate use. Later events may precede them by up to a step.
    void flush(std::vector<CollisionEvent>& events) { pendingEvents_.flush(events); }

    /// The engine has shifted all coordinates (a new origin): shifts pending impacts, and the field, so that
    /// events keep their places in it.
    void shift(Vector2 offset) noexcept;

    /// Contacts and events lost so far because buffers were full.
    std::uint64_t drops() const noexcept {
        return recorder_.drops() + release_.drops() + pendingEvents_.drops();
    }

    /// Impacts left out so far because of ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept { return overBudget_; }

    /// Grains (roughness elements) left out so far by thinning; the remaining ones carry their power.
    std::uint64_t thinned() const noexcept { return lasting_.thinned(); }

    /// Counts of all contacts so far; see explain().
    ContactCounts counts() const noexcept;
    /// Counts since the last call of this, or since the beginning.
    ContactCounts takeRecent() noexcept;

    /// The constants of Eq. 5.4 in the current or last step.
    const ImpactModel& impactModel() const noexcept { return model_; }

private:
    ContactCounts recentCounts() const noexcept;
    void processStep();
    void addImpacts();
    EventMaker makeEventMaker() noexcept;
    void keepStrongest(std::size_t count);
    void forget(std::int32_t slot, bool dropsEvents, bool dropsCaused);

    const BodyReader& bodies_;
    ImpactSettings settings_;
    ImpactModel model_;
    FixtureTable table_;
    ContactGraph graph_;
    CollisionRecorder recorder_;
    OnsetImpacts onset_;
    ReleaseImpacts release_;
    LastingContacts lasting_;
    EventSorter pendingEvents_;
    StepSpan span_;
    std::vector<Impact> impacts_;
    FullScale fullScale_;
    PairSounds pairSounds_;
    std::uint64_t overBudget_ = 0;
    ContactCounts earlierCounts_; // until the last takeRecent(); later counts are in the recorder's tally
    bool isProcessed_ = true;
};

} // namespace physvib
