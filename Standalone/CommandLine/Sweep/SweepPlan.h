// SPDX-License-Identifier: GPL-3.0-or-later
// A validated sweep design: its files exist and `render` accepts its words. Gives tasks by number, each with
// the hash of its result.
#pragma once
#include "Calls/RenderOptions.h"
#include "Lab/Files/SweepFile.h"
#include <cstdint>
#include <map>
#include <string>

namespace physvib {

/// Version of the measured features; a change invalidates stored results.
constexpr int sweepResultVersion = 1;

struct PlannedTask {
    SweepTask task;
    std::string files; ///< "NAME=HASH NAME=HASH": all its input files
    std::string hash;  ///< of program version, call, and contents of these files
};

/// Checked options of a call "render ..."; or one error line. Message thread only.
Result<RenderJob> renderOptionsOf(const std::string& call);

class SweepPlan {
public:
    /// Checks every word of the design once without rendering, and reads every file; or one error line.
    /// Message thread only.
    static Result<SweepPlan> of(SweepDesign design, const std::string& name);

    const SweepDesign& design() const noexcept { return design_; }
    std::uint64_t size() const noexcept { return design_.size(); }
    int channels() const noexcept { return channels_; } ///< of the largest layout

    /// Task `index`, from 0; created at each call. Any thread.
    PlannedTask at(std::uint64_t index) const;

    /// True if the input files of a task are unchanged. Message thread only.
    bool isUnchanged(const PlannedTask& task) const;

private:
    std::string tryTask(const SweepTask& task);
    std::string tryWords(const std::string& name);
    std::string placeOfFault(); ///< location in the design that makes the first task invalid
    void noteFile(const std::string& word, const std::string& path);
    std::string filesOf(const SweepTask& task) const;

    SweepDesign design_;
    int channels_ = 0;
    // hashes of files, by the word that names them
    std::map<std::string, std::map<std::string, std::string>> files_;
};

} // namespace physvib
