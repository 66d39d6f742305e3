// SPDX-License-Identifier: MIT
// Report section on when participants answered, from the files of times beside the trial files.
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Report/ReportSections.h"
#include <set>

namespace physvib {
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
        if (code == file.head.end() || observer == file.head.end() || observer->second != "person") continue;
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
