// SPDX-License-Identifier: MIT
// The table of messages, and the router that checks messages of all inputs against it, gives them a time and
// passes them to the session; the rate limit of their error reports.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Core/Limits.h"
#include "Core/NameNumbers.h"
#include "Io/Result.h"
#include "Live/Documents/InputLine.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/Session.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

// Table of all messages that a session accepts, with their arguments. The inputs (lines, OSC) read it; a test
// compares it with Docs/messages.md.

class MessageValues;
class Session;
struct CollisionEvent;
struct EventShaping;
struct Material;
struct PlainMessage;

struct MessageArgument {
    enum class Type {
        number, ///< from `minimum` to `maximum`
        text,
        place,  ///< an actuator's letter, or x and y in metres of the field
        places, ///< letters, or x, y, x, y...
        numbers ///< rising, each from `minimum` to `maximum`
    };
    std::string_view name;
    Type type = Type::number;
    double minimum = 0.0, maximum = 0.0;
    std::string_view defaultText; ///< default value as it is written in a line; empty: see `meaning`
    std::string_view meaning;
};

struct MessageDescription {
    /// Computes the events of a message, in time order, from time 0 on. An event that is cut ends at the
    /// nearest zero crossing of the frequency that is played. `materials` are the scene's. Throws
    /// MessageError. Any thread but the render thread (R). In MessageValues.cpp.
    using Strikes = std::vector<CollisionEvent>(const MessageValues& values,
                                                const std::vector<Material>& materials,
                                                const EventShaping& shaping);
    /// Computes the answer of a query. Any thread but R. In MessageRouter.cpp.
    using Answer = PlainMessage(const Session& session);
    struct Clip {};
    struct Stop {};

    std::string_view name, meaning;
    std::span<const MessageArgument> arguments;         ///< all but queries have time arguments as well
    std::variant<Strikes*, Answer*, Clip, Stop> action; ///< what the router does for it

    constexpr bool isQuery() const noexcept { return std::holds_alternative<Answer*>(action); }
};

namespace messages {

using Type = MessageArgument::Type;
constexpr double maxSeconds = 3600.0;        // of one vibration
constexpr double maxAheadSeconds = 86'400.0; // a day's programme can be sent in advance
constexpr int maxPlaces = 64, maxPulses = 64;

/// An argument's name means the same in every message.
inline constexpr MessageArgument frequency{"frequency_hz",         Type::number, limits::slowestToneHz,
                                           limits::maxFrequencyHz, "205",        "of the tone"};
inline constexpr MessageArgument level{"level", Type::number, 0.0,
                                       1.0,     "0.5",        "peak at gain 1, in shares of full scale"};
inline constexpr MessageArgument place{"place", Type::place, 0.0,
                                       0.0,     "",          "where; left out: the middle of the field"};
inline constexpr MessageArgument law{
    "law",    Type::text,
    0.0,      0.0,
    "layout", "how it is spread: `layout` (as hits are), by a [law](panning.md#laws), `equal`, `alone`"};

inline constexpr MessageArgument part{
    "part", Type::text,
    0.0,    0.0,
    "",     "of the body ([names](space.md#parts)), on whose actuators alone it is felt; left out: all"};

inline constexpr std::array timeArguments{
    MessageArgument{"at", Type::number, 0.0, limits::maxTimeNs * 1e-9, "now",
                    "session time in s, or `now`; felt the output latency later"},
    MessageArgument{"in", Type::number, 0.0, maxAheadSeconds, "0", "seconds from now, instead of `at`"}};

inline constexpr std::array strike{
    MessageArgument{"material", Type::text, 0.0, 0.0, "", "of the scene, for its frequency and decay"},
    MessageArgument{"frequency_hz", Type::number, 1.0, limits::maxFrequencyHz, "",
                    "instead of a material; below 5 with a decay of at least 1"},
    MessageArgument{"decay_per_s", Type::number, 0.0, limits::maxDecayPerSecond, "",
                    "with it: this or `seconds`"},
    place,
    level,
    MessageArgument{"seconds", Type::number, 0.0, maxSeconds, "0",
                    "after which it is cut, at a zero crossing; 0: when it has decayed"},
    law,
    part};
inline constexpr std::array pattern{
    MessageArgument{"pattern", Type::text, 0.0, 0.0, "",
                    "one to three actuators and a pulse's ms: `ABA-250`"},
    MessageArgument{"enchanters", Type::text, 0.0, 0.0, "",
                    "instead of it, letters of up to 64 pulses: `ABCDDCBA`"},
    MessageArgument{"pulse_s", Type::number, 0.001, 10.0, "0.25", "length of each of those"},
    MessageArgument{"gap_s", Type::number, 0.0, 10.0, "0.1", "silence between two pulses"},
    frequency,
    level};
inline constexpr std::array phantom{
    place, MessageArgument{"seconds", Type::number, 0.001, maxSeconds, "1", "length"}, law, frequency, level,
    part};
inline constexpr std::array path{
    MessageArgument{"places", Type::places, 0.0, 0.0, "",
                    "2 to 64 of them, joined by straight lines: `AD`, `[[0, 0], [1, 0.5]]`"},
    MessageArgument{"seconds", Type::number, 0.001, maxSeconds, "1", "for all of it, at one speed"},
    MessageArgument{"speed_m_per_s", Type::number, 1e-6, 1e6, "", "instead of `seconds`"},
    MessageArgument{"times_s", Type::numbers, 0.0, maxSeconds, "",
                    "instead of `seconds`: when each place is reached"},
    MessageArgument{"strokes", Type::number, 0.0, 64.0, "0",
                    "so many still vibrations along it, timed as Tactile Brush does; 0: one that moves"},
    MessageArgument{"law", Type::text, 0.0, 0.0, "auto",
                    "as of a strike; `auto` is felt where it is, and equally strong all the way: "
                    "`neighbours` on a row, grid or belt of three or more, else `equal`; `linear`, `log` and "
                    "`log-outer` lag behind (linear: 0.16 where 0.3 is meant)"},
    frequency,
    level,
    part};

inline constexpr std::array clip{
    MessageArgument{
        "file", Type::text, 0.0, 0.0, "",
        "a recording or [haptic file](events.md#haptic-files-of-others), in the folder that the door "
        "reads from"},
    MessageArgument{
        "place", Type::place, 0.0, 0.0, "",
        "where; left out: its own places, or one channel per actuator, or the middle of the field"},
    MessageArgument{"level", Type::number, 0.0, 1.0, "1", "of what is in the file, at gain 1"}, law};

} // namespace messages

MessageDescription::Strikes strikeStrikes, patternStrikes, phantomStrikes, pathStrikes;
MessageDescription::Answer statusAnswer, layoutAnswer, latencyAnswer;

inline constexpr auto messageTable = std::to_array<MessageDescription>({
    {"strike", "a vibration that decays, or is cut", messages::strike, strikeStrikes},
    {"pattern", "pulses, each on one actuator alone", messages::pattern, patternStrikes},
    {"phantom", "a vibration that stays at a place", messages::phantom, phantomStrikes},
    {"path", "a vibration that moves", messages::path, pathStrikes},
    {"clip", "a recording or a haptic file", messages::clip, MessageDescription::Clip{}},
    {"stop",
     "what sounds fades out within 10 ms; what was asked for before and has not begun is forgotten",
     {},
     MessageDescription::Stop{}},
    {"status",
     "answers session time, strikes that wait, bodies, collisions lost, time given up in stalls, and events "
     "dropped",
     {},
     statusAnswer},
    {"layout",
     "answers the law, the field, and the actuators' places in metres of the field",
     {},
     layoutAnswer},
    {"latency",
     "answers the output latency: how long after its time each vibration is felt",
     {},
     latencyAnswer},
});

// Clips come from the input of a message through a callback. This module reads no files: each input (lines,
// OSC) reads them from its own folder.

struct LoadedClip {
    std::vector<ContactRecording> channels; ///< one or more, of one file, equal in rate and length; their
                                            ///< `file` has path and hash
    std::vector<ActuatorPlace> places; ///< places as shares of the field, 0 to 1, one per channel; empty:
                                       ///< the file has no places
};

/// Loads the clip of the name in a message, or returns a one-line error. Called on the input's thread.
using ClipSource = std::function<Result<LoadedClip>(const std::string& name)>;

class MessageValues;

/// The time tag with which a message arrived at an input.
struct MessageTag {
    std::int64_t sessionNs = 0;
    bool isLate = false; ///< set by the router: the time had passed, so the message acted at once
};

/// Routes the messages of any number of inputs. Any thread but the render thread (R).
class MessageRouter {
public:
    /// `session` outlives it.
    explicit MessageRouter(Session& session) noexcept
        : session_{session} {}

    /// Executes a message, completely or not at all; with a tag, at the tag's time, as with `at`. Returns
    /// the answer of a query, a note (an empty name: none), or a one-line error. `clips` loads this input's
    /// clips; empty: it accepts no clips.
    Result<PlainMessage> handle(const PlainMessage& message, MessageTag* tag = nullptr,
                                const ClipSource& clips = {});

private:
    void checkTime(const MessageValues& values, const MessageTag* tag);
    std::vector<CollisionEvent> makeStrikes(const MessageDescription& description,
                                            const MessageValues& values, const ClipSource& clips,
                                            const PhantomPanner& panner, std::string& note);
    std::vector<CollisionEvent> addClip(const MessageValues& values, const ClipSource& clips,
                                        const PhantomPanner& panner, std::string& note);
    std::int64_t resolveTimeNs(const MessageValues& values, MessageTag* tag) const;
    std::int64_t scheduledNs(const MessageValues& values, std::string_view name, std::int64_t timeNs) const;
    void submitStrikes(std::vector<CollisionEvent> strikes, std::int64_t startNs, bool isNow);
    void submitStop(std::int64_t timeNs);
    std::int64_t nowNs() const;

    Session& session_;
    std::mutex mutex_;             // guards the following member
    std::int64_t latestNowNs_ = 0; // time of the newest event requested for "now"; a stop is later, and the
                                   // next such event not earlier
};

// Rate limit for error reports per cause, so that many faulty messages do not flood a log or an input's reply
// line.

/// At most one report per cause in `intervalNs`, and at most `maxCauses` causes in that time; the others are
/// counted. The caller supplies the clock. One thread at a time.
class ErrorRateLimit {
public:
    static constexpr std::size_t maxCauses = 16;

    explicit ErrorRateLimit(std::int64_t intervalNs) noexcept
        : intervalNs_{intervalNs} {}

    /// True if this error is to be reported.
    bool shouldReport(std::string_view reason, std::int64_t nowNs) noexcept {
        const std::uint64_t cause = hashCause(reason);
        ReportedCause* entry = nullptr; // entry of this cause, or a free one
        for (ReportedCause& candidate : reported_) {
            const bool isFree = candidate.untilNs <= nowNs;
            if (!isFree && candidate.cause == cause) return ++suppressed_, false;
            if (isFree) entry = &candidate;
        }
        if (entry == nullptr) return ++suppressed_, false;
        *entry = {cause, nowNs + intervalNs_};
        return true;
    }

    /// Number of errors that were suppressed since the last call.
    std::uint64_t resetSuppressedCount() noexcept { return std::exchange(suppressed_, 0); }

    /// Equal for errors that differ only in what was found, in numbers and in quoted words. Any thread.
    static constexpr std::uint64_t hashCause(std::string_view reason) noexcept {
        std::uint64_t hash = fnv1a({});
        bool isQuoted = false;
        for (const char c : reason.substr(0, reason.find(", found "))) {
            if (c == '"')
                isQuoted = !isQuoted;
            else if (!isQuoted && (c < '0' || c > '9'))
                hash = fnv1a({&c, 1}, hash);
        }
        return hash;
    }

private:
    struct ReportedCause {
        std::uint64_t cause = 0;
        std::int64_t untilNs = INT64_MIN;
    };
    std::int64_t intervalNs_;
    std::array<ReportedCause, maxCauses> reported_{};
    std::uint64_t suppressed_ = 0;
};

/// Requests or withdraws silence. Returns a line if other inputs still request it, or empty. Any thread.
std::string applySilence(MuteRequests& silence, const SilenceControl& control, MuteRequester requester);

} // namespace physvib
