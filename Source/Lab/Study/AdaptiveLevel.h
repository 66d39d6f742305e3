// SPDX-License-Identifier: MIT
// Stimulus level controlled by the participant's answers, with a transformed up-down staircase or QUEST+ as
// the session specifies.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace physvib {

// Transformed up-down staircase (Levitt 1971): converges to the level at which a run of `down` correct
// answers has probability one half.

class Staircase {
public:
    explicit Staircase(const StaircasePlan& plan)
        : Staircase{plan, plan.startDb} {}
    Staircase(const StaircasePlan& plan, double startDb)
        : plan_{plan}
        , levelDb_{startDb}
        , stepDb_{plan.stepDb} {}

    double levelDb() const noexcept { return levelDb_; }
    bool isDone() const noexcept {
        return trials_ >= plan_.mostTrials || static_cast<int>(reversals_.size()) >= plan_.reversals;
    }

    void answer(bool isCorrect) {
        ++trials_;
        if (isCorrect && ++inARow_ < plan_.down) return;
        inARow_ = 0;
        const int direction = isCorrect ? -1 : 1;
        if (lastDirection_ != 0 && direction != lastDirection_) {
            reversals_.push_back(levelDb_);
            stepDb_ = std::max(plan_.leastStepDb, 0.5 * stepDb_);
        }
        lastDirection_ = direction;
        levelDb_ = std::clamp(levelDb_ + (direction > 0 ? plan_.upRatio : -1.0) * stepDb_, plan_.leastDb,
                              plan_.mostDb);
    }

    const std::vector<double>& reversals() const noexcept { return reversals_; }
    /// "ended at 40 trials with 5 of 6 reversals"; else empty.
    std::string cutShort() const {
        const int found = static_cast<int>(reversals_.size());
        return !isDone() || found >= plan_.reversals
                   ? std::string{}
                   : "ended at " + std::to_string(plan_.mostTrials) + " trials with " +
                         std::to_string(found) + " of " + std::to_string(plan_.reversals) + " reversals";
    }

private:
    StaircasePlan plan_;
    double levelDb_, stepDb_;
    int trials_ = 0, inARow_ = 0, lastDirection_ = 0;
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
        return std::visit([](const auto& m) { return m.levelDb(); }, methods_[at_]);
    }
    bool isDone() const { return std::ranges::all_of(methods_, isOver); }
    /// Of staircases that ended before their reversals; else empty.
    std::string cutShort() const {
        std::string words;
        for (std::size_t i = 0; i < methods_.size(); ++i)
            if (const auto* const one = std::get_if<Staircase>(&methods_[i]); one && !one->cutShort().empty())
                words += (words.empty() ? "" : "; ") +
                         (methods_.size() > 1 ? "staircase " + std::to_string(i + 1) : "the staircase") +
                         " " + one->cutShort();
        return words;
    }
    void answer(bool isCorrect) {
        std::visit([=](auto& m) { m.answer(isCorrect); }, methods_[at_]);
    }
    /// The next answer is of that staircase, from 0; of the last if there are not as many.
    void choose(std::size_t staircase) noexcept { at_ = std::min(staircase, methods_.size() - 1); }
    /// Chooses one that is not over, at random; its number from 1, or 0 if there is only one. Precondition:
    /// !isDone().
    std::size_t draw(SeededRandom& random) {
        if (methods_.size() == 1) return 0;
        do at_ = random.below(methods_.size());
        while (isOver(methods_[at_]));
        return at_ + 1;
    }
    /// Number of trials in the run; 0 if the answers decide when it ends.
    int trials() const noexcept {
        const auto* const quest = std::get_if<QuestTrials>(&methods_.front());
        return quest == nullptr ? 0 : quest->trials();
    }

private:
    using Method = std::variant<Staircase, QuestTrials>;
    static bool isOver(const Method& method) {
        return std::visit([](const auto& m) { return m.isDone(); }, method);
    }
    std::vector<Method> methods_;
    std::size_t at_ = 0;
};

} // namespace physvib
