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

struct Attendance {
    std::string number, observer, group;
    std::size_t main = 0, training = 0, unanswered = 0, timedOut = 0;
    std::vector<double> seconds;
};

/// True if a row of another program's table has columns of answers, but no answer.
bool hasNoAnswer(const Cells& cell, const CsvRow& row) {
    return std::ranges::any_of(answerColumns, [&](auto c) { return cell.has(c); }) &&
           std::ranges::all_of(answerColumns, [&](auto c) { return cell(row, c).empty(); });
}

/// Attendance of all participants, in file order.
std::vector<std::pair<std::string, Attendance>> attendance(const ReportTrials& trials) {
    std::vector<std::pair<std::string, Attendance>> people;
    const auto person = [&](const std::string& code) -> Attendance& {
        const auto found = std::ranges::find(people, code, &std::pair<std::string, Attendance>::first);
        return (found == people.end() ? people.emplace_back(code, Attendance{}) : *found).second;
    };
    for (const TrialFile& file : trials.files) {
        const Cells cell{file.table};
        for (const CsvRow& row : file.table.rows) {
            Attendance& record = person(cell(row, "participant"));
            if (const auto number = file.head.find("number");
                number != file.head.end() && record.number.empty())
                record.number = number->second;
            record.observer = cell(row, trialColumns::observer);
            if (const std::string& group = cell(row, trialColumns::group); !group.empty())
                record.group = record.group.empty() || record.group == group
                                   ? group
                                   : "in several (" + cell(row, "participant") + ")";
            const bool isTraining = cell(row, trialColumns::phase) == trialColumns::training,
                       timedOut = cell(row, trialColumns::timedOut) == "1";
            ++(isTraining ? record.training : record.main);
            if (isTraining) continue;
            record.timedOut += timedOut;
            record.unanswered +=
                !timedOut &&
                (trials.hasTasks() ? answerKindOf(cell(row, trialColumns::task)) == AnswerKind::label &&
                                         cell(row, "response").empty()
                                   : hasNoAnswer(cell, row));
            if (const auto seconds = parseNumber<double>(cell(row, "response_s")); seconds && !timedOut)
                record.seconds.push_back(*seconds);
        }
    }
    for (const auto& [code, unanswered] : trials.excluded.unanswered) {
        Attendance& record = person(code);
        record.main += unanswered[0], record.unanswered += unanswered[0], record.training += unanswered[1];
    }
    return people;
}

void addProtocol(ReportPage& page, const Protocol& protocol) {
    std::vector<std::string> conditions, sessions;
    for (const auto& condition : protocol.conditions) conditions.push_back(conditionText(condition));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionText(session));
    page.addSubheading("Protocol, by the fields of its file");
    page.addList({protocolText(protocol)});
    page.addSubheading("Conditions");
    page.addList(conditions);
    page.addSubheading("Sessions, each in each condition");
    page.addList(sessions);
    page.addSubheading("Full scale of the layouts");
    page.addList({fullScales(protocol)});
}

/// Lists every stimulus with its call; the page shows one example per condition and session.
void addCalls(ReportBuilder& report) {
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    if (!cell.has("render")) return;
    // key: condition, session, stimulus, call; value: number of trials
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> calls;
    std::map<std::pair<std::string, std::string>, std::string> examples;
    for (const CsvRow& row : all.rows) {
        if (cell(row, "render").empty() || answerKindOf(cell(row, trialColumns::task)) == AnswerKind::request)
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
    report.page.addSubheading("Calls of the stimuli: one of each condition and session (all: stimuli.csv)");
    for (const auto& [key, call] : examples) {
        std::string lines;
        for (std::size_t from = 0; from < call.size();) {
            const std::size_t to = std::min(call.find(" ; ", from), call.size());
            lines += "physvib " + call.substr(from, to - from) + "\n";
            from = to + 3;
        }
        report.page.addPreformatted("# " + key.first + ", " + key.second + "\n" + lines);
    }
}

/// Table of age, sex, handedness and group of the participants who are not excluded.
void addFacts(ReportBuilder& report, const std::vector<std::pair<std::string, Attendance>>& attended) {
    const StudyFacts& facts = report.trials.facts;
    std::vector<double> ages;
    std::map<std::string, std::map<std::string, std::size_t>> counts; // people by sex, handedness and group
    std::size_t analysed = 0;
    for (const auto& [code, record] : attended) {
        if (facts.isExcluded(code)) continue;
        ++analysed;
        const ParticipantFacts& person = facts.person(code);
        if (person.ageYears) ages.push_back(*person.ageYears);
        ++counts["sex"][person.sex], ++counts["handedness"][person.handedness];
        if (record.main > 0) ++counts["group"][record.group.empty() ? person.group : record.group];
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
    report.page.addTable(table.text(), "sample");
    for (const ParticipantFacts& person : facts.people)
        if (std::ranges::find(attended, person.participant, &std::pair<std::string, Attendance>::first) ==
            attended.end())
            report.page.addNote("participant " + person.participant + " of the table of people: no trials");
}

/// Notes participants with the same number, as they had the same orders.
void noteSameNumbers(ReportPage& page, const std::vector<std::pair<std::string, Attendance>>& people) {
    std::map<std::string, std::vector<std::string>> codes;
    for (const auto& [code, record] : people)
        if (!record.number.empty()) codes[record.number].push_back(code);
    for (const auto& [number, sameCodes] : codes)
        if (sameCodes.size() > 1)
            page.addNote("participants " + nameList(sameCodes) + " have the same number, " + number);
}

} // namespace

void addParticipantsSection(ReportBuilder& report) {
    report.page.addHeading("Participants");
    const auto people = attendance(report.trials);
    const StudyFacts& facts = report.trials.facts;
    const bool hasGroups =
        std::ranges::any_of(facts.people, [](const auto& person) { return !person.group.empty(); });
    ExportTable table{
        "participants", report.isSimulated(),
        std::string{"participant,number,observer,trials,training_trials,unanswered,median_response_s"} +
            (facts.people.empty() ? "" : ",age,sex,handedness,excluded") + (hasGroups ? ",group" : "")};
    std::vector<std::size_t> counts; // numbers of trials
    for (const auto& [code, record] : people) {
        table.cells(code, record.number, record.observer, record.main, record.training,
                    record.unanswered + record.timedOut,
                    record.seconds.empty() ? std::nullopt : std::optional{median(record.seconds)});
        if (!facts.people.empty()) {
            const ParticipantFacts& person = facts.person(code);
            table.cells(person.ageYears ? numberText(*person.ageYears) : std::string{}, person.sex,
                        person.handedness, person.excluded);
            if (hasGroups) table.cells(person.group);
        }
        table.endRow();
        if (!facts.isExcluded(code)) counts.push_back(record.main);
    }
    const auto doubledCount = [&](std::size_t count) { return 2 * std::ranges::count(counts, count); };
    const auto commonCount = std::ranges::find_if(counts, [&](std::size_t count) {
        return doubledCount(count) > std::ssize(counts); // where more than half have as many
    });
    for (const std::string& note : report.trials.notes) report.page.addNote(note);
    addFacts(report, people);
    report.show("participants.csv", table);
    noteSameNumbers(report.page, people);
    ExportTable leftOut{"left-out", report.isSimulated(),
                        "participant,condition,session,trials,planned,why,left_out"};
    std::size_t rows = report.trials.excluded.rowCount;
    for (const UnfinishedRun& run : unfinishedRuns(report.trials))
        leftOut.row(run.participant, run.condition, run.session, run.trials,
                    (run.hasFixedCount ? "" : "at most ") + std::to_string(run.planned), run.reason(),
                    run.excludedFrom());
    const bool isAdaptive = hasAdaptiveRows(report.trials);
    if (isAdaptive)
        if (const auto data = readFinishedLevels(report.options()))
            for (const LevelSummary& summary : summariseLevels(data.value.groups.front().trials))
                for (const auto& [code, reason] : summary.excluded)
                    leftOut.row(code, summary.condition, "", "", "", reason, "threshold");
    // Without a protocol the number of trials is inferred from others; adaptive sessions have no fixed
    // number.
    const bool canCompare = !report.trials.protocol && !isAdaptive;
    const auto addLeftOut = [&](const std::string& code, std::size_t trials, const auto& planned,
                                const std::string& why, const char* what) {
        if (trials > 0) leftOut.row(code, "", "", trials, planned, why, what);
    };
    for (const auto& [code, record] : people) {
        rows -= std::min(rows, record.unanswered); // listed with their participant
        if (facts.isExcluded(code)) {
            addLeftOut(code, record.main + record.training, "", facts.person(code).excluded, "all trials");
            continue;
        }
        if (canCompare && commonCount != counts.end() && record.main < *commonCount)
            leftOut.row(code, "", "", record.main, "",
                        "fewer trials than most (" + std::to_string(*commonCount) + ")",
                        "tests of what is lacking, if any");
        addLeftOut(code, record.timedOut, "", "ran out of time", "these trials");
        addLeftOut(code, record.unanswered, "", "no answer", "these trials");
    }
    addLeftOut("", rows, "", "nothing in a named column", "these rows");
    std::map<std::string, std::size_t> undelivered;
    for (const CsvRow& row : report.trials.undelivered)
        ++undelivered[Cells{report.trials.all}(row, "participant")];
    for (const auto& [code, trials] : undelivered)
        addLeftOut(code, trials, "", "did not leave as planned (column left, or a peak of 0 g)",
                   "these trials");
    std::size_t training = 0;
    for (const auto& [code, record] : people) training += facts.isExcluded(code) ? 0 : record.training;
    addLeftOut("", training, "", "training", "these trials");
    report.page.addSubheading("Left out before the analyses");
    if (!report.trials.protocol && isAdaptive)
        report.page.addNote(
            "no protocol: unfinished staircases and thresholds at an end of the levels are not known");
    report.show("left-out.csv", leftOut, 200);
}

void addProcedureSection(ReportBuilder& report) {
    report.page.addHeading("Procedure");
    if (report.trials.protocol)
        addProtocol(report.page, *report.trials.protocol);
    else
        report.page.addNote(report.trials.protocolNote);
    addOrdersSection(report);
    addApparatusSection(report);
    addTimesSection(report);
    addCalls(report);
    addExposureSection(report);
}

void addProvenanceSection(ReportBuilder& report) {
    report.page.addHeading("Files, versions, seeds");
    std::vector<std::string> facts{std::string("report: physvib ") + PHYSVIB_VERSION};
    for (const auto& [key, words] : {std::pair{"version", "trials: physvib "},
                                     {"protocol", "protocol: "},
                                     {"hash", "hash of the protocol: "},
                                     {"seed", "seed of all orders: "}})
        if (const auto value = report.trials.commonValue(key); !value.empty()) facts.push_back(words + value);
    report.page.addList(facts);
    report.page.addSubheading("Tables");
    std::vector<std::string> files;
    for (const auto& [name, text] : report.tables()) files.push_back(name);
    report.page.addList(files);
}

// Report section on when participants answered, from the files of times beside the trial files.

namespace {

/// All different values of a field in starts and resumes.
std::string distinctValues(const std::vector<StudyEvent>& entries, std::string StudyEvent::*field) {
    std::set<std::string> values;
    for (const StudyEvent& entry : entries)
        if (entry.isStartOrResume()) values.insert(entry.*field);
    return joinNames(values, " | ");
}

/// Adds a participant's row. Precondition: there are entries.
void addTimes(ExportTable& table, const std::string& participant, const std::vector<StudyEvent>& entries) {
    namespace events = studyEvents;
    std::size_t sittings = 0, cutOff = 0, breaks = 0, pauses = 0;
    double absentSeconds = 0.0, breakSeconds = 0.0;
    StudyBreakState breakState;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const StudyEvent& entry = entries[i];
        const double elapsedSeconds =
            i > 0 ? unixSeconds(entry.timeUtc) - unixSeconds(entries[i - 1].timeUtc) : 0.0;
        sittings += entry.isStartOrResume() ? 1 : 0;
        breaks += entry.event == events::breakStart && !breakState.isOnBreak ? 1 : 0;
        pauses += entry.event == events::pause ? 1 : 0;
        if (entry.isStartOrResume()) absentSeconds += elapsedSeconds;
        if (entry.isStartOrResume() && i > 0 && entries[i - 1].event != events::leave &&
            entries[i - 1].event != events::end)
            ++cutOff;
        if (breakState.isOnBreak && !entry.isStartOrResume()) breakSeconds += elapsedSeconds;
        breakState.apply(entry);
    }
    const auto minutes = [](double seconds) { return fixedNumber(seconds / 60.0, 1); };
    table.row(participant, entries.front().timeUtc, entries.back().timeUtc,
              entries.back().event == events::end ? "yes" : "no", sittings, minutes(absentSeconds), cutOff,
              breaks, minutes(breakSeconds), pauses, distinctValues(entries, &StudyEvent::language),
              distinctValues(entries, &StudyEvent::outputs),
              distinctValues(entries, &StudyEvent::noiseOutputs));
}

} // namespace

void addTimesSection(ReportBuilder& report) {
    ExportTable table{"times", report.isSimulated(),
                      "participant,time_utc,event,trials,language,outputs,noise_outputs"};
    ExportTable sittingTable{
        "sittings", report.isSimulated(),
        "participant,first_entry_utc,last_entry_utc,ended,sittings,min_between_sittings,cut_off,breaks,"
        "break_min,pauses,language,outputs,noise_outputs"};
    const std::string empty = sittingTable.text();
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
        for (const StudyEvent& entry : file.times)
            table.row(code->second, entry.timeUtc, entry.event, static_cast<std::size_t>(entry.trials),
                      entry.language, entry.outputs, entry.noiseOutputs);
        addTimes(sittingTable, code->second, file.times);
    }
    if (unknown > 0) report.page.addNote(plural(unknown, "participant") + " without a file of times");
    if (sittingTable.text() == empty) return;
    report.page.addSubheading("When");
    report.addTable("times.csv", table.text());
    report.page.addTable(sittingTable.text(), "sittings");
}

} // namespace physvib
