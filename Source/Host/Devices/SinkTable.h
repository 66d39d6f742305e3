// SPDX-License-Identifier: GPL-3.0-or-later
// What can be played beside a device: a row of the table each. Names, lists of choices and the first start
// are made from it.
#pragma once
#include "Core/PhantomPanner.h"
#include "Live/Session/SinkSet.h"
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Something that is there to be played on.
struct SinkPlace {
    std::string where{}, about{}; ///< as a name says it; for people
    bool isLikely = true;         ///< it can be told that it is one: a first start offers it
};

struct SinkKind {
    std::string_view name;     ///< as names have it: "BOARD"
    std::string_view title;    ///< for people: "Four-channel board"
    std::string_view about;    ///< what a tooltip says
    std::string_view setting;  ///< by which a program keeps what was chosen
    std::string_view any;      ///< where: the first that is there
    std::string_view anyWords; ///< the same for people
    std::string_view other; ///< what may be typed beside those that are listed: "Serial port"; empty: nothing
    int actuators;          ///< that one has
    std::string_view tooMany; ///< why no more are played on it; empty: any number is spread over what it has
    bool isMeant;             ///< whoever plugs one in means it: a first start offers it first
    std::vector<SinkPlace> (*places)(); ///< M; asks the system, which takes a while
    /// `isAwaited`: Sink::awaitReady is called before the session is prepared; else it assumes how early it
    /// has to know what it plays.
    std::unique_ptr<Sink> (*make)(const std::string& where, const PhantomPanner& panner, bool isAwaited);
};

/// All rows. Any thread.
std::span<const SinkKind> sinkKinds() noexcept;

/// One that is wanted: BOARD:auto.
struct SinkName {
    std::string kind, where;
    bool operator==(const SinkName&) const = default;
};

/// The row of a name that was read by OutputNames, or made of a row. Any thread.
const SinkKind& kindOf(const SinkName& sink) noexcept;

/// "DEVICE", "KIND:WHERE" or "DEVICE+KIND:WHERE", and up to mostNamedSinks of them. Beside no device, they
/// follow a clock: None.
struct OutputNames {
    std::string device;
    std::vector<SinkName> sinks;

    explicit OutputNames(std::string_view text);
};

/// Empty, or one line: what is wanted has fewer channels than there are enchanters.
std::string channelFault(const std::vector<SinkName>& sinks, int channels);

using Sinks = std::vector<std::unique_ptr<Sink>>;

/// At once; a SinkSet has as much room again for what programs attach themselves (recorder, meters, OSC).
constexpr std::size_t mostNamedSinks = SinkSet::most / 2;

/// All of them, for a session with that panner; or one line. Each is ready, and waited for as long as
/// `goesOn`; without it each comes when it comes. M.
std::string openSinks(const std::vector<SinkName>& wanted, const PhantomPanner& panner,
                      const std::function<bool()>& goesOn, Sinks& opened);

} // namespace physvib
