// SPDX-License-Identifier: GPL-3.0-or-later
// Executes received OSC packets: turns addresses and values into messages, inputs and controls, and counts
// them.
#pragma once
#include "Host/Osc/OscClock.h"
#include "Host/Osc/OscSocket.h"
#include "Host/Osc/PhoneSensors.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/Session.h"
#include <functional>
#include <string>
#include <vector>

namespace physvib {

/// Valid addresses are `/physvib/` followed by the name of a message, an input or a control, and the
/// addresses of phone sensor programs.
inline constexpr std::string_view oscPrefix = "/physvib/", oscAnswerPrefix = "/physvib/answer/",
                                  oscHitAddress = "/physvib/hit", oscSilenceAddress = "/physvib/silence",
                                  oscErrorAddress = "/physvib/error";

/// Sender of a message, to which a refusal is sent.
struct OscOrigin {
    OscSender from;
    std::string address; ///< of the message
};

/// Callbacks into the program that owns the port; called on the port's thread.
struct OscHooks {
    /// applies inputs and controls; returns empty, or the reason of a refusal
    std::function<std::string(const LineInput&, const OscOrigin&)> act;
    std::function<std::string()> closed; ///< returns why only silence is accepted now; empty: all is;
                                         ///< optional
    ClipSource clips{};                  ///< source of clip files; empty: clips are refused
};

/// A message that was not executed.
struct OscRefusal {
    std::string address; ///< as received, printable part only; empty: unreadable
    std::string reason;  ///< one line
};

/// Any thread.
OscRefusal refusalOf(std::string_view address, std::string_view reason);

/// Counts since the port was opened.
struct OscCounts {
    std::uint64_t packets = 0;
    std::uint64_t bad = 0;  ///< of these: not OSC; nothing in the packet was executed
    std::uint64_t lost = 0; ///< dropped by the system for lack of buffer space, not counted above
    std::uint64_t messages = 0;
    std::uint64_t refused = 0; ///< of these: not executed
    std::uint64_t late = 0;    ///< of these: executed at once, because the time of the tag had passed
    std::uint64_t held = 0;    ///< replies held back by OscReplies
    std::string fault;         ///< the last error; empty: none

    std::uint64_t wrong() const noexcept { return bad + refused; }
};

/// Executes packets of one port. One thread at a time.
class OscDoor {
public:
    /// Session and messages outlive this object. `turnRadians`: see PhoneSensors.
    OscDoor(Session& session, MessageRouter& messages, OscHooks hooks, double turnRadians = 0.0);

    /// Executes a packet. Replies to queries and to silence, one packet each, are appended to `answers`.
    /// `silences`: number of silence requests before this packet.
    void take(std::span<const char> bytes, const OscClock& clock, std::vector<std::vector<char>>& answers,
              std::uint64_t silences = 0, const OscSender& from = {});

    /// Messages of the last packet that were refused, except replies: two programs that refuse each other's
    /// refusals would never stop.
    const std::vector<OscRefusal>& refusals() const noexcept { return refusals_; }
    void holdBack(std::uint64_t replies) noexcept { counts_.held = replies; }
    void lose(std::uint64_t packets) noexcept { counts_.lost += packets; }
    const OscCounts& counts() const noexcept { return counts_; }

    /// The reply to the query `status`, with the counts.
    PlainMessage status();

private:
    std::string act(const OscMessage& message, const OscClock& clock,
                    std::vector<std::vector<char>>& answers);
    std::string actPlain(const PlainMessage& plain);
    std::string silence(const Result<SilenceControl>& asked, std::vector<std::vector<char>>& answers);
    std::string turn(const SensorFormat& format, const OscMessage& message);
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
std::uint64_t silencesIn(std::span<const char> bytes);

} // namespace physvib
