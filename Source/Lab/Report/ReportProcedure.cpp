// SPDX-License-Identifier: MIT
// Report sections on participants and procedure, for the methods section of a paper, from the study's files.
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Study/StudyTasks.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <set>
#include <tuple>

namespace physvib {
namespace {

struct Attended {
    std::string number, observer, group;
    std::size_t main = 0, training = 0, unanswered = 0, ranOut = 0;
    std::vector<double> seconds;
};

/// Of other programs' tables: columns of answers, and nothing in them.
bool hasNoAnswer(const Cells& cell, const CsvRow& row) {
    return std::ranges::any_of(answerColumns, [&](auto c) { return cell.has(c); }) &&
           std::ranges::all_of(answerColumns, [&](auto c) { return cell(row, c).empty(); });
}

/// Attendance of all participants, in file order.
std::vector<std::pair<std::string, Attended>> attendance(const ReportTrials& trials) {
    std::vector<std::pair<std::string, Attended>> people;
    const auto person = [&](const std::string& code) -> Attended& {
        const auto found = std::ranges::find(people, code, &std::pair<std::string, Attended>::first);
        return (found == people.end() ? people.emplace_back(code, Attended{}) : *found).second;
    };
    for (const TrialFile& file : trials.files) {
        const Cells cell{file.table};
        for (const CsvRow& row : file.table.rows) {
            Attended& own = person(cell(row, "participant"));
            if (const auto number = file.head.find("number"); number != file.head.end() && own.number.empty())
                own.number = number->second;
            own.observer = cell(row, trialColumns::observer);
            if (const std::string& group = cell(row, trialColumns::group); !group.empty())
                own.group = own.group.empty() || own.group == group
                                ? group
                                : "in several (" + cell(row, "participant") + ")";
            const bool isTraining = cell(row, trialColumns::phase) == trialColumns::training,
                       ranOut = cell(row, trialColumns::ranOut) == "1";
            ++(isTraining ? own.training : own.main);
            if (isTraining) continue;
            own.ranOut += ranOut;
            own.unanswered += !ranOut && (trials.knowTasks() ? answerOf(cell(row, trialColumns::task)) ==
                                                                       AnswerKind::label &&
                                                                   cell(row, "response").empty()
                                                             : hasNoAnswer(cell, row));
            if (const auto seconds = parseNumber<double>(cell(row, "response_s")))
                own.seconds.push_back(*seconds);
        }
    }
    for (const auto& [code, unanswered] : trials.leftOut.unanswered) {
        Attended& own = person(code);
        own.main += unanswered[0], own.unanswered += unanswered[0], own.training += unanswered[1];
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
    for (const auto& one : protocol.conditions) conditions.push_back(conditionWords(one));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionWords(session, protocol));
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
        if (cell(row, "render").empty() || answerOf(cell(row, trialColumns::task)) == AnswerKind::wish)
            continue;
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

/// "6 female, 5 male, 1 not known"; empty where nothing is known.
std::string countsOf(const std::map<std::string, std::size_t>& counts) {
    std::string words;
    for (const auto& [word, number] : counts)
        if (!word.empty())
            words.append(words.empty() ? "" : ", ").append(std::to_string(number)).append(" ").append(word);
    if (counts.contains("") && !words.empty()) words += ", " + std::to_string(counts.at("")) + " not known";
    return words;
}

/// The facts given by the user on participants whose trials count; missing ones as reminders.
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
    std::map<std::string, std::size_t> groups;
    for (const auto& [code, own] : attended) // in rows, or in the table of people
        if (const auto* const person = facts.person(code); !facts.isExcluded(code) && own.main > 0)
            ++groups[own.group.empty() && person ? person->group : own.group];
    if (const std::string words = countsOf(groups); !words.empty())
        report.page.paragraph("Groups: " + words + ".");
    const Moments moments{ages};
    if (!ages.empty())
        report.page.paragraph(
            (ages.size() == 1 ? "Age: " + numberText(ages.front()) + " years ("
                              : "Age: mean " + fixedNumber(moments.mean, 1) + " years, standard deviation " +
                                    fixedNumber(moments.deviation, 1) + ", " +
                                    numberText(*std::ranges::min_element(ages)) + " to " +
                                    numberText(*std::ranges::max_element(ages)) + " (") +
            std::to_string(ages.size()) + " of " + std::to_string(people.size() + strangers) + " known).");
    for (const auto& [name, field] :
         {std::pair{"Sex: ", &PersonFacts::sex}, {"Handedness: ", &PersonFacts::handedness}}) {
        std::map<std::string, std::size_t> counts;
        if (strangers > 0) counts[""] = strangers;
        for (const PersonFacts* const person : people) ++counts[person->*field];
        if (const std::string words = countsOf(counts); !words.empty())
            report.page.paragraph(name + words + ".");
    }
    if (!facts.ethics.empty()) report.page.paragraph("Ethics: " + facts.ethics);
    if (!facts.consent.empty()) report.page.paragraph("Consent: " + facts.consent);
    if (facts.people.empty())
        notes.emplace_back("to be filled in: age, sex and handedness of the participants (--people)");
    if (facts.ethics.empty()) notes.emplace_back("to be filled in: approval by an ethics board (--ethics)");
    if (facts.consent.empty()) notes.emplace_back("to be filled in: consent of the participants (--consent)");
    if (!report.isSimulated() || !facts.people.empty()) report.page.notes(notes);
}

/// The number chooses the orders: people who share one had the same.
void tellSameNumbers(ReportPage& page, const std::vector<std::pair<std::string, Attended>>& people) {
    std::map<std::string, std::vector<std::string>> codes;
    for (const auto& [code, own] : people)
        if (!own.number.empty()) codes[own.number].push_back(code);
    for (const auto& [number, same] : codes)
        if (same.size() > 1)
            page.note("participants " + listed(same) + " have the same number, " + number +
                      ": they had the same orders, which nothing balances");
}

} // namespace

void tellParticipants(ReportBuilder& report) {
    report.page.heading("Participants");
    const auto people = attendance(report.trials);
    const StudyFacts& facts = report.trials.facts;
    const bool hasGroups =
        std::ranges::any_of(facts.people, [](const PersonFacts& one) { return !one.group.empty(); });
    ExportTable table{
        "participants", report.isSimulated(),
        std::string{"participant,number,observer,trials,training_trials,unanswered,median_response_s"} +
            (facts.people.empty() ? "" : ",age,sex,handedness,excluded") + (hasGroups ? ",group" : "")};
    std::size_t most = 0;
    for (const auto& [code, own] : people) {
        table.cells(code, own.number, own.observer, own.main, own.training, own.unanswered + own.ranOut,
                    own.seconds.empty() ? std::nullopt : std::optional{median(own.seconds)});
        if (!facts.people.empty()) {
            const PersonFacts* const person = facts.person(code);
            const PersonFacts one = person != nullptr ? *person : PersonFacts{};
            table.cells(one.ageYears ? numberText(*one.ageYears) : std::string{}, one.sex, one.handedness,
                        one.excluded);
            if (hasGroups) table.cells(one.group);
        }
        table.endRow();
        if (!facts.isExcluded(code)) most = std::max(most, own.main);
    }
    report.addTable("participants.csv", table.text());
    const auto analysed = static_cast<std::size_t>(
        std::ranges::count_if(people, [&](const auto& one) { return !facts.isExcluded(one.first); }));
    report.page.paragraph(counted(people.size(), "participant") + " in " +
                          counted(report.trials.files.size(), "file") +
                          (analysed < people.size() ? "; the table below is of all, everything else of the " +
                                                          std::to_string(analysed) + " who are not excluded."
                                                    : "."));
    for (const std::string& note : report.trials.notes) report.page.note(note);
    tellFacts(report, people);
    if (people.size() == 1)
        report.page.note("one participant: intervals and tests over participants are not possible, and "
                         "nothing here says anything about other people");
    report.page.table(table.text(), "participants.csv");
    std::vector<std::string> exclusions;
    std::size_t rows = report.trials.leftOut.rows;
    for (const UnfinishedRun& run : unfinishedRuns(report.trials)) exclusions.push_back(run.words());
    if (report.trials.protocol && hasAdaptiveRows(report.trials)) {
        AnalysisJob levels = report.options();
        levels.protocol = report.trials.protocol;
        if (const auto data = readFinishedLevels(levels))
            for (const LevelSummary& one : summariseLevels(data.value.conditions.front().trials))
                for (const std::string& words : one.leftOut)
                    exclusions.push_back(one.condition + ": " + words + "; of means and tests");
    }
    // Without a protocol only others tell how many trials there were; adaptive sessions have no fixed number.
    const bool canCompare = !report.trials.protocol && !hasAdaptiveRows(report.trials);
    for (const auto& [code, own] : people) {
        if (facts.isExcluded(code)) {
            exclusions.push_back("participant " + code +
                                 " is excluded, with all trials: " + facts.person(code)->excluded);
            continue;
        }
        if (canCompare && own.main < most)
            exclusions.push_back("participant " + code + " has " + counted(own.main, "trial") +
                                 ", others have up to " + std::to_string(most) + ": they " +
                                 countedButWhereLacking);
        if (own.ranOut > 0)
            exclusions.push_back("participant " + code + ": " + ranOutWords(own.ranOut) +
                                 ": analyses leave them out");
        rows -= std::min(rows, own.unanswered);
        if (own.unanswered > 0)
            exclusions.push_back("participant " + code + ": " + counted(own.unanswered, "trial") +
                                 " without an answer left out");
    }
    if (rows > 0)
        exclusions.push_back(counted(rows, "row") + " with nothing in one of the named columns left out");
    std::set<std::string> whose;
    for (const CsvRow& row : report.trials.notLeft)
        whose.insert(Cells{report.trials.all}(row, "participant"));
    if (!whose.empty())
        exclusions.push_back(notLeftWords(report.trials.notLeft.size()) + ": of " + joined(whose, ", "));
    tellSameNumbers(report.page, people);
    report.page.subheading("Exclusions");
    if (!report.trials.protocol && hasAdaptiveRows(report.trials))
        report.page.note(
            "whether everyone finished, and who was at an end of the levels, is not known: levels "
            "followed the answers, and the protocol, which says both, is not known");
    if (exclusions.empty())
        report.page.paragraph("Nobody and no main trial is left out before the analyses, each of which names "
                              "whom it leaves out.");
    else
        report.page.list(exclusions);
    if (std::ranges::any_of(people, [](const auto& one) { return one.second.training > 0; }))
        report.page.paragraph("Trainings are left out of all analyses.");
}

void tellProcedure(ReportBuilder& report) {
    report.page.heading("Procedure");
    if (report.trials.protocol)
        tellProtocol(report.page, *report.trials.protocol);
    else
        report.page.note(report.trials.protocolNote);
    tellOrders(report);
    tellApparatus(report);
    tellTimes(report);
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
        if (const auto value = report.trials.common(key); !value.empty()) facts.push_back(words + value);
    if (report.people() > 1)
        facts.emplace_back("intervals over participants: Student's t, where nothing else is named");
    report.page.list(facts);
    report.page.paragraph(
        "Every table below is CSV with names of columns in its second line, after one of its origin.");
    std::vector<std::string> files;
    for (const auto& [name, text] : report.tables()) files.push_back(name);
    report.page.list(files);
}

// Report section on when participants answered, from the files of times beside the trial files.

namespace {

std::string minutesOf(double seconds) { return fixedNumber(seconds / 60.0, 1) + " min"; }

/// Every value that a column has, in words.
std::string listedOf(const std::vector<StudyMoment>& moments, std::string StudyMoment::*field,
                     const char* none) {
    std::set<std::string> values;
    for (const StudyMoment& m : moments)
        if (m.isBegin()) values.insert((m.*field).empty() ? none : m.*field);
    return joined(values, ", then ");
}

} // namespace

std::string timesSentence(const std::string& participant, const std::vector<StudyMoment>& moments) {
    namespace events = studyEvents;
    std::size_t sittings = 0, cutOff = 0, breaks = 0, pauses = 0;
    double awaySeconds = 0.0, restSeconds = 0.0;
    StudyRests rests;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        const StudyMoment& m = moments[i];
        const double since = i > 0 ? secondsOf(m.timeUtc) - secondsOf(moments[i - 1].timeUtc) : 0.0;
        sittings += m.isBegin() ? 1 : 0;
        breaks += m.event == events::rest && !rests.isResting ? 1 : 0;
        pauses += m.event == events::pause ? 1 : 0;
        if (m.isBegin()) awaySeconds += since;
        if (m.isBegin() && i > 0 && moments[i - 1].event != events::leave &&
            moments[i - 1].event != events::end)
            ++cutOff;
        if (rests.isResting && !m.isBegin()) restSeconds += since;
        rests.take(m);
    }
    const bool isOver = moments.back().event == events::end;
    std::string words = participant + " began at " + moments.front().timeUtc +
                        (isOver ? " and ended at " : " and has not ended; the last entry is of ") +
                        moments.back().timeUtc + ": " + counted(sittings, "sitting");
    if (sittings > 1) words += " with " + minutesOf(awaySeconds) + " between their entries";
    if (cutOff > 0) words += ", " + std::to_string(cutOff) + " of them cut off";
    words += ", " + counted(breaks, "break") + " of " + minutesOf(restSeconds) + " in all";
    if (pauses > 0) words += ", " + counted(pauses, "pause") + " by closing the window";
    return words + "; language " + listedOf(moments, &StudyMoment::language, "en") + "; outputs " +
           listedOf(moments, &StudyMoment::outputs, "not known") + "; noise on outputs " +
           listedOf(moments, &StudyMoment::noiseOutputs, "none") + ".";
}

void tellTimes(ReportBuilder& report) {
    ExportTable table{"times", report.isSimulated(),
                      "participant,time_utc,event,trials,language,outputs,noise_outputs"};
    std::vector<std::string> sentences;
    std::size_t unknown = 0;
    for (const TrialFile& file : report.trials.files) {
        const auto code = file.head.find("participant"), observer = file.head.find("observer");
        if (code == file.head.end() || observer == file.head.end() || observer->second != "person" ||
            report.trials.facts.isExcluded(code->second))
            continue;
        if (file.times.empty()) {
            ++unknown;
            continue;
        }
        for (const StudyMoment& m : file.times)
            table.row(code->second, m.timeUtc, m.event, static_cast<std::size_t>(m.trials), m.language,
                      m.outputs, m.noiseOutputs);
        sentences.push_back(timesSentence(code->second, file.times));
    }
    if (unknown > 0)
        report.page.note(counted(unknown, "participant") +
                         " without a file of times: nothing is known of dates, breaks and outputs");
    if (sentences.empty()) return;
    report.page.subheading("When");
    report.addTable("times.csv", table.text());
    report.page.list(sentences);
}

} // namespace physvib
