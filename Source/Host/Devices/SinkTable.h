// SPDX-License-Identifier: GPL-3.0-or-later
// What can be played beside a device, by its name: a row of the table each.
#pragma once
#include "Core/PhantomPanner.h"
#include "Live/Session/SinkSet.h"
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// One that is wanted: BOARD:auto.
struct SinkName {
    std::string kind, where;
};

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

/// All of them, ready, for a session with that panner; or one line. Waits for as long as `goesOn`. M.
std::string openSinks(const std::vector<SinkName>& wanted, const PhantomPanner& panner,
                      const std::function<bool()>& goesOn, Sinks& opened);

} // namespace physvib
