// SPDX-License-Identifier: MIT
// Limits of the files PhysVib reads, with the reason for each value.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib::limits {

constexpr std::size_t maxEventRows = 10'000'000;          // 100 s at 10^5 strikes per second; 1 GB of events
constexpr std::size_t maxEventsFileBytes = 2'000'000'000; // that many rows, usually of 160 bytes
constexpr std::size_t maxLayoutFileBytes = 1'000'000;     // 64 enchanters fill about 10 kB
constexpr std::size_t maxSceneFileBytes = 4'000'000;      // 4096 bodies of two fixtures fill about half of it
constexpr std::size_t maxSessionFileBytes = 64'000'000;   // 100,000 inputs of a hundred bytes, and scenes
constexpr std::size_t maxTakeBodies = 1'000'000;          // of all takes of a session, each checked and built: 250 starts of the largest scene
constexpr std::int64_t maxSessionNs = 1'000'000'000'000'000; // 11.6 days: the most that a number of a file, a double, tells to the nanosecond
constexpr std::size_t maxMaterialsFileBytes = 1'000'000;  // 256 materials fill about 40 kB
constexpr std::size_t maxProtocolFileBytes = 1'000'000;   // a study of many conditions fills a few kB
constexpr std::size_t maxActuatorFileBytes = 100'000;    // a profile fills less than 1 kB
constexpr std::size_t maxCouplingFileBytes = 4'000'000; // four enchanters fill 1 kB per frequency, 64 fill 100 kB
constexpr std::size_t maxSweepFileBytes = 1'000'000;     // a design fills a few kB; a list of 100,000 seeds is a range
constexpr std::size_t maxSweepValues = 4096;              // of a list in it; each is compared with each, and tried before the first render
constexpr std::size_t maxSweepTasks = 10'000'000;         // each leaves a file
constexpr std::size_t maxTableRows = 1'000'000;           // of the three columns that an analysis needs
constexpr std::size_t maxTableCells = 3'000'000;          // 150,000 trials of twenty columns: a thousand participants
constexpr std::size_t maxTableBytes = 64'000'000;         // those, usually of 200 bytes a trial
constexpr std::size_t maxLongTableBytes = 256'000'000;    // read row by row, of which a number and some names stay: a million trials of 200 bytes
constexpr std::size_t maxTableColumns = 256;              // a trial has twenty; an exported matrix one per response
constexpr std::size_t maxConditions = 4096;               // of an analysis: each is looked for in a list
constexpr std::size_t maxLabels = 2048;                   // of stimuli and responses: the patterns of five enchanters are 1240
constexpr std::size_t maxCellBytes = 200'000;             // the longest cell is the calls of a trial: 64 parts of 2000 bytes (CallWords.h), and their levels
constexpr std::int64_t maxRecordingSeconds = 600;         // a contact or a stimulus that long is a mistake
constexpr std::int64_t maxRecordingSamples = 32'000'000;  // of all channels: those seconds of one channel at 48 kHz, 128 MB
constexpr std::size_t maxRecordingFileBytes = 256'000'000; // as many samples of 64 bits
constexpr std::int64_t maxMusicSeconds = 86'400;          // read block by block: a day
constexpr std::size_t maxMusicFileBytes = 64'000'000'000; // a day of two channels of 32 bits at 92 kHz
constexpr std::size_t maxRecordingSets = 1024;            // different ones of a session; each is resampled
constexpr int maxRecordingChannels = 64;                  // as many as there are outputs
constexpr int minRecordingRateHz = 100, maxRecordingRateHz = 768'000; // slow accelerometers; the fastest converters
constexpr std::size_t maxVariables = 16;                  // of a scene; a study has three
constexpr std::size_t maxChoices = 64;                    // of a variable
constexpr std::size_t maxNameBytes = 200;                 // names and labels: one line on a screen
constexpr double leastExtentMetres = 1e-3, mostExtentMetres = 1e6; // of layouts and fields
constexpr double leastFullScaleG = 1e-6, mostFullScaleG = 1e6; // of an enchanter
constexpr double leastQ = 0.05, mostQ = 1000.0;           // of a resonance
constexpr double leastMeasuredHz = 1.0;                   // of actuators and of what is measured on them; the most is Core's
constexpr std::size_t maxJsonDepth = 16;                  // our formats need fourteen levels
constexpr std::size_t maxJsonMarks = 1'000'000, jsonBytesPerMark = 8; // , : [ { of a text, and more by its length: an input has one in 12 bytes

} // namespace physvib::limits
