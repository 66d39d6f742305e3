// SPDX-License-Identifier: GPL-3.0-or-later
// OscReceiver executes OSC packets as messages, inputs and controls; OscClock converts time tags to session
// time; PhoneSensors turns readings of phones into gravity.
#pragma once
#include "Core/Units.h"
#include "Host/Osc/OscPacket.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Session.h"
#include "Live/Sockets/UdpSocket.h"
#include "Scene/Scene.h"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

constexpr std::int64_t oscEpochSeconds = 2'208'988'800; ///< seconds from 1900 to 1970

/// Nanoseconds since 1970. Tags whose highest bit is 0 denote times from 2036 on. Any thread.
std::int64_t unixNsFromTag(OscTag tag) noexcept;
OscTag tagFromUnixNs(std::int64_t unixNs) noexcept;

/// Converts between OSC time tags (the sender's clock) and session time. Estimates the system time at which
/// the session started. Blocks show it only with jitter, so the estimate is held constant: two tags one
/// second apart are one second apart in the session, to the nanosecond. Once the device's clock has drifted
/// from the system's by `slackNs`, the estimate follows at `maxSlewPpm` at most. One thread at a time.
class OscClock {
public:
    static constexpr std::int64_t slackNs = 1'000'000, jumpNs = 20'000'000, settleNs = 1'000'000'000;
    static constexpr std::int64_t maxSlewPpm = 200;

    /// `unixMinusSteadyNs`: system clock minus steady clock.
    void update(const OutputMoment& moment, std::int64_t unixMinusSteadyNs) noexcept;

    bool isReady() const noexcept { return clock_.isReady(); }

    /// The session time of an event at `unixNs`; it is felt later by the output latency and the device's
    /// latency. Only if ready.
    std::int64_t sessionNsFromUnix(std::int64_t unixNs) const noexcept { return unixNs - startUnixNs_; }
    /// The system time at which `sessionNs` is felt. Only if ready.
    std::int64_t outputUnixNs(std::int64_t sessionNs) const noexcept {
        return sessionNs + startUnixNs_ + outputLatencyNs_;
    }
    /// The system time at which `sessionNs` is the current session time. Only if ready.
    std::int64_t unixNsFromSession(std::int64_t sessionNs) const noexcept { return sessionNs + startUnixNs_; }

private:
    SessionClock clock_;
    std::int64_t startUnixNs_ = 0, outputLatencyNs_ = 0; // start of the session, ns since 1970; latency until
                                                         // it is felt
    std::int64_t settlesAtNs_ = 0, updatedAtNs_ = 0;     // of the steady clock
};

/// System clock minus steady clock, now. Any thread but R.
std::int64_t unixMinusSteadyNs() noexcept;

/// A message of a phone's sensor program, the world's gravity (Docs/osc.md): three axes, or one.
struct SensorFormat {
    enum class Part { pull, gravity, motion, x, y, unused };
    std::string_view address; ///< a leading `*` stands for the phone's name
    Part part;
    double metresPerSecond2PerUnit; ///< factor from reading to acceleration on an object in the phone, in
                                    ///< m/s^2; x to the right of its screen, y up
};

// An accelerometer at rest reads the supporting force, upwards; iPhones report the opposite sign, in g.
inline constexpr double androidFactor = -1.0, iPhoneFactor = standardGravity;
inline constexpr std::array sensorFormats{
    SensorFormat{"/accelerometer", SensorFormat::Part::pull, androidFactor},
    SensorFormat{"/accelerometer/X", SensorFormat::Part::x, androidFactor},
    SensorFormat{"/accelerometer/Y", SensorFormat::Part::y, androidFactor},
    SensorFormat{"/accelerometer/Z", SensorFormat::Part::unused, androidFactor},
    SensorFormat{"/accxyz", SensorFormat::Part::pull, iPhoneFactor},
    SensorFormat{"/gyrosc/grav", SensorFormat::Part::gravity, iPhoneFactor},
    SensorFormat{"/gyrosc/accel", SensorFormat::Part::motion, iPhoneFactor},
    SensorFormat{"*/gravity", SensorFormat::Part::gravity, iPhoneFactor},
    SensorFormat{"*/accel", SensorFormat::Part::motion, iPhoneFactor}};

/// The format of that address; null: unknown. Any thread.
const SensorFormat* sensorFormat(std::string_view address) noexcept;

/// One thread at a time.
class PhoneSensors {
public:
    /// Changes below this are tremor of a resting hand: a reading that close to the last used is ignored.
    static constexpr double minChangeMetresPerSecond2 = 0.05; // m/s^2; 0.3 degrees

    /// `phoneAngleRadians`: angle at which the phone is held, counter-clockwise from upright.
    explicit PhoneSensors(double phoneAngleRadians = 0.0) noexcept
        : phoneAngleRadians_{phoneAngleRadians} {}

    /// The new gravity, if it has changed; otherwise none. Or the error.
    Result<std::optional<GravityAction>> read(const SensorFormat& format, const OscMessage& message);

private:
    struct Acceleration {
        double x = 0.0, y = 0.0;
    };
    double phoneAngleRadians_;
    Acceleration gravity_, motion_, lastReported_;
    bool hasReported_ = false;
};

/// Valid addresses are `/physvib/` followed by the name of a message, an input or a control, and the
/// addresses of phone sensor programs.
inline constexpr std::string_view oscPrefix = "/physvib/", oscAnswerPrefix = "/physvib/answer/",
                                  oscHitAddress = "/physvib/hit", oscSilenceAddress = "/physvib/silence",
                                  oscErrorAddress = "/physvib/error";

/// Sender of a message, to which a refusal is sent.
struct OscOrigin {
    UdpSender from;
    std::string address; ///< of the message
};

/// Callbacks into the program that owns the port; called on the port's thread.
struct OscHooks {
    /// applies inputs and controls; returns empty, or the reason of a refusal
    std::function<std::string(const LineInput&, const OscOrigin&)> apply;
    std::function<std::string()> closed; ///< why only silence is accepted; empty: all is; optional
    ClipSource clips{};                  ///< source of clip files; empty: clips are refused
};

/// A message that was not executed.
struct OscRefusal {
    std::string address; ///< as received, printable part only; empty: unreadable
    std::string reason;  ///< one line
};

/// Any thread.
OscRefusal makeRefusal(std::string_view address, std::string_view reason);

/// Counts since the port was opened.
struct OscCounts {
    std::uint64_t packets = 0;
    std::uint64_t malformed = 0; ///< of these: not OSC; nothing in the packet was executed
    std::uint64_t lost = 0;      ///< dropped by the system for lack of buffer space, not counted above
    std::uint64_t messages = 0;
    std::uint64_t refused = 0;  ///< of these: not executed
    std::uint64_t late = 0;     ///< of these: executed at once, because the time of the tag had passed
    std::uint64_t heldBack = 0; ///< replies held back by OscReplyLimiter
    std::string lastError;      ///< the last error; empty: none

    std::uint64_t failures() const noexcept { return malformed + refused; }
};

/// Executes packets of one port. One thread at a time.
class OscReceiver {
public:
    /// Session and messages outlive this object. `phoneAngleRadians`: see PhoneSensors.
    OscReceiver(Session& session, MessageRouter& messages, OscHooks hooks, double phoneAngleRadians = 0.0);

    /// Executes a packet. Replies to queries and to silence, one packet each, are appended to `answers`.
    /// `silences`: number of silence requests before this packet.
    void receive(std::span<const char> bytes, const OscClock& clock, std::vector<std::vector<char>>& answers,
                 std::uint64_t silences = 0, const UdpSender& from = {});

    /// Messages of the last packet that were refused, except replies: two programs that refuse each other's
    /// refusals would never stop.
    const std::vector<OscRefusal>& refusals() const noexcept { return refusals_; }
    void setHeldBackReplies(std::uint64_t replies) noexcept { counts_.heldBack = replies; }
    void addLostPackets(std::uint64_t packets) noexcept { counts_.lost += packets; }
    const OscCounts& counts() const noexcept { return counts_; }

    /// The reply to the query `status`, with the counts.
    PlainMessage status();

private:
    std::string execute(const OscMessage& message, const OscClock& clock,
                        std::vector<std::vector<char>>& answers);
    std::string silence(const Result<SilenceControl>& request, std::vector<std::vector<char>>& answers);
    std::string route(const PlainMessage& plain, OscTag tag, const OscClock& clock,
                      std::vector<std::vector<char>>& answers);
    void refuse(std::string_view address, std::string_view reason);
    void addCounts(PlainMessage& answer) const;

    Session& session_;
    MessageRouter& messages_;
    OscHooks hooks_;
    PhoneSensors sensors_;
    OscCounts counts_;
    std::uint64_t silences_ = 0; // requests so far
    OscOrigin origin_;           // of the message being executed
    std::vector<OscRefusal> refusals_;
};

/// Number of messages in a packet that request silence: an address with our prefix that names silence, unless
/// it is a well-formed `off`. An unreadable packet that contains the word counts as one. Any thread but R.
std::uint64_t countSilenceRequests(std::span<const char> bytes);

} // namespace physvib
