// SPDX-License-Identifier: MIT
// How often 95 % intervals hold, and how often studies without any difference find one, by simulation.
// Minutes; by hand and every night. Exit code 1 beyond 93 to 97 %, or above 5 % of false findings by more
// than chance.
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Places.h"
#include "Lab/Study/Psychometric.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace physvib {
namespace {

constexpr double meanThreshold = 10.0, width = 6.0, lapse = 0.02;
constexpr double perPersonDb = 1.5; // standard deviation of thresholds over participants

enum class Method { constant, staircase, quest };
constexpr const char* methodNames[] = {"constant stimuli", "staircase", "QUEST+"};

PsychometricFunction person(SeededRandom& random, bool isOfPrior) {
    // one person's interval of QUEST+ is Bayesian: it holds for people of its prior
    const double threshold =
        isOfPrior ? 20.25 * random.uniform() - 0.125 : meanThreshold + perPersonDb * random.normal();
    return {PsychometricShape::weibull, threshold, isOfPrior ? 2.0 + 18.0 * random.uniform() : width, 0.5,
            lapse};
}

SessionPlan sessionOf(Method method) {
    SessionPlan session;
    session.alternatives = {{"a", 0.0}, {"b", 0.0}};
    if (method == Method::staircase) {
        session.staircase.emplace();
        session.staircase->startDb = 16.0;
        session.staircase->minDb = -10.0;
        session.staircase->reversals = 12;
    } else if (method == Method::quest)
        session.quest.emplace();
    return session;
}

/// True if a study's interval of the mean threshold holds the true one. Adds the mean's error (dB) to `off`.
bool holds(Method method, int people, SeededRandom& random, double& off) {
    const SessionPlan session = sessionOf(method);
    std::vector<LevelTrial> trials;
    std::vector<double> fitted;
    double truth = meanThreshold;
    for (int p = 0; p < people; ++p) {
        const PsychometricFunction observer = person(random, people == 1);
        if (people == 1) truth = observer.threshold;
        if (method == Method::constant) {
            std::vector<LevelCount> counts;
            for (int i = 0; i < 8; ++i) {
                LevelCount& count = counts.emplace_back(LevelCount{4.0 + 1.75 * i, 0, 30});
                for (int t = 0; t < 30; ++t) count.hits += random.chance(observer.probability(count.level));
            }
            if (const auto fit = fitPsychometric(counts, {observer.shape, 0.5, lapse}); fit.error.empty())
                fitted.push_back(fit.function.threshold);
            continue;
        }
        for (AdaptiveLevel level{session}; !level.isDone();) {
            const bool isCorrect = random.chance(observer.probability(level.levelDb()));
            trials.push_back({method == Method::quest ? LevelTrial::Kind::quest : LevelTrial::Kind::staircase,
                              std::to_string(p), "c", "", level.levelDb(), isCorrect ? 1.0 : 0.0, "s",
                              session.quest ? questText(*session.quest, 0.5) : std::string{}});
            level.answer(isCorrect);
        }
        if (method == Method::staircase) // two down, one up comes to 70.7 %
            truth = meanThreshold + observer.levelAt(std::sqrt(0.5)) - observer.threshold;
    }
    if (method == Method::constant) {
        const Moments interval{fitted};
        off += interval.mean - truth;
        return interval.lowerLimit() <= truth && truth <= interval.upperLimit();
    }
    const LevelSummary summary = summariseLevels(trials).front();
    off += summary.estimate - truth;
    return std::abs(summary.estimate - truth) <= summary.halfInterval;
}

int run(int studies) {
    bool isGood = true;
    SeededRandom random{1, "coverage"};
    const auto say = [&](const char* what, int people, int held) {
        const double percent = 100.0 * held / studies, slack = 2.0 * std::sqrt(95.0 * 5.0 / studies);
        isGood &= percent >= 93.0 - slack && percent <= 97.0 + slack;
        std::printf("%-28s %3d people  %5.1f %% of %d\n", what, people, percent, studies),
            std::fflush(stdout);
    };
    for (const auto& [method, all] : std::map<Method, std::vector<int>>{{Method::constant, {2, 6, 12, 60}},
                                                                        {Method::staircase, {2, 6, 12, 60}},
                                                                        {Method::quest, {1, 6, 12, 60}}})
        for (const int people : all) {
            int held = 0;
            double off = 0.0;
            for (int study = 0; study < studies; ++study) held += holds(method, people, random, off);
            say(methodNames[static_cast<int>(method)], people, held);
            std::printf("%42s %+.2f dB\n", "bias", off / studies);
        }
    std::puts(isGood ? "intervals hold" : "BEYOND what is said");
    return isGood ? 0 : 1;
}

} // namespace
} // namespace physvib

int main(int count, char** words) { return physvib::run(count > 1 ? std::atoi(words[1]) : 1000); }
