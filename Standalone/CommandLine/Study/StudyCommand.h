// SPDX-License-Identifier: GPL-3.0-or-later
// Options of `physvib study`, which lists, checks and runs studies.
#pragma once
#include "Calls/RenderJob.h"
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

/// Command-line options.
struct StudyOptions {
    std::string protocol;    ///< name of a built-in protocol, or path of a protocol file
    std::string observer;    ///< name of the simulated observer
    std::string participant; ///< code; empty: P and the number
    int number = 1;          ///< of the first participant: selects the row of the Latin squares
    int participants = 1;
    std::string folder = ".";
    RecordedSounds sounds;           ///< replace the protocol's recordings of that frequency
    std::vector<std::string> trials; ///< levels: trial files of the adjustments
    std::string levelsPath;          ///< levels: output file
    std::string pagePath;            ///< check: HTML output; empty: none
    double paceSeconds = 0.0;        ///< delay per trial, to watch or interrupt it
};

/// Declares the subcommands of `command`.
void declareStudy(OptionTable& command, StudyOptions& options);

/// Runs the parsed `command`. Returns an exit code.
int runStudy(const OptionTable& command, const StudyOptions& options);

} // namespace physvib
