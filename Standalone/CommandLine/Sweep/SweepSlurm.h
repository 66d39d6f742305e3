// SPDX-License-Identifier: GPL-3.0-or-later
// A sweep as an array of jobs of the Slurm workload manager.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// What a job of the array needs to know, but its own number.
struct SlurmSweep {
    std::filesystem::path folder, design; ///< as every node sees them
    std::uint64_t tasks = 0;
    bool keepsWavs = false, keepsEvents = false;
    std::vector<std::string> words; ///< of sbatch, of the user's own: partition, time, account
};

/// How many jobs: a hundred tasks in each, and not more jobs than a usual Slurm takes. Any thread.
std::uint64_t slurmJobs(std::uint64_t tasks) noexcept;

/// The script for sbatch; its paths fit. M only.
std::string slurmScript(const SlurmSweep& sweep);

/// Whether a path can stand in the script. Any thread.
bool fitsSlurm(const std::string& path) noexcept;

/// Gives the script to sbatch: empty, or one line. What sbatch says is said. M only.
std::string submitToSlurm(const std::filesystem::path& script);

} // namespace physvib
