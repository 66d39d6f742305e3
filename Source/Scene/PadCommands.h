// SPDX-License-Identifier: MIT
// Computes the motor commands that a game controller would get for a render, as a table.
#pragma once
#include "Core/Pads/PadMotors.h"
#include "Core/RenderControl.h"
#include "Io/Provenance.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// All commands that differ from the one before, from 0 to `endNs`, where motors are at rest. `events` use
/// `panner` and its changes in `controls`; of other controls only stopAll matters. `lost`: events for which
/// there was no room. Any thread.
std::vector<PadCommand> padCommands(const PadLaw& law, std::span<const CollisionEvent> events,
                                    std::span<const RenderControl> controls, const PhantomPanner& panner,
                                    std::int64_t endNs, std::uint64_t* lost = nullptr);

/// `time_s,low,high`, a line per command; times as in event lists, commands from 0 to 1.
std::string motorsCsv(const std::vector<PadCommand>& commands, const Provenance& provenance);

} // namespace physvib
