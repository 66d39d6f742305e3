// SPDX-License-Identifier: MIT
// Report sections on participants and procedure, for the methods section of a paper, from the study's files.
#include "Io/Text/CsvText.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Statistics/Bootstrap.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <set>
#include <sstream>
#include <tuple>

namespace physvib {
namespace {

/// Cells of a row by column name; an empty string for missing columns.
class Cells {
public:
    explicit Cells(const CsvTable& table)
        : table_{table} {}
    const std::string& operator()(const CsvRow& row, std::string_view column) const {
        static const std::string none;
        const auto at = table_.column(column);
        return at ? row.cells[*at] : none;
    }
    bool has(std::string_view column) const { return table_.column(column).has_value(); }

private:
    const CsvTable& table_;
};

struct Attended {
    std::string number, observer;
    std::size_t main = 0, training = 0, unanswered = 0;
    std::size_t adaptive = 0; ///< number of main trials in adaptive sessions
    std::vector<double> seconds;
};

/// Attendance of all participants, in file order.
std::vector<std::pair<std::string, Attended>> attendance(const ReportTrials& trials) {
    std::vector<std::pair<std::string, Attended>> people;
    for (const TrialFile& file : trials.files) {
        const Cells cell{file.table};
        for (const CsvRow& row : file.table.rows) {
            const std::string& code = cell(row, "participant");
            auto found = std::ranges::find(people, code, &std::pair<std::string, Attended>::first);
            if (found == people.end()) {
                found = people.insert(people.end(), {code, {}});
                const auto number = file.head.find("number");
                if (number != file.head.end()) found->second.number = number->second;
            }
            Attended& own = found->second;
            const bool isMain = cell(row, trialColumns::phase) != trialColumns::training;
            own.adaptive += isMain && trials.knowTasks() && !cell(row, "correct").empty();
            own.observer = cell(row, trialColumns::observer);
            (cell(row, trialColumns::phase) == trialColumns::training ? own.training : own.main) += 1;
            own.unanswered +=
                answerOf(cell(row, trialColumns::task)) == AnswerKind::label && cell(row, "response").empty();
            if (const auto seconds = parseNumber<double>(cell(row, "response_s"));
                seconds && cell(row, trialColumns::phase) != trialColumns::training)
                own.seconds.push_back(*seconds);
        }
    }
    return people;
}

/// Lists the deviations of a built-in protocol from the thesis.
void tellDeviations(ReportPage& page, const Protocol& protocol) {
    std::vector<std::string> lines;
    for (const ThesisDeviation& one : deviationsOf(protocol))
        lines.push_back(
            std::string{one.section}.append(": ").append(one.thesis).append("; here: ").append(one.here));
    if (lines.empty()) return;
    page.subheading("Deviations from the thesis");
    page.list(lines);
}

void tellProtocol(ReportPage& page, const Protocol& protocol) {
    for (const std::string& sentence : protocolSentences(protocol)) page.paragraph(sentence);
    page.subheading("Conditions");
    std::vector<std::string> conditions, sessions;
    for (const ConditionPlan& condition : protocol.conditions)
        conditions.push_back(conditionWords(condition));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionWords(session));
    page.list(conditions);
    page.subheading("Sessions");
    page.list(sessions);
    tellDeviations(page, protocol);
    if (protocol.sounds.empty()) return;
    page.subheading("Recorded contacts");
    page.list(soundLines(protocol));
}

/// Lists every stimulus with its call; the page shows one example per condition and session.
void tellCalls(ReportBuilder& report) {
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    if (!cell.has("render")) return;
    // key: condition, session, stimulus, call; value: number of trials
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> calls;
    std::map<std::pair<std::string, std::string>, std::string> examples;
    for (const CsvRow& row : all.rows) {
        if (answerOf(cell(row, trialColumns::task)) == AnswerKind::wish) continue;
        ++calls[{cell(row, "condition"), cell(row, "session"), cell(row, "stimulus"), cell(row, "render")}];
        examples.try_emplace({cell(row, "condition"), cell(row, "session")}, cell(row, "render"));
    }
    if (calls.empty()) return;
    ExportTable table{"stimuli", report.isSimulated(), "condition,session,stimulus,trials,call"};
    for (const auto& [key, trials] : calls) {
        const auto& [condition, session, stimulus, call] = key;
        table.row(condition, session, stimulus, trials, call);
    }
    report.addTable("stimuli.csv", table.text());
    report.page.subheading("How stimuli were made");
    report.page.paragraph(
        "Each of these calls of physvib renders a stimulus again; one of each condition and session, all " +
        std::to_string(calls.size()) + " in stimuli.csv:");
    for (const auto& [key, call] : examples) {
        std::string lines;
        for (std::size_t from = 0; from < call.size();) {
            const std::size_t to = std::min(call.find(" ; ", from), call.size());
            lines += "physvib " + call.substr(from, to - from) + "\n";
            from = to + 3;
        }
        report.page.lines("# " + key.first + ", " + key.second + "\n" + lines);
    }
}

/// Numbers of a cell such as "0.5|0.3", which has two parts.
std::vector<double> numbersOf(std::string_view cell) {
    std::vector<double> numbers;
    while (!cell.empty())
        if (const auto number = parseNumber<double>(takeUntil('|', cell))) numbers.push_back(*number);
    return numbers;
}

/// A sentence on a column of the table of tellDoses(), followed by a space.
std::string meaningOf(std::string_view column) {
    if (column == "level_db")
        return "level_db: in dB of the condition's own level, or of a call's full scale; where participants "
               "set a "
               "level, that at the start. ";
    if (column == trialColumns::peakG)
        return "peak_g: the peak of what was felt, of each part of a trial, in g. ";
    if (column == trialColumns::rmsG) return "rms_g: its root mean square, in g. ";
    if (column == trialColumns::exposure)
        return "a8_m_per_s2: the participant's exposure up to there, A(8) by ISO 5349-1. ";
    return {};
}

/// Table of the numeric columns on level and exposure, by condition.
void tellDoses(ReportBuilder& report) {
    if (!report.trials.knowTasks()) return; // units of other programs are unknown
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    ExportTable table{"levels-and-exposure", report.isSimulated(),
                      "condition,session,measure,values,least,mean,most"};
    std::string meanings;
    for (const std::string& column : all.columns) {
        if (column != "level_db" && !trialColumns::isMeasured(column)) continue;
        std::map<std::pair<std::string, std::string>, std::vector<double>> values;
        for (const CsvRow& row : all.rows)
            for (const double value : numbersOf(cell(row, column)))
                values[{cell(row, "condition"), cell(row, "session")}].push_back(value);
        if (column == "level_db" && std::ranges::all_of(values, [](const auto& v) {
                return std::ranges::all_of(v.second, [](double db) { return db == 0.0; });
            }))
            continue;
        if (!values.empty()) meanings += meaningOf(column);
        for (const auto& [key, own] : values) {
            double sum = 0.0;
            for (const double value : own) sum += value;
            // means of adaptive levels and accumulated exposure have no meaning
            const bool hasMean = column == trialColumns::peakG || column == trialColumns::rmsG;
            table.row(key.first, key.second, column, own.size(), *std::ranges::min_element(own),
                      hasMean ? std::optional{sum / static_cast<double>(own.size())} : std::nullopt,
                      *std::ranges::max_element(own));
        }
    }
    report.page.subheading("Levels and exposure");
    if (meanings.empty())
        return report.page.paragraph("Every trial had the level of its call; nobody measured what was felt.");
    report.addTable("levels-and-exposure.csv", table.text());
    report.page.paragraph(meanings.substr(0, meanings.size() - 1));
    report.page.table(table.text(), "levels-and-exposure.csv");
    if (meanings.find(trialColumns::exposure) == std::string::npos)
        report.page.note("exposure was not measured in these trials");
}

/// "6 female, 5 male, 1 not known": counts of each word. `strangers` is the number of participants without an
/// entry.
std::string countsOf(const std::vector<const PersonFacts*>& people, std::size_t strangers,
                     std::string PersonFacts::*field) {
    std::map<std::string, std::size_t> counts;
    if (strangers > 0) counts[""] = strangers;
    for (const PersonFacts* const person : people) ++counts[person->*field];
    std::string words;
    for (const auto& [word, number] : counts)
        if (!word.empty())
            words.append(words.empty() ? "" : ", ").append(std::to_string(number)).append(" ").append(word);
    if (counts.contains("") && !words.empty()) words += ", " + std::to_string(counts.at("")) + " not known";
    return words;
}

/// Reports the facts given by the user on participants whose trials count, and lists missing facts as
/// reminders.
void tellFacts(ReportBuilder& report, const std::vector<std::pair<std::string, Attended>>& attended) {
    const StudyFacts& facts = report.trials.facts;
    std::vector<const PersonFacts*> people;
    std::vector<double> ages;
    std::vector<std::string> notes;
    std::size_t strangers = 0;
    for (const auto& [code, own] : attended) {
        const PersonFacts* const person = facts.person(code);
        strangers += person == nullptr;
        if (person == nullptr && !facts.people.empty())
            notes.push_back("nothing is known of participant " + code + ": no line in the table of people");
        if (person == nullptr || !person->excluded.empty()) continue;
        people.push_back(person);
        if (person->ageYears) ages.push_back(*person->ageYears);
    }
    for (const PersonFacts& person : facts.people)
        if (std::ranges::find(attended, person.participant, &std::pair<std::string, Attended>::first) ==
            attended.end())
            notes.push_back("participant " + person.participant +
                            " of the table of people has no trials here");
    const Moments moments{ages};
    if (!ages.empty())
        report.page.paragraph(
            "Age: mean " + fixedNumber(moments.mean, 1) + " years, standard deviation " +
            fixedNumber(moments.deviation, 1) + ", " + numberText(*std::ranges::min_element(ages)) + " to " +
            numberText(*std::ranges::max_element(ages)) + " (" + std::to_string(ages.size()) + " of " +
            std::to_string(people.size() + strangers) + " known).");
    if (const std::string words = countsOf(people, strangers, &PersonFacts::sex); !words.empty())
        report.page.paragraph("Sex: " + words + ".");
    if (const std::string words = countsOf(people, strangers, &PersonFacts::handedness); !words.empty())
        report.page.paragraph("Handedness: " + words + ".");
    if (!facts.ethics.empty()) report.page.paragraph("Ethics: " + facts.ethics);
    if (!facts.consent.empty()) report.page.paragraph("Consent: " + facts.consent);
    if (facts.people.empty())
        notes.emplace_back("to be filled in: age, sex and handedness of the participants (--people)");
    if (facts.ethics.empty()) notes.emplace_back("to be filled in: approval by an ethics board (--ethics)");
    if (facts.consent.empty()) notes.emplace_back("to be filled in: consent of the participants (--consent)");
    if (!report.isSimulated() || !facts.people.empty()) report.page.notes(notes);
}

/// Explains which training trials count: adjustments and staircases count in every session.
std::string trainingWords(const CsvTable& all) {
    const Cells cell{all};
    bool isAny = false, isLevel = false;
    for (const CsvRow& row : all.rows) {
        if (cell(row, trialColumns::phase) != trialColumns::training) continue;
        isAny = true;
        const StudyTaskDescription* const did = studyTaskNamed(cell(row, trialColumns::task));
        isLevel |= did != nullptr && (did->analysis == "levels" || !cell(row, "correct").empty());
    }
    if (!isAny) return {};
    return isLevel ? "Trainings are left out of all analyses but that of levels."
                   : "Trainings are left out of all analyses.";
}

} // namespace

void tellParticipants(ReportBuilder& report) {
    report.page.heading("Participants");
    const auto people = attendance(report.trials);
    const StudyFacts& facts = report.trials.facts;
    ExportTable table{
        "participants", report.isSimulated(),
        std::string{"participant,number,observer,trials,training_trials,unanswered,median_response_s"} +
            (facts.people.empty() ? "" : ",age,sex,handedness,excluded")};
    std::size_t most = 0;
    for (const auto& [code, own] : people) {
        table.cells(code, own.number, own.observer, own.main, own.training, own.unanswered,
                    own.seconds.empty() ? std::nullopt : std::optional{median(own.seconds)});
        if (!facts.people.empty()) {
            const PersonFacts* const person = facts.person(code);
            const PersonFacts one = person != nullptr ? *person : PersonFacts{};
            table.cells(one.ageYears ? numberText(*one.ageYears) : std::string{}, one.sex, one.handedness,
                        one.excluded);
        }
        table.endRow();
        if (!facts.isExcluded(code)) most = std::max(most, own.main - own.adaptive);
    }
    report.addTable("participants.csv", table.text());
    report.page.paragraph(counted(people.size(), "participant") + " in " +
                          counted(report.trials.files.size(), "file") + ".");
    if (!report.trials.sharedNote.empty()) report.page.note(report.trials.sharedNote);
    tellFacts(report, people);
    if (people.size() == 1)
        report.page.note("one participant: intervals and tests over participants are not possible, and "
                         "nothing here says anything about other people");
    report.page.table(table.text(), "participants.csv");
    std::vector<std::string> exclusions;
    for (const auto& [code, own] : people) {
        if (facts.isExcluded(code)) {
            exclusions.push_back("participant " + code +
                                 " is excluded, with all trials: " + facts.person(code)->excluded);
            continue;
        }
        if (own.main - own.adaptive < most)
            exclusions.push_back("participant " + code + " has " + std::to_string(own.main) +
                                 " trials, others have up to " + std::to_string(most) +
                                 ": tests leave out who lacks a combination of levels");
        if (own.unanswered > 0)
            exclusions.push_back("participant " + code + ": " + counted(own.unanswered, "trial") +
                                 " without an answer left out");
    }
    if (report.trials.rowsLeftOut > 0)
        exclusions.push_back(counted(report.trials.rowsLeftOut, "row") +
                             " with nothing in one of the named columns left out");
    report.page.subheading("Exclusions");
    if (exclusions.empty())
        report.page.paragraph("Nobody and no main trial is left out.");
    else
        report.page.list(exclusions);
    if (const std::string words = trainingWords(report.trials.all); !words.empty())
        report.page.paragraph(words);
}

void tellProcedure(ReportBuilder& report) {
    report.page.heading("Procedure");
    if (report.trials.protocol)
        tellProtocol(report.page, *report.trials.protocol);
    else
        report.page.note(report.trials.protocolNote);
    tellOrders(report);
    tellApparatus(report);
    tellCalls(report);
    tellDoses(report);
}

void tellProvenance(ReportBuilder& report) {
    report.page.heading("Files, versions, seeds");
    std::vector<std::string> facts{std::string("report: physvib ") + PHYSVIB_VERSION};
    for (const auto& [key, words] :
         std::initializer_list<std::pair<const char*, const char*>>{{"version", "trials: physvib "},
                                                                    {"protocol", "protocol: "},
                                                                    {"hash", "hash of the protocol: "},
                                                                    {"seed", "seed of all orders: "}})
        if (const std::string value = report.trials.common(key); !value.empty())
            facts.push_back(words + value);
    const auto has = [&](const char* table) { return report.tables().contains(table); };
    if (has("psychometric.csv") || has("power-law.csv"))
        facts.push_back("intervals of thresholds and exponents over " + std::to_string(fewestDrawn) +
                        " participants or more: " + std::to_string(bootstrapDraws) +
                        " draws of participants, seed 1; all other intervals over participants: Student's t");
    else
        facts.emplace_back("intervals over participants: Student's t");
    report.page.list(facts);
    report.page.paragraph(std::string{"Every table below is CSV with names in its first line"} +
                          (report.tests().empty() ? "."
                                                  : "; report.R (R with afex) repeats every test from them "
                                                    "and compares each p."));
    std::vector<std::string> files;
    for (const auto& [name, text] : report.tables()) files.push_back(name);
    report.page.list(files);
}

} // namespace physvib
