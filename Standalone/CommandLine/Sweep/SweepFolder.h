// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of a sweep: a file for each task that is done, under its hash; a log per worker; at the end the
// index.
#pragma once
#include "CommandLine/Sweep/SweepFeatures.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include "Io/Text/CsvTable.h"
#include <filesystem>
#include <optional>

namespace physvib {

/// Any number of programs, on any number of machines, may work in one folder at once. M only.
class SweepFolder {
public:
    SweepFolder(std::filesystem::path folder, bool keepsWavs, bool keepsEvents)
        : folder_{std::move(folder)}
        , keepsWavs_{keepsWavs}
        , keepsEvents_{keepsEvents} {}

    /// Makes it where it is missing, and keeps the design in it; empty, or one line.
    std::string prepare(const std::string& designText) const;

    std::filesystem::path design() const { return folder_ / "design.json"; }
    std::filesystem::path index() const { return folder_ / "index.csv"; }
    std::filesystem::path log(const std::string& worker) const { return folder_ / "log" / (worker + ".txt"); }
    std::filesystem::path slurm() const { return folder_ / "slurm"; }
    std::filesystem::path result(const std::string& hash) const { return ofTask(hash, ".csv"); }
    /// Empty: not wanted.
    std::string wav(const std::string& hash) const {
        return keepsWavs_ ? ofTask(hash, ".wav").string() : std::string{};
    }
    std::string events(const std::string& hash) const {
        return keepsEvents_ ? ofTask(hash, ".events.csv").string() : std::string{};
    }

    /// Makes the folder of a file in it, where it is missing; empty, or one line, also if a link leads out of
    /// the sweep's folder.
    std::string makeFolderOf(const std::filesystem::path& file) const;

    /// Whether all that is wanted of a task is there and whole.
    bool has(const PlannedTask& task) const { return table(task).has_value(); }

    /// The table of a task, a row; none if it is not done, or what is kept beside it is not whole.
    std::optional<CsvTable> table(const PlannedTask& task) const;

    /// What is kept of a task that is done.
    static std::string text(const PlannedTask& task, const std::vector<SweepFeature>& features,
                            const std::string& warnings);

private:
    std::filesystem::path ofTask(const std::string& hash, const char* ending) const {
        return folder_ / "tasks" / hash.substr(0, 2) / (hash + ending);
    }
    bool isEventListWhole(const PlannedTask& task, const CsvTable& row) const;

    std::filesystem::path folder_;
    bool keepsWavs_, keepsEvents_;
};

} // namespace physvib
