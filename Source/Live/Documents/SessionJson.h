// SPDX-License-Identifier: MIT
// JSON parts that session files and journals share. Included by .cpp files of this folder only.
#pragma once
#include "Live/Documents/ControlJson.h"
#include "Live/Documents/MixJson.h"
#include "Live/Documents/SessionFile.h"
#include <cmath>

namespace physvib {

void visitFields(auto& v, FieldsOf<WorldStall>) {
    v.field("time_s", &WorldStall::worldNs, kinds::Time{});
    v.field("seconds", &WorldStall::lengthNs, kinds::Time{});
    v.field("steps", &WorldStall::steps, kinds::whole(1, 1'000'000'000), Need::optional.from(2));
}

/// The scene is left out if it is that of the scene run before. In a journal, end, inputs and stalls follow
/// as lines of their own.
void visitTake(auto& v, bool isJournal) {
    v.field("start_s", &SceneRun::startNs, kinds::Time{});
    if (!isJournal) v.field("world_end_s", &SceneRun::worldEndNs, kinds::Time{});
    v.field("seed", &SceneRun::seed, kinds::upTo(4294967295.0));
    v.part("scene", Need::optional);
    if (!isJournal) v.part("inputs", Need::optional), v.part("stalls", Need::optional);
}
struct JournalTake;
void visitFields(auto& v, FieldsOf<SceneRun>) { visitTake(v, false); }
void visitFields(auto& v, FieldsOf<JournalTake>) { visitTake(v, true); }

/// An event that was played without a collision in the world.
void visitFields(auto& v, FieldsOf<CollisionEvent>) {
    using E = CollisionEvent;
    using C = StrikeCourse;
    constexpr auto course = &E::course;
    constexpr auto travel = in(course, &C::travelNs);
    v.field("time_s", &E::timeNs, kinds::Time{});
    v.field("frequency_hz", &E::frequencyHz, kinds::positive);
    v.field("sound", &E::sound, kinds::whole(0, std::numeric_limits<SoundNumber>::max()),
            Need::filled.from(9));
    v.field("decay_per_s", &E::decayPerSecond, kinds::number);
    v.field("amplitude", &E::amplitude, kinds::number);
    v.field("x_m", &E::x, kinds::number);
    v.field("y_m", &E::y, kinds::number);
    v.field("z_m", &E::z, kinds::number, Need::optional);
    v.field("part", in(&E::source, &CollisionSource::part),
            kinds::whole(0, std::numeric_limits<PartNumber>::max()), Need::optional);
    v.field("duration_s", &E::durationNs, kinds::Time{}, Need::optional);
    if (v.has("travel_s", travel)) {
        v.field("to_x_m", in(course, &C::toX), kinds::number);
        v.field("to_y_m", in(course, &C::toY), kinds::number);
        v.field("to_z_m", in(course, &C::toZ), kinds::number, Need::optional);
        v.field("travel_s", travel, kinds::Time{});
    }
    v.field("since_s", in(course, &C::sinceNs), kinds::Time{}, Need::optional.from(5));
    v.field("spread", &E::spread, kinds::OneOf{spreadNames}, Need::optional.from(5));
}

Ceilings readKind(const JsonField& list, const PerChannel<Ceilings>& kind);
OrderedJson writeKind(const PerChannel<Ceilings>& kind, const Ceilings& ceilings);
RenderingMethod readKind(const JsonField& json, const Own<RenderingMethod>& kind);
OrderedJson writeKind(const Own<RenderingMethod>& kind, const RenderingMethod& method);

namespace detail {

// Readers; all throw JsonError.
SceneRun readTakeStart(const JsonField& json, const SceneRun* before, bool isJournal);
WorldStall readStall(const JsonField& json, const SceneRun& take); ///< not before the run's last
void readTimedControl(const JsonField& json, SavedSession& session);
void readRecordingsChange(const JsonField& json, SessionLog& log);
CollisionEvent readStrike(const JsonField& json);
void readClipFile(const JsonField& json, SessionLog& log);

// Writers.
OrderedJson takeStartJson(const SceneRun& take, const SceneRun* before, bool isJournal);
OrderedJson inputJson(const LiveInput& input, const Scene& scene);
OrderedJson timedControlJson(const RenderControl& control);
OrderedJson recordingsJson(RecordingsChange change, const std::filesystem::path& folder);
OrderedJson clipJson(ClipFile clip, const std::filesystem::path& folder);

} // namespace detail
} // namespace physvib
