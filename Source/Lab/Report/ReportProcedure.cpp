// SPDX-License-Identifier: MIT
// Report sections on participants, procedure and times, for the methods section of a paper.
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/StudyTasks.h"
#include <set>
#include <tuple>

namespace physvib {
namespace {

struct Attended {
    std::string number, observer, group;
    std::size_t main = 0, training = 0, unanswered = 0, ranOut = 0;
    std::vector<double> seconds;
};

/// True if a row of another program's table has columns of answers, but no answer.
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
            if (const auto seconds = parseNumber<double>(cell(row, "response_s")); seconds && !ranOut)
                own.seconds.push_back(*seconds);
        }
    }
    for (const auto& [code, unanswered] : trials.leftOut.unanswered) {
        Attended& own = person(code);
        own.main += unanswered[0], own.unanswered += unanswered[0], own.training += unanswered[1];
    }
    return people;
}

void tellProtocol(ReportPage& page, const Protocol& protocol) {
    std::vector<std::string> conditions, sessions;
    for (const auto& one : protocol.conditions) conditions.push_back(conditionWords(one));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionWords(session));
    page.subheading("Protocol, by the fields of its file");
    page.list({protocolWords(protocol)});
    page.subheading("Conditions");
    page.list(conditions);
    page.subheading("Sessions, each in each condition");
    page.list(sessions);
    page.subheading("Full scale of the layouts");
    page.list({fullScales(protocol)});
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
    report.page.subheading("Calls of the stimuli: one of each condition and session (all: stimuli.csv)");
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

/// Table of age, sex, handedness and group of the participants who are not excluded.
void tellFacts(ReportBuilder& report, const std::vector<std::pair<std::string, Attended>>& attended) {
    const StudyFacts& facts = report.trials.facts;
    std::vector<double> ages;
    std::map<std::string, std::map<std::string, std::size_t>> counts; // of sex, handedness and group
    std::size_t analysed = 0;
    for (const auto& [code, own] : attended) {
        if (facts.isExcluded(code)) continue;
        ++analysed;
        const PersonFacts& person = facts.person(code);
        if (person.ageYears) ages.push_back(*person.ageYears);
        ++counts["sex"][person.sex], ++counts["handedness"][person.handedness];
        if (own.main > 0) ++counts["group"][own.group.empty() ? person.group : own.group];
    }
    ExportTable table{"sample", report.isSimulated(), "of,value,participants"};
    table.row("participants", "", attended.size());
    table.row("participants who are not excluded", "", analysed);
    if (const Moments age{ages}; !ages.empty()) {
        table.row("age, mean (years)", fixedNumber(age.mean, 1), ages.size());
        if (ages.size() > 1) table.row("age, SD (years)", fixedNumber(age.deviation, 1), ages.size());
        table.row("age, least (years)", numberText(*std::ranges::min_element(ages)), ages.size());
        table.row("age, most (years)", numberText(*std::ranges::max_element(ages)), ages.size());
    }
    for (const auto& [name, all] : counts)
        if (all.size() > 1 || !all.contains(""))
            for (const auto& [value, number] : all)
                table.row(name, value.empty() ? "not known" : value, number);
    for (const auto& [name, words] :
         {std::pair{"ethics", facts.ethics}, {"consent", facts.consent}, {"noise at the ear", facts.noise}})
        if (!report.isSimulated() || !words.empty())
            table.row(name, words.empty() ? "not stated" : words, "");
    report.page.table(table.text(), "sample");
    for (const PersonFacts& person : facts.people)
        if (std::ranges::find(attended, person.participant, &std::pair<std::string, Attended>::first) ==
            attended.end())
            report.page.note("participant " + person.participant + " of the table of people: no trials");
}

/// Notes participants with the same number, as they had the same orders.
void tellSameNumbers(ReportPage& page, const std::vector<std::pair<std::string, Attended>>& people) {
    std::map<std::string, std::vector<std::string>> codes;
    for (const auto& [code, own] : people)
        if (!own.number.empty()) codes[own.number].push_back(code);
    for (const auto& [number, same] : codes)
        if (same.size() > 1) page.note("participants " + listed(same) + " have the same number, " + number);
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
    std::vector<std::size_t> counts; // of trials
    for (const auto& [code, own] : people) {
        table.cells(code, own.number, own.observer, own.main, own.training, own.unanswered + own.ranOut,
                    own.seconds.empty() ? std::nullopt : std::optional{median(own.seconds)});
        if (!facts.people.empty()) {
            const PersonFacts& one = facts.person(code);
            table.cells(one.ageYears ? numberText(*one.ageYears) : std::string{}, one.sex, one.handedness,
                        one.excluded);
            if (hasGroups) table.cells(one.group);
        }
        table.endRow();
        if (!facts.isExcluded(code)) counts.push_back(own.main);
    }
    const auto have = [&](std::size_t count) { return 2 * std::ranges::count(counts, count); };
    const auto usual = std::ranges::find_if(counts, [&](std::size_t count) {
        return have(count) > std::ssize(counts); // where more than half have as many
    });
    for (const std::string& note : report.trials.notes) report.page.note(note);
    tellFacts(report, people);
    report.show("participants.csv", table);
    tellSameNumbers(report.page, people);
    ExportTable left{"left-out", report.isSimulated(),
                     "participant,condition,session,trials,planned,why,left_out"};
    std::size_t rows = report.trials.leftOut.rows;
    for (const UnfinishedRun& run : unfinishedRuns(report.trials))
        left.row(run.participant, run.condition, run.session, run.trials,
                 (run.isFixed ? "" : "at most ") + std::to_string(run.planned), run.why(), run.leftOut());
    const bool isAdaptive = hasAdaptiveRows(report.trials);
    if (isAdaptive)
        if (const auto data = readFinishedLevels(report.options()))
            for (const LevelSummary& one : summariseLevels(data.value.conditions.front().trials))
                for (const auto& [who, why] : one.leftOut)
                    left.row(who, one.condition, "", "", "", why, "threshold");
    // Without a protocol the number of trials is inferred from others; adaptive sessions have no fixed
    // number.
    const bool canCompare = !report.trials.protocol && !isAdaptive;
    const auto of = [&](const std::string& code, std::size_t trials, const auto& planned,
                        const std::string& why, const char* what) {
        if (trials > 0) left.row(code, "", "", trials, planned, why, what);
    };
    for (const auto& [code, own] : people) {
        rows -= std::min(rows, own.unanswered); // listed with their participant
        if (facts.isExcluded(code)) {
            of(code, own.main + own.training, "", facts.person(code).excluded, "all trials");
            continue;
        }
        if (canCompare && usual != counts.end() && own.main < *usual)
            left.row(code, "", "", own.main, "", "fewer trials than most (" + std::to_string(*usual) + ")",
                     "tests of what is lacking, if any");
        of(code, own.ranOut, "", "ran out of time", "these trials");
        of(code, own.unanswered, "", "no answer", "these trials");
    }
    of("", rows, "", "nothing in a named column", "these rows");
    std::map<std::string, std::size_t> whose;
    for (const CsvRow& row : report.trials.notLeft) ++whose[Cells{report.trials.all}(row, "participant")];
    for (const auto& [code, trials] : whose)
        of(code, trials, "", "did not leave as planned (column left, or a peak of 0 g)", "these trials");
    std::size_t training = 0;
    for (const auto& [code, own] : people) training += facts.isExcluded(code) ? 0 : own.training;
    of("", training, "", "training", "these trials");
    report.page.subheading("Left out before the analyses");
    if (!report.trials.protocol && isAdaptive)
        report.page.note(
            "no protocol: unfinished staircases and thresholds at an end of the levels are not known");
    report.show("left-out.csv", left, 200);
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
    for (const auto& [key, words] : {std::pair{"version", "trials: physvib "},
                                     {"protocol", "protocol: "},
                                     {"hash", "hash of the protocol: "},
                                     {"seed", "seed of all orders: "}})
        if (const auto value = report.trials.common(key); !value.empty()) facts.push_back(words + value);
    report.page.list(facts);
    report.page.subheading("Tables");
    std::vector<std::string> files;
    for (const auto& [name, text] : report.tables()) files.push_back(name);
    report.page.list(files);
}

// Report section on when participants answered, from the files of times beside the trial files.

namespace {

/// Every value that a column has.
std::string listedOf(const std::vector<StudyMoment>& moments, std::string StudyMoment::*field) {
    std::set<std::string> values;
    for (const StudyMoment& m : moments)
        if (m.isBegin()) values.insert(m.*field);
    return joined(values, " | ");
}

/// A row on a participant. Precondition: there are moments.
void addTimes(ExportTable& table, const std::string& participant, const std::vector<StudyMoment>& moments) {
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
    const auto minutes = [](double seconds) { return fixedNumber(seconds / 60.0, 1); };
    table.row(participant, moments.front().timeUtc, moments.back().timeUtc,
              moments.back().event == events::end ? "yes" : "no", sittings, minutes(awaySeconds), cutOff,
              breaks, minutes(restSeconds), pauses, listedOf(moments, &StudyMoment::language),
              listedOf(moments, &StudyMoment::outputs), listedOf(moments, &StudyMoment::noiseOutputs));
}

} // namespace

void tellTimes(ReportBuilder& report) {
    ExportTable table{"times", report.isSimulated(),
                      "participant,time_utc,event,trials,language,outputs,noise_outputs"};
    ExportTable each{
        "sittings", report.isSimulated(),
        "participant,first_entry_utc,last_entry_utc,ended,sittings,min_between_sittings,cut_off,breaks,"
        "break_min,pauses,language,outputs,noise_outputs"};
    const std::string empty = each.text();
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
        addTimes(each, code->second, file.times);
    }
    if (unknown > 0) report.page.note(counted(unknown, "participant") + " without a file of times");
    if (each.text() == empty) return;
    report.page.subheading("When");
    report.addTable("times.csv", table.text());
    report.page.table(each.text(), "sittings");
}

} // namespace physvib
