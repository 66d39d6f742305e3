// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the study commands: warnings, output files, the option --columns, and tests by R.
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
inline void printWarning(const std::string& text) { printMessage("warning: " + text); }

/// Marks results of a simulated observer, so that they cannot be mistaken for a person's.
inline void printIfSimulated(bool isSimulated) {
    if (isSimulated) std::cout << "SIMULATED: a simulated observer answered, not a person\n";
}

/// An output file; its contents are created only if it is requested.
struct StudyFile {
    std::string path; ///< empty: not requested
    std::function<std::string()> makeBytes;
    StudyFile(std::string filePath, std::function<std::string()> make)
        : path{std::move(filePath)}
        , makeBytes{std::move(make)} {}
    StudyFile(std::string filePath, std::string text)
        : path{std::move(filePath)}
        , makeBytes{[text = std::move(text)] { return text; }} {}
};

/// Writes all files or none. Returns an exit code.
inline int writeStudyFiles(const std::vector<StudyFile>& files) {
    std::vector<std::unique_ptr<AtomicFile>> openFiles;
    for (const StudyFile& file : files) {
        if (file.path.empty()) continue;
        openFiles.push_back(std::make_unique<AtomicFile>(file.path));
        if (const auto& error = openFiles.back()->write(file.makeBytes()); !error.empty())
            return reportExit(exitFailed, error);
    }
    for (const auto& file : openFiles)
        if (const auto& error = file->commit(); !error.empty()) return reportExit(exitFailed, error);
    return exitDone;
}

/// Writes all files into `folder`, which it makes, or none; never over `inputs`. Returns an exit code.
int writeFolder(const std::filesystem::path& folder, const StudyFiles& files,
                const std::vector<std::string>& inputs);

/// Runs analysis.R in a temporary folder; returns its tables (none without R) or an error. Message thread.
Result<StudyFiles> runAnalysisScript(const StudyFiles& files);

class OptionTable;

/// Declares the option `--columns` of commands that read tables of other programs.
void declareColumns(OptionTable& command, std::vector<std::string>& columnNames);

} // namespace physvib
