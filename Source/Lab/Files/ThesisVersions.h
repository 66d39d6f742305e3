// SPDX-License-Identifier: MIT
// Built-in protocols with every change of ThesisDeviations.h that a protocol can make, so that they run as
// published: NAME-thesis.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string_view>
#include <vector>

namespace physvib {

/// What follows a built-in protocol's name in that of its version as published.
inline constexpr std::string_view thesisSuffix = "-thesis";

/// Of each built-in protocol that can be changed in this way, in the order of their listing. Built on first
/// use; any thread.
const std::vector<Protocol>& thesisVersions();

} // namespace physvib
