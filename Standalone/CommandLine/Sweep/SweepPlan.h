// SPDX-License-Identifier: GPL-3.0-or-later
// A design whose files are there and whose words the program knows: tasks by their numbers, each with the
// hash that it is kept under.
#pragma once
#include "Calls/RenderOptions.h"
#include "Lab/Files/SweepFile.h"
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// The version of what is measured of a render: with another one, tasks are done again.
constexpr int sweepResultVersion = 1;

struct PlannedTask {
    SweepTask task;
    std::string files; ///< "NAME=HASH NAME=HASH": all that it reads
    std::string hash;  ///< of the program's version, the call, and the bytes of those files
};

/// The options of a call "render ...", checked; or one line. M only.
Result<RenderJob> renderOptionsOf(const std::string& call);

class SweepPlan {
public:
    /// Tries every word of the design once, without a render, and reads every file; one line if one is not to
    /// be had. M only.
    static Result<SweepPlan> of(SweepDesign design, const std::string& name);

    const SweepDesign& design() const noexcept { return design_; }
    std::uint64_t size() const noexcept { return design_.size(); }
    int channels() const noexcept { return channels_; } ///< of the largest layout

    /// From 0 on; made anew each time. Any thread.
    PlannedTask at(std::uint64_t index) const;

    /// Whether the files of a task are still what they were. M only.
    bool isUnchanged(const PlannedTask& task) const;

private:
    std::string tryTask(const SweepTask& task);
    std::string tryWords(const std::string& name);
    std::string placeOfFault(); ///< of the first task: without what it is none
    void noteFile(const std::string& word, const std::string& path);
    std::string filesOf(const SweepTask& task) const;

    SweepDesign design_;
    int channels_ = 0;
    // by the word that names them: their hashes
    std::map<std::string, std::map<std::string, std::string>> files_;
};

} // namespace physvib
