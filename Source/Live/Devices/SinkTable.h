// SPDX-License-Identifier: MIT
// Table of the sinks that can play beside an audio device, one entry each. Output names, lists of choices and
// the first-start dialog are made from it.
#pragma once
#include "Core/PhantomPanner.h"
#include "Live/Session/Sink.h"
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// A connected unit that a sink can play on.
struct SinkPlace {
    std::string where{}, about{}; ///< as in an output name; description for users
    bool isLikely = true;         ///< known to be a unit of this kind, so the first-start dialog offers it
};

struct SinkKind {
    std::string_view name;    ///< as in output names: "BOARD"
    std::string_view title;   ///< for users: "Four-channel board"
    std::string_view about;   ///< tooltip
    std::string_view setting; ///< key under which a program saves the choice
    std::string_view any;     ///< `where` that means the first unit found
    std::string_view other;   ///< what may be typed beside the listed units: "Serial port"; empty: nothing
    int actuators;            ///< number that a unit has
    std::string_view tooMany; ///< why more actuators are not supported; empty: any number is panned onto
                              ///< those of the unit
    bool isMeant; ///< connected units are made for vibration, so the first-start dialog offers them first
    std::vector<SinkPlace> (*places)(); ///< M; queries the system, which takes a while
    std::unique_ptr<Sink> (*make)(const std::string& where, const PhantomPanner& panner);
    bool takesReports = false; ///< a controller that is sent raw reports, beside its ordinary motors
};

/// All entries. Any thread.
std::span<const SinkKind> sinkKinds() noexcept;

/// A requested sink: BOARD:auto.
struct SinkName {
    std::string kind, where;
    bool operator==(const SinkName&) const = default;
};

/// The entry of a name that OutputNames read or that was made from an entry. Any thread.
const SinkKind& kindOf(const SinkName& sink) noexcept;

/// Parses "DEVICE", "KIND:WHERE" or "DEVICE+KIND:WHERE", with up to mostNamedSinks sinks. Without a device,
/// the sinks follow the clock of the null device None.
struct OutputNames {
    std::string device;
    std::vector<SinkName> sinks;

    explicit OutputNames(std::string_view text);
};

/// Empty, or one line if a requested sink has fewer channels than there are actuators.
std::string channelFault(const std::vector<SinkName>& sinks, int channels);

using Sinks = std::vector<std::unique_ptr<Sink>>;

/// Named sinks at a time. A SinkSet has as many places again for recorder, meters and OSC.
constexpr std::size_t mostNamedSinks = SinkSet::maxSinks / 2;

/// Opens all requested sinks for a session with that panner. Returns the first error. Waits for each as long
/// as `keepGoing` returns true; without `keepGoing` it does not wait. M.
std::string openSinks(const std::vector<SinkName>& wanted, const PhantomPanner& panner,
                      const std::function<bool()>& keepGoing, Sinks& opened);

} // namespace physvib
