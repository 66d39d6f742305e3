// SPDX-License-Identifier: MIT
// Limits of the files of studies, with the reason for each value.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib::limits {

constexpr std::size_t maxProtocolFileBytes = 1'000'000; // a study of many conditions fills a few kB
constexpr std::size_t maxCouplingFileBytes = 4'000'000; // four enchanters fill 1 kB per frequency, 64 fill
                                                        // 100 kB
constexpr std::size_t maxSweepFileBytes = 1'000'000; // a design fills a few kB; a list of 100,000 seeds is a
                                                     // range
constexpr std::size_t maxSweepValues = 4096; // of a list in it; each is compared with each, and tried before
                                             // the first render
constexpr std::size_t maxSweepTasks = 10'000'000; // each leaves a file
constexpr std::size_t maxConditions = 4096;       // of an analysis: each is looked for in a list
constexpr std::size_t maxLabels = 2048; // of stimuli and responses: the patterns of five enchanters are 1240

} // namespace physvib::limits
