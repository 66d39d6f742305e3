// SPDX-License-Identifier: MIT
// Texts about a board link: its state for display, and a summary after playing.
#pragma once
#include "Live/Session/BoardLink.h"
#include "Live/Session/Sink.h"
#include <functional>
#include <string>

namespace physvib {

/// State of a board that is wanted at `port` and gets events `latencySeconds` before they are felt. Any
/// thread, as the next function.
SinkState sinkStateOf(const BoardLinkStatus& board, const std::string& port, double latencySeconds);

/// Lines on what was sent and played since `before`. Waits briefly for newer telemetry.
std::string boardSummary(const BoardLink& link, const wire::Telemetry& before,
                         const std::function<bool()>& keepGoing);

} // namespace physvib
