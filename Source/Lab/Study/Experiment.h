// SPDX-License-Identifier: MIT
// A study of one participant as a state machine: it says what to present, takes the answer, and says what is
// next. A user interface or a simulated observer drives it; what was answered before can be done again, so a
// study that was cut off goes on where it was.
#pragma once
#include "Lab/Study/AdaptiveLevel.h"
#include "Lab/Study/StudyOrder.h"
#include "Lab/Study/Trial.h"
#include "Stimuli/SeededRandom.h"
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// The trial at hand while it is being felt: what unlocks the answer. Times come from the caller: there is no
/// clock here.
class TrialProgress {
public:
    TrialProgress(const SessionPlan& session, const Trial& trial);

    /// True if `part` may be started (once more).
    bool canPlay(std::size_t part) const noexcept;
    void played(std::size_t part) noexcept;
    /// Time spent with `part`.
    void spent(std::size_t part, double seconds) noexcept;
    /// Every part was felt, each for as long as the protocol asks.
    bool canAnswer() const noexcept;
    int plays() const noexcept;
    int plays(std::size_t part) const noexcept { return parts_[part].plays; }
    double seconds(std::size_t part) const noexcept { return parts_[part].seconds; } ///< spent with it

private:
    struct Part {
        int plays = 0;
        double seconds = 0.0;
    };
    const SessionPlan& session_;
    std::vector<Part> parts_;
};

/// M only. `protocol` is valid and outlives the experiment.
class Experiment {
public:
    /// `explorersEnd`: whoever asks for what they feel says when that training ends; else it ends as soon as
    /// it may.
    Experiment(const Protocol& protocol, Participant participant, bool explorersEnd = false);

    bool isDone() const noexcept { return !trial_; }

    /// The trial at hand; not after the last.
    const Trial& trial() const noexcept { return *trial_; }
    const SessionPlan& session() const noexcept { return protocol_.sessions[trial_->session]; }
    const ConditionPlan& condition() const noexcept { return protocol_.conditions[trial_->condition]; }

    /// What the answer lacks to be one of this trial, e.g. `expected a place, found none`; empty if nothing.
    std::string refusal(const Answer& answer) const;

    /// Takes an answer that is not refused, and goes on to the next trial.
    TrialRecord take(Answer answer);

    /// take(), if the record is what this experiment would have asked; else what differs, and nothing
    /// happens.
    std::string redo(const TrialRecord& record);

    /// Whether the training at hand may end: enough was felt.
    bool mayEnd() const { return trial_ && session().answer() == AnswerKind::wish && hasExplored(); }
    /// The next session begins; if mayEnd().
    void endSession();

    int trialsTaken() const noexcept { return taken_; }

    /// Trials of the session at hand; 0 where its length depends on the answers (a staircase, a training that
    /// goes on for as long as wanted).
    int sessionTrials() const noexcept;

    /// Which of all sessions (those of the first condition, of the second ...) it is, from 1, in this
    /// participant's order.
    int sessionNumber() const noexcept {
        return static_cast<int>(conditionAt_ * protocol_.sessions.size() + sessionAt_) + 1;
    }

    /// The stimuli that were asked for in the training at hand.
    const std::set<std::string>& explored() const noexcept { return explored_; }

    /// The level that a session's adjustments gave for a stimulus: their mean; none if there was none. dB.
    std::optional<double> adjustedDb(std::size_t condition, const std::string& session,
                                     const std::string& stimulus) const;

private:
    void beginSession();
    void advance();
    bool isSessionOver() const;
    bool hasExplored() const;
    Trial nextTrial();
    double startOf(const Adjustment& adjustment, int trial) const;
    void addAlternatives(Trial& trial, bool isSwapped);
    std::string choiceRefusal(const Answer& answer) const;
    SeededRandom randomFor(const std::string& purpose) const;
    std::size_t conditionIndex() const { return conditions_[conditionAt_]; }
    const SessionPlan& plan() const { return protocol_.sessions[sessionAt_]; }

    const Protocol& protocol_;
    Participant participant_;
    bool explorersEnd_;
    std::vector<std::size_t> conditions_; // in this participant's order
    std::size_t conditionAt_ = 0, sessionAt_ = 0;

    std::vector<StimulusItem> items_; // of the condition at hand
    std::vector<PlannedTrial> order_; // of the session at hand
    std::set<std::string> explored_;
    bool isEnded_ = false; // by whoever explores
    std::optional<AdaptiveLevel> adaptive_;
    int inSession_ = 0; // trials answered

    // (condition, session), stimulus
    std::map<std::pair<std::size_t, std::string>, std::map<std::string, std::vector<double>>> adjusted_;
    std::optional<Trial> trial_;
    int taken_ = 0;
};

} // namespace physvib
