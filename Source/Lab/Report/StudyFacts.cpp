// SPDX-License-Identifier: MIT
// Reads the table of participants. Unknown columns are errors, so that no fact is silently ignored.
#include "Lab/Report/StudyFacts.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <array>
#include <set>

namespace physvib {
namespace {

constexpr std::array<std::string_view, 5> peopleColumns{"participant", "age", "sex", "handedness",
                                                        "excluded"};
constexpr double oldestYears = 130.0;

} // namespace

const PersonFacts* StudyFacts::person(std::string_view participant) const noexcept {
    const auto found = std::ranges::find(people, participant, &PersonFacts::participant);
    return found == people.end() ? nullptr : &*found;
}

bool StudyFacts::isExcluded(std::string_view participant) const noexcept {
    const PersonFacts* const facts = person(participant);
    return facts != nullptr && !facts->excluded.empty();
}

Result<std::vector<PersonFacts>> readPeople(std::string_view text, std::string_view name) {
    auto read = readCsvTable(text, name, CsvHeader::named);
    if (!read) return Failure{read.error};
    const CsvTable& table = read.value;
    for (const std::string& column : table.columns)
        if (std::ranges::find(peopleColumns, column) == peopleColumns.end())
            return Failure{table.name +
                           ": expected the columns participant, age, sex, handedness, excluded, found " +
                           inQuotes(column)};
    if (!table.column("participant"))
        return Failure{table.name + ": expected a column participant, found none"};
    std::vector<PersonFacts> people;
    std::set<std::string> codes;
    for (const CsvRow& row : table.rows) {
        const auto cell = [&](std::string_view column) {
            const auto at = table.column(column);
            return at ? row.cells[*at] : std::string{};
        };
        PersonFacts facts{cell("participant"), {}, cell("sex"), cell("handedness"), cell("excluded")};
        if (facts.participant.empty() || !codes.insert(facts.participant).second)
            return Failure{
                table.fault(row, *table.column("participant"), "a code of its own for each participant")};
        if (const std::string age = cell("age"); !age.empty()) {
            facts.ageYears = parseNumber<double>(age);
            if (!facts.ageYears || *facts.ageYears < 0.0 || *facts.ageYears > oldestYears)
                return Failure{table.fault(row, *table.column("age"), "years from 0 to 130")};
        }
        people.push_back(std::move(facts));
    }
    return people;
}

} // namespace physvib
