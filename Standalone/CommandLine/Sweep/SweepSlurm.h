// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a sweep as a job array of the Slurm workload manager.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// Parameters common to all jobs of the array.
struct SlurmSweep {
    std::filesystem::path folder, design; ///< as seen by every node
    std::uint64_t tasks = 0;
    bool keepsWavs = false, keepsEvents = false;
    std::vector<std::string> words; ///< the user's options of sbatch: partition, time, account
};

/// Number of jobs: one per hundred tasks, within Slurm's usual limit. Any thread.
std::uint64_t slurmJobs(std::uint64_t tasks) noexcept;

/// The script for sbatch. Precondition: fitsSlurm() for its paths. Message thread only.
std::string slurmScript(const SlurmSweep& sweep);

/// True if a path can be used in the script. Any thread.
bool fitsSlurm(const std::string& path) noexcept;

/// Submits the script with sbatch; empty, or one error line. Prints sbatch's output. Message thread only.
std::string submitToSlurm(const std::filesystem::path& script);

} // namespace physvib
