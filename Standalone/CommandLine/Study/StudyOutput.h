// SPDX-License-Identifier: GPL-3.0-or-later
// What the study commands share: warnings, and files out.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "System/ExitCode.h"
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

inline void warn(const std::string& words) { tell("warning: " + words); }

/// Says in which files a result is a simulated observer's; no person's figures may be mistaken for it.
inline void tellIfSimulated(bool isSimulated) {
    if (isSimulated) std::cout << "SIMULATED: a simulated observer answered, not a person\n";
}

/// A file to write: its bytes are made only if it is wanted.
struct StudyFile {
    std::string path; ///< empty: not wanted
    std::function<std::string()> bytes;
    StudyFile(std::string where, std::function<std::string()> make)
        : path{std::move(where)}
        , bytes{std::move(make)} {}
    StudyFile(std::string where, std::string text)
        : path{std::move(where)}
        , bytes{[text = std::move(text)] { return text; }} {}
};

/// Writes all of them, or none; the code to leave with.
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

} // namespace physvib
