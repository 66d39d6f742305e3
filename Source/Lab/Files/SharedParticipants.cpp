// SPDX-License-Identifier: MIT
// Detects participants in several tables. A trial file has one person, so a second file of the same person is
// an error; other programs write one table per run.
#include "Lab/Files/SharedParticipants.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialHead.h"
#include <sstream>

namespace physvib {
namespace {

constexpr std::size_t mostNamed = 6; // limit of the participants, and of the tables of one, that a message
                                     // lists

std::string tablesOf(const std::vector<std::string>& names) {
    std::string words;
    for (std::size_t i = 0; i < names.size() && i < mostNamed; ++i)
        words.append(i ? ", " : "").append(names[i]);
    return names.size() > mostNamed ? words + " ..." : words;
}

} // namespace

TrialHead trialHeadOf(const std::vector<std::string>& comments) {
    TrialHead head;
    for (const std::string& line : comments) {
        std::istringstream words{line};
        std::string word;
        if (!(words >> word) || word != "physvib" || !(words >> head["version"])) continue;
        while (words >> word)
            if (const auto equals = word.find('='); equals != std::string::npos)
                head[word.substr(0, equals)] = word.substr(equals + 1);
        break;
    }
    return head;
}

std::string SharedParticipants::add(const CsvTable& head, const std::set<std::string>& participants) {
    const auto entries = trialHeadOf(head.comments);
    if (const auto code = entries.find("participant"), protocol = entries.find("protocol");
        code != entries.end() && protocol != entries.end()) {
        const auto [at, isNew] = trialFiles_.try_emplace({protocol->second, code->second}, head.name);
        if (!isNew)
            return head.name + ": expected trials of somebody else than " + at->second +
                   ", found participant " + printable(code->second) +
                   " in both: leave one of them out; two people need two codes";
    }
    for (const std::string& participant : participants)
        if (!participant.empty()) tables_[participant].push_back(head.name);
    return {};
}

std::string SharedParticipants::add(const CsvTable& table, std::string_view column) {
    std::set<std::string> participants;
    if (const auto at = table.column(column))
        for (const CsvRow& row : table.rows) participants.insert(row.cells[*at]);
    return add(table, participants);
}

std::string SharedParticipants::note() const {
    std::string words;
    std::size_t shared = 0;
    for (const auto& [participant, tables] : tables_) {
        if (tables.size() < 2 || ++shared > mostNamed) continue;
        words.append(shared > 1 ? "; " : "")
            .append(printable(participant))
            .append(" in ")
            .append(tablesOf(tables));
    }
    if (shared == 0) return {};
    if (shared > mostNamed) words += "; and " + std::to_string(shared - mostNamed) + " more";
    return "participants who are in several tables count as one person each; if they are not, give them "
           "different codes: " +
           words;
}

} // namespace physvib
