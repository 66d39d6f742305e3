// SPDX-License-Identifier: MIT
// Finds participants who occur in more than one table: one person with several files, or two people with the
// same code.
#pragma once
#include "Io/Text/CsvTable.h"
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

class SharedParticipants {
public:
    /// Adds a table by its head and its participants. Returns one line if it is a trial file of a participant
    /// of whom another file of the same protocol was added, else an empty string. Any thread (allocates).
    std::string add(const CsvTable& head, const std::set<std::string>& participants);
    /// Adds a whole table, by its participant column if it has one.
    std::string add(const CsvTable& table, std::string_view column = "participant");

    /// Lists participants in several tables, who count as one person; empty if there are none.
    std::string note() const;

private:
    std::map<std::pair<std::string, std::string>, std::string> trialFiles_; // by protocol and participant
    std::map<std::string, std::vector<std::string>> tables_;                // by participant
};

} // namespace physvib
