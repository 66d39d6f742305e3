// SPDX-License-Identifier: MIT
// Trials as a dataset of the Brain Imaging Data Structure (BIDS 1.8, behaviour without imaging), as files in
// memory.
#pragma once
#include "Io/Text/CsvTable.h"
#include <map>
#include <span>
#include <string>

namespace physvib {

/// What a dataset says of itself.
struct BidsWords {
    std::string name, task;                      ///< of the study; the task as its protocol is called
    std::string version;                         ///< of the program
    std::map<std::string, std::string> source{}; ///< what else is known of it: key and value
    bool isSimulated = false;
};

/// Paths within the dataset and their bytes: dataset_description.json, participants.tsv,
/// sub-CODE/beh/sub-CODE_task-NAME_beh.tsv, and what their columns mean. `trials` has a column `participant`;
/// codes that are the same without hyphens get a number. Any thread (allocates).
std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsWords& words);

} // namespace physvib
