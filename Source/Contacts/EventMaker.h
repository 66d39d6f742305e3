// SPDX-License-Identifier: MIT
// From impacts to events (EventMaker), in order of time (EventSorter), with a learned level (FullScale).
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/GrainRuns.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/Impact.h"
#include "Contacts/ImpactSettings.h"
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

namespace physvib {

/// Holds events until no earlier one can arrive, sorted by time, then by fixture id, then by arrival. Memory
/// grows with what waits, up to the capacity. World thread (M).
class EventSorter {
public:
    explicit EventSorter(std::size_t capacity)
        : capacity_{capacity} {
        grow();
    }

    /// Adds an event; when full, or without memory, the weakest of all is dropped and counted. Fixtures
    /// without haptic values have no id: as the other one they are released as -1.
    [[gnu::always_inline]] void push(const CollisionEvent& event) noexcept {
        if (count_ == slotCount_ && !grow() && !dropWeakest(event.amplitude)) return;
        earliestNewNs_ = std::min(earliestNewNs_, event.timeNs);
        const std::size_t slot = ringIndex(count_++);
        heldEvents_[slot] = event;
        heldEvents_[slot].source.other = std::max(event.source.other, -1);
        keys_[slot] = {event.timeNs, event.source.fixture, event.source.other};
    }

    /// Adds an event per grain; other values are those of `model`. False, and nothing is added: no room.
    bool push(const GrainRuns& grains, const CollisionEvent& model) noexcept;

    /// Moves all events before `beforeNs` to the end of `finished`.
    void release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished);

    /// Releases all events, whatever their time.
    void flush(std::vector<CollisionEvent>& finished) {
        release(std::numeric_limits<std::int64_t>::max(), finished);
    }

    /// Removes the events of a fixture (by its id), and if `dropsCaused` also those that it caused of others.
    void removeEventsOf(std::int32_t fixture, bool dropsCaused) noexcept;

    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct HeldKey {
        std::int64_t timeNs;
        std::int32_t fixture, other;
    };
    struct ReleaseOrder { // sort key of an event that is being released
        std::int64_t timeNs;
        std::uint64_t rank; // fixture, then arrival
        friend bool operator<(const ReleaseOrder& a, const ReleaseOrder& b) noexcept {
            return a.timeNs != b.timeNs ? a.timeNs < b.timeNs : a.rank < b.rank;
        }
    };
    std::size_t ringIndex(std::size_t arrival) const noexcept { return (first_ + arrival) & mask_; }
    [[gnu::noinline]] bool grow() noexcept;      // false: full, or no memory
    bool dropWeakest(double amplitude) noexcept; // only an event weaker than `amplitude`
    void sort(std::size_t count) noexcept;
    template <class IsRemoved>
    void removeIf(std::size_t count, IsRemoved isRemoved) noexcept;

    std::size_t capacity_;
    std::uint64_t drops_ = 0;
    // A ring in order of arrival; its size is a power of two, one more than the mask
    std::size_t first_ = 0, count_ = 0, slotCount_ = 0, mask_ = 0;
    std::size_t oldCount_ = 0;    // events up to the last release; later ones come after them
    std::int64_t releasedNs_ = 0; // events before it have been released
    std::int64_t earliestNewNs_ = std::numeric_limits<std::int64_t>::max();
    std::vector<CollisionEvent> heldEvents_;
    std::vector<HeldKey> keys_; // of each held event
    // Buckets in time of the events being released, as many as heldEvents_ has
    std::vector<std::uint32_t> buckets_;
    std::vector<ReleaseOrder> order_, sorted_;
    std::vector<std::uint32_t> bucketEnds_; // ends of the buckets
};

/// Adds one event per impact and mode (Eq. 5.4). If the source's voice is `both`, both bodies sound, each
/// with the full amplitude, because sounds that overlap add (Eq. 5.1). Voice `other` or `both` with a partner
/// that has no frequency is `own`. Without any frequency, or without a mass for Eq. 5.4, there is no event.
/// Pairs of surfaces with a sound of their own use that instead. Created, muted and unplayable events are
/// counted.
///
/// Values common to a pair are computed once for consecutive impacts, as grains are. Valid for one step,
/// while settings and fixtures stay unchanged and the bodies exist. World thread (M).
class EventMaker {
public:
    EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
               const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
               ContactCounts& counts) noexcept;
    EventMaker(const EventMaker&) = delete;
    EventMaker& operator=(const EventMaker&) = delete;
    ~EventMaker() { counts_.addEvents(eventBounds_); }
    [[gnu::noinline]] void add(const Impact& impact) {
        selectPair(impact.source, impact.other);
        if (isMuted_ || modeCount_ != 1) [[unlikely]]
            return addModesOf(impact);
        addEvent(modes_[0], impact, amplitudeOf(impact));
    }
    /// Sets the source and the partner of the next impacts.
    void selectPair(std::int32_t source, std::int32_t other) {
        if (source != source_) setSource(source);
        if (!isMuted_ && (!hasPartner_ || other != partner_)) setPartner(other);
    }
    /// Selects the pair, and sets its factors in `runs`. False: its grains have to be added one by one.
    bool prepare(std::int32_t source, std::int32_t other, GrainRuns& runs) {
        selectPair(source, other);
        const bool isUsed = !isMuted_ && hasOwnSound_ && modeCount_ == 1 && isAtContact_ &&
                            modes_[0].isPlayable && runs.startNs >= 0 && runs.startNs < limits::maxTimeNs / 2;
        runs.perNewtonSecond = perNewtonSecond_;
        runs.divisor = amplitudeDivisor_;
        runs.gain = gain_;
        runs.pairGain = pairGain_;
        runs.relativeAmplitude = modes_[0].relativeAmplitude;
        runs.origin = settings_.fieldOrigin;
        runs.cosine = cos_;
        runs.sine = sin_;
        return isUsed;
    }
    std::int32_t idOf(std::int32_t other) const noexcept { return table_[other].id; }
    void addGrains(const GrainRuns& runs);

private:
    struct Mode {
        double frequencyHz, decayPerSecond, relativeAmplitude;
        SoundNumber sound;
        bool isPlayable; // isPlayable() of the values that do not depend on the impact
    };
    void addModesOf(const Impact& impact); ///< for any number of modes; only counts it if muted
    double amplitudeOf(const Impact& impact) const noexcept {
        return pairGain_ * (gain_ * (perNewtonSecond_ * impact.newtonSeconds / amplitudeDivisor_));
    }
    [[gnu::always_inline]] void addEvent(const Mode& mode, const Impact& impact, double amplitude) noexcept {
        if (isAtContact_) setPlace(impact.point);
        event_.timeNs = impact.timeNs;
        event_.source.impulseNewtonSeconds = impact.newtonSeconds;
        event_.source.kind = impact.kind;
        event_.amplitude = mode.relativeAmplitude * amplitude;
        send(mode.isPlayable);
    }
    [[gnu::always_inline]] void send(bool isPlayable) noexcept {
        // The rest of isPlayable() is the mode's. The sum is finite if its parts are: these are no larger
        // than floats.
        if (!(event_.timeNs >= 0 && event_.timeNs <= limits::maxTimeNs &&
              std::isfinite(event_.x + event_.y + event_.z) && isPlayable &&
              std::abs(event_.amplitude) <= limits::maxAmplitude)) [[unlikely]] {
            ++counts_.unplayable;
            return;
        }
        events_.push(event_);
        eventBounds_.add(event_.x, event_.y);
    }
    void setMode(const Mode& mode) noexcept {
        event_.frequencyHz = mode.frequencyHz;
        event_.decayPerSecond = mode.decayPerSecond;
        event_.sound = mode.sound;
    }
    void setSource(std::int32_t source);
    void setPartner(std::int32_t other);
    template <class Sound>
    void addModes(const Sound& sound) noexcept;
    // The field lies in the plane: its origin and rotation leave z as it is.
    void setPlace(Vector3 world) noexcept {
        const Vector2 offset = inPlane(world) - settings_.fieldOrigin;
        event_.x = static_cast<double>(cos_ * offset.x + sin_ * offset.y);
        event_.y = static_cast<double>(cos_ * offset.y - sin_ * offset.x);
        event_.z = static_cast<double>(world.z);
    }

    const FixtureTable& table_;
    const PairSounds& pairSounds_;
    const BodyReader& bodies_;
    const ImpactSettings& settings_;
    EventSorter& events_;
    ContactCounts& counts_;
    const ImpactModel model_;
    const float cos_, sin_;  // rotation of the field
    const bool isAtContact_; // else events are at the source's fixture
    CollisionEvent event_;
    EventBounds eventBounds_;
    // Of the current haptic source:
    std::int32_t source_ = FixtureTable::none;
    double perNewtonSecond_ = 0.0, amplitudeDivisor_ = 1.0; // ImpactModel::amplitude, in its order of
                                                            // operations
    double gain_ = 0.0;
    bool isMuted_ = false;
    // Of its current partner:
    bool hasPartner_ = false, hasOwnSound_ = false; // the source's own, for any partner
    std::int32_t partner_ = FixtureTable::none;
    double pairGain_ = 1.0;
    int modeCount_ = 0;
    std::array<Mode, 2 * (1 + std::tuple_size_v<Overtones>)> modes_;
};

/// The amplitude of the impact's first mode (Eq. 5.4 and the source's gain). World thread (M).
double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model);

/// Follows the strength of the hardest usual hit and puts it 6 dB below full scale, so that nobody has to
/// guess a gain.
///
/// Strength is the impulse of what sounds at once: impulses are summed to the power of 1.5, between the sum
/// of vibrations in phase and that of powers. It fades by 30 per second, as a usual vibration does. The level
/// rises to it at once, so no hit is played above the goal. It falls by a time constant of 10 s, of which a
/// pause counts 1 s at most: a quiet minute does not make the next touch loud.
///
/// The speeds below are multiples of the threshold for impacts, which fits the scale of the world. At first
/// the level is that of a change of the lighter body's velocity by 10 thresholds (1.5 m/s by default). It is
/// never below 2 thresholds (0.3 m/s), so the smallest impact stays 6 dB below the goal.
///
/// It depends on simulated time and impulses only. World thread (M).
class FullScale {
public:
    static constexpr double goal = 0.5; ///< amplitude of the hardest usual hit: 6 dB below full scale
    static constexpr double fallSeconds = 10.0;
    static constexpr double longestPauseSeconds = 1.0;
    static constexpr double fadePerSecond = 30.0;
    static constexpr double firstThresholds = 10.0;
    static constexpr double minThresholds = 2.0;

    /// Learns from the impacts of a step, whatever their order. Those of muted sources do not count, and
    /// grains do not raise the level.
    void learn(std::span<const Impact> impacts, const StepSpan& step, const FixtureTable& table);

    /// The impulse of an amplitude of 1. Until something was learned 1, which keeps the order of impacts.
    double newtonSeconds() const noexcept { return level_ > 0.0 ? level_ / goal : 1.0; }

private:
    double level_ = 0.0;    // N s, of the goal
    double strength_ = 0.0; // N s, of what sounds at once
    std::int64_t learnedNs_ = 0;
};

} // namespace physvib
