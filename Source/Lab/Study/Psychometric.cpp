// SPDX-License-Identifier: MIT
// Maximum-likelihood fit of threshold, width and lapse rate.
// Steps: 1. Evaluate a coarse grid. 2. Start Nelder and Mead's simplex (1965) at the best point of each
// width, because there may be several maxima. 3. Restart it once at the best of all, because it may have
// collapsed on a slope. Search units: the range of the levels is 1, the width is logarithmic, and the lapse
// rate is kept in bounds by a cosine.
#include "Lab/Study/Psychometric.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace physvib {
namespace {

const double logisticSpan = 2.0 * std::log(19.0); // width of its argument from F = 0.05 to 0.95
constexpr double normalSpan = 3.289707253902943;  // 2 x 1.644853626951472
const double weibullSpan = std::log(-std::log(0.05)) - std::log(-std::log(0.95));

/// F: 0.5 at `x` = 0; rises from 0.05 to 0.95 over a width of 1.
double standardFunction(PsychometricShape shape, double x) noexcept {
    if (shape == PsychometricShape::logistic) return 1.0 / (1.0 + std::exp(-logisticSpan * x));
    if (shape == PsychometricShape::normal) return 0.5 * std::erfc(-normalSpan * x / std::numbers::sqrt2);
    return -std::expm1(-std::numbers::ln2 * std::exp(weibullSpan * x));
}

double standardQuantile(PsychometricShape shape, double share) {
    if (shape == PsychometricShape::logistic) return std::log(share / (1.0 - share)) / logisticSpan;
    if (shape == PsychometricShape::normal) return normalQuantile(share) / normalSpan;
    return std::log(-std::log1p(-share) / std::numbers::ln2) / weibullSpan;
}

using Point = std::array<double, 3>; // threshold, log of the width, lapse, each in search units

/// Objective function of the fit: maps a point to a psychometric function and to its likelihood.
class Likelihood {
public:
    Likelihood(std::span<const LevelCount> counts, const PsychometricModel& model)
        : counts_{counts}
        , model_{model} {
        const auto [low, high] = std::ranges::minmax(counts, {}, &LevelCount::level);
        minLevel_ = low.level;
        range_ = high.level - low.level;
    }
    PsychometricFunction function(const Point& point) const {
        // The cosine maps any real number to a lapse rate within its bounds.
        const double lapse = model_.maxFittedLapseRate() * 0.5 * (1.0 - std::cos(point[2]));
        return model_.functionWith(minLevel_ + range_ * point[0], range_ * std::exp(point[1]), lapse);
    }
    /// Negative log-likelihood.
    double operator()(const Point& point) const {
        if (point[0] < -3.0 || point[0] > 4.0 || point[1] < std::log(1e-3) || point[1] > std::log(20.0))
            return std::numeric_limits<double>::max();
        return -logLikelihood(counts_, function(point));
    }

private:
    std::span<const LevelCount> counts_;
    PsychometricModel model_;
    double minLevel_ = 0.0, range_ = 1.0;
};

Point bestGridPoint(const Likelihood& likelihood, double width) {
    Point best{};
    double minValue = std::numeric_limits<double>::max();
    for (double threshold = -0.25; threshold < 1.3; threshold += 0.125)
        for (const double lapse : {0.5, 1.5}) {
            const Point point{threshold, std::log(width), lapse};
            if (const double value = likelihood(point); value < minValue) minValue = value, best = point;
        }
    return best;
}

Point interpolate(const Point& a, const Point& b, double share) {
    Point point{};
    for (std::size_t i = 0; i < point.size(); ++i) point[i] = a[i] + share * (b[i] - a[i]);
    return point;
}

/// Runs the simplex until its corners have nearly equal values, and returns the best. Shares of the way from
/// the worst corner to the centre of the others: 2 mirrors it, 3 expands, 1.5 and 0.5 contract.
Point nelderMead(const Likelihood& likelihood, const Point& start) {
    struct Corner {
        Point point{};
        double value = 0.0;
    };
    std::array<Corner, 4> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i].point = start;
        if (i > 0) corners[i].point[i - 1] += 0.2;
        corners[i].value = likelihood(corners[i].point);
    }
    constexpr int maxSteps = 1000;
    for (int step = 0; step < maxSteps; ++step) {
        std::ranges::sort(corners, {}, &Corner::value);
        Corner& worst = corners.back();
        if (worst.value - corners.front().value < 1e-10) break;
        Point centre{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t c = 0; c < 3; ++c) centre[i] += corners[c].point[i] / 3.0;
        const auto cornerAt = [&](double share) {
            const Point point = interpolate(worst.point, centre, share);
            return Corner{point, likelihood(point)};
        };
        const Corner mirrored = cornerAt(2.0);
        if (mirrored.value < corners.front().value) {
            const Corner farther = cornerAt(3.0);
            worst = farther.value < mirrored.value ? farther : mirrored;
        } else if (mirrored.value < corners[2].value) {
            worst = mirrored;
        } else if (const Corner nearer = cornerAt(mirrored.value < worst.value ? 1.5 : 0.5);
                   nearer.value < std::min(worst.value, mirrored.value)) {
            worst = nearer;
        } else {
            for (std::size_t c = 1; c < corners.size(); ++c) {
                corners[c].point = interpolate(corners.front().point, corners[c].point, 0.5);
                corners[c].value = likelihood(corners[c].point);
            }
        }
    }
    return std::ranges::min(corners, {}, &Corner::value).point;
}

std::string countsError(std::span<const LevelCount> counts) {
    if (counts.empty()) return "expected trials, found none";
    const auto [low, high] = std::ranges::minmax(counts, {}, &LevelCount::level);
    if (low.level == high.level) return "expected trials at two or more levels, found one";
    const auto share = [](const LevelCount& c) {
        return static_cast<double>(c.hits) / static_cast<double>(c.trials);
    };
    const auto [lowest, highest] = std::ranges::minmax(counts, {}, share);
    if (share(lowest) == share(highest))
        return "expected answers that change with the level, found the same share at every one";
    return {};
}

constexpr double likelihoodTolerance = 0.01; // tolerance of the log-likelihood

/// Maximum-likelihood lapse rate of a step at `level`, from the answers on both sides.
double stepLapseRate(std::span<const LevelCount> counts, const PsychometricModel& model, double level,
                     bool isRisenAt) {
    double lapses = 0.0, trials = 0.0;
    for (const LevelCount& c : counts) {
        const bool isAbove = c.level > level || (isRisenAt && c.level == level);
        if (!isAbove && (model.guess > 0.0 || c.level == level)) continue; // guesses hide lapses
        trials += static_cast<double>(c.trials);
        lapses += static_cast<double>(isAbove ? c.trials - c.hits : c.hits);
    }
    return trials > 0.0 ? std::min(lapses / trials, model.maxFittedLapseRate()) : 0.0;
}

/// If a step is as likely as `f`: the lowest and highest threshold of such steps. Then the answers do not
/// determine the width, and `f` becomes the likeliest function half way between these thresholds.
std::optional<std::pair<double, double>> stepThresholdRange(std::span<const LevelCount> counts,
                                                            const PsychometricModel& model,
                                                            PsychometricFunction& f, double maxLog) {
    const double range = counts.back().level - counts.front().level;
    std::vector<double> thresholds;
    for (double width = 1e-3 * range; width < range; width *= 1.1) {
        for (const LevelCount& c : counts)
            for (const double lapse : {f.lapse, stepLapseRate(counts, model, c.level, false),
                                       stepLapseRate(counts, model, c.level, true)})
                for (const std::uint64_t hits : {std::uint64_t{0}, c.hits, c.trials}) { // at this level or
                                                                                        // beside it
                    PsychometricFunction step = model.functionWith(c.level, width, lapse);
                    const double share =
                        (static_cast<double>(hits) / static_cast<double>(c.trials) - step.guess) /
                        (1.0 - step.guess - lapse);
                    step.threshold -=
                        width * standardQuantile(model.shape, std::clamp(share, 1e-4, 1.0 - 1e-4));
                    if (logLikelihood(counts, step) > maxLog - likelihoodTolerance)
                        thresholds.push_back(step.threshold);
                }
        if (thresholds.empty()) return {}; // no step fits
    }
    const auto [low, high] = std::ranges::minmax(thresholds);
    const double middle = std::midpoint(low, high);
    const std::array lapses{f.lapse, stepLapseRate(counts, model, middle, false)};
    f = model.functionWith(middle, 1e-3 * range, f.lapse);
    for (double width = 1e-3 * range; width < range; width *= 1.1)
        for (const double lapse : lapses)
            if (const auto step = model.functionWith(middle, width, lapse);
                logLikelihood(counts, step) > logLikelihood(counts, f))
                f = step;
    return std::pair{low, high};
}

/// Error if the levels and answers do not determine the function, though a maximum was found.
std::string fitError(std::span<const LevelCount> counts, const PsychometricFunction& f, double maxLog) {
    const double minLevel = counts.front().level, maxLevel = counts.back().level, range = maxLevel - minLevel;
    double trials = 0.0, level = 0.0, hits = 0.0, product = 0.0;
    for (const LevelCount& c : counts) {
        const auto n = static_cast<double>(c.trials), h = static_cast<double>(c.hits);
        trials += n, level += n * c.level, hits += h, product += h * c.level;
    }
    if (product - level * hits / trials <= 0.0) return "the share of answers does not rise with the level";
    const double constantLog = hits * std::log(hits / trials) + (trials - hits) * std::log1p(-hits / trials);
    const double gain = std::max(0.0, 2.0 * (maxLog - constantLog));
    if (f.width > 19.5 * range) return "the fitted width is 20 times the range of the levels, or more";
    if (gain < 3.84 && f.threshold >= minLevel && f.threshold <= maxLevel)
        return "the function fits no better than a constant (likelihood ratio, p = " +
               fixedNumber(std::erfc(std::sqrt(0.5 * gain)), 3) + ")"; // 3.84: 95 % of chi-squared, 1 degree
                                                                       // of freedom
    if (f.threshold < minLevel || f.threshold > maxLevel)
        return "the fitted threshold lies outside the levels that were played, " + plainNumber(minLevel) +
               " to " + plainNumber(maxLevel);
    return {};
}

} // namespace

double PsychometricFunction::probability(double level) const noexcept {
    return guess + (1.0 - guess - lapse) * standardFunction(shape, (level - threshold) / width);
}

double PsychometricFunction::levelAt(double probability) const {
    return threshold + width * standardQuantile(shape, (probability - guess) / (1.0 - guess - lapse));
}

double PsychometricFunction::jnd() const noexcept {
    return 0.5 * width * (standardQuantile(shape, 0.75) - standardQuantile(shape, 0.25));
}

double logLikelihood(std::span<const LevelCount> counts, const PsychometricFunction& function) {
    double sum = 0.0;
    for (const LevelCount& count : counts) {
        const double p = std::clamp(function.probability(count.level), 1e-12, 1.0 - 1e-12);
        sum += static_cast<double>(count.hits) * std::log(p) +
               static_cast<double>(count.trials - count.hits) * std::log1p(-p);
    }
    return sum;
}

PsychometricFit fitPsychometric(std::span<const LevelCount> counts, const PsychometricModel& model) {
    if (auto error = countsError(counts); !error.empty()) return {error};
    const Likelihood likelihood{counts, model};
    std::vector<Point> maxima;
    for (const double width : {0.1, 0.25, 0.5, 1.0, 2.0})
        maxima.push_back(nelderMead(likelihood, bestGridPoint(likelihood, width)));
    const Point best = nelderMead(likelihood, std::ranges::min(maxima, {}, likelihood)); // step 3, see above
    PsychometricFunction found = likelihood.function(best);
    const double maxLog = -likelihood(best);
    const auto steps = stepThresholdRange(counts, model, found, maxLog);
    return {fitError(counts, found, maxLog), found, maxLog, !steps, steps.value_or(std::pair{0.0, 0.0})};
}

// Groups trials by participant and fits each group.

std::vector<ParticipantFit<PsychometricFit>> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                                       const PsychometricModel& model) {
    std::vector<ParticipantFit<PsychometricFit>> fits;
    for (const auto& [participant, answers] : groupByParticipant(trials)) {
        const auto counts =
            countByLevel(answers, [](const LevelAnswer& trial) { return trial.levelAndHit(); });
        fits.push_back({participant, answers.size(), fitPsychometric(counts, model)});
    }
    return fits;
}

std::vector<ParticipantFit<PowerLaw>> powerLawByParticipant(const std::vector<LevelAnswer>& trials) {
    std::vector<ParticipantFit<PowerLaw>> laws;
    for (const auto& [participant, answers] : groupByParticipant(trials))
        laws.push_back({participant, answers.size(), fitPowerLaw(answers)});
    return laws;
}

} // namespace physvib
