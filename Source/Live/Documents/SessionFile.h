// SPDX-License-Identifier: MIT
// Session file: a live session as JSON (scenes, seeds, timed inputs and controls) whose render reproduces
// what was played; and its journal, the form in which it grows during the session.
#pragma once
#include "Core/EventShaping.h"
#include "Core/HapticRenderer.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionLog.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {
/// Version of the format that is written, and the newest that is read. 2: mixer state, strikes, slow motion;
/// 3: recordings, gain, perceived level; 4: drags in metres of the screen; 5: moving strikes; 6: clips; 7:
/// law of grains, scenes of version 2; 8: groups, lanes; 9: sounds by number, recordings by material.
constexpr int sessionFormatVersion = std::max(9, stripsVersion);

// indexed by ImpactTiming and ImpactLocation
inline constexpr std::array<std::string_view, 2> timingNames{"onset", "release"};
inline constexpr std::array<std::string_view, 2> locationNames{"contact", "fixture"};

using Ceilings = std::array<float, limits::maxActuators>;

/// A saved session.
struct SavedSession {
    RunSettings run;      ///< its seed is not used: each scene run has its own
    PhantomPanner panner; ///< at the start of the session
    int channels = 0; ///< number of outputs, at least the number of actuators of any layout in the session
    bool limiterEnabled = true;
    /// drive ceiling per channel
    Ceilings ceilings = RendererSettings::fullScale();
    std::int64_t lengthNs = 0;
    SessionLog log;                 ///< at least one scene run
    std::optional<Mix> mix{};       ///< the mixer state at the end, if the session was played in the mixer
    EqualisedActuators equalised{}; ///< per channel
    EventShaping shaping{};         ///< for all collisions
    LayoutDescription layout{};     ///< of `panner`: name, labels, full scales; empty: not known
};

/// Fields that a session file and the first line of its journal share.
void visitSetup(auto& v) {
    using S = SavedSession;
    constexpr auto run = &S::run;
    v.field("steps_per_second", nest(run, &RunSettings::stepsPerSecond),
            kinds::wholeNumber(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond));
    v.field("timing", nest(run, &RunSettings::timing), kinds::OneOf{timingNames});
    v.field("location", nest(run, &RunSettings::location), kinds::OneOf{locationNames});
    v.field("limiter", &S::limiterEnabled, kinds::boolean);
    v.field("channels", &S::channels, kinds::wholeNumber(1, limits::maxActuators));
    v.field("panning", &S::panner, DescribedPanner{v.object.channels, v.object.layout});
}
void visitChannels(auto& v) {
    using S = SavedSession;
    v.field("ceilings", &S::ceilings, PerChannel<Ceilings>{v.object.channels}, Need::optional);
    v.field("equalised", &S::equalised, PerChannel<EqualisedActuators>{v.object.channels},
            Need::optional.from(2));
    v.field("shaping", &S::shaping, kinds::Object<EventShaping>{}, Need::optional.from(2));
}

void visitFields(auto& v, FieldsOf<SavedSession>) {
    v.version("physvib_session", sessionFormatVersion);
    v.field("seconds", &SavedSession::lengthNs, kinds::Time{});
    visitSetup(v);
    v.part("takes");
    visitChannels(v);
    v.part("controls", Need::optional);
    v.part("recordings", Need::optional.from(3));
    v.part("clips", Need::optional.from(6));
    v.part("strikes", Need::optional.from(2));
    v.part("desk", Need::optional.from(2));
}

struct JournalHead; // a SavedSession in the first line of a journal
constexpr int journalFormatVersion = 1;
void visitFields(auto& v, FieldsOf<JournalHead>) {
    v.version("physvib_session", sessionFormatVersion);
    v.version("journal", journalFormatVersion);
    visitSetup(v);
    visitChannels(v);
}

void visitFields(auto& v, FieldsOf<EventShaping>) {
    using S = EventShaping;
    constexpr auto method = &S::method;
    v.field("method", method, Custom<RenderingMethod>{}, Need::filled);
    v.field("fixed_amplitude", nest(method, &RenderingMethod::fixedAmplitude),
            kinds::upTo(limits::maxAmplitude), Need::filled);
    v.field("holds_level", nest(method, &RenderingMethod::holdsLevel), kinds::boolean,
            Need::optional.from(3));
    v.field("remap_hz", nest(&S::remap, &FrequencyRemap::band), Custom<FrequencyBand>{}, Need::optional);
    v.field("gain", &S::gain, kinds::upTo(limits::maxAmplitude), Need::optional.from(3));
    v.field("perceived_level", nest(&S::perceived, &PerceivedLevel::isWeighted), kinds::boolean,
            Need::optional.from(3));
    v.field("gamma", &S::truncation, kinds::range(0.0, S::maxTruncation), Need::optional.from(3));
}

/// Empty, or why no session file of `channels` outputs holds this control: its reader's line. Any thread.
std::string controlError(const RenderControl& control, int channels);

/// Parses a session; or one line about the first error, `name: takes[0].scene.bodies[1]...`. Unknown and
/// repeated fields are errors. Any thread.
Result<SavedSession> readSession(std::string_view text, std::string_view name);

/// Reads a file; recordings with relative paths are searched beside it. M only.
Result<SavedSession> loadSession(const std::filesystem::path& path);

/// The mixer state at the end: the saved one, or one made of layout, gains and mutes; its scene is the last
/// one as it was left, with drawings. Any thread.
Mix mixAtEnd(const SavedSession& session);

/// Whether the world was paused when the session ended. Any thread.
bool endsPaused(const SavedSession& session);

/// Writes a session as JSON. A scene run with the same scene as the one before does not repeat it.
/// readSession restores everything bit for bit, except labels of actuators. Paths of recordings become
/// relative to `folder`, the file's folder; empty: they stay unchanged. Any thread.
std::string sessionJson(const SavedSession& session, const std::filesystem::path& folder = {});

// Session journal: a file written while a session is played. Lines are only appended, so the cost of saving
// does not grow with the session.
//
// The first line is the head of a session file. Each further line adds one item: a scene run, an input, a
// stall, a control, recordings, a clip or a strike. A stall replaces the one before if it starts at the same
// time. A line with "seconds" says that all items up to that time are complete; lines after the last such
// line are ignored, because the file was cut off there.

/// Whether the text of a session file is a journal. Any thread.
bool isJournal(std::string_view text) noexcept;

/// The session up to the last complete time; or one line about the first error. Any thread.
Result<SavedSession> readJournal(std::string_view text, std::string_view name);

/// Produces the lines of one journal. One thread at a time.
class JournalLines {
public:
    /// Writes the head from `session`; paths of recordings become relative to `folder`.
    JournalLines(const SavedSession& session, std::filesystem::path folder);

    /// The first line of the journal.
    const std::string& head() const noexcept { return head_; }

    /// Lines for the items that Session::readLog has moved to `log` since the last call; they are complete up
    /// to `sessionNs`. `log` keeps what the next call needs. Returns empty once the journal is full.
    std::string nextLines(SessionLog& log, std::int64_t sessionNs);

    /// Empty, or the limit of the file that was reached; the journal ends there.
    const std::string& limitError() const noexcept { return limitError_; }
    std::int64_t completeNs() const noexcept { return completeNs_; }

private:
    std::string formatLines(SessionLog& log, std::int64_t sessionNs);

    int channels_;
    std::filesystem::path folder_;
    std::string head_, limitError_;
    std::size_t bytesWritten_, bodies_ = 0; // of all scene runs
    std::size_t runInputs_ = 0;             // of the current scene run
    std::int64_t completeNs_ = 0;
    bool isRunWritten_ = false; // the first scene run of the log has been written
    WorldStall lastStall_{-1};
    SceneRun previousRun_; // the scene run before the last, to compare scenes
};

} // namespace physvib
