// SPDX-License-Identifier: GPL-3.0-or-later
// Output folder of a sweep: a file per completed task, named by its hash; a log per worker; and the final
// index.
#pragma once
#include "CommandLine/Sweep/SweepFeatures.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include "Io/Text/CsvTable.h"
#include <filesystem>
#include <optional>

namespace physvib {

/// Several programs on several machines may use one folder at the same time. Message thread only.
class SweepFolder {
public:
    SweepFolder(std::filesystem::path folder, bool keepsWavs, bool keepsEvents)
        : folder_{std::move(folder)}
        , keepsWavs_{keepsWavs}
        , keepsEvents_{keepsEvents} {}

    /// Creates the folder if necessary, and stores the design in it; empty, or one error line.
    std::string prepare(const std::string& designText) const;

    std::filesystem::path design() const { return folder_ / "design.json"; }
    std::filesystem::path index() const { return folder_ / "index.csv"; }
    std::filesystem::path log(const std::string& worker) const { return folder_ / "log" / (worker + ".txt"); }
    std::filesystem::path slurm() const { return folder_ / "slurm"; }
    std::filesystem::path result(const std::string& hash) const { return ofTask(hash, ".csv"); }
    /// Empty if not requested.
    std::string wav(const std::string& hash) const {
        return keepsWavs_ ? ofTask(hash, ".wav").string() : std::string{};
    }
    std::string events(const std::string& hash) const {
        return keepsEvents_ ? ofTask(hash, ".events.csv").string() : std::string{};
    }

    /// Creates the folder of a file within the sweep's folder. Empty, or one error line, also if a link leads
    /// out of it.
    std::string makeFolderOf(const std::filesystem::path& file) const;

    /// True if all requested files of a task exist and are complete.
    bool has(const PlannedTask& task) const { return table(task).has_value(); }

    /// One-row table of a task; nullopt if it is not done or one of its files is incomplete.
    std::optional<CsvTable> table(const PlannedTask& task) const;

    /// Contents of the result file of a task.
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
