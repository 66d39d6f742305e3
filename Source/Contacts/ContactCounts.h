// SPDX-License-Identifier: MIT
// Counts of what happened to a world's contacts, to diagnose why no vibration, or too little, is played.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {
class PhantomPanner;

/// Why a haptic source can touch nothing in the physics engine, as the state of its bodies shows.
enum class EngineNote : std::uint8_t { sensor, filtered, disabled, asleep };

/// How many events were made, and the bounds of their places, m of the field.
struct EventBounds {
    std::uint64_t count = 0;
    double minX = std::numeric_limits<double>::infinity(), minY = minX, maxX = -minX, maxY = -minX;

    void add(std::size_t eventCount, std::array<double, 2> min, std::array<double, 2> max) noexcept {
        count += eventCount - 2; // the two corners below add 2
        add(min[0], min[1]);
        add(max[0], max[1]);
    }
    void add(double x, double y) noexcept {
        ++count;
        minX = std::min(minX, x);
        minY = std::min(minY, y);
        maxX = std::max(maxX, x);
        maxY = std::max(maxY, y);
    }
};

/// Counts of a period: since the world was made, or since the last explanation.
struct ContactCounts {
    std::uint64_t contacts = 0;       ///< pairs that began to touch, and new contact points that the engine
                                      ///< distinguishes
    std::uint64_t belowThreshold = 0; ///< of haptic sources: slower than the threshold, including new points
                                      ///< of jittering contacts
    std::uint64_t withoutSource = 0;  ///< contacts of which neither body is a haptic source
    std::uint64_t unplayable = 0; ///< impacts whose sound has no frequency or is outside the playable range
    std::uint64_t muted = 0;    ///< impacts while everything is muted, or of a haptic source with a gain of 0
    std::uint64_t settling = 0; ///< impacts in the first ImpactSettings::settlingSeconds
    std::uint64_t dropped = 0;  ///< more than there is room for, or than ImpactSettings::hitsPerStep
    std::uint64_t events = 0;   ///< events created
    std::uint64_t handedOn = 0; ///< impacts that a movable source passed between its neighbours: push and
                                ///< reaction cancel (Eq. 5.4), so it has no event
    double minX = 0.0, minY = 0.0, maxX = 0.0, maxY = 0.0; ///< bounds of the events' places, m of the
                                                           ///< field
    double thresholdMetresPerSecond = 0.0; ///< effective value: at least 1.5 g dt of the last step
    bool hasSources = false;               ///< a body is a haptic source now
    bool mayBePushed = false;              ///< one of them is movable

    std::uint64_t steps = 0;         ///< steps begun
    std::uint64_t zeroSteps = 0;     ///< of these: 0 s long
    double longestStepSeconds = 0.0; ///< the longest of them
    std::uint64_t outsideSteps = 0;  ///< contacts refused because no step had begun
    std::uint64_t unknownBodies = 0; ///< contacts refused because they name a body that was never set
    std::int32_t unknownBody = -1;   ///< the last such body
    std::uint64_t immovable = 0;     ///< of belowThreshold: both masses are 0
    std::uint64_t parting = 0;       ///< of belowThreshold: the surfaces part along the normal
    std::uint64_t motionless = 0;    ///< of belowThreshold: neither speed nor impulse nor motion was reported
    double strongestBelowMetresPerSecond = 0.0;  ///< threshold that would let the strongest of belowThreshold
                                                 ///< pass, m/s
    double fastestPartingMetresPerSecond = 0.0;  ///< speed of the fastest of `parting`, m/s
    double fastestApproachMetresPerSecond = 0.0; ///< of all collisions, m/s
    double gravityMetresPerSecond2 = 0.0;        ///< of the last step
    double configuredThresholdMetresPerSecond = 0.0; ///< ImpactSettings::thresholdMetresPerSecond
    double fieldWidthMetres = 0.0;                   ///< ImpactSettings::fieldWidthMetres
    bool isMuted = false;                            ///< ImpactSettings::isMuted

    /// What the engine says of haptic sources now: how many, by EngineNote, and the last body of each.
    struct NoteCount {
        std::uint32_t count = 0;
        std::int32_t body = -1;
    };
    std::array<NoteCount, 4> notes{};

    /// Counts events.
    void addEvents(const EventBounds& places) noexcept {
        if (places.count == 0) return;
        const bool isFirst = std::exchange(events, events + places.count) == 0;
        minX = isFirst ? places.minX : std::min(minX, places.minX);
        minY = isFirst ? places.minY : std::min(minY, places.minY);
        maxX = isFirst ? places.maxX : std::max(maxX, places.maxX);
        maxY = isFirst ? places.maxY : std::max(maxY, places.maxY);
    }

    /// Notes what the engine says of a haptic source.
    void note(EngineNote kind, std::int32_t body) noexcept;

    /// True if the world was stepped, or a contact was reported.
    bool hasActivity() const noexcept { return steps + contacts + outsideSteps + unknownBodies > 0; }

    /// Adds the counts of another world, whose threshold is then shown.
    ContactCounts& operator+=(const ContactCounts& other) noexcept;
};

/// State of the output that plays a world's events, to explain silence that the world cannot see. The
/// owner of the renderer or device fills it in.
struct OutputFacts {
    bool isMissing = false;                ///< no device asks for samples
    bool isSilent = false;                 ///< the output is muted
    std::string_view silentBy{};           ///< who muted it, in words; empty: unknown
    std::string_view error{};              ///< error of the device, in one line
    int channels = 0;                      ///< that the device plays; 0: all of the layout
    double levelGain = 1.0;                ///< gain of all channels
    std::uint64_t mutedChannels = 0;       ///< bit j: channel j is muted, or its gain is 0
    std::uint64_t late = 0;                ///< events played after their time, since the last explanation
    std::uint64_t dropped = 0;             ///< events for which the queue had no room, since then
    std::uint64_t rejected = 0;            ///< events that cannot be played, since then
    const PhantomPanner* panner = nullptr; ///< layout and field of later events; null: unknown
    std::uint64_t withoutPart = 0; ///< events of a part of the body that no actuator is on, since then
};

/// The most likely reason why nothing, or not everything, is felt, as one sentence with names of physvib.h.
/// `recent`: of the time since the last explanation; if nothing has happened since, the sentence is about
/// `total`, and says so. `output`: what plays the events; null: unknown. Its names are those of C,
/// see replaceNames(). Any thread.
std::string explain(const ContactCounts& recent, const ContactCounts& total,
                    const OutputFacts* output = nullptr);
/// The reason for one period alone. Any thread.
inline std::string explain(const ContactCounts& counts) { return explain(counts, counts); }

/// The output of `--explain`: the sentence, and a line per count. Any thread.
std::string describe(const ContactCounts& counts, const OutputFacts* output = nullptr);

/// Why events that were made are not felt, as one sentence with names of physvib.h; empty: no reason is
/// known. Any thread.
std::string outputReason(const ContactCounts& counts, const OutputFacts& output);

/// The value with three significant digits and a decimal point in every locale. Any thread.
std::string formatThreeDigits(double value);

/// The number with its noun in singular or plural: `1 event`, `2 events`. Any thread.
std::string countWithNoun(std::uint64_t count, std::string_view noun);

/// Whose names an explanation uses: those of the C++ classes, of scene files, or of the mixer's controls.
enum class Names { cpp, scene, mixer };

/// Replaces the names of physvib.h in an explanation. Languages with bindings do so themselves, by the names
/// of their bindings. Any thread.
std::string replaceNames(std::string sentence, Names vocabulary);

} // namespace physvib
