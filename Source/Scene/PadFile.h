// SPDX-License-Identifier: MIT
// Profiles of game controllers as JSON: properties of their rumble motors; and the commands that the motors
// would get for a render, as a table.
#pragma once
#include "Core/Pads/PadMotors.h"
#include "Core/RenderControl.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// The version of the format that is written, and the newest that is read.
constexpr int padFormatVersion = 1;

struct PadProfile {
    std::string name;
    std::string description;
    std::string source; ///< source of the figures
    PadModel law;
    bool operator==(const PadProfile&) const = default;
};

/// The profile in `text`; or, for the first error, one line `name: low.half: expected a number from ...`.
/// Every field is required; unknown and repeated fields are errors. Any thread.
Result<PadProfile> readPad(std::string_view text, std::string_view name);

/// `profile` as JSON; readPad restores it bit for bit. Any thread.
std::string padJson(const PadProfile& profile);

/// The profiles that come with PhysVib, in listing order. Built on first use; any thread.
const std::vector<PadProfile>& builtInPads();

/// A built-in profile by its name, else that of the file (NAME.json, or a path). Message thread only.
Result<PadProfile> findPad(const std::string& nameOrPath);

/// The motor commands from 0 to `endNs`, where the motors stop, without repetitions. `events` are panned by
/// `panner` and its changes in `controls`; of other controls only stopAll has an effect. `drops` gets the
/// number of events that were dropped because too many sounded at once. Any thread.
std::vector<PadCommand> padCommands(const PadModel& law, std::span<const CollisionEvent> events,
                                    std::span<const RenderControl> controls, const PhantomPanner& panner,
                                    std::int64_t endNs, std::uint64_t* drops = nullptr);

/// The commands as CSV `time_s,low,high`; times as in event lists, commands from 0 to 1. Any thread.
std::string motorsCsv(const std::vector<PadCommand>& commands, const Provenance& provenance);

} // namespace physvib
