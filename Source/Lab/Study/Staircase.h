// SPDX-License-Identifier: MIT
// Transformed up-down staircase (Levitt 1971): converges to the level at which a run of `down` correct
// answers has probability one half.
#pragma once
#include "Lab/Study/Protocol.h"
#include <algorithm>
#include <vector>

namespace physvib {

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

private:
    StaircasePlan plan_;
    double levelDb_, stepDb_;
    int trials_ = 0, inARow_ = 0, lastDirection_ = 0;
    std::vector<double> reversals_;
};

} // namespace physvib
