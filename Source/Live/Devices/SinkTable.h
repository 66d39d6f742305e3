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
struct SinkUnit {
    std::string address{}, label{}; ///< as in an output name; a description for users
    bool isLikely = true;           ///< known to be a unit of this kind, so the first-start dialog offers it
};

/// An entry of the table.
struct SinkKind {
    std::string_view name;       ///< as in output names: "BOARD"
    std::string_view title;      ///< for users: "Four-channel board"
    std::string_view tooltip;    ///< for users
    std::string_view settingKey; ///< key under which a program saves the choice
    std::string_view anyAddress; ///< `address` that means the first unit found
    std::string_view otherTitle; ///< what may be typed beside the listed units: "Serial port"; empty: nothing
    int actuators;               ///< number of actuators that a unit has
    std::string_view tooManyActuatorsError; ///< why more actuators are not supported; empty: any number is
                                            ///< panned onto those of the unit
    bool isPreferred; ///< connected units are made for vibration, so the first-start dialog offers them first
    std::vector<SinkUnit> (*listUnits)(); ///< message thread (M); queries the system for a while
    std::unique_ptr<Sink> (*makeSink)(const std::string& address, const PhantomPanner& panner);
    bool acceptsRawReports = false; ///< a controller that gets raw HID reports, not motor commands
};

/// All entries, in the order of lists for users. Any thread.
std::span<const SinkKind> sinkKinds() noexcept;

/// A requested sink, such as BOARD:auto.
struct SinkName {
    std::string kind, address;
    bool operator==(const SinkName&) const = default;
};

/// The entry of that kind, which must exist: OutputNames makes only such names. Any thread.
const SinkKind& findSinkKind(const SinkName& sink) noexcept;

/// Parses "DEVICE", "KIND:ADDRESS" or "DEVICE+KIND:ADDRESS", with up to maxNamedSinks sinks. Without a
/// device, the sinks follow the clock of the null device None.
struct OutputNames {
    std::string device;
    std::vector<SinkName> sinks;

    explicit OutputNames(std::string_view text);
};

/// Empty, or one line if a requested sink has fewer channels than there are actuators.
std::string channelCountError(const std::vector<SinkName>& sinks, int channels);

using Sinks = std::vector<std::unique_ptr<Sink>>;

/// Most named sinks at once: half of a SinkSet, whose other half is for recorder, meters and OSC.
constexpr std::size_t maxNamedSinks = SinkSet::maxSinks / 2;

/// Opens all requested sinks for a session with that panner. Returns the first error. Waits for each as long
/// as `keepGoing` returns true; without `keepGoing` it does not wait. M.
std::string openSinks(const std::vector<SinkName>& names, const PhantomPanner& panner,
                      const std::function<bool()>& keepGoing, Sinks& opened);

} // namespace physvib
