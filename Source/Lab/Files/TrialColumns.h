// SPDX-License-Identifier: MIT
// Column names of trial files in their order, and fixed words in their cells.
#pragma once
#include <algorithm>
#include <array>
#include <string_view>

namespace physvib::trialColumns {

constexpr std::string_view observer = "observer", phase = "phase", task = "task", render = "render";
constexpr std::string_view training = "training", simulated = "simulated";

/// followed by the study's rating scales
inline constexpr std::array<std::string_view, 21> names{
    "participant", "observer", "condition", "session",       "phase",      "trial",    "task",
    "stimulus",    "parts",    "response",  "target_column", "target_row", "x",        "y",
    "choice",      "value",    "correct",   "replays",       "response_s", "level_db", "render"};

/// Only in protocols with a QUEST+ session, after the scales: the prior before the first trial.
constexpr std::string_view quest = "quest";

/// Only in protocols with staircases that are mixed: which one the trial is of.
constexpr std::string_view staircase = "staircase";

/// Measured values of each trial, after those. Files that older versions began without them stay without
/// them.
constexpr std::string_view peakG = "peak_g", rmsG = "rms_g", exposure = "a8_m_per_s2";
inline constexpr std::array<std::string_view, 3> measured{peakG, rmsG, exposure};

/// Settings of the apparatus. Files that older versions began without them stay without them.
constexpr std::string_view limiterDb = "limiter_db", masterDb = "master_db", noiseDb = "noise_db",
                           device = "device", version = "version";
inline constexpr std::array<std::string_view, 5> apparatus{limiterDb, masterDb, noiseDb, device, version};
constexpr std::string_view noNoise = "off"; ///< cell of noise_db without noise

/// What of the trial left, the last columns; older files stay without them. `left`: 1 if every part left as
/// it was planned, 0 if one did not, empty if nothing is known. `again`: plays that did not leave and were
/// repeated.
constexpr std::string_view left = "left", again = "again";
inline constexpr std::array<std::string_view, 2> receipts{left, again};

constexpr bool isReceipt(std::string_view name) {
    return std::ranges::find(receipts, name) != receipts.end();
}
constexpr bool isMeasured(std::string_view name) {
    return std::ranges::find(measured, name) != measured.end();
}
constexpr bool isApparatus(std::string_view name) {
    return std::ranges::find(apparatus, name) != apparatus.end();
}
constexpr bool has(std::string_view name) {
    return name == quest || name == staircase || isMeasured(name) || isApparatus(name) || isReceipt(name) ||
           std::ranges::find(names, name) != names.end();
}

} // namespace physvib::trialColumns
