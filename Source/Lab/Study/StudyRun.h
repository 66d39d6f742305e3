// SPDX-License-Identifier: MIT
// One participant's run of a study with its trial file, for a person or a simulated observer.
#pragma once
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Experiment.h"
#include <filesystem>
#include <string>

namespace physvib {

/// Protocol, participant and output folder of a run.
struct StudyRun {
    Protocol protocol;
    Participant participant;
    std::filesystem::path folder;

    /// Path of the trial file. Any thread (allocates).
    std::filesystem::path trialFile() const {
        return folder / (protocol.name + "-" + participant.code + ".csv");
    }
};

/// True if the code can be part of file names: at most 32 letters, digits, - and _. Any thread.
bool isParticipantCode(const std::string& code) noexcept;

/// Empty, or one line on what is invalid, before any trial or file. Any thread (allocates).
std::string studyRunError(const StudyRun& run);

/// A run from its first unanswered trial to its last. Message thread only.
class StudyInProgress {
public:
    /// Opens or creates the trial file and replays its answers; error() reports failures.
    explicit StudyInProgress(StudyRun run);
    StudyInProgress(const StudyInProgress&) = delete;
    StudyInProgress& operator=(const StudyInProgress&) = delete;

    /// Empty, or one error line, after which the experiment must not be used.
    const std::string& error() const noexcept { return error_; }

    const Protocol& protocol() const noexcept { return run_.protocol; }
    const std::filesystem::path& path() const noexcept { return path_; }
    const Experiment& experiment() const noexcept { return experiment_; }
    /// Trials that the file had when it was opened.
    int resumedTrials() const noexcept { return resumedTrials_; }
    /// Empty, or one line naming the setting of the apparatus that differs from the last recorded trial, or
    /// the outputs that differ from those of the last start. A newer program version is allowed, since each
    /// row has its version. Any thread (allocates).
    std::string apparatusError(const Apparatus& current) const;
    /// Master level in dB of the earlier trials if it differs from the current one; else nullopt. Any thread.
    std::optional<double> previousMasterDb(const Apparatus& current) const {
        const auto& records = log_.records();
        const auto before = records.empty() ? std::nullopt : records.back().answer.apparatus;
        return before && before->masterDb != current.masterDb ? std::optional{before->masterDb}
                                                              : std::nullopt;
    }
    /// Writes the start or resume with this apparatus into the file of times. Returns an error, or empty.
    std::string logStart(const Apparatus& current) {
        return logEvent(log_.records().empty() ? studyEvents::start : studyEvents::resume, current);
    }
    /// Adds an event (studyEvents) with the current time. Returns an error, or empty.
    /// After the end nothing is added, however often the study is opened again.
    std::string logEvent(std::string_view event, const Apparatus& current = {});
    /// Remaining seconds of the break before the current trial; it also runs while the window is closed.
    double remainingBreakSeconds() const;
    /// From the start of a break until the participant goes on.
    bool isOnBreak() const noexcept { return breakState_.isOnBreak; }
    /// True if the break before the current trial has begun, in this sitting or an earlier one.
    bool hasBreakBegun() const { return breakStart() != nullptr; }
    /// A(8) in m/s^2 after these trials, if the last of them is of today.
    double exposureToday() const noexcept { return exposureToday_; }

    /// Accepts the answer to the current trial and writes its row before it returns. Returns false and sets
    /// error() if the answer is invalid or cannot be written.
    bool acceptAnswer(Answer answer);

    /// Starts the next session. Precondition: the experiment's mayEnd().
    void endSession() { experiment_.endSession(); }

    /// Folder beside the trial file for the sessions of worlds that the participant felt.
    std::filesystem::path worldSessionsFolder() const {
        return std::filesystem::path{path_}.replace_extension(".felt");
    }

    /// Writes the participant's comment beside the trial file as .comment.txt. Returns an error, or empty.
    std::string saveComment(const std::string& words) const;

private:
    // the break before the current trial; null if none was noted
    const StudyEvent* breakStart() const {
        const auto found = std::ranges::find_if(times_, [&](const StudyEvent& entry) {
            return entry.event == studyEvents::breakStart && entry.trials == experiment_.answeredTrials();
        });
        return found != times_.end() ? &*found : nullptr;
    }

    StudyRun run_;
    std::filesystem::path path_;
    bool wasWrittenToday_;
    TrialLogFile log_;
    std::vector<StudyEvent> times_; // events of the file of times
    StudyBreakState breakState_;    // after these events
    Experiment experiment_;
    int resumedTrials_ = 0;
    double exposureToday_ = 0.0;
    std::string error_;
};

} // namespace physvib
