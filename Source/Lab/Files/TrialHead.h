// SPDX-License-Identifier: MIT
// A trial file's first line, key by key.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// version, protocol, hash, seed, participant ...
using TrialHead = std::map<std::string, std::string>;

/// Of a table's comments: the first line that names this program; empty if there is none. Any thread.
TrialHead trialHeadOf(const std::vector<std::string>& comments);

} // namespace physvib
