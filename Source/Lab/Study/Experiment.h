// SPDX-License-Identifier: MIT
// State machine for one participant's study: presents a trial, accepts its answer, and goes on to the next. A
// user interface or a simulated observer drives it. Recorded answers can be replayed, so an interrupted study
// resumes where it stopped.
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

/// Progress of the current trial: decides when an answer is allowed. The caller measures times; this class
/// has no clock.
class TrialProgress {
public:
    TrialProgress(const SessionPlan& session, const Trial& trial);

    /// True if `part` may be played (again).
    bool canPlay(std::size_t part) const noexcept;
    void played(std::size_t part) noexcept;
    /// The play of `part` that was counted last did not leave: it does not count, and the part is to be felt
    /// again before an answer.
    void lost(std::size_t part) noexcept;
    /// Adds time spent with `part`.
    void spent(std::size_t part, double seconds) noexcept;
    /// True if every part was played, none is to be felt again, and each had its minimum time from the
    /// protocol.
    bool canAnswer() const noexcept;
    int plays() const noexcept;
    int again() const noexcept { return again_; } ///< plays that were lost
    int plays(std::size_t part) const noexcept { return parts_[part].plays; }
    double seconds(std::size_t part) const noexcept { return parts_[part].seconds; } ///< time with it

private:
    struct Part {
        int plays = 0;
        double seconds = 0.0;
        bool isOwed = false;
    };
    const SessionPlan& session_;
    std::vector<Part> parts_;
    int again_ = 0;
};

/// Message thread only. `protocol` is valid and outlives the experiment.
class Experiment {
public:
    /// `explorersEnd`: the participant ends an exploration by endSession(). Otherwise it ends as soon as it
    /// may.
    Experiment(const Protocol& protocol, Participant participant, bool explorersEnd = false);

    bool isDone() const noexcept { return !trial_; }

    /// The current trial. Precondition: !isDone().
    const Trial& trial() const noexcept { return *trial_; }
    const SessionPlan& session() const noexcept { return protocol_.sessions[trial_->session]; }
    const ConditionPlan& condition() const noexcept { return protocol_.conditions[trial_->condition]; }

    /// Why the answer does not fit this trial, e.g. `expected a place, found none`; empty if it fits.
    std::string refusal(const Answer& answer) const;

    /// Stores an answer that refusal() accepts, and advances to the next trial. Of a trial that did not leave
    /// as planned, the answer moves no level and counts for nothing but the order.
    TrialRecord take(Answer answer);

    /// Replays a recorded trial with take() if it is the one that this experiment expects. Otherwise returns
    /// the difference and changes nothing.
    std::string redo(const TrialRecord& record);

    /// True if the current exploration may end because enough was felt.
    bool mayEnd() const { return trial_ && session().answer() == AnswerKind::wish && hasExplored(); }
    /// Starts the next session. Precondition: mayEnd().
    void endSession();

    int trialsTaken() const noexcept { return taken_; }

    /// Trials of the current session; 0 if its length depends on the answers (a staircase, an open
    /// exploration).
    int sessionTrials() const noexcept;

    /// Number of the current session among those of all conditions, from 1, in this participant's order.
    int sessionNumber() const noexcept {
        return static_cast<int>(conditionAt_ * protocol_.sessions.size() + sessionAt_) + 1;
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

    std::vector<StimulusItem> items_; // of the current condition
    std::vector<PlannedTrial> order_; // of the current session
    std::set<std::string> explored_;
    bool isEnded_ = false; // the participant ended the exploration
    std::optional<AdaptiveLevel> adaptive_;
    int inSession_ = 0; // trials answered
    int inARow_ = 0;    // right answers

    // (condition, session), stimulus
    std::map<std::pair<std::size_t, std::string>, std::map<std::string, std::vector<double>>> adjusted_;
    std::optional<Trial> trial_;
    int taken_ = 0;
};

} // namespace physvib
