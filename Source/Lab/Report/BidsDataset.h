// SPDX-License-Identifier: MIT
// Trials as a dataset of the Brain Imaging Data Structure (BIDS 1.8, without imaging), in memory.
#pragma once
#include "Io/Text/CsvTable.h"
#include <map>
#include <string>

namespace physvib {

/// Description of a dataset.
struct BidsWords {
    std::string name, task;                      ///< of the study; the task has the protocol's name
    std::string version;                         ///< of the program
    std::map<std::string, std::string> source{}; ///< further facts, as keys and values
    bool isSimulated = false;
    std::map<std::string, std::string> columns{}; ///< what the scales of the protocol mean
};

/// Paths and contents of the dataset's files: dataset_description.json, participants.tsv,
/// sub-CODE/beh/sub-CODE_task-NAME_beh.tsv, and descriptions of their columns. Precondition: `trials` has a
/// column `participant`. Codes that differ only in hyphens get a number. Any thread (allocates).
std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsWords& words);

/// What a column of our own trial files means. Any thread (allocates).
std::string columnMeaning(std::string_view column);

} // namespace physvib
