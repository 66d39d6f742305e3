// SPDX-License-Identifier: GPL-3.0-or-later
// Writes tables and pictures together, all or none.
#include "CommandLine/Study/StudyOutput.h"
#include <memory>

namespace physvib {

int writeStudyFiles(const std::vector<StudyFile>& files) {
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
