// SPDX-License-Identifier: MIT
// Participants who are in more than one table: one person with several files, or two people with one number.
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
    /// Takes a table by its head and its participants. Empty, or one line: it is a trial file of somebody of
    /// whom another of the same protocol was added. Any thread (allocates).
    std::string add(const CsvTable& head, const std::set<std::string>& participants);
    /// The same of a whole table, by the column of that name, if it has one.
    std::string add(const CsvTable& table, std::string_view column = "participant");

    /// Who is in which tables, and counts as one person; empty if nobody is in several.
    std::string note() const;

private:
    std::map<std::pair<std::string, std::string>, std::string> trialFiles_; // by protocol and participant
    std::map<std::string, std::vector<std::string>> tables_;                // by participant
};

} // namespace physvib
