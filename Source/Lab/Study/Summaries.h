// SPDX-License-Identifier: MIT
// Summary statistics of each condition: means, shares and thresholds, with 95 % intervals. The unit is the
// participant: the trials of each are averaged first, so that many trials do not count as many people.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

// Quantiles of Student's and the normal distribution. Any thread. Preconditions: 0 < probability < 1; df > 0.
double studentQuantile(double probability, std::size_t df);
double normalQuantile(double probability);

/// Median (mean of the two middle values if the count is even); 0 if empty. Any thread.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

struct RankInterval {
    double lower = 0.0, upper = 0.0;
};

struct Moments {
    std::size_t n = 0;
    double mean = 0.0;
    double deviation = 0.0; ///< sample standard deviation; 0 for fewer than two values
    /// Moments of these values. Any thread.
    explicit Moments(std::span<const double> values) noexcept
        : n{values.size()} {
        for (const double v : values) mean += v / static_cast<double>(n);
        for (const double v : values) deviation += (v - mean) * (v - mean);
        const bool isRounding = deviation <= 1e-24 * static_cast<double>(n) * mean * mean; // of equal values
        deviation = n > 1 && !isRounding ? std::sqrt(deviation / static_cast<double>(n - 1)) : 0.0;
    }
    /// Standard error of the mean; 0 for fewer than two values.
    double standardError() const noexcept {
        return n > 1 ? deviation / std::sqrt(static_cast<double>(n)) : 0.0;
    }
    /// Half of the 95 % interval by Student's t; 0 for fewer than two values.
    double halfInterval() const { return n > 1 ? studentQuantile(0.975, n - 1) * standardError() : 0.0; }
    double lowerLimit() const { return mean - halfInterval(); }
    double upperLimit() const { return mean + halfInterval(); }
};

/// The trials of each participant, in the order of first trials. Any thread (allocates).
template <class Trial>
std::vector<std::pair<std::string, std::vector<Trial>>> groupByParticipant(const std::vector<Trial>& trials) {
    std::map<std::string_view, std::size_t> indices;
    std::vector<std::pair<std::string, std::vector<Trial>>> groups;
    for (const Trial& trial : trials) {
        const auto [entry, isNew] = indices.try_emplace(trial.participant, groups.size());
        if (isNew) groups.emplace_back(trial.participant, std::vector<Trial>{});
        groups[entry->second].second.push_back(trial);
    }
    return groups;
}

/// Share of trials, with its confidence interval.
struct Proportion {
    std::uint64_t hits = 0, trials = 0;
    double share = 0.0;              ///< hits / trials; 0 without a trial
    double lower = 0.0, upper = 1.0; ///< 95 % confidence interval (Wilson 1927), assuming independent trials
};

/// The share of `hits` (<= `trials`) in `trials`. Any thread.
inline Proportion proportion(std::uint64_t hits, std::uint64_t trials) noexcept {
    Proportion result{hits, trials};
    if (trials == 0) return result;
    constexpr double z = 1.959963984540054; // 97.5 % quantile of the normal distribution
    const auto n = static_cast<double>(trials);
    const double p = static_cast<double>(hits) / n;
    const double middle = p + z * z / (2.0 * n),
                 half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    const double scale = 1.0 + z * z / n;
    result.share = p;
    result.lower = std::max(0.0, (middle - half) / scale);
    result.upper = std::min(1.0, (middle + half) / scale);
    return result;
}

// Summaries of forced choices and slider ratings by condition (thesis 5.2, 5.3).

/// One forced choice: alternative, condition and participant (which may be empty).
struct ChoiceTrial {
    std::string participant, condition, choice;
    std::string offered{}; ///< its alternatives, "a|b|c"; empty: inferred from stimuli, else all
    std::string stimulus{};
};

/// How often an alternative was chosen. The unit is the participant, whose trials give one share.
struct ChoiceShare {
    std::string alternative;
    std::uint64_t hits = 0, trials = 0;     ///< times chosen; trials that offered it
    std::size_t participants = 0;           ///< number of people to whom it was offered
    double share = 0.0, median = 0.0;       ///< over the participants' shares; NaN: the offer is unknown
    std::optional<RankInterval> interval{}; ///< 95 %: of the median by ranks for six or more participants;
                                            ///< for one, Wilson's over trials
};

struct ChoiceSummary {
    std::string condition; ///< "all": all conditions of a session together
    std::size_t participants = 0;
    std::uint64_t trials = 0;
    std::vector<ChoiceShare> shares; ///< shares of the offered alternatives, sorted by name

    const ChoiceShare* findShare(std::string_view alternative) const noexcept {
        const auto found = std::ranges::find(shares, alternative, &ChoiceShare::alternative);
        return found == shares.end() ? nullptr : &*found;
    }
};

/// First all trials together. With several conditions, then each factor of names like "pair=wood size=small"
/// and each condition, sorted by name. Any thread (allocates).
std::vector<ChoiceSummary> summariseChoices(const std::vector<ChoiceTrial>& trials);

/// One rating trial: a score per scale.
struct RatingTrial {
    std::string participant, condition;
    std::vector<double> scores; ///< NaN: a scale that was not asked
};

struct RatingSummary {
    std::string condition;
    std::size_t trials = 0, participants = 0;
    std::vector<std::size_t> scoreCounts, raterCounts; ///< per scale: trials with a score, and people
    std::vector<double> means, medians, deviations;    ///< over participants, or over the trials of a
                                                       ///< single one; NaN: not asked
    std::vector<double> halfIntervals; ///< 95 %: t interval over participants' means, or over trials if
                                       ///< participants are unknown; 0 for one value
};

/// Each condition by name. Precondition: every trial has the same number of scores. Any thread (allocates).
std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials);

// Staircases, adjustments, magnitude estimations and QUEST+: thresholds, levels, magnitudes per condition.

/// One trial of a staircase, an adjustment, a magnitude estimation or QUEST+.
struct LevelTrial {
    enum class Kind { staircase, adjustment, magnitude, quest };
    Kind kind = Kind::staircase;
    std::string participant, condition, stimulus;
    double levelDb = 0.0;           ///< staircase, QUEST+: level of the trial
    double value = 0.0;             ///< adjustment: dB; magnitude: > 0; else 1 if correct, 0 if not
    std::string session{}, quest{}; ///< QUEST+: the text of its plan (QuestMethod.h)
    std::optional<std::pair<double, double>> range{}; ///< staircase: its minimum and maximum level, if known
};

struct LevelSummary {
    LevelTrial::Kind kind = LevelTrial::Kind::staircase;
    std::string condition, stimulus; ///< stimulus is empty for staircases and QUEST+, which pool all stimuli
    std::size_t trials = 0, participants = 0;
    std::vector<std::pair<std::string, std::string>> excluded{}; ///< participants without a threshold, and
                                                                 ///< why
    double estimate = 0.0;  ///< staircase, QUEST+: mean threshold in dB; adjustment: mean dB; magnitude:
                            ///< geometric mean; NaN: no participant has a threshold
    double deviation = 0.0; ///< sample standard deviation over participants of thresholds, dB, or log10; of
                            ///< one participant over trials; 0 for one value
    double halfInterval = 0.0; ///< 95 % half-interval of thresholds and adjustments over participants; for
                               ///< one QUEST+ participant from the posterior; else 0
    std::vector<std::pair<std::string, double>> thresholds{}; ///< staircase, QUEST+: per participant, in dB
};

/// Sorted by kind, condition and stimulus. A staircase threshold is the mean level of the later half of the
/// reversals (Levitt 1971). Left out: staircases of fewer than two, and staircases and QUEST+ at an end of
/// their levels. A QUEST+ threshold is the posterior mean, recomputed from levels and answers; for several
/// participants, their widths are estimated together (QuestMethod.h). Several sessions of a participant are
/// averaged. Any thread (allocates).
std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials);

} // namespace physvib
