// SPDX-License-Identifier: MIT
// A participant's way through a study, with the file that keeps it: whoever answers, a person or an observer,
// does it here.
#pragma once
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Experiment.h"
#include <filesystem>
#include <string>

namespace physvib {

/// Whose way through which study, and where it is kept.
struct StudyRun {
    Protocol protocol;
    Participant participant;
    std::filesystem::path folder;
    bool operator==(const StudyRun&) const = default;

    /// The file of its trials. Any thread (allocates).
    std::filesystem::path trialFile() const {
        return folder / (protocol.name + "-" + participant.code + ".csv");
    }
};

/// Whether files may be called after it: at most 32 letters, digits, - and _. Any thread.
bool isStudyCode(const std::string& code) noexcept;

/// What is wrong with it before anything is asked or written: empty, or one line. Any thread (allocates).
std::string faultOf(const StudyRun& run);

/// From the first trial without an answer to the last. M only.
class StudyInProgress {
public:
    /// Opens or makes the trial file and does again what was answered before; error() says what went wrong.
    explicit StudyInProgress(StudyRun run);
    StudyInProgress(const StudyInProgress&) = delete;
    StudyInProgress& operator=(const StudyInProgress&) = delete;

    /// Empty, or one line; then nothing may be asked of the experiment.
    const std::string& error() const noexcept { return error_; }

    const Protocol& protocol() const noexcept { return run_.protocol; }
    const std::filesystem::path& path() const noexcept { return path_; }
    const Experiment& experiment() const noexcept { return experiment_; }
    int trialsBefore() const noexcept { return before_; } ///< that were in the file when it was opened
    /// What of the apparatus is not as it was when the last trial before was felt: empty, or one line that
    /// says what to set. Its program may be a newer version: rows say which. Any thread (allocates).
    std::string apparatusFault(const Apparatus& now) const;
    /// A(8) in m/s^2 of those, if the last of them is of today
    double exposureToday() const noexcept { return exposureToday_; }

    /// The answer to the experiment's trial: its row is in the file before this returns. False, and error(),
    /// if it is not an answer, or cannot be written.
    bool take(Answer answer);

    /// The next session begins; if the experiment's mayEnd().
    void endSession() { experiment_.endSession(); }

    /// Folder of the sessions of worlds that this participant felt, beside the trial file.
    std::filesystem::path feltFolder() const {
        return std::filesystem::path{path_}.replace_extension(".felt");
    }

    /// The participant's own words, beside the trial file as .comment.txt. Empty, or why they cannot be kept.
    std::string keepComment(const std::string& words) const;

private:
    StudyRun run_;
    std::filesystem::path path_;
    bool isOfToday_;
    TrialLogFile log_;
    Experiment experiment_;
    int before_ = 0;
    double exposureToday_ = 0.0;
    std::string error_;
};

} // namespace physvib
