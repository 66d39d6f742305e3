// SPDX-License-Identifier: MIT
// Profiles of game controllers as JSON: properties of their rumble motors; and motor commands of a render.
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
    PadLaw law;
    bool operator==(const PadProfile&) const = default;
};

/// The profile in `text`; or, for the first error, one line `name: low.half: expected a number from ...`.
/// Every field is required; unknown and repeated fields are errors. Any thread.
Result<PadProfile> readPad(std::string_view text, std::string_view name);

/// `profile` as JSON; readPad restores it bit for bit. Any thread.
std::string padJson(const PadProfile& profile);

/// The profiles that come with PhysVib, in listing order. Built on first use; any thread.
const std::vector<PadProfile>& builtInPads();

/// A built-in profile by its name, else that of the file (NAME.json, or a path). M only.
Result<PadProfile> findPad(const std::string& nameOrPath);

// Computes the motor commands that a game controller would get for a render, as a table.

/// All commands that differ from the one before, from 0 to `endNs`, where motors are at rest. `events` use
/// `panner` and its changes in `controls`; of other controls only stopAll matters. `lost`: events for which
/// there was no room. Any thread.
std::vector<PadCommand> padCommands(const PadLaw& law, std::span<const CollisionEvent> events,
                                    std::span<const RenderControl> controls, const PhantomPanner& panner,
                                    std::int64_t endNs, std::uint64_t* lost = nullptr);

/// `time_s,low,high`, a line per command; times as in event lists, commands from 0 to 1.
std::string motorsCsv(const std::vector<PadCommand>& commands, const Provenance& provenance);

} // namespace physvib
