// SPDX-License-Identifier: MIT
// JSON forms that documents share: controls and panners, the mixer state, parts of sessions. Included by .cpp
// files of documents only.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Json/FieldTable.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NameList.h"
#include "Live/Documents/InputLine.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionFile.h"
#include "Scene/EventColumns.h"
#include "Scene/LayoutJson.h"
#include <array>
#include <string_view>

namespace physvib {
/// Reads a mixer state without scene and seed. Throws JsonError, as do all readers here.
Mix readMix(const JsonField& json);

std::vector<Strip> readCustom(const JsonField& list, const PerChannel<std::vector<Strip>>& kind);
OrderedJson writeCustom(const PerChannel<std::vector<Strip>>& kind, const std::vector<Strip>& strips);
std::vector<Strip> readCustom(const JsonField& list, const kinds::PluginStrips& kind);
OrderedJson writeCustom(const kinds::PluginStrips& kind, const std::vector<Strip>& strips);
GainLane readCustom(const JsonField& list, const Custom<GainLane>& kind);
OrderedJson writeCustom(const Custom<GainLane>& kind, const GainLane& lane);
FrequencyBand readCustom(const JsonField& json, const Custom<FrequencyBand>& kind);
OrderedJson writeCustom(const Custom<FrequencyBand>& kind, const FrequencyBand& band);
EqualisedActuators readCustom(const JsonField& list, const PerChannel<EqualisedActuators>& kind);
OrderedJson writeCustom(const PerChannel<EqualisedActuators>& kind, const EqualisedActuators& equalised);
std::uint32_t readCustom(const JsonField& json, const Custom<std::uint32_t>& kind); ///< a seed
inline OrderedJson writeCustom(const Custom<std::uint32_t>&, std::uint32_t seed) { return seed; }

// JSON form of render controls and panners, for session files and input lines. For .cpp files of documents.

/// How files and lines name a control, and the field and range of its value.
struct ControlDescription {
    enum class ValueType { panner, number, boolean, nothing }; ///< number and boolean belong to a channel
    std::string_view name;
    RenderControl::Kind kind;
    ValueType type;
    std::string_view field{};
    double minimum = 0.0, maximum = 0.0;
};

inline constexpr double minCeiling = 1e-6;

inline constexpr auto controlTable = std::to_array<ControlDescription>({
    {"layout", RenderControl::Kind::panner, ControlDescription::ValueType::panner, "panning"},
    {"gain", RenderControl::Kind::gain, ControlDescription::ValueType::number, "value", -1000.0, 1000.0},
    {"mute", RenderControl::Kind::mute, ControlDescription::ValueType::boolean, "on"},
    {"stop", RenderControl::Kind::stopAll, ControlDescription::ValueType::nothing},
    {"delay", RenderControl::Kind::delay, ControlDescription::ValueType::number, "seconds", 0.0,
     limits::maxChannelDelaySeconds},
    {"ceiling", RenderControl::Kind::ceiling, ControlDescription::ValueType::number, "value", minCeiling,
     1.0},
});
inline constexpr auto controlNames = entryNames(controlTable);

/// Reads a panner, and its layout's names into `kind`. Throws JsonError.
PhantomPanner readCustom(const JsonField& json, const DescribedPanner<LayoutDescription>& kind);
OrderedJson writeCustom(const DescribedPanner<const LayoutDescription>& kind, const PhantomPanner& panner);

/// Reads a control without its time; `otherField` may be present too. Throws JsonError.
OwnedControl readControl(const JsonField& json, int channels, std::string_view otherField = {});

OrderedJson controlJson(const RenderControl& control); ///< without its time

// JSON parts that session files and journals share. Included by .cpp files of this folder only.

void visitFields(auto& v, FieldsOf<WorldStall>) {
    v.field("time_s", &WorldStall::worldNs, kinds::Time{});
    v.field("seconds", &WorldStall::lengthNs, kinds::Time{});
    v.field("steps", &WorldStall::steps, kinds::wholeNumber(1, 1'000'000'000), Need::optional.from(2));
}

/// A run does not repeat the scene of the previous run. In a journal, end, inputs and stalls are later
/// lines of their own.
void visitRun(auto& v, bool isJournal) {
    v.field("start_s", &SceneRun::startNs, kinds::Time{});
    if (!isJournal) v.field("world_end_s", &SceneRun::worldEndNs, kinds::Time{});
    v.field("seed", &SceneRun::seed, Custom<std::uint32_t>{});
    v.part("scene", Need::optional);
    if (!isJournal) v.part("inputs", Need::optional), v.part("stalls", Need::optional);
}
struct JournalRun;
void visitFields(auto& v, FieldsOf<SceneRun>) { visitRun(v, false); }
void visitFields(auto& v, FieldsOf<JournalRun>) { visitRun(v, true); }

/// An event that was played without a collision in the world.
void visitFields(auto& v, FieldsOf<CollisionEvent>) {
    using E = CollisionEvent;
    using C = ToneCourse;
    constexpr auto course = &E::course;
    constexpr auto travel = nest(course, &C::travelNs);
    v.field("time_s", &E::timeNs, kinds::Time{});
    v.field("frequency_hz", &E::frequencyHz, kinds::positive);
    v.field("sound", &E::sound, kinds::wholeNumber(0, std::numeric_limits<SoundNumber>::max()),
            Need::filled.from(9));
    v.field("decay_per_s", &E::decayPerSecond, kinds::number);
    v.field("amplitude", &E::amplitude, kinds::number);
    v.field("x_m", &E::x, kinds::number);
    v.field("y_m", &E::y, kinds::number);
    v.field("z_m", &E::z, kinds::number, Need::optional);
    v.field("part", nest(&E::source, &CollisionSource::part),
            kinds::wholeNumber(0, std::numeric_limits<PartNumber>::max()), Need::optional);
    v.field("kind", nest(&E::source, &CollisionSource::kind), kinds::OneOf{contactKindNames}, Need::optional);
    v.field("duration_s", &E::durationNs, kinds::Time{}, Need::optional);
    if (v.has("travel_s", travel)) {
        v.field("to_x_m", nest(course, &C::toX), kinds::number);
        v.field("to_y_m", nest(course, &C::toY), kinds::number);
        v.field("to_z_m", nest(course, &C::toZ), kinds::number, Need::optional);
        v.field("travel_s", travel, kinds::Time{});
    }
    v.field("since_s", nest(course, &C::toneAgeNs), kinds::Time{}, Need::optional.from(5));
    v.field("spread", &E::spread, kinds::OneOf{spreadNames}, Need::optional.from(5));
}

Ceilings readCustom(const JsonField& list, const PerChannel<Ceilings>& kind);
OrderedJson writeCustom(const PerChannel<Ceilings>& kind, const Ceilings& ceilings);
RenderingMethod readCustom(const JsonField& json, const Custom<RenderingMethod>& kind);
OrderedJson writeCustom(const Custom<RenderingMethod>& kind, const RenderingMethod& method);

namespace detail {

/// Number of bodies of a scene, including those that its script spawns.
std::size_t bodyCount(const Scene& scene);

// Readers; all throw JsonError.
SceneRun readRunStart(const JsonField& json, const SceneRun* prior, bool isJournal);
WorldStall readStall(const JsonField& json, const SceneRun& run); ///< an error if before the run's last
void readTimedControl(const JsonField& json, SavedSession& session);
void readRecordingsChange(const JsonField& json, SessionLog& log);
CollisionEvent readStrike(const JsonField& json);
void readClipFile(const JsonField& json, SessionLog& log);

// Writers.
OrderedJson runStartJson(const SceneRun& run, const SceneRun* prior, bool isJournal);
OrderedJson inputJson(const LiveInput& input, const Scene& scene);
OrderedJson timedControlJson(const RenderControl& control);
OrderedJson recordingsJson(RecordingsChange change, const std::filesystem::path& folder);
OrderedJson clipJson(ClipFile clip, const std::filesystem::path& folder);

} // namespace detail

} // namespace physvib
