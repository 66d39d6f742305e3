// SPDX-License-Identifier: MIT
// Limits of the files PhysVib reads, with the reason for each value.
#pragma once
#include <cstddef>

namespace physvib::limits {

constexpr std::size_t maxEventRows = 10'000'000;          // 100 s at 10^5 strikes per second; 1 GB of events
constexpr std::size_t maxEventsFileBytes = 2'000'000'000; // that many rows, usually of 160 bytes
constexpr std::size_t maxLayoutFileBytes = 1'000'000;     // 64 enchanters fill about 10 kB
constexpr std::size_t maxNameBytes = 200;                 // names and labels: one line on a screen
constexpr std::size_t maxJsonDepth = 16;                  // our formats need four levels

} // namespace physvib::limits
