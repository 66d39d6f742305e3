// SPDX-License-Identifier: MIT
// Stimulus level controlled by the participant's answers, with a staircase or QUEST+ as the session
// specifies.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Staircase.h"
#include "Stimuli/SeededRandom.h"
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

/// Staircases whose trials are mixed.
class Staircases {
public:
    explicit Staircases(const StaircasePlan& plan) {
        for (const double startDb : plan.starts()) all_.emplace_back(plan, startDb);
    }

    double levelDb() const noexcept { return all_[at_].levelDb(); }
    bool isDone() const { return std::ranges::all_of(all_, &Staircase::isDone); }
    void answer(bool isCorrect) { all_[at_].answer(isCorrect); }

    std::size_t count() const noexcept { return all_.size(); }
    void choose(std::size_t staircase) noexcept { at_ = std::min(staircase, all_.size() - 1); }
    /// One that is not over. Precondition: !isDone().
    std::size_t draw(SeededRandom& random) const {
        std::size_t drawn = random.below(all_.size());
        while (all_[drawn].isDone()) drawn = random.below(all_.size());
        return drawn;
    }

private:
    std::vector<Staircase> all_;
    std::size_t at_ = 0;
};

/// Not thread-safe: use from one thread at a time.
class AdaptiveLevel {
public:
    /// Precondition: `session` has a staircase or QUEST+.
    explicit AdaptiveLevel(const SessionPlan& session)
        : method_{session.staircase ? Method{Staircases{*session.staircase}}
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
    /// The staircases, where there are several; else null.
    Staircases* mixed() noexcept {
        auto* const staircases = std::get_if<Staircases>(&method_);
        return staircases != nullptr && staircases->count() > 1 ? staircases : nullptr;
    }
    /// Number of trials in the run; 0 if the answers decide when it ends.
    int trials() const noexcept {
        const auto* const quest = std::get_if<QuestTrials>(&method_);
        return quest == nullptr ? 0 : quest->trials();
    }

private:
    using Method = std::variant<Staircases, QuestTrials>;
    Method method_;
};

} // namespace physvib
