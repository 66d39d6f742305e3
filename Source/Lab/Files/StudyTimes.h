// SPDX-License-Identifier: MIT
// Times of a participant's study: starts, breaks, resumes and ends. They stand in a file of their own, so
// that a trial file has the same bytes whenever it was answered.
#pragma once
#include "Io/Result.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

namespace studyEvents {
constexpr std::string_view start = "start", resume = "resume", rest = "break", goOn = "go-on",
                           pause = "pause", leave = "leave", end = "end";
} // namespace studyEvents

/// One line of the file. The last three fields are those of start and resume.
struct StudyMoment {
    std::string timeUtc;                         ///< 2026-11-24T14:02:31Z
    std::string event;                           ///< one of studyEvents
    int trials = 0;                              ///< answered so far
    std::string language, outputs, noiseOutputs; ///< "ko", "1 2 3 4", "5 6"
    bool operator==(const StudyMoment&) const = default;
    bool isBegin() const { return event == studyEvents::start || event == studyEvents::resume; }
};

/// Breaks and pauses, followed event by event. A break stays open while the window is closed in it.
struct StudyRests {
    bool isResting = false, isPaused = false;
    void take(const StudyMoment& moment) noexcept;
};

/// Path of the times of a trial file. Any thread (allocates).
std::filesystem::path timesPathOf(const std::filesystem::path& trialFile);

/// The current time, to the second. Any thread (allocates).
std::string utcNow();

/// Seconds since 1970 of such a time; throws nothing, NaN for other text. Any thread.
double secondsOf(std::string_view timeUtc) noexcept;

/// Reads the file; no moments if there is none, or one error line. Message thread only.
Result<std::vector<StudyMoment>> loadStudyTimes(const std::filesystem::path& path);

/// Replaces the file by these moments. Empty, or why not. Message thread only.
std::string writeStudyTimes(const std::filesystem::path& path, const std::vector<StudyMoment>& moments);

} // namespace physvib
