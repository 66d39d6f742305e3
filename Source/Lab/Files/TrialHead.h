// SPDX-License-Identifier: MIT
// First line of a trial file as keys and values.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// version, protocol, hash, seed, participant ...
using TrialHead = std::map<std::string, std::string>;

/// Parses the first comment line that names this program; empty if there is none. Any thread.
TrialHead trialHeadOf(const std::vector<std::string>& comments);

} // namespace physvib
