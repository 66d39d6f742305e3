// SPDX-License-Identifier: MIT
// Table of all study tasks: name, kind of answer, texts for the participant, and analysis of the trials.
// Protocols, trial files, simulated observers, screens, analyses and reports read this table; a test compares
// Docs/protocols.md with it.
#pragma once
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// The participant's task in a trial, in the order of the table.
enum class StudyTask { explore, identify, locate, choose, rate, adjust, estimate, describe };

/// Kind of an answer. It decides which fields of Answer and columns of the row are used, and what session and
/// condition must have.
enum class AnswerKind {
    request, ///< the requested stimulus, or a place if the session counts touches; training only, not
             ///< analysed
    label,   ///< label of a stimulus
    place,   ///< place on the field of a grid
    choice,  ///< one of the session's alternatives
    scores,  ///< one score per scale of the session
    level,   ///< level in dB of the alternative that is adjusted
    number,  ///< greater than 0
    words    ///< one line in the participant's own words; listed, not analysed
};

/// English text, translated line by line. Where a variant is empty, `standard` applies.
struct TaskText {
    std::string_view standard, forGrid{}, forPatterns{};
};

/// An entry of the table of tasks.
struct StudyTaskDescription {
    StudyTask task;        ///< its number is its index in the table
    std::string_view name; ///< in protocols and trial files; never changes
    AnswerKind answer;
    std::string_view analysis; ///< name for `physvib analyse` and the report; empty: none
    TaskText question;
    TaskText instruction; ///< how a session proceeds; follows a line on how often stimuli may be played
};

inline constexpr std::array studyTasks{
    StudyTaskDescription{StudyTask::explore,
                         "explore",
                         AnswerKind::request,
                         "",
                         {"What do you want to feel?", "Where do you want to feel it?"},
                         {"Choose what you want to feel, as often as you like.\nWhen everything was felt "
                          "once, Next ends the training."}},
    StudyTaskDescription{StudyTask::identify,
                         "identify",
                         AnswerKind::label,
                         "confusion",
                         {"What did you feel?", "Where did you feel it?"},
                         {"Then say which one it was.", "Then choose the point where you felt it.",
                          "Then choose the place of its first pulse, and the whole pattern."}},
    StudyTaskDescription{StudyTask::locate,
                         "locate",
                         AnswerKind::place,
                         "resolution",
                         {"Where did you feel it?"},
                         {"Then mark where you felt it, anywhere on the field."}},
    StudyTaskDescription{StudyTask::choose,
                         "choose",
                         AnswerKind::choice,
                         "choices",
                         {"Which one do you choose?"},
                         {"Feel them alternately, as often as you like, then choose one."}},
    StudyTaskDescription{StudyTask::rate,
                         "rate",
                         AnswerKind::scores,
                         "ratings",
                         {"Rate what you felt."},
                         {"Then set every scale, and go on."}},
    StudyTaskDescription{StudyTask::adjust,
                         "adjust",
                         AnswerKind::level,
                         "levels",
                         {"Make both equal."},
                         {"Feel both alternately, as often as you like.\nMake the marked one softer or "
                          "stronger until both are equal, and go on."}},
    StudyTaskDescription{StudyTask::estimate,
                         "estimate",
                         AnswerKind::number,
                         "levels",
                         {"How much is it?"},
                         {"Then type a number, and go on."}},
    StudyTaskDescription{StudyTask::describe,
                         "describe",
                         AnswerKind::words,
                         "",
                         {"What did it feel like?"},
                         {"Then write it in your own words, and go on."}}};

/// The task's entry. Any thread.
constexpr const StudyTaskDescription& taskDescription(StudyTask task) noexcept {
    return studyTasks[static_cast<std::size_t>(task)];
}

/// The entry with that name; null if there is none. Any thread.
constexpr const StudyTaskDescription* findStudyTask(std::string_view name) noexcept {
    for (const auto& entry : studyTasks)
        if (entry.name == name) return &entry;
    return nullptr;
}

/// Kind of answer of the task with that name; nullopt if there is no such task. Any thread.
constexpr std::optional<AnswerKind> answerKindOf(std::string_view name) noexcept {
    const StudyTaskDescription* const found = findStudyTask(name);
    return found != nullptr ? std::optional{found->answer} : std::nullopt;
}

/// Names of the tasks, in table order.
inline constexpr auto studyTaskNames = [] {
    std::array<std::string_view, studyTasks.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = studyTasks[i].name;
    return names;
}();

static_assert(
    [] {
        for (std::size_t i = 0; i < studyTasks.size(); ++i)
            if (static_cast<std::size_t>(studyTasks[i].task) != i) return false;
        return true;
    }(),
    "each task at the place of its number");

/// "the task rate", "the tasks choose and adjust": those with answers of these kinds. Any thread (allocates).
inline std::string taskNames(std::initializer_list<AnswerKind> kinds) {
    std::string names;
    std::size_t count = 0;
    for (const auto& entry : studyTasks)
        for (const AnswerKind kind : kinds)
            if (entry.answer == kind) names.append(count++ > 0 ? " and " : "").append(entry.name);
    return (count == 1 ? "the task " : "the tasks ") + names;
}

} // namespace physvib
