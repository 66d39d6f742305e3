// SPDX-License-Identifier: MIT
// Versions NAME-thesis of the built-in protocols, with all applicable changes of ThesisDeviations.h, so that
// they run as published.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string_view>
#include <vector>

namespace physvib {

/// Suffix of the names of these versions.
inline constexpr std::string_view thesisSuffix = "-thesis";

/// One version per built-in protocol with an applicable change, in listing order. Created on first use; any
/// thread.
const std::vector<Protocol>& thesisVersions();

} // namespace physvib
