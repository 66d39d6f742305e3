// SPDX-License-Identifier: GPL-3.0-or-later
// Each job runs every n-th task, so all jobs take about equally long. The folder shows which tasks are done.
#include "CommandLine/Sweep/SweepSlurm.h"
#include "System/Process.h"
#include <algorithm>

namespace physvib {
namespace {

namespace fs = std::filesystem;

std::string inShellQuotes(const fs::path& path) { return '"' + path.string() + '"'; }

} // namespace

std::uint64_t slurmJobs(std::uint64_t tasks) noexcept {
    // starting a job costs as much as some renders; Slurm's default MaxArraySize is 1001
    constexpr std::uint64_t tasksPerJob = 100, mostAtOnce = 1000;
    return std::clamp<std::uint64_t>((tasks + tasksPerJob - 1) / tasksPerJob, 1, mostAtOnce);
}

// Characters that neither the shell in quotes, nor #SBATCH lines, nor Slurm's file name patterns change.
bool fitsSlurm(const std::string& path) noexcept {
    return path.find_first_of("\"\\$`%\n'") == std::string::npos;
}

std::string slurmScript(const SlurmSweep& sweep) {
    const std::string jobs = std::to_string(slurmJobs(sweep.tasks));
    std::string text =
        "#!/bin/sh\n# physvib " PHYSVIB_VERSION ": " + std::to_string(sweep.tasks) +
        " tasks. A job may be given up, repeated or submitted again: what is done is not done twice.\n";
    text += "#SBATCH --job-name=physvib\n#SBATCH --array=1-" + jobs +
            "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n";
    text += "#SBATCH --chdir=" + inShellQuotes(fs::current_path()) +
            "\n#SBATCH --output=" + inShellQuotes(sweep.folder / "slurm" / "%A_%a.txt") + '\n';
    for (const std::string& word : sweep.words) text += "#SBATCH " + word + '\n';
    text += "exec " + inShellQuotes(ownPath()) + " sweep " + inShellQuotes(sweep.design) + " --out " +
            inShellQuotes(sweep.folder);
    text += " --part \"$SLURM_ARRAY_TASK_ID/" + jobs + '"';
    return text + (sweep.keepsWavs ? " --wav" : "") + (sweep.keepsEvents ? " --events" : "") + '\n';
}

std::string submitToSlurm(const fs::path& script) {
    const auto ran = runProgram("sbatch", {script.string()});
    if (!ran) return ran.error + "; the script is " + script.string();
    return ran.value ? std::string{} : "sbatch did not take " + script.string();
}

} // namespace physvib
