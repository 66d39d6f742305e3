// SPDX-License-Identifier: MIT
// Limits of the files PhysVib reads, with the reason for each value.
#pragma once
#include <cstddef>

namespace physvib::limits {

constexpr std::size_t maxEventRows = 10'000'000;          // 100 s at 10^5 strikes per second; 1 GB of events
constexpr std::size_t maxEventsFileBytes = 2'000'000'000; // that many rows, usually of 160 bytes
constexpr std::size_t maxLayoutFileBytes = 1'000'000;     // 64 enchanters fill about 10 kB
constexpr std::size_t maxSceneFileBytes = 4'000'000;      // 4096 bodies of two fixtures fill about half of it
constexpr std::size_t maxSessionFileBytes = 64'000'000;   // 100,000 inputs of a hundred bytes, and scenes
constexpr std::size_t maxMaterialsFileBytes = 1'000'000;  // 256 materials fill about 40 kB
constexpr std::size_t maxProtocolFileBytes = 1'000'000;   // a study of many conditions fills a few kB
constexpr std::size_t maxActuatorFileBytes = 100'000;    // a profile fills less than 1 kB
constexpr std::size_t maxCouplingFileBytes = 4'000'000; // four enchanters fill 1 kB per frequency, 64 fill 100 kB
constexpr std::size_t maxTableRows = 1'000'000;           // a thousand participants of a thousand trials
constexpr std::size_t maxTableBytes = 400'000'000;        // that many rows of a study, usually of 200 bytes
constexpr std::size_t maxTableColumns = 256;              // a trial has twenty; an exported matrix one per response
constexpr std::size_t maxCellBytes = 2000;                // the longest cell is the call that renders a stimulus
constexpr std::size_t maxVariables = 16;                  // of a scene; a study has three
constexpr std::size_t maxChoices = 64;                    // of a variable
constexpr std::size_t maxNameBytes = 200;                 // names and labels: one line on a screen
constexpr double leastMeasuredHz = 1.0;                   // of actuators and of what is measured on them; the most is Core's
constexpr std::size_t maxJsonDepth = 16;                  // our formats need fourteen levels

} // namespace physvib::limits
