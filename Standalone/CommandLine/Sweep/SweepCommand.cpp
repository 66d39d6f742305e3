// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib sweep`: reads a design, plans and runs its tasks, and writes the index.
#include "CommandLine/Command.h"
#include "CommandLine/Sweep/SweepIndex.h"
#include "CommandLine/Sweep/SweepRun.h"
#include "CommandLine/Sweep/SweepSlurm.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace physvib {
namespace {

struct SweepOptions {
    std::string design, folder; ///< design: its path; all output is written to folder
    bool keepsWavs = false, keepsEvents = false;
    bool plans = false, gathers = false, submits = false; ///< instead of rendering here
    std::string part;                                     ///< "K/N"
    std::vector<std::string> slurmWords;
};

/// "K/N".
std::optional<SweepPart> partOf(const std::string& words) {
    if (words.empty()) return SweepPart{};
    const auto slash = words.find('/');
    if (slash == words.npos) return std::nullopt;
    const auto number = parseNumber<std::uint64_t>(std::string_view{words}.substr(0, slash)),
               parts = parseNumber<std::uint64_t>(std::string_view{words}.substr(slash + 1));
    if (!number || !parts || *number < 1 || *number > *parts) return std::nullopt;
    return SweepPart{*number, *parts};
}

int showPlan(const SweepPlan& plan, const SweepFolder& folder, bool hasFolder) {
    constexpr std::uint64_t shown = 5;
    std::uint64_t done = 0;
    for (std::uint64_t i = 0; i < plan.size(); ++i) {
        const PlannedTask task = plan.at(i);
        if (i < shown) std::cout << task.hash << "  " << task.task.call << '\n';
        done += hasFolder && folder.has(task) ? 1 : 0;
    }
    if (plan.size() > shown) std::cout << "...\n";
    std::cout << counted(plan.size(), "task") << ", " << done << " of them done\n";
    return exitDone;
}

int gather(const SweepPlan& plan, const SweepFolder& folder, const std::string& afterwards) {
    const SweepGap gap = findGap(plan, folder);
    if (gap.tasks > 0)
        return leave(exitFailed, counted(gap.tasks, "task") + " of " + std::to_string(plan.size()) +
                                     " not done, the first: " + gap.first);
    if (auto fault = writeIndex(plan, folder); !fault.empty()) return leave(exitFailed, fault);
    std::cout << folder.index().string() << "  " << counted(plan.size(), "task") << afterwards << '\n';
    return exitDone;
}

int submit(const SweepPlan& plan, const SweepFolder& folder, const SweepOptions& o) {
    const auto absolute = std::filesystem::absolute(o.folder);
    for (const auto& path : {absolute, std::filesystem::current_path()})
        if (!fitsSlurm(path.string()))
            return leave(exitFailed,
                         path.string() + ": expected a path without quotes, $, %, ` and \\ for Slurm");
    const auto script = folder.slurm() / "sweep.sbatch";
    if (auto fault = folder.makeFolderOf(script); !fault.empty()) return leave(exitFailed, fault);
    const SlurmSweep sweep{absolute,    absolute / "design.json", plan.size(), o.keepsWavs, o.keepsEvents,
                           o.slurmWords};
    if (auto fault = writeFile(script, slurmScript(sweep)); !fault.empty()) return leave(exitFailed, fault);
    if (auto fault = submitToSlurm(script); !fault.empty()) return leave(exitFailed, fault);
    std::cout << script.string() << "  " << counted(plan.size(), "task") << " in an array of "
              << slurmJobs(plan.size())
              << "; when it is over, the same call with --gather instead of --slurm\n";
    return exitDone;
}

int render(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part,
           const std::string& partWords) {
    const SweepTally tally = runSweepTasks(plan, folder, part);
    if (tally.failed > 0)
        return leave(exitFailed, counted(tally.failed, "task") + " failed, the first: " + tally.fault);
    if (!partWords.empty()) {
        std::cout << "part " << partWords << "  " << tally.rendered << " rendered\n";
        return exitDone;
    }
    return gather(plan, folder, ", " + std::to_string(tally.rendered) + " rendered now");
}

void declareSweep(OptionTable& command, SweepOptions& o) {
    command
        .add("design", o.design, "which renders: scenes, variables, seeds, layouts, laws, methods, options")
        .required()
        .as("DESIGN.json");
    command
        .add("--out", o.folder,
             "the folder: index.csv, a row per task; tasks, a file for each that is done. The same call goes "
             "on where it was cut off")
        .as("FOLDER");
    command.add("--wav", o.keepsWavs, "keep each task's samples as well");
    command.add("--events", o.keepsEvents, "keep each task's event list as well");
    command.add("--plan,--dry-run", o.plans,
                "only say how many tasks there are and how many are done, and the first of them");
    command.add("--gather", o.gathers, "only write the index of what is done");
    command
        .add(
            "--part", o.part,
            "only every N-th task, from the K-th on, and no index: for several processes or machines at once")
        .as("K/N");
    command.add("--slurm", o.submits, "write an array of jobs for Slurm and submit it with sbatch");
    command
        .add("--sbatch", o.slurmWords,
             "of --slurm: an option of sbatch, as --sbatch=--time=10:00; may be repeated")
        .as("WORD")
        .single();
}

int runSweep(SweepOptions& o) {
    if (o.folder.empty() && !o.plans) return leave(exitUsage, "sweep: expected --out FOLDER, or --plan");
    if (o.plans + o.gathers + o.submits + !o.part.empty() > 1)
        return leave(exitUsage, "sweep: expected one of --plan, --gather, --slurm and --part");
    const auto part = partOf(o.part);
    if (!part)
        return leave(exitUsage, "--part: expected K/N, the K-th of N parts, found " + inQuotes(o.part));
    if (std::ranges::any_of(o.slurmWords, [](const std::string& word) {
            return !word.starts_with('-') || word.find('\n') != word.npos;
        }))
        return leave(exitUsage, "--sbatch: expected options of sbatch, as --sbatch=--time=10:00");
    const auto text = readFile(o.design, limits::maxSweepFileBytes);
    if (!text) return leave(exitFailed, text.error);
    auto design = readSweep(text.value, o.design);
    if (!design) return leave(exitFailed, design.error);
    const auto plan = SweepPlan::of(std::move(design.value), o.design);
    if (!plan) return leave(exitFailed, plan.error);
    const SweepFolder folder{o.folder, o.keepsWavs, o.keepsEvents};
    if (o.plans) return showPlan(plan.value, folder, !o.folder.empty());
    if (o.gathers) return gather(plan.value, folder, "");
    if (auto fault = folder.prepare(text.value); !fault.empty()) return leave(exitFailed, fault);
    return o.submits ? submit(plan.value, folder, o) : render(plan.value, folder, *part, o.part);
}

} // namespace

Command sweepCommand() {
    return commandOf("sweep", "many renders of a design as a table of numbers", declareSweep, runSweep);
}

} // namespace physvib
