// SPDX-License-Identifier: MIT
// Converts impacts of haptic sources to collision events: amplitude, voice and place.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"
#include "Core/CollisionEvent.h"
#include <array>
#include <cstdint>
#include <tuple>

namespace physvib {

/// Adds one event per impact and mode (Eq. 5.4). If the source's voice is `both`, both bodies sound, each
/// with the full amplitude, because sounds that overlap add (Eq. 5.1). Voice `other` or `both` with a partner
/// that has no frequency is `own`. Without any frequency, or without a mass for Eq. 5.4, there is no event.
/// Pairs of surfaces with a sound of their own use that instead. Created, muted and unplayable events are
/// counted.
///
/// Values common to a pair are computed once for consecutive impacts, as grains are. Valid for one step,
/// while settings and fixtures stay unchanged and the bodies exist. World thread (M) only.
class EventMaker {
public:
    EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
               const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
               ContactCounts& counts) noexcept;
    void add(const Impact& impact);

private:
    struct Mode {
        double frequencyHz, decayPerSecond, relativeAmplitude;
        SoundNumber sound;
    };
    void setSource(std::int32_t camera);
    void setPartner(std::int32_t other);
    template <class Sound>
    void addModes(const Sound& sound) noexcept;
    void place(Vector3 world) noexcept;

    const FixtureTable& table_;
    const PairSounds& pairs_;
    const BodyReader& bodies_;
    const ImpactSettings& settings_;
    EventSorter& events_;
    ContactCounts& counts_;
    const ImpactModel model_;
    const float cos_, sin_; // rotation of the field
    CollisionEvent event_;
    // Of the current haptic source:
    std::int32_t camera_ = FixtureTable::none;
    ImpactModel own_;
    double gain_ = 0.0;
    bool isMuted_ = false;
    // Of its current partner:
    bool hasMet_ = false;
    std::int32_t other_ = FixtureTable::none;
    double pairGain_ = 1.0;
    int modeCount_ = 0;
    std::array<Mode, 2 * (1 + std::tuple_size_v<Overtones>)> modes_;
};

/// The amplitude of the impact's first mode (Eq. 5.4 and the source's gain). World thread (M).
double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model);

} // namespace physvib
