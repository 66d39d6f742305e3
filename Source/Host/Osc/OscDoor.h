// SPDX-License-Identifier: GPL-3.0-or-later
// The door by which packets come in: from addresses and values to messages, inputs and controls, each
// counted.
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

/// Addresses are `/physvib/` and a name of the table of messages, of an input or of a control, and those of
/// sensor programs.
inline constexpr std::string_view oscPrefix = "/physvib/", oscAnswerPrefix = "/physvib/answer/",
                                  oscHitAddress = "/physvib/hit", oscSilenceAddress = "/physvib/silence",
                                  oscErrorAddress = "/physvib/error";

/// Of a message: to whom a refusal goes.
struct OscOrigin {
    OscSender from;
    std::string address; ///< of the message
};

/// What the program does itself with what comes in; called on the port's thread.
struct OscHooks {
    /// inputs and controls; empty, or what is wrong
    std::function<std::string(const LineInput&, const OscOrigin&)> act;
    std::function<std::string()> closed; ///< why nothing but silence is taken now; empty: it is; may be left
                                         ///< out
    ClipSource clips{};                  ///< left out: none are taken
};

/// A message of which nothing was done.
struct OscRefusal {
    std::string address; ///< as it came, as far as it can be printed; empty: it could not be read
    std::string reason;  ///< one line
};

/// Any thread.
OscRefusal refusalOf(std::string_view address, std::string_view reason);

struct OscCounts {
    std::uint64_t packets = 0;
    std::uint64_t bad = 0;  ///< of these: not OSC, and nothing in it was done
    std::uint64_t lost = 0; ///< that the system had no room for, beside these
    std::uint64_t messages = 0;
    std::uint64_t refused = 0; ///< of these: and nothing of it was done
    std::uint64_t late = 0;    ///< of these: done at once, since the time of their tag was over
    std::uint64_t held = 0;    ///< replies that were too many to be sent
    std::string fault;         ///< the last that was wrong; empty: none

    std::uint64_t wrong() const noexcept { return bad + refused; }
};

/// One thread at a time.
class OscDoor {
public:
    /// Both outlive it. `turnRadians`: see PhoneSensors.
    OscDoor(Session& session, MessageRouter& messages, OscHooks hooks, double turnRadians = 0.0);

    /// Does what is in a packet; answers of queries and of silence, each a packet, go to the end of
    /// `answers`. `silences`: how many messages before this packet have asked for silence.
    void take(std::span<const char> bytes, const OscClock& clock, std::vector<std::vector<char>>& answers,
              std::uint64_t silences = 0, const OscSender& from = {});

    /// What was refused of the last packet, but for what only answers: two programs that refuse each other's
    /// refusals never end.
    const std::vector<OscRefusal>& refusals() const noexcept { return refusals_; }
    void holdBack(std::uint64_t replies) noexcept { counts_.held = replies; }
    void lose(std::uint64_t packets) noexcept { counts_.lost += packets; }
    const OscCounts& counts() const noexcept { return counts_; }

    /// The answer of the query `status`, with the counts.
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
    std::uint64_t silences_ = 0; // asked for so far
    OscOrigin origin_;           // of what is done now
    std::vector<OscRefusal> refusals_;
};

/// How many of a packet's messages silence: an address of ours with silence in it, and not off in its right
/// form. A packet that cannot be read is one if the word stands in it. Any thread but R.
std::uint64_t silencesIn(std::span<const char> bytes);

} // namespace physvib
