// SPDX-License-Identifier: MIT
// Summarises level trials: thresholds from reversals or QUEST+, means in dB or in logarithms.
#include "Lab/Study/LevelTrials.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/QuestPooled.h"
#include "Lab/Study/QuestMethod.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

namespace physvib {
namespace {

/// Levels at which the sequence changes direction.
std::vector<double> reversalsOf(const std::vector<double>& levels) {
    std::vector<double> reversals;
    double last = 0.0;
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        const double change = levels[i + 1] - levels[i];
        if (change == 0.0) continue;
        if (change * last < 0.0) reversals.push_back(levels[i]);
        last = change;
    }
    return reversals;
}

double meanOf(const std::vector<double>& values, std::size_t from = 0) {
    double sum = 0.0;
    for (std::size_t i = from; i < values.size(); ++i) sum += values[i];
    return sum / static_cast<double>(values.size() - from);
}

bool isThreshold(LevelTrial::Kind kind) {
    return kind == LevelTrial::Kind::staircase || kind == LevelTrial::Kind::quest;
}

bool isSame(const LevelSummary& s, const LevelTrial& t) {
    return s.kind == t.kind && s.condition == t.condition &&
           (isThreshold(t.kind) || s.stimulus == t.stimulus);
}

/// Sort key: numbers by value, then all other labels by their bytes.
auto labelKey(const std::string& label) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
    const bool isNumber = error == std::errc{} && end == label.data() + label.size() && std::isfinite(number);
    return std::tuple{!isNumber, isNumber ? number : 0.0, std::string_view{label}};
}

using Run = std::vector<const LevelTrial*>; // one participant's trials of a session

double staircaseThreshold(const Run& run, LevelSummary& summary) {
    std::vector<double> levels;
    for (const LevelTrial* trial : run) levels.push_back(trial->levelDb);
    const auto reversals = reversalsOf(levels);
    summary.reversals += reversals.size();
    summary.flatRuns += reversals.size() < 2 ? 1 : 0;
    return reversals.size() < 2 ? levels.back() : meanOf(reversals, reversals.size() / 2);
}

double questThreshold(const Run& run, LevelSummary& summary) {
    QuestPlus quest{*questPlan(run.front()->quest)};
    for (const LevelTrial* trial : run) quest.answerAt(trial->levelDb, trial->value > 0.5);
    // variances add up: this becomes the half-interval of the sum of thresholds
    summary.halfInterval = std::hypot(summary.halfInterval, quest.thresholdHalfInterval(0.95));
    return quest.estimate().threshold;
}

using SessionKey = std::pair<std::string, std::string>; // session, plan of QUEST+

std::map<SessionKey, Run> runsOf(const Run& trials) {
    std::map<SessionKey, Run> runs;
    for (const LevelTrial* trial : trials) runs[{trial->session, trial->quest}].push_back(trial);
    return runs;
}

std::vector<LevelCount> levelCountsOf(const Run& run) {
    std::map<double, LevelCount> counts;
    for (const LevelTrial* trial : run) {
        LevelCount& count = counts.try_emplace(trial->levelDb, LevelCount{trial->levelDb}).first->second;
        ++count.trials;
        count.hits += trial->value > 0.5;
    }
    std::vector<LevelCount> all;
    for (const auto& [level, count] : counts) all.push_back(count);
    return all;
}

/// Thresholds of several people's runs, in the order of participants and runsOf(). Returns the error that all
/// share, as a standard deviation.
double poolThresholds(const std::map<std::string, Run>& participants, std::vector<std::vector<double>>& own) {
    struct Place {
        std::size_t participant, run;
    };
    std::map<std::string, std::pair<std::vector<std::vector<LevelCount>>, std::vector<Place>>> plans;
    std::size_t total = 0;
    for (const auto& [participant, trials] : participants) {
        auto& thresholds = own.emplace_back();
        for (const auto& [key, run] : runsOf(trials)) {
            auto& [counts, places] = plans[key.second];
            counts.push_back(levelCountsOf(run));
            places.push_back({own.size() - 1, thresholds.size()});
            thresholds.push_back(0.0);
            ++total;
        }
    }
    double deviation = 0.0;
    for (const auto& [words, runs] : plans) {
        const PooledThresholds pooled = pooledThresholds(*questPlan(words), runs.first);
        for (std::size_t r = 0; r < runs.second.size(); ++r)
            own[runs.second[r].participant][runs.second[r].run] = pooled.thresholds[r];
        deviation = std::hypot(deviation, pooled.deviation * static_cast<double>(runs.first.size()) /
                                              static_cast<double>(total));
    }
    return deviation;
}

void summariseThresholds(LevelSummary& summary, const std::map<std::string, Run>& participants) {
    std::vector<std::vector<double>> own;
    double shared = 0.0;
    if (summary.kind == LevelTrial::Kind::quest && participants.size() > 1)
        shared = poolThresholds(participants, own);
    else
        for (const auto& [participant, trials] : participants) {
            auto& thresholds = own.emplace_back();
            for (const auto& [session, run] : runsOf(trials))
                thresholds.push_back(summary.kind == LevelTrial::Kind::quest
                                         ? questThreshold(run, summary)
                                         : staircaseThreshold(run, summary));
            summary.halfInterval /= static_cast<double>(thresholds.size());
        }
    std::vector<double> thresholds;
    for (const auto& [participant, trials] : participants) {
        thresholds.push_back(meanOf(own[thresholds.size()]));
        summary.thresholds.emplace_back(participant, thresholds.back());
    }
    const Moments moments{thresholds};
    summary.estimate = moments.mean;
    summary.deviation = moments.deviation;
    if (thresholds.size() > 1)
        summary.halfInterval = std::hypot(moments.halfInterval(), normalQuantile(0.975) * shared);
}

} // namespace

std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials) {
    std::vector<LevelSummary> summaries;
    for (const LevelTrial& trial : trials)
        if (std::ranges::none_of(summaries, [&](const auto& s) { return isSame(s, trial); }))
            summaries.push_back({trial.kind, trial.condition, isThreshold(trial.kind) ? "" : trial.stimulus});
    std::ranges::stable_sort(summaries, {}, [](const LevelSummary& s) {
        return std::tuple{s.kind, std::string_view{s.condition}, labelKey(s.stimulus)};
    });
    for (LevelSummary& summary : summaries) {
        std::map<std::string, Run> byParticipant;
        std::vector<double> values;
        for (const LevelTrial& trial : trials) {
            if (!isSame(summary, trial)) continue;
            byParticipant[trial.participant].push_back(&trial);
            values.push_back(trial.kind == LevelTrial::Kind::magnitude ? std::log10(trial.value)
                                                                       : trial.value);
        }
        summary.trials = values.size();
        summary.participants = byParticipant.size();
        if (isThreshold(summary.kind)) {
            summariseThresholds(summary, byParticipant);
            continue;
        }
        std::vector<double> means;
        for (const auto& [participant, own] : byParticipant) {
            std::vector<double> adjusted;
            for (const LevelTrial* trial : own) adjusted.push_back(trial->value);
            means.push_back(meanOf(adjusted));
        }
        if (summary.kind == LevelTrial::Kind::adjustment)
            summary.halfInterval = Moments(means).halfInterval();
        summary.deviation = Moments(values).deviation;
        summary.estimate =
            summary.kind == LevelTrial::Kind::magnitude ? std::pow(10.0, meanOf(values)) : meanOf(values);
    }
    return summaries;
}

} // namespace physvib
