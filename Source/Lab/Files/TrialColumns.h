// SPDX-License-Identifier: MIT
// The names in a trial file: its columns in their order, and the words in them.
#pragma once
#include <algorithm>
#include <array>
#include <string_view>

namespace physvib::trialColumns {

constexpr std::string_view observer = "observer", phase = "phase", task = "task", render = "render";
constexpr std::string_view training = "training", simulated = "simulated";

/// A study's rating scales follow.
inline constexpr std::array<std::string_view, 21> names{
    "participant", "observer", "condition", "session",       "phase",      "trial",    "task",
    "stimulus",    "parts",    "response",  "target_column", "target_row", "x",        "y",
    "choice",      "value",    "correct",   "replays",       "response_s", "level_db", "render"};

/// Of protocols with a session by QUEST+, behind the scales: what was thought possible before the first
/// trial.
constexpr std::string_view quest = "quest";

/// What was measured where the trial was felt, the last columns: files that were begun without them go on
/// without them.
constexpr std::string_view peakG = "peak_g", rmsG = "rms_g", exposure = "a8_m_per_s2";
inline constexpr std::array<std::string_view, 3> measured{peakG, rmsG, exposure};

/// With what it was felt, behind those: files that were begun before there were any go on without them.
constexpr std::string_view limiterDb = "limiter_db", masterDb = "master_db", noiseDb = "noise_db",
                           device = "device", version = "version";
inline constexpr std::array<std::string_view, 5> apparatus{limiterDb, masterDb, noiseDb, device, version};
constexpr std::string_view noNoise = "off"; ///< instead of noise_db

constexpr bool isMeasured(std::string_view name) {
    return std::ranges::find(measured, name) != measured.end();
}
constexpr bool isApparatus(std::string_view name) {
    return std::ranges::find(apparatus, name) != apparatus.end();
}
constexpr bool has(std::string_view name) {
    return name == quest || isMeasured(name) || isApparatus(name) ||
           std::ranges::find(names, name) != names.end();
}

} // namespace physvib::trialColumns
