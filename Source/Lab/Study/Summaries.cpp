// SPDX-License-Identifier: MIT
// Quantiles by bisection; choices and ratings by name; thresholds from reversals or QUEST+.
#include "Lab/Study/Summaries.h"
#include "Core/EventShaping.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/QuestMethod.h"
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

namespace physvib {
namespace {

/// Where a rising function reaches `target`, to the last bit, between 0 and `upper` > 0.
template <class Function>
double solveRising(Function rising, double target, double upper) {
    double lower = 0.0;
    for (double middle = 0.5 * upper; middle > lower && middle < upper; middle = std::midpoint(lower, upper))
        (rising(middle) < target ? lower : upper) = middle;
    return upper;
}

/// Probability that Student's t lies within -t and t (Abramowitz and Stegun 26.7.3, 26.7.4).
double studentCoverage(double t, std::size_t df) {
    const double root = std::sqrt(static_cast<double>(df)), reach = std::hypot(root, t);
    const double sine = t / reach, cosine = root / reach;
    const bool isOdd = df % 2 == 1;
    double term = isOdd ? cosine : 1.0, sum = 0.0;
    for (std::size_t n = isOdd ? 3 : 2; n <= df; n += 2) {
        sum += term;
        term *= cosine * cosine * static_cast<double>(n - 1) / static_cast<double>(n);
    }
    return isOdd ? 2.0 / std::numbers::pi * (std::atan2(t, root) + sine * sum) : sine * sum;
}

} // namespace

double studentQuantile(double probability, std::size_t df) {
    if (probability < 0.5) return -studentQuantile(1.0 - probability, df);
    return solveRising([df](double t) { return studentCoverage(t, df); }, 2.0 * probability - 1.0, 1e6);
}

double normalQuantile(double probability) {
    const double tail = std::min(probability, 1.0 - probability);
    const double z =
        solveRising([](double x) { return -std::erfc(x / std::numbers::sqrt2); }, -2.0 * tail, 40.0);
    return probability < 0.5 ? -z : z;
}

// Forced choices and ratings.

namespace {

/// 95 % interval of a median by ranks (sign test); for fewer than six values, the range of the values.
RankInterval rankInterval(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto n = static_cast<double>(values.size());
    double rank = 0.0, term = std::exp2(-n); // P(rank of n values lie below the median)
    for (double below = term; below <= 0.025; below += term) term *= (n - rank) / (rank + 1.0), ++rank;
    const auto left = static_cast<std::size_t>(std::max(0.0, rank - 1.0));
    return {values[left], values[values.size() - 1 - left]};
}

/// "pair=wood", "size=very small" of "pair=wood size=very small".
std::vector<std::string> factorTokens(std::string_view condition) {
    std::vector<std::string> words;
    while (!condition.empty()) {
        const std::string_view word = takeUntil(' ', condition);
        const bool isNew = words.empty() || word.find('=') - 1 < word.size();
        if (isNew && !words.empty() && words.back().ends_with(" &"))
            words.back().erase(words.back().size() - 2);
        if (isNew)
            words.emplace_back(word);
        else
            words.back().append(" ").append(word);
    }
    return words;
}

/// The factors in a condition's name: "size=small" of "pair=wood size=small", the letters of a method.
std::set<std::string> findFactors(const std::string& condition) {
    std::set<std::string> factors; // a set, because both stimuli of a pair may have them
    for (std::string_view word : factorTokens(condition)) {
        RenderingMethod method;
        const bool isMethod = parseRenderingMethod(word, method);
        if (word.find('=') != word.npos || (isMethod && word.size() < condition.size()))
            factors.emplace(word);
        while (isMethod && !word.empty()) factors.emplace(takeUntil('-', word));
    }
    return factors;
}

ChoiceShare makeShare(const std::string& alternative, std::uint64_t hits, std::uint64_t trials,
                      const std::vector<double>& shares, bool isKnown) {
    constexpr std::size_t minRankValues = 6; // two values of five cover the median in 94 % of samples
    const double none = std::nan("");
    ChoiceShare share{alternative, hits, trials, shares.size(), none, none};
    if (!isKnown) return share;
    share.share = Moments(shares).mean, share.median = median(shares);
    if (shares.size() >= minRankValues) share.interval = rankInterval(shares);
    if (shares.size() < 2)
        share.interval = RankInterval{proportion(hits, trials).lower, proportion(hits, trials).upper};
    return share;
}

using Alternatives = std::set<std::string, std::less<>>;

/// The alternatives that each trial offered: its parts, else those of its stimulus, else all. `isKnown`
/// becomes false if neither parts nor stimuli determine them.
std::vector<Alternatives> offeredAlternatives(const std::vector<ChoiceTrial>& trials, bool& isKnown) {
    Alternatives all, chosen;
    std::vector<Alternatives> offers;
    std::map<std::string, Alternatives> answers; // by stimulus
    bool areChoicesOffered = true;
    for (const ChoiceTrial& trial : trials) {
        Alternatives& offered = offers.emplace_back();
        for (std::string_view rest = trial.offered; !rest.empty();) offered.emplace(takeUntil('|', rest));
        areChoicesOffered &= offered.empty() || offered.contains(trial.choice);
        all.insert(offered.begin(), offered.end()), chosen.insert(trial.choice);
        answers[trial.stimulus].insert(trial.choice);
    }
    const bool hasParts = !all.empty();
    all.insert(chosen.begin(), chosen.end());
    const std::size_t size = answers.empty() ? 0 : answers.begin()->second.size();
    const bool arePairs =
        !hasParts && size > 1 && size < all.size() && // pairs such as AB, BC, AC
        std::ranges::all_of(answers, [&](const auto& entry) { return entry.second.size() == size; });
    isKnown =
        hasParts || arePairs || all.size() < 3 || // the rule of analysis.R
        std::ranges::any_of(answers, [&](const auto& entry) { return entry.second.size() == all.size(); });
    for (std::size_t i = 0; i < trials.size(); ++i)
        if (!areChoicesOffered || offers[i].empty()) offers[i] = arePairs ? answers[trials[i].stimulus] : all;
    return offers;
}

using OffersByTrial = std::map<const ChoiceTrial*, Alternatives>;

ChoiceSummary summarise(const std::string& condition, const std::vector<const ChoiceTrial*>& trials,
                        const OffersByTrial& offered, bool isKnown) {
    struct Votes {
        std::uint64_t hits = 0, trials = 0;
    };
    std::map<std::string, std::map<std::string, Votes>> votes; // by alternative and participant
    std::set<std::string> people;
    for (const auto* trial : trials) {
        people.insert(trial->participant);
        for (const std::string& alternative : offered.at(trial)) {
            Votes& tally = votes[alternative][trial->participant];
            tally.hits += alternative == trial->choice, ++tally.trials;
        }
    }
    ChoiceSummary summary{condition, people.size(), trials.size(), {}};
    for (const auto& [alternative, byParticipant] : votes) {
        std::vector<double> shares;
        Votes all;
        for (const auto& [participant, tally] : byParticipant) {
            shares.push_back(static_cast<double>(tally.hits) / static_cast<double>(tally.trials));
            all.hits += tally.hits, all.trials += tally.trials;
        }
        summary.shares.push_back(makeShare(alternative, all.hits, all.trials, shares, isKnown));
    }
    return summary;
}

using RatingTrials = std::vector<const RatingTrial*>;

std::vector<double> participantMeans(const RatingTrials& trials, std::size_t scale) {
    std::map<std::string, std::vector<double>> scores;
    for (const auto* trial : trials)
        if (const double score = trial->scores[scale]; !std::isnan(score))
            scores[trial->participant].push_back(score);
    std::vector<double> means;
    for (const auto& [participant, values] : scores) means.push_back(Moments(values).mean);
    return means;
}

/// `isOverParticipants`: deviations and intervals are over participants, else over one participant's trials.
RatingSummary summarise(const std::string& condition, const RatingTrials& trials, bool isOverParticipants) {
    RatingSummary summary{condition, trials.size(), 0, {}, {}, {}, {}, {}, {}};
    for (std::size_t scale = 0; scale < trials.front()->scores.size(); ++scale) {
        std::vector<double> scores;
        for (const auto* trial : trials)
            if (!std::isnan(trial->scores[scale])) scores.push_back(trial->scores[scale]);
        summary.scoreCounts.push_back(scores.size());
        const auto means = participantMeans(trials, scale);
        summary.raterCounts.push_back(means.size());
        summary.participants = std::max(summary.participants, means.size());
        summary.means.push_back(scores.empty() ? std::nan("") : Moments(means).mean);
        summary.medians.push_back(median(means));
        summary.deviations.push_back(Moments(isOverParticipants ? means : scores).deviation);
        summary.halfIntervals.push_back(Moments(isOverParticipants ? means : scores).halfInterval());
    }
    return summary;
}

template <class Trial>
using Groups = std::map<std::string, std::vector<const Trial*>, NaturalOrder>;

template <class Trial>
Groups<Trial> groupByCondition(const std::vector<Trial>& trials) {
    Groups<Trial> conditions;
    for (const Trial& trial : trials) conditions[trial.condition].push_back(&trial);
    return conditions;
}

/// Trials by the factors in the names of their conditions, without factors that are conditions themselves.
template <class Trial>
Groups<Trial> groupByFactor(const std::vector<Trial>& trials, const Groups<Trial>& conditions) {
    Groups<Trial> factors;
    for (const Trial& trial : trials)
        for (const auto& factor : findFactors(trial.condition))
            if (!conditions.contains(factor)) factors[factor].push_back(&trial);
    return factors;
}

} // namespace

std::vector<ChoiceSummary> summariseChoices(const std::vector<ChoiceTrial>& trials) {
    std::vector<const ChoiceTrial*> all;
    OffersByTrial offered;
    bool isKnown = true;
    const auto offers = offeredAlternatives(trials, isKnown);
    for (const auto& trial : trials) offered[&trial] = offers[all.size()], all.push_back(&trial);
    std::vector<ChoiceSummary> summaries;
    if (all.empty()) return summaries;
    summaries.push_back(summarise("all", all, offered, isKnown));
    const auto conditions = groupByCondition(trials);
    if (conditions.size() < 2) return summaries;
    for (const auto& groups : {groupByFactor(trials, conditions), conditions})
        for (const auto& [name, group] : groups)
            summaries.push_back(summarise(name, group, offered, isKnown));
    return summaries;
}

std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials) {
    std::vector<RatingSummary> summaries;
    const bool isOverParticipants = std::ranges::any_of(
        trials, [&](const RatingTrial& trial) { return trial.participant != trials.front().participant; });
    for (const auto& [condition, group] : groupByCondition(trials))
        summaries.push_back(summarise(condition, group, isOverParticipants));
    return summaries;
}

// Levels.

namespace {

/// Levels at which the sequence changes direction.
std::vector<double> findReversals(const std::vector<double>& levels) {
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

using Run = std::vector<const LevelTrial*>; // one participant's trials of a session, or of one staircase

/// NaN if there are fewer than two reversals; -infinity or infinity if half of the later reversals, or of all
/// trials, are at the lower or upper end of the levels (if known).
double staircaseThreshold(const Run& run) {
    std::vector<double> levels;
    for (const LevelTrial* trial : run) levels.push_back(trial->levelDb);
    const auto reversals = findReversals(levels);
    if (reversals.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    const std::span later{reversals.begin() + static_cast<std::ptrdiff_t>(reversals.size() / 2),
                          reversals.end()};
    const auto& range = run.front()->range;
    const auto isAtLowerEnd = [&](double level) { return range && level <= range->first; };
    const auto isAtEnd = [&](double level) {
        return range && (isAtLowerEnd(level) || level >= range->second);
    };
    const auto reversalsAtEnd = std::ranges::count_if(later, isAtEnd),
               trialsAtEnd = std::ranges::count_if(levels, isAtEnd);
    if (2 * static_cast<std::size_t>(reversalsAtEnd) < later.size() && 2 * trialsAtEnd < std::ssize(levels))
        return meanOf(reversals, reversals.size() / 2);
    const double beyond = std::numeric_limits<double>::infinity();
    return 2 * std::ranges::count_if(levels, isAtLowerEnd) >= trialsAtEnd ? -beyond : beyond;
}

double questThreshold(const Run& run, LevelSummary& summary) {
    QuestPlus quest{*questPlan(run.front()->quest)};
    for (const LevelTrial* trial : run) quest.answerAt(trial->levelDb, trial->value > 0.5);
    // variances add up, so this becomes the half-interval of the sum of thresholds
    summary.halfInterval =
        std::hypot(summary.halfInterval, normalQuantile(0.975) * quest.thresholdDeviation());
    return quest.estimate().threshold;
}

using SessionKey = std::pair<std::string, std::string>; // session, plan of QUEST+

std::map<SessionKey, Run> groupRuns(const Run& trials) {
    std::map<SessionKey, Run> runs;
    for (const LevelTrial* trial : trials) runs[{trial->session, trial->quest}].push_back(trial);
    return runs;
}

/// Thresholds of several people's runs, in the order of participants and their runs. Returns the error that
/// all share, as a standard deviation.
double poolThresholds(const std::map<std::string, Run>& participants,
                      std::vector<std::vector<double>>& runThresholds) {
    struct RunIndex {
        std::size_t participant, run;
    };
    std::map<std::string, std::pair<std::vector<std::vector<LevelCount>>, std::vector<RunIndex>>> plans;
    std::size_t total = 0;
    for (const auto& [participant, trials] : participants) {
        auto& thresholds = runThresholds.emplace_back();
        for (const auto& [key, run] : groupRuns(trials)) {
            auto& [counts, indices] = plans[key.second];
            counts.push_back(countByLevel(run, [](const LevelTrial* t) {
                return std::pair{t->levelDb, t->value > 0.5};
            }));
            indices.push_back({runThresholds.size() - 1, thresholds.size()});
            thresholds.push_back(0.0);
            ++total;
        }
    }
    double deviation = 0.0;
    for (const auto& [words, runs] : plans) {
        const PooledThresholds pooled = pooledThresholds(*questPlan(words), runs.first);
        for (std::size_t r = 0; r < runs.second.size(); ++r)
            runThresholds[runs.second[r].participant][runs.second[r].run] = pooled.thresholds[r];
        deviation = std::hypot(deviation, pooled.deviation * static_cast<double>(runs.first.size()) /
                                              static_cast<double>(total));
    }
    return deviation;
}

/// Why the trials give no threshold, staircase by staircase; empty if they do.
std::string noThresholdReason(LevelTrial::Kind kind, const Run& trials, double threshold,
                              const std::vector<double>& runThresholds) {
    if (kind == LevelTrial::Kind::staircase) {
        std::string words;
        std::size_t at = 0, reasonCount = 0;
        for (const auto& [key, run] : groupRuns(trials)) {
            const double runThreshold = runThresholds[at++];
            if (std::isfinite(runThreshold)) continue;
            const std::size_t slash = key.first.rfind('/');
            words += (reasonCount++ > 0 ? "; " : "") +
                     (runThresholds.size() == 1    ? std::string{"a staircase"}
                      : slash == std::string::npos ? "the staircase of " + key.first
                                                   : "staircase " + key.first.substr(slash + 1) + " of " +
                                                         key.first.substr(0, slash)) +
                     (std::isnan(runThreshold)
                          ? " has fewer than two reversals"
                          : " had half or more of its trials, or of the reversals that count, at the " +
                                std::string{runThreshold < 0.0 ? "lower" : "upper"} + " end of its levels");
        }
        return words;
    }
    double lower = -std::numeric_limits<double>::max(), upper = std::numeric_limits<double>::max();
    for (const LevelTrial* trial : trials) {
        const auto levels = questPlan(trial->quest)->levels;
        const double step = levels.size() > 1 ? levels[1] - levels[0] : 0.0;
        lower = std::max(lower, levels.front() + 0.5 * step),
        upper = std::min(upper, levels.back() - 0.5 * step);
    }
    if (threshold >= lower && threshold <= upper) return {};
    return std::string{"threshold at the "} + (threshold < lower ? "lower" : "upper") +
           " end of the levels of QUEST+";
}

void summariseThresholds(LevelSummary& summary, const std::map<std::string, Run>& participants) {
    std::vector<std::vector<double>> runThresholds;
    double sharedDeviation = 0.0;
    if (summary.kind == LevelTrial::Kind::quest && participants.size() > 1)
        sharedDeviation = poolThresholds(participants, runThresholds);
    else
        for (const auto& [participant, trials] : participants) {
            auto& thresholds = runThresholds.emplace_back();
            for (const auto& [session, run] : groupRuns(trials))
                thresholds.push_back(summary.kind == LevelTrial::Kind::quest ? questThreshold(run, summary)
                                                                             : staircaseThreshold(run));
            summary.halfInterval /= static_cast<double>(thresholds.size());
        }
    std::vector<double> thresholds;
    std::size_t at = 0;
    for (const auto& [participant, trials] : participants) {
        const double threshold = meanOf(runThresholds[at++]);
        if (const auto reason = noThresholdReason(summary.kind, trials, threshold, runThresholds[at - 1]);
            !reason.empty()) {
            summary.excluded.emplace_back(participant, reason);
            summary.trials -= trials.size();
            continue;
        }
        thresholds.push_back(threshold);
        summary.thresholds.emplace_back(participant, threshold);
    }
    summary.participants = thresholds.size();
    const Moments moments{thresholds};
    summary.estimate = thresholds.empty() ? std::numeric_limits<double>::quiet_NaN() : moments.mean;
    summary.deviation = moments.deviation;
    if (thresholds.size() > 1)
        summary.halfInterval = std::hypot(moments.halfInterval(), normalQuantile(0.975) * sharedDeviation);
}

} // namespace

std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials) {
    std::vector<LevelSummary> summaries;
    for (const LevelTrial& trial : trials)
        if (std::ranges::none_of(summaries, [&](const auto& s) { return isSame(s, trial); }))
            summaries.push_back({trial.kind, trial.condition, isThreshold(trial.kind) ? "" : trial.stimulus});
    std::ranges::stable_sort(summaries, [](const LevelSummary& a, const LevelSummary& b) {
        if (a.kind != b.kind) return a.kind < b.kind;
        return a.condition != b.condition ? NaturalOrder{}(a.condition, b.condition)
                                          : NaturalOrder{}(a.stimulus, b.stimulus);
    });
    for (LevelSummary& summary : summaries) {
        std::map<std::string, Run> trialsByParticipant;
        for (const LevelTrial& trial : trials)
            if (isSame(summary, trial))
                trialsByParticipant[trial.participant].push_back(&trial), ++summary.trials;
        summary.participants = trialsByParticipant.size();
        if (isThreshold(summary.kind)) {
            summariseThresholds(summary, trialsByParticipant);
            continue;
        }
        const bool isMagnitude = summary.kind == LevelTrial::Kind::magnitude;
        std::vector<double> means, values;
        for (const auto& [participant, participantTrials] : trialsByParticipant) {
            values.clear();
            for (const LevelTrial* trial : participantTrials)
                values.push_back(isMagnitude ? std::log10(trial->value) : trial->value);
            means.push_back(meanOf(values));
        }
        const Moments moments{means.size() > 1 ? means : values};
        if (!isMagnitude) summary.halfInterval = Moments(means).halfInterval();
        summary.deviation = moments.deviation;
        summary.estimate = isMagnitude ? std::pow(10.0, moments.mean) : moments.mean;
    }
    return summaries;
}

} // namespace physvib
