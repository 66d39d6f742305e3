// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of simulated participants whose rows are edited, sentence by sentence.
#pragma once
#include "Io/Text/CsvTable.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Report/StudyReport.h"
#include "Support/Studies.h"
#include <cctype>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <ranges>
#include <regex>

namespace physvib::test {

using Row = std::map<std::string, std::string>;
using Edit = std::function<void(Row&)>; ///< a row without a participant is left out

/// A simulated participant's trial file as if of a person, edited.
inline std::string fileOf(const Protocol& protocol, int number, const Edit& edit) {
    const Participant participant{std::string("P").append(std::to_string(number)), number, "person"};
    const std::string text = trialFile(protocol, participant, answered(protocol, participant), "0.2.0");
    const CsvTable table = readCsvTable(text, "rows").value;
    std::string edited = text.substr(0, text.find('\n') + 1) + csvLine(table.columns);
    for (const CsvRow& row : table.rows) {
        Row cells;
        for (std::size_t c = 0; c < table.columns.size(); ++c) cells[table.columns[c]] = row.cells[c];
        if (edit) edit(cells);
        if (!cells["participant"].empty())
            edited += csvLine(
                std::views::transform(table.columns, [&](const auto& column) { return cells[column]; }));
    }
    return edited;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

/// Tables begin as the page says: a line of their origin, then names of columns.
inline void expectTables(const StudyReport& report) {
    for (const auto& [name, text] : report.files)
        if (name.ends_with(".csv")) {
            const std::string second = text.substr(text.find('\n') + 1);
            EXPECT_TRUE(text.starts_with("# physvib ") && std::isalpha(static_cast<unsigned char>(second[0])))
                << name;
        }
}

using Files = std::vector<std::pair<std::string, std::string>>;

inline std::string pageOf(const Files& files, const std::optional<Protocol>& given) {
    const auto trials = readReportTrials(files, {}, given);
    EXPECT_TRUE(trials) << trials.error;
    if (!trials) return {};
    const StudyReport report = studyReport(trials.value);
    expectTables(report);
    std::string page = report.files.at("index.html");
    for (const auto& [code, sign] :
         {std::pair{"&#39;", "'"}, {"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
        page = replaced(page, code, sign);
    return page;
}

/// Files of so many people, edited; of a protocol that is given, or is looked up.
struct Rows {
    Protocol protocol;
    int people = 3;
    Edit edit{};
    bool isGiven = false;
};

inline Rows of(const Protocol& protocol, int people, const Edit& edit = {}, bool isGiven = false) {
    return {protocol, people, edit, isGiven};
}

inline std::string pageOf(const Rows& rows) {
    const auto& [protocol, people, edit, isGiven] = rows;
    static std::map<std::string, std::string> pages; // of rows as they are
    std::string& page = pages[protocol.name + std::to_string(protocol.seed) + (isGiven ? "given" : "") +
                              std::to_string(people)];
    if (!edit && !page.empty()) return page;
    Files files;
    for (int number = 1; number <= people; ++number)
        files.emplace_back(std::string("P").append(std::to_string(number)) + ".csv",
                           fileOf(protocol, number, edit));
    const std::string made = pageOf(files, isGiven ? std::optional{protocol} : std::nullopt);
    if (!edit) page = made;
    return made;
}

/// Numbers are of no account.
inline std::string withoutNumbers(const std::string& words) {
    static const std::regex number{"[0-9]+([.][0-9]+)?"};
    return std::regex_replace(words, number, "#");
}

/// Paragraphs, notes, items of lists and captions of a page, sentence by sentence.
inline std::vector<std::string> sentencesIn(const std::string& page) {
    static const std::regex element{"<(p|li|figcaption)( class=\"note\")?>([^\n]*?)</"}, end{"[.] (?=[A-Z])"};
    static const std::regex figure{"<b>Figure [0-9]+</b> "};
    const std::string html = std::regex_replace(replaced(page, "<br>\n", "</p><p>"), figure, "");
    std::vector<std::string> found;
    for (std::sregex_iterator at{html.begin(), html.end(), element}, none; at != none; ++at) {
        const std::string words = (*at)[3];
        for (std::sregex_token_iterator piece{words.begin(), words.end(), end, -1}, last; piece != last;
             ++piece)
            found.push_back(withoutNumbers(*piece));
    }
    return found;
}

inline Edit set(const std::string& column, const std::string& value, const std::string& ofPerson = {}) {
    return [=](Row& row) {
        if (ofPerson.empty() || row["participant"] == ofPerson) row[column] = value;
    };
}

inline Edit both(const Edit& a, const Edit& b) {
    return [=](Row& row) { a(row), b(row); };
}

} // namespace physvib::test
