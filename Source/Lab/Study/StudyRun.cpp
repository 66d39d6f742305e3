// SPDX-License-Identifier: MIT
// Runs an experiment and writes each answer to its trial file.
#include "Lab/Study/StudyRun.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>

namespace physvib {
namespace {

/// In local time, because exposure is summed per calendar day.
bool wasWrittenToday(const std::filesystem::path& path) {
    using Clock = std::chrono::system_clock;
    const auto dayOf = [](Clock::time_point moment) {
        const std::time_t seconds = Clock::to_time_t(moment);
        const std::tm* const day = std::localtime(&seconds);
        return day != nullptr ? std::pair{day->tm_year, day->tm_yday} : std::pair{0, 0};
    };
    std::error_code error;
    const auto written = std::filesystem::last_write_time(path, error);
    return !error &&
           dayOf(std::chrono::time_point_cast<Clock::duration>(std::chrono::file_clock::to_sys(written))) ==
               dayOf(Clock::now());
}

} // namespace

bool isParticipantCode(const std::string& code) noexcept {
    const auto isPlain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
               c == '_';
    };
    return code.size() <= 32 && std::ranges::all_of(code, isPlain);
}

std::string studyRunError(const StudyRun& run) {
    if (!isParticipantCode(run.protocol.name))
        return "name: expected letters, digits, - and _, as files are called after it";
    if (!isParticipantCode(run.participant.code))
        return "participant: expected at most 32 letters, digits, - and _, found " +
               inQuotes(run.participant.code);
    return validate(run.protocol);
}

StudyInProgress::StudyInProgress(StudyRun run)
    : run_{std::move(run)}
    , path_{run_.trialFile()}
    , wasWrittenToday_{wasWrittenToday(path_)}
    , log_{path_, run_.protocol, run_.participant, PHYSVIB_VERSION}
    , experiment_{run_.protocol, run_.participant, run_.participant.observer == Participant{}.observer}
    , error_{log_.error()} {
    if (!error_.empty()) return;
    auto times = loadStudyTimes(timesPath(path_));
    error_ = times.error;
    times_ = std::move(times.value);
    if (!error_.empty()) return;
    for (const StudyEvent& entry : times_) breakState_.apply(entry);
    for (const TrialRecord& record : log_.records()) {
        const std::string error = experiment_.replay(record);
        if (error.empty()) continue;
        error_ = path_.string() + ": session " +
                 cleanLine(run_.protocol.sessions[record.trial.session].name) + ", trial " +
                 std::to_string(record.trial.number) + ": " + error;
        return;
    }
    resumedTrials_ = experiment_.answeredTrials();
    if (wasWrittenToday_ && resumedTrials_ > 0)
        exposureToday_ = log_.records().back().answer.exposure.value_or(0.0);
}

std::string StudyInProgress::logEvent(std::string_view event, const Apparatus& current) {
    if (!times_.empty() && times_.back().event == studyEvents::end) return {};
    times_.push_back({utcNow(), std::string(event), experiment_.answeredTrials(), current.language,
                      current.outputs, current.noiseOutputs});
    breakState_.apply(times_.back());
    return writeStudyTimes(timesPath(path_), times_);
}

double StudyInProgress::remainingBreakSeconds() const {
    const double planned = experiment_.trial().breakSeconds;
    const StudyEvent* const start = breakStart();
    if (start == nullptr) return planned;
    return std::clamp(planned - (unixSeconds(utcNow()) - unixSeconds(start->timeUtc)), 0.0, planned);
}

std::string StudyInProgress::apparatusError(const Apparatus& current) const {
    if (log_.records().empty() || !log_.records().back().answer.apparatus) return {};
    const Apparatus& before = *log_.records().back().answer.apparatus;
    const auto noiseWords = [](const Apparatus& apparatus) {
        return apparatus.noiseDb ? numberText(*apparatus.noiseDb) + " dB" : std::string{"off"};
    };
    const auto differs = [&](const char* what, const std::string& was, const std::string& is) {
        return path_.filename().string() + ": expected " + what + " as in the trials before, " + was +
               ", found " + is + "; set it so, or begin anew in another folder";
    };
    if (before.device != current.device)
        return differs("the device", inQuotes(before.device), inQuotes(current.device));
    if (before.masterDb != current.masterDb)
        return differs("the master level", numberText(before.masterDb) + " dB",
                       numberText(current.masterDb) + " dB");
    if (before.noiseDb != current.noiseDb)
        return differs("the pink noise", noiseWords(before), noiseWords(current));
    const auto start =
        std::find_if(times_.rbegin(), times_.rend(), std::mem_fn(&StudyEvent::isStartOrResume));
    if (start == times_.rend()) return {}; // begun by a version that wrote no times
    if (start->outputs != current.outputs) return differs("the outputs", start->outputs, current.outputs);
    if (start->noiseOutputs != current.noiseOutputs)
        return differs("the outputs of the noise", start->noiseOutputs, current.noiseOutputs);
    return {};
}

std::string StudyInProgress::saveComment(const std::string& words) const {
    AtomicFile file{std::filesystem::path{path_}.replace_extension(".comment.txt")};
    file.write(run_.protocol.closingQuestion + "\n\n" + words + "\n");
    return file.error().empty() ? file.commit() : file.error();
}

bool StudyInProgress::acceptAnswer(Answer answer) {
    if (!error_.empty()) return false;
    if (const std::string error = experiment_.answerError(answer); !error.empty())
        return error_ = error, false;
    if (!log_.append(experiment_.acceptAnswer(std::move(answer))) || (experiment_.isDone() && !log_.sync()))
        error_ = log_.error();
    return error_.empty();
}

} // namespace physvib
