// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib study`: protocols, and studies run without a window.
#pragma once
#include "Calls/RenderJob.h"
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct StudyOptions {
    std::string protocol;    ///< a built-in one's name or the path of a protocol file
    std::string observer;    ///< who answers
    std::string participant; ///< code; empty: P and the number
    int number = 1;          ///< of the first participant: the row of the Latin squares
    int participants = 1;
    std::string folder = ".";
    RecordedSounds sounds;           ///< instead of the protocol's of that frequency
    std::vector<std::string> trials; ///< levels: files of those who set them
    std::string levelsPath;          ///< levels: where they are written
    std::string pagePath;            ///< check: the page of HTML; empty: none
    double paceSeconds = 0.0;        ///< per trial, to watch it or to interrupt it
};

/// Declares list, show, run and levels as subcommands of `command`.
void declareStudy(OptionTable& command, StudyOptions& options);

/// Does what `command` has parsed; the code to leave with.
int runStudy(const OptionTable& command, const StudyOptions& options);

} // namespace physvib
