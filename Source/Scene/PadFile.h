// SPDX-License-Identifier: MIT
// Profiles of game controllers as JSON: properties of their rumble motors, and the source of the figures.
#pragma once
#include "Core/Pads/PadMotors.h"
#include "Io/Result.h"
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

} // namespace physvib
