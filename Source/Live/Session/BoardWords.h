// SPDX-License-Identifier: MIT
// What a link and its board have done, in words.
#pragma once
#include "Live/Session/BoardLink.h"
#include "Live/Session/Sink.h"
#include <functional>
#include <string>

namespace physvib {

/// Of a board that is wanted at `port`, and is told strikes so long before they are felt. Any thread, as what
/// follows.
SinkState sinkStateOf(const BoardLinkStatus& board, const std::string& port, double latencySeconds);

/// Lines on what was sent and played since `before`, as soon as the board has told it, or a moment later.
std::string boardSummary(const BoardLink& link, const wire::Telemetry& before,
                         const std::function<bool()>& goesOn);

} // namespace physvib
