// SPDX-License-Identifier: MIT
// From what a camera felt to collision events: amplitude, voice and place.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/EventSorter.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"
#include "Core/CollisionEvent.h"
#include <array>
#include <cstdint>
#include <tuple>

namespace physvib {

/// Adds the events of impacts (Eq. 5.4): one each, or two if the camera's voice is `both`: each with the full
/// amplitude, as two bodies sound that ring at the same time (Eq. 5.1 adds). Voice `other` or `both` with a
/// partner that has no frequency is `own`; where there is none either, or no mass for Eq. 5.4, nothing
/// sounds. What is made, muted or cannot be played is counted. Two surfaces that have a sound of their own
/// make that one instead. Each mode of a sound is an event.
///
/// What impacts of a pair have in common is worked out once for those that follow each other, as grains do.
/// For one step: while settings and fixtures stay as they are, and the cameras' bodies in the world. M only.
class EventMaker {
public:
    EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
               const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
               ContactCounts& counts) noexcept;
    void add(const Impact& impact);

private:
    struct Mode {
        double frequencyHz, decayPerSecond, relativeAmplitude;
    };
    void hold(std::int32_t camera);
    void meet(std::int32_t other);
    template <class Sound>
    void addModes(const Sound& sound) noexcept;
    void place(Vector2 world) noexcept;

    const FixtureTable& table_;
    const PairSounds& pairs_;
    const BodyReader& bodies_;
    const ImpactSettings& settings_;
    EventSorter& events_;
    ContactCounts& counts_;
    const ImpactModel model_;
    const float cos_, sin_; // of the field
    CollisionEvent event_;
    // Of the camera at hand:
    std::int32_t camera_ = FixtureTable::none;
    ImpactModel own_;
    double gain_ = 0.0;
    bool isMuted_ = false;
    // Of it and another fixture:
    bool hasMet_ = false;
    std::int32_t other_ = FixtureTable::none;
    double pairGain_ = 1.0;
    int modeCount_ = 0;
    std::array<Mode, 2 * (1 + std::tuple_size_v<Overtones>)> modes_;
};

/// The amplitude of its first mode (Eq. 5.4 and the camera's gain). As above.
double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model);

} // namespace physvib
