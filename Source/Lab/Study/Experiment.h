// SPDX-License-Identifier: MIT
// One participant's study: orders of trials, adaptive levels, trials with their answers, and the experiment
// that presents a trial, accepts its answer and goes on. A user interface or a simulated observer drives it.
// Recorded answers can be replayed, so an interrupted study resumes.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/StimulusJob.h"
#include "Stimuli/SeededRandom.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

// Orders of conditions and trials: balanced by Latin squares, or random from the seed.

/// Row `row` of a balanced Latin square (Williams 1949) over 0 to count - 1. Within `count` rows (twice as
/// many if `count` is odd) each item has each position, and follows each other item, equally often. Any
/// thread (allocates).
std::vector<std::size_t> latinSquareRow(std::size_t count, std::size_t row);

/// Conditions in the order of participant `number` (from 1). Groups use one square, conditions within a group
/// another. Any thread (allocates).
std::vector<std::size_t> conditionOrder(const Protocol& protocol, int number);

/// A trial of a planned order: its stimulus, and whether its two alternatives are swapped.
struct PlannedTrial {
    std::size_t stimulus = 0;
    bool isSwapped = false;
};

/// All trials of a session with fixed levels. Any thread (allocates).
std::vector<PlannedTrial> sessionOrder(const SessionPlan& session, std::size_t stimuli, SeededRandom& random);

// Stimulus level controlled by the participant's answers, with a transformed up-down staircase or QUEST+ as
// the session specifies.

// Transformed up-down staircase (Levitt 1971): converges to the level at which a run of `down` correct
// answers has probability one half.

class Staircase {
public:
    Staircase(const StaircasePlan& plan, double startDb)
        : plan_{plan}
        , levelDb_{startDb}
        , stepDb_{plan.stepDb} {}

    double levelDb() const noexcept { return levelDb_; }
    bool isDone() const noexcept {
        return trials_ >= plan_.maxTrials || static_cast<int>(reversals_.size()) >= plan_.reversals;
    }

    void answer(bool isCorrect) {
        ++trials_;
        if (isCorrect && ++consecutiveCorrect_ < plan_.down) return;
        consecutiveCorrect_ = 0;
        const int direction = isCorrect ? -1 : 1;
        if (lastDirection_ != 0 && direction != lastDirection_) {
            reversals_.push_back(levelDb_);
            stepDb_ = std::max(plan_.minStepDb, 0.5 * stepDb_);
        }
        lastDirection_ = direction;
        levelDb_ =
            std::clamp(levelDb_ + (direction > 0 ? plan_.upRatio : -1.0) * stepDb_, plan_.minDb, plan_.maxDb);
    }

    const std::vector<double>& reversals() const noexcept { return reversals_; }
    /// "ended at 40 trials with 5 of 6 reversals" if the trials ran out first; else empty.
    std::string earlyEnd() const {
        const int found = static_cast<int>(reversals_.size());
        return !isDone() || found >= plan_.reversals
                   ? std::string{}
                   : "ended at " + std::to_string(plan_.maxTrials) + " trials with " + std::to_string(found) +
                         " of " + std::to_string(plan_.reversals) + " reversals";
    }

private:
    StaircasePlan plan_;
    double levelDb_, stepDb_;
    int trials_ = 0, consecutiveCorrect_ = 0, lastDirection_ = 0;
    std::vector<double> reversals_;
};

/// A QUEST+ run that ends after its number of trials or at its target precision.
class QuestTrials {
public:
    QuestTrials(const QuestMethod& method, double guess)
        : quest_{questPlan(method, guess)}
        , trials_{method.trials}
        , deviationDb_{method.deviationDb} {}

    double levelDb() const noexcept { return quest_.level(); }
    bool isDone() const {
        return quest_.trials() >= trials_ ||
               (deviationDb_ > 0.0 && quest_.thresholdDeviation() <= deviationDb_);
    }
    void answer(bool isCorrect) { quest_.answer(isCorrect); }
    int trials() const noexcept { return deviationDb_ > 0.0 ? 0 : trials_; }

private:
    QuestPlus quest_;
    int trials_;
    double deviationDb_;
};

/// One QUEST+, or staircases whose trials are mixed. Not thread-safe: use from one thread at a time.
class AdaptiveLevel {
public:
    /// Precondition: `session` has a staircase or QUEST+.
    explicit AdaptiveLevel(const SessionPlan& session) {
        if (session.quest) methods_.emplace_back(QuestTrials{*session.quest, session.guessRate()});
        if (session.staircase)
            for (const double startDb : session.staircase->starts())
                methods_.emplace_back(Staircase{*session.staircase, startDb});
    }

    double levelDb() const {
        return std::visit([](const auto& m) { return m.levelDb(); }, methods_[current_]);
    }
    bool isDone() const { return std::ranges::all_of(methods_, isMethodDone); }
    /// Text on staircases that ended before their number of reversals; else empty.
    std::string earlyEnd() const {
        std::string words;
        for (std::size_t i = 0; i < methods_.size(); ++i)
            if (const auto* const staircase = std::get_if<Staircase>(&methods_[i]);
                staircase && !staircase->earlyEnd().empty())
                words += (words.empty() ? "" : "; ") +
                         (methods_.size() > 1 ? "staircase " + std::to_string(i + 1) : "the staircase") +
                         " " + staircase->earlyEnd();
        return words;
    }
    void answer(bool isCorrect) {
        std::visit([=](auto& m) { m.answer(isCorrect); }, methods_[current_]);
    }
    /// Selects the staircase, from 0, that the next answer belongs to; a larger index selects the last one.
    void selectStaircase(std::size_t staircase) noexcept {
        current_ = std::min(staircase, methods_.size() - 1);
    }
    /// Selects an unfinished staircase at random; returns its number from 1, or 0 if there is only one.
    /// Precondition: !isDone().
    std::size_t drawStaircase(SeededRandom& random) {
        if (methods_.size() == 1) return 0;
        do current_ = random.below(methods_.size());
        while (isMethodDone(methods_[current_]));
        return current_ + 1;
    }
    /// Number of trials in the run; 0 if the answers decide when it ends.
    int trials() const noexcept {
        const auto* const quest = std::get_if<QuestTrials>(&methods_.front());
        return quest == nullptr ? 0 : quest->trials();
    }

private:
    using Method = std::variant<Staircase, QuestTrials>;
    static bool isMethodDone(const Method& method) {
        return std::visit([](const auto& m) { return m.isDone(); }, method);
    }
    std::vector<Method> methods_;
    std::size_t current_ = 0;
};

// One trial: its stimulus, its answer, and the jobs that reproduce it.

/// A participant, without personal data: a code, and a number that selects the row of the Latin squares.
struct Participant {
    std::string code = "P01";
    int number = 1;                  ///< number from 1, which selects orders
    std::string observer = "person"; ///< "simulated-..." for a simulated observer
};

struct Trial {
    std::size_t condition = 0, session = 0; ///< indices into the protocol
    int number = 0;                         ///< number within its session, from 1
    StudyTask task = StudyTask::identify;
    std::string stimulus;             ///< label; empty while exploring
    std::vector<std::string> parts;   ///< played separately: alternatives as their buttons, or objects
    std::vector<double> partLevelsDb; ///< levels of the alternatives
    double roveDb = 0.0;              ///< offset of the roving variable; 0 if there is none
    double levelDb = 0.0;             ///< level of the adapted, adjusted or matched alternative; else 0
    std::size_t staircase = 0;        ///< its number from 1, where several are mixed; else 0
    double breakSeconds = 0.0;        ///< break before this trial
};

/// Settings of the apparatus in a trial. They must be the same in all trials of a participant.
struct Apparatus {
    std::string version, device;     ///< program version, and device such as "JACK:system"
    double masterDb = 0.0;           ///< the mixer's level
    std::optional<double> noiseDb{}; ///< root mean square of pink noise on headphones, dB of full scale
    std::string outputs{}, noiseOutputs{}, language{}; ///< "1 2 3 4", "5 6", "ko"; not in rows but in the
                                                       ///< file of times, see TrialLog.h
    bool operator==(const Apparatus&) const = default;
};

constexpr double minEstimate = 1e-12, maxEstimate = 1e12; // range of magnitude estimates
constexpr std::size_t maxAnswerBytes = 4000;              // maximum length of an answer in words

/// A participant's answer. Each task uses some of the fields.
struct Answer {
    std::string response; ///< identify: a label; choose: an alternative; explore: a stimulus; describe: words
    std::optional<FieldPlace> place;         ///< locate; explore with free touches
    std::vector<double> scores;              ///< rate: one per scale
    double value = 0.0;                      ///< adjust: dB; estimate: minEstimate to maxEstimate
    bool timedOut = false;                   ///< the time for an answer was over; there is no answer
    int plays = 1;                           ///< number of plays
    double seconds = 0.0;                    ///< time from the first play to the answer
    std::vector<PlayedLevel> playedLevels{}; ///< output level of each part in its last play; empty if no
                                             ///< device was used
    std::optional<Apparatus> apparatus{};    ///< none if no device was used
    double limiterDb = 0.0;                  ///< maximum gain reduction of the limiter
    std::optional<bool> wasDelivered{}; ///< whether every part left as planned in its last play; none: not
                                        ///< known, as there was no device
    int revokedPlays = 0; ///< plays that were not delivered as planned and were repeated; not among `plays`
    std::optional<double> exposure{}; ///< of the participant so far, A(8) in m/s^2; none: not measured
    std::vector<std::string> worldSessions{}; ///< interactive worlds: saved sessions of each scene run in
                                              ///< order, beside the trial file
    bool operator==(const Answer&) const = default;
};

/// A trial and its answer: a row of the trial file.
struct TrialRecord {
    Trial trial;
    Answer answer;
};

/// The grid cell of a trial's stimulus; nullopt if it is not a cell. Any thread.
std::optional<GridCell> targetCell(const ConditionPlan& condition, const Trial& trial);

/// Whether the answer was correct; nullopt if the task has no correct answer, or time ran out. Any thread.
std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record);

/// A call in a protocol (see CallSet), with all names replaced.
struct ResolvedCall {
    std::string words;
    bool operator==(const ResolvedCall&) const = default;
};
inline std::string textOf(const ResolvedCall& call) { return call.words; }

/// The call with the recordings that it plays appended: " --sound 80=ball.wav" and so on; a path with spaces
/// is quoted. Any thread (allocates).
std::string addSoundOptions(const Protocol& protocol, std::string call);

/// The job that creates one part of a trial.
using TrialJob = std::variant<StimulusJob, ResolvedCall>;

/// One job per part, or one for a trial without parts. For an unanswered trial, pass the current answer.
/// Message thread only (allocates).
std::vector<TrialJob> trialJobs(const Protocol& protocol, const TrialRecord& record);

/// Texts of the jobs, joined by " ; "; of interactive worlds the saved sessions. Message thread only.
std::string resolvedCalls(const Protocol& protocol, const TrialRecord& record);

/// Progress of the current trial: decides when an answer is allowed. The caller has the clock.
class TrialProgress {
public:
    TrialProgress(const SessionPlan& session, const Trial& trial);

    /// True if `part` may be played (again).
    bool canPlay(std::size_t part) const noexcept {
        return part < parts_.size() && (session_.maxPlays == 0 || parts_[part].plays < session_.maxPlays);
    }
    void addPlay(std::size_t part) noexcept {
        ++parts_[part].plays;
        parts_[part].isReplayDue = false;
    }
    /// The last play of `part` was not delivered: it no longer counts, and the part must be played again
    /// before an answer is accepted.
    void revokePlay(std::size_t part) noexcept {
        Part& played = parts_[part];
        --played.plays;
        played.seconds = 0.0;
        played.isReplayDue = true;
        ++revokedPlays_;
    }
    /// Adds time spent with `part`.
    void addSeconds(std::size_t part, double seconds) noexcept { parts_[part].seconds += seconds; }
    /// True if every part was played, none must be repeated, and each had its minimum time.
    bool canAnswer() const noexcept {
        return std::ranges::all_of(parts_, [this](const Part& p) {
            return p.plays > 0 && !p.isReplayDue && p.seconds >= session_.minSeconds;
        });
    }
    int plays() const noexcept;
    int revokedPlays() const noexcept { return revokedPlays_; } ///< plays that were lost
    int plays(std::size_t part) const noexcept { return parts_[part].plays; }
    double seconds(std::size_t part) const noexcept { return parts_[part].seconds; } ///< time with `part`

private:
    struct Part {
        int plays = 0;
        double seconds = 0.0;
        bool isReplayDue = false;
    };
    const SessionPlan& session_;
    std::vector<Part> parts_;
    int revokedPlays_ = 0;
};

/// Runs the trials of one participant. `protocol` is valid and outlives it. Message thread only.
class Experiment {
public:
    /// `endsOnRequest`: the participant ends an exploration by endSession(); else it ends as soon as it may.
    Experiment(const Protocol& protocol, Participant participant, bool endsOnRequest = false);

    bool isDone() const noexcept { return !trial_; }

    /// The current trial. Precondition: !isDone().
    const Trial& trial() const noexcept { return *trial_; }
    const SessionPlan& session() const noexcept { return protocol_.sessions[trial_->session]; }
    const ConditionPlan& condition() const noexcept { return protocol_.conditions[trial_->condition]; }

    /// Why the answer does not fit this trial, e.g. `expected a place, found none`; empty if it fits.
    std::string answerError(const Answer& answer) const;

    /// Stores an answer that answerError() accepts, and advances to the next trial. If the trial was not
    /// delivered as planned or timed out, its answer changes no level.
    TrialRecord acceptAnswer(Answer answer);

    /// Replays a recorded trial with acceptAnswer() if it is the one that this experiment expects. Otherwise
    /// returns the difference and changes nothing.
    std::string replay(const TrialRecord& record);

    /// True if the current exploration may end: all stimuli, or enough places, were played.
    bool mayEnd() const { return trial_ && session().answerKind() == AnswerKind::request && hasExplored(); }
    /// Starts the next session. Precondition: mayEnd().
    void endSession() {
        isExplorationEnded_ = true;
        advance();
    }

    int answeredTrials() const noexcept { return answeredTrials_; }

    /// Trials of the current session; 0 if answers decide (a staircase, an open exploration).
    int sessionTrials() const noexcept {
        if (adaptive_) return adaptive_->trials();
        return plan().answerKind() == AnswerKind::request || plan().untilCorrect > 0
                   ? 0
                   : static_cast<int>(order_.size());
    }

    /// Number of the current session among those of all conditions, from 1, in this participant's order.
    int sessionNumber() const noexcept {
        return static_cast<int>(conditionPosition_ * protocol_.sessions.size() + sessionIndex_) + 1;
    }

    /// Stimuli that were requested in the current exploration.
    const std::set<std::string>& explored() const noexcept { return explored_; }

    /// Mean level in dB that a session's adjustments gave for a stimulus; nullopt if there were none.
    std::optional<double> adjustedDb(std::size_t condition, const std::string& session,
                                     const std::string& stimulus) const;

private:
    void beginSession();
    void advance();
    bool isSessionOver() const;
    bool hasExplored() const {
        return plan().minTouches > 0 ? answeredInSession_ >= plan().minTouches
                                     : explored_.size() >= items_.size();
    }
    Trial nextTrial();
    double adjustmentStartDb(const Adjustment& adjustment, int trial) const;
    void addAlternatives(Trial& trial, bool isSwapped);
    SeededRandom makeRandom(const std::string& purpose) const;
    std::size_t conditionIndex() const { return conditions_[conditionPosition_]; }
    const SessionPlan& plan() const { return protocol_.sessions[sessionIndex_]; }

    const Protocol& protocol_;
    Participant participant_;
    bool endsOnRequest_;
    std::vector<std::size_t> conditions_; // in this participant's order
    std::size_t conditionPosition_ = 0, sessionIndex_ = 0;

    std::vector<StimulusItem> items_; // of the current condition
    std::vector<PlannedTrial> order_; // of the current session
    std::set<std::string> explored_;
    bool isExplorationEnded_ = false; // the participant ended the exploration
    std::optional<AdaptiveLevel> adaptive_;
    int answeredInSession_ = 0;  // trials answered
    int consecutiveCorrect_ = 0; // correct answers in a row

    // adjusted levels in dB by (condition, session) and stimulus
    std::map<std::pair<std::size_t, std::string>, std::map<std::string, std::vector<double>>> adjusted_;
    std::optional<Trial> trial_;
    int answeredTrials_ = 0;
};

} // namespace physvib
