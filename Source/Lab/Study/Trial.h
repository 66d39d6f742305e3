// SPDX-License-Identifier: MIT
// One trial: what is presented, what is answered, and what it is made by.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/StimulusJob.h"
#include "Stimuli/FeltLevel.h"
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace physvib {

/// Who takes part. No personal data: a code, and the row of the Latin squares.
struct Participant {
    std::string code = "P01";
    int number = 1;                  ///< from 1; decides orders
    std::string observer = "person"; ///< "simulated-..." for a simulated one
};

struct Trial {
    std::size_t condition = 0, session = 0; ///< indices in the protocol
    int number = 0;                         ///< in its session, from 1
    StudyTask task = StudyTask::identify;
    std::string stimulus;           ///< its label; empty while exploring
    std::vector<std::string> parts; ///< what is felt one by one: alternatives in the order of their buttons,
                                    ///< or objects
    std::vector<double> partLevelsDb; ///< of alternatives
    double levelDb = 0.0;             ///< of the alternative that is moved, or was matched before; else 0
    double restSeconds = 0.0;         ///< break before it
};

/// With what a trial was felt: the same for all trials of a participant, or they are not of one study.
struct Apparatus {
    std::string version, device;     ///< of the program; of the device, "JACK:system"
    double masterDb = 0.0;           ///< the mixer's level
    std::optional<double> noiseDb{}; ///< pink noise on headphones: its root mean square in dB of full scale;
                                     ///< none: there was none
    bool operator==(const Apparatus&) const = default;
};

constexpr double leastEstimate = 1e-12, mostEstimate = 1e12; // of how strong something was

/// What a participant says. Each task uses some of it.
struct Answer {
    std::string response; ///< identify: a label; choose: an alternative; explore: the stimulus that was felt
    std::optional<FieldPlace> place;      ///< locate; explore with free touches
    std::vector<double> scores;           ///< rate: one per scale
    double value = 0.0;                   ///< adjust: dB; estimate: leastEstimate to mostEstimate
    int plays = 1;                        ///< how often it was felt
    double seconds = 0.0;                 ///< from the first feel to the answer
    std::vector<FeltLevel> felt{};        ///< per part, the last time; empty: nobody felt it on a device
    std::optional<Apparatus> apparatus{}; ///< none: nobody felt it on a device
    double limiterDb = 0.0;               ///< by how much the limiter lowered what was felt, at most
    std::optional<double> exposure{}; ///< of the participant up to here: A(8) in m/s^2; none: nobody measured
                                      ///< it
    std::vector<std::string> sessions{}; ///< what was felt of worlds, in this order: saved sessions, beside
                                         ///< the trial file
    bool operator==(const Answer&) const = default;
};

/// A trial and its answer: a row of the trial file.
struct TrialRecord {
    Trial trial;
    Answer answer;
};

/// The grid cell of a trial's stimulus; none if the stimulus is no cell. Any thread.
std::optional<GridCell> targetOf(const ConditionPlan& condition, const Trial& trial);

/// Whether the answer was right; none if the task knows no right. Any thread.
std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record);

/// A call of the program in the words of a protocol (see CallSet), with all names filled in.
struct WrittenCall {
    std::string words;
    bool operator==(const WrittenCall&) const = default;
};
inline std::string textOf(const WrittenCall& call) { return call.words; }

/// A protocol's call with the recordings that it plays: " --sound 80=ball.wav" and so on; a path with spaces
/// in quotes. Any thread (allocates).
std::string withSounds(const Protocol& protocol, std::string call);

/// What a part of a trial is made by.
using TrialJob = std::variant<StimulusJob, WrittenCall>;

/// One for each part; of a trial without parts one. What is felt while a trial is not answered yet: give the
/// answer as it stands. M only (allocates).
std::vector<TrialJob> jobsOf(const Protocol& protocol, const TrialRecord& record);

/// Their texts, joined by " ; "; of worlds, the sessions that were felt. M only (allocates).
std::string callsOf(const Protocol& protocol, const TrialRecord& record);

} // namespace physvib
