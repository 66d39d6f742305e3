// SPDX-License-Identifier: MIT
// How a figure in g comes about, told wherever one is printed: samples, full scale, actuator.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string>
#include <string_view>

namespace physvib {

/// A sentence with the full scale of each layout of the protocol, calibrated or assumed. `samples`: "as
/// rendered". A full scale counts as calibrated if the layout's actuator profile states the same. Message
/// thread only.
std::string levelChain(const Protocol& protocol, std::string_view samples);

} // namespace physvib
