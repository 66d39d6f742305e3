// SPDX-License-Identifier: MIT
// Limits of texts, tables and sound files that are read, each with its reason.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib::limits {

constexpr std::size_t maxTableRows = 1'000'000;   // for the three columns that an analysis needs
constexpr std::size_t maxTableCells = 3'000'000;  // 150,000 trials of twenty columns: a thousand participants
constexpr std::size_t maxTableBytes = 64'000'000; // those cells, usually 200 bytes a trial
constexpr std::size_t maxTableColumns = 256;      // a trial has twenty; an exported matrix one per response
constexpr std::size_t maxCellBytes = 200'000; // the longest cell has the presentations of a trial: 64 parts
                                              // of 2000 bytes (Protocol.h), and their levels
constexpr std::int64_t maxRecordingSeconds = 600;        // a longer contact or stimulus is a mistake
constexpr std::int64_t maxRecordingSamples = 32'000'000; // of all channels: one channel of that length at 48
                                                         // kHz, 128 MB
constexpr std::size_t maxRecordingFileBytes = 256'000'000; // as many samples of 64 bits
constexpr std::int64_t maxMusicSeconds = 86'400;           // read block by block: a day
constexpr std::size_t maxMusicFileBytes = 64'000'000'000;  // a day of two channels of 32 bits at 92 kHz
constexpr int maxRecordingChannels = 64;                   // the maximum number of outputs
// slow accelerometers; the fastest converters
constexpr int minRecordingRateHz = 100, maxRecordingRateHz = 768'000;
constexpr std::size_t maxNameBytes = 200; // names and labels: one line on a screen
constexpr std::size_t maxJsonDepth = 16;  // our formats need fourteen levels
// the characters , : [ {, plus a number proportional to the length: an input has one per 12 bytes
constexpr std::size_t maxJsonMarks = 1'000'000, jsonBytesPerMark = 8;

} // namespace physvib::limits
