// SPDX-License-Identifier: MIT
// Size limits of study files, with the reason for each value.
#pragma once
#include <cstddef>

namespace physvib::limits {

constexpr std::size_t maxProtocolFileBytes = 1'000'000; // a protocol with many conditions has a few kB
constexpr std::size_t maxCouplingFileBytes = 4'000'000; // four actuators need 1 kB per frequency, 64 need 100
                                                        // kB
constexpr std::size_t maxConditions = 4096;             // per analysis; they are searched linearly
constexpr std::size_t maxLabels = 2048; // stimuli and responses; five actuators have 1240 patterns

} // namespace physvib::limits
