// SPDX-License-Identifier: MIT
// Every task of a study once: its name, what its answer consists of, what a participant reads, and which
// analysis takes its trials. Protocols, trial files, simulated observers, screens, analyses and reports read
// this table; Docs/protocols.md is held against it.
#pragma once
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// What a participant does in a trial: the tasks in the order of the table.
enum class StudyTask { explore, identify, locate, choose, rate, adjust, estimate };

/// What an answer consists of: the fields of Answer, the columns of its row, and what its session and
/// condition have to have.
enum class AnswerKind {
    wish,  ///< what shall be felt: a stimulus, or a place where a session counts touches; trainings only, not
           ///< analysed
    label, ///< of a stimulus
    place, ///< on the field of a grid
    choice, ///< one of the session's alternatives
    scores, ///< one for each of the session's scales
    level,  ///< of the alternative that the session's adjustment moves, in dB
    number  ///< greater than 0
};

/// In English, to be translated line by line. Where one is empty, `usual` holds.
struct TaskText {
    std::string_view usual, onGrid{}, ofPatterns{};
};

/// One task.
struct StudyTaskDescription {
    StudyTask task;        ///< its number, which is its place in the table
    std::string_view name; ///< in protocols and trial files: never changes
    AnswerKind answer;
    std::string_view analysis; ///< of `physvib analyse` and the report; empty: none
    TaskText question;
    TaskText instruction; ///< how a session goes, after the line on how often something may be felt
};

/// All of them.
inline constexpr std::array studyTasks{
    StudyTaskDescription{StudyTask::explore,
                         "explore",
                         AnswerKind::wish,
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
                         {"Then type a number, and go on."}}};

/// The task's row. Any thread.
constexpr const StudyTaskDescription& describe(StudyTask task) noexcept {
    return studyTasks[static_cast<std::size_t>(task)];
}

/// The row of that name; null if there is none. Any thread.
constexpr const StudyTaskDescription* studyTaskNamed(std::string_view name) noexcept {
    for (const auto& one : studyTasks)
        if (one.name == name) return &one;
    return nullptr;
}

/// What is answered in the task of that name; none if there is no such task. Any thread.
constexpr std::optional<AnswerKind> answerOf(std::string_view name) noexcept {
    const StudyTaskDescription* const found = studyTaskNamed(name);
    return found != nullptr ? std::optional{found->answer} : std::nullopt;
}

/// Names of the tasks, in their order.
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

/// "the task rate", "the tasks choose and adjust": those with an answer of one of these kinds. Any thread
/// (allocates).
inline std::string tasksThatAnswer(std::initializer_list<AnswerKind> kinds) {
    std::string names;
    std::size_t count = 0;
    for (const auto& one : studyTasks)
        for (const AnswerKind kind : kinds)
            if (one.answer == kind) names.append(count++ > 0 ? " and " : "").append(one.name);
    return (count == 1 ? "the task " : "the tasks ") + names;
}

} // namespace physvib
