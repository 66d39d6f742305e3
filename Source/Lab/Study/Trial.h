// SPDX-License-Identifier: MIT
// One trial: its stimulus, its answer, and the jobs that reproduce it.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/StimulusJob.h"
#include "Stimuli/FeltLevel.h"
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace physvib {

/// A participant, without personal data: a code, and a number that selects the row of the Latin squares.
struct Participant {
    std::string code = "P01";
    int number = 1;                  ///< from 1; selects orders
    std::string observer = "person"; ///< "simulated-..." for a simulated one
};

struct Trial {
    std::size_t condition = 0, session = 0; ///< indices into the protocol
    int number = 0;                         ///< within its session, from 1
    StudyTask task = StudyTask::identify;
    std::string stimulus;           ///< label; empty while exploring
    std::vector<std::string> parts; ///< parts played separately: alternatives in the order of their buttons,
                                    ///< or objects
    std::vector<double> partLevelsDb; ///< levels of the alternatives
    double levelDb = 0.0;             ///< of the alternative that is moved, or was matched before; else 0
    std::size_t staircase = 0;        ///< from 1, where several are mixed; else 0
    double restSeconds = 0.0;         ///< break before it
};

/// Settings of the apparatus in a trial. They must be the same in all trials of a participant.
struct Apparatus {
    std::string version, device;     ///< program version, and device such as "JACK:system"
    double masterDb = 0.0;           ///< the mixer's level
    std::optional<double> noiseDb{}; ///< root mean square of pink noise on headphones, dB of full scale;
                                     ///< none: no noise
    std::string outputs{}, noiseOutputs{}, language{}; ///< "1 2 3 4", "5 6", "ko"; not in rows but in the
                                                       ///< file of times, see StudyTimes.h
    bool operator==(const Apparatus&) const = default;
};

constexpr double leastEstimate = 1e-12, mostEstimate = 1e12; // range of magnitude estimates
constexpr std::size_t mostAnswerBytes = 4000;                // of an answer in words

/// A participant's answer. Each task uses some of the fields.
struct Answer {
    std::string response; ///< identify: a label; choose: an alternative; explore: the stimulus that was felt;
                          ///< describe: words
    std::optional<FieldPlace> place; ///< locate; explore with free touches
    std::vector<double> scores;      ///< rate: one per scale
    double value = 0.0;              ///< adjust: dB; estimate: leastEstimate to mostEstimate
    int plays = 1;                   ///< number of plays
    double seconds = 0.0;            ///< from the first play to the answer
    std::vector<FeltLevel> felt{}; ///< felt level of each part in its last play; empty if no device was used
    std::optional<Apparatus> apparatus{}; ///< none if no device was used
    double limiterDb = 0.0;               ///< maximum gain reduction of the limiter
    std::optional<bool> left{}; ///< whether every part left as planned in its last play; none: not known, as
                                ///< there was no device
    int again = 0;              ///< plays that did not leave as planned, each felt again; not among `plays`
    std::optional<double> exposure{}; ///< accumulated exposure of the participant, A(8) in m/s^2; none: not
                                      ///< measured
    std::vector<std::string> sessions{}; ///< interactive worlds: saved sessions of each scene run in order,
                                         ///< beside the trial file
    bool operator==(const Answer&) const = default;
};

/// A trial and its answer: a row of the trial file.
struct TrialRecord {
    Trial trial;
    Answer answer;
};

/// The grid cell of a trial's stimulus; nullopt if it is not a cell. Any thread.
std::optional<GridCell> targetOf(const ConditionPlan& condition, const Trial& trial);

/// Whether the answer was correct; nullopt if the task has no correct answer. Any thread.
std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record);

/// A call in a protocol (see CallSet), with all names replaced.
struct WrittenCall {
    std::string words;
    bool operator==(const WrittenCall&) const = default;
};
inline std::string textOf(const WrittenCall& call) { return call.words; }

/// The call with the recordings that it plays appended: " --sound 80=ball.wav" and so on; a path with spaces
/// is quoted. Any thread (allocates).
std::string withSounds(const Protocol& protocol, std::string call);

/// The job that creates one part of a trial.
using TrialJob = std::variant<StimulusJob, WrittenCall>;

/// One job per part, or one for a trial without parts. For an unanswered trial, pass the current answer.
/// Message thread only (allocates).
std::vector<TrialJob> jobsOf(const Protocol& protocol, const TrialRecord& record);

/// Texts of the jobs, joined by " ; "; for interactive worlds, the saved sessions. Message thread only
/// (allocates).
std::string callsOf(const Protocol& protocol, const TrialRecord& record);

} // namespace physvib
