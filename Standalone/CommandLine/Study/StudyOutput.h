// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the study commands: warnings and output files.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Report/AnalysisScript.h"
#include "System/Process.h"
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace physvib {
inline void warn(const std::string& words) { tell("warning: " + words); }

/// Marks results of a simulated observer, so that they cannot be mistaken for a person's.
inline void tellIfSimulated(bool isSimulated) {
    if (isSimulated) std::cout << "SIMULATED: a simulated observer answered, not a person\n";
}

/// An output file; its contents are created only if it is requested.
struct StudyFile {
    std::string path; ///< empty: not requested
    std::function<std::string()> bytes;
    StudyFile(std::string where, std::function<std::string()> make)
        : path{std::move(where)}
        , bytes{std::move(make)} {}
    StudyFile(std::string where, std::string text)
        : path{std::move(where)}
        , bytes{[text = std::move(text)] { return text; }} {}
};

/// Writes all files or none. Returns an exit code.
inline int writeStudyFiles(const std::vector<StudyFile>& files) {
    std::vector<std::unique_ptr<AtomicFile>> open;
    for (const StudyFile& file : files) {
        if (file.path.empty()) continue;
        open.push_back(std::make_unique<AtomicFile>(file.path));
        if (const auto& error = open.back()->write(file.bytes()); !error.empty())
            return leave(exitFailed, error);
    }
    for (const auto& file : open)
        if (const auto& error = file->commit(); !error.empty()) return leave(exitFailed, error);
    return exitDone;
}

/// Writes all files into a folder, which is made, or none; never over `inputs`. Returns an exit code.
int writeFolder(const std::filesystem::path& folder, const StudyFiles& files,
                const std::vector<std::string>& inputs);

/// Runs analysis.R in a folder of its own, where R is there; else returns no files. Message thread.
Result<StudyFiles> runAnalysisScript(const StudyFiles& files);

// The option `--columns`, shared by commands that read tables of other programs.

class OptionTable;

void declareColumns(OptionTable& command, std::vector<std::string>& words);

} // namespace physvib
