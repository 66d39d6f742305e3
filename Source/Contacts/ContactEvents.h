// SPDX-License-Identifier: MIT
// From the contacts of any physics engine to collision events: the whole way, but for the engine.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/OnsetImpacts.h"
#include "Contacts/ReleaseImpacts.h"
#include "Core/CollisionEvent.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// An engine's attachment feeds one of these. Each step: `look` at every fixture between `beginLook` and `endLook`,
/// `beginStep`, what the engine tells of its contacts to `catcher()`, `endStep`; then the events are taken.
///
/// All methods: the world's thread (M). After warm-up none allocates, but where the world or the caller's vector grows.
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

    FixtureTable& fixtures() noexcept { return table_; }
    const FixtureTable& fixtures() const noexcept { return table_; }
    CollisionCatcher& catcher() noexcept { return catcher_; }

    /// Takes the values of a fixture away, and its events that have not been handed out.
    void remove(std::int32_t slot);

    /// A fixture that is gone: its slot is free.
    void release(std::int32_t slot);

    /// After the look: what was not seen is released.
    void endLook();

    /// The step ends at `endNs` (not before timeNs()); gravity in m/s^2.
    void beginStep(std::int64_t endNs, Vector2 gravity);
    void endStep();

    /// World time after the steps done, and the time before which all events are final: one step earlier,
    /// since a contact is noticed up to one step after it was made.
    std::int64_t timeNs() const noexcept { return span_.endNs; }
    std::int64_t settledNs() const noexcept { return span_.startNs; }
    double stepSeconds() const noexcept { return span_.seconds(); }

    /// Appends the events that are final now, in the order of their times.
    void take(std::vector<CollisionEvent>& events);

    /// Contacts and events lost so far because more came in one step than there is room for.
    std::uint64_t drops() const noexcept { return catcher_.drops() + release_.drops() + held_.drops(); }

    /// The constants of Eq. 5.4 in the last step begun.
    const ImpactModel& impactModel() const noexcept { return model_; }

private:
    void forget(std::int32_t slot);

    const BodyReader& bodies_;
    ImpactSettings settings_;
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
