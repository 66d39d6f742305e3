// SPDX-License-Identifier: MIT
// Limits of scene, layout, event list, session and actuator files, each with its reason.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib::limits {

constexpr std::size_t maxEventRows = 10'000'000;          // 100 s at 10^5 events per second; 1 GB of events
constexpr std::size_t maxEventsFileBytes = 2'000'000'000; // that many rows, usually of 160 bytes
constexpr std::size_t maxLayoutFileBytes = 1'000'000;     // 64 actuators need about 10 kB
constexpr std::size_t maxSceneFileBytes = 4'000'000;      // 4096 bodies of two fixtures fill about half of it
constexpr std::size_t maxSessionFileBytes = 64'000'000;   // 100,000 inputs of a hundred bytes, and scenes
constexpr std::size_t maxTakeBodies = 1'000'000; // of all scene runs of a session, each checked and built:
                                                 // 250 starts of the largest scene
constexpr std::int64_t maxSessionNs = 1'000'000'000'000'000; // 11.6 days: the largest time that a double in a
                                                             // file resolves to the nanosecond
constexpr std::size_t maxMaterialsFileBytes = 1'000'000;     // 256 materials fill about 40 kB
constexpr std::size_t maxActuatorFileBytes = 100'000;        // a profile fills less than 1 kB
constexpr std::size_t maxPadFileBytes = 100'000;             // as of an actuator
constexpr std::size_t maxRecordingSets = 1024;               // distinct sets of a session; each is resampled
constexpr std::size_t maxVariables = 16;                     // of a scene; a study has three
constexpr std::size_t maxChoices = 64;                       // of a variable
constexpr double leastExtentMetres = 1e-3, mostExtentMetres = 1e6; // of layouts and fields
constexpr double leastFullScaleG = 1e-6, mostFullScaleG = 1e6;     // of an enchanter
constexpr double leastQ = 0.05, mostQ = 1000.0;                    // of a resonance
constexpr double leastMeasuredHz = 1.0; // of actuators and of what is measured on them; the most is Core's

} // namespace physvib::limits
