// SPDX-License-Identifier: MIT
// Stimulus level controlled by the participant's answers, with a staircase or QUEST+ as the session
// specifies.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Staircase.h"
#include <variant>

namespace physvib {

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

/// Not thread-safe: use from one thread at a time.
class AdaptiveLevel {
public:
    /// Precondition: `session` has a staircase or QUEST+.
    explicit AdaptiveLevel(const SessionPlan& session)
        : method_{session.staircase ? Method{Staircase{*session.staircase}}
                                    : Method{QuestTrials{*session.quest, session.guessRate()}}} {}

    double levelDb() const {
        return std::visit([](const auto& m) { return m.levelDb(); }, method_);
    }
    bool isDone() const {
        return std::visit([](const auto& m) { return m.isDone(); }, method_);
    }
    void answer(bool isCorrect) {
        std::visit([=](auto& m) { m.answer(isCorrect); }, method_);
    }
    /// Number of trials in the run; 0 if the answers decide when it ends.
    int trials() const noexcept {
        const auto* const quest = std::get_if<QuestTrials>(&method_);
        return quest == nullptr ? 0 : quest->trials();
    }

private:
    using Method = std::variant<Staircase, QuestTrials>;
    Method method_;
};

} // namespace physvib
