// SPDX-License-Identifier: MIT
// Extraction of a texture: checks the recording, counts grains that stand out, else looks for repetition.
#include "Measure/TextureExtractor.h"
#include "Measure/HitExcerpt.h"
#include "Measure/Spectrum.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>

namespace physvib {
namespace {

// Removes the material's resonance from the recording of a scrape, so that one pulse per grain remains. A
// cos^4 kernel and its derivatives smooth the samples; weighted least squares with past values as
// instrumental variables estimate the resonance.

/// Pulses of a scrape. A grain that excites A exp(-tau t) sin(omega t) gives a pulse of height A, with the
/// shape of the smoothing kernel.
struct ScrapePulses {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of the resonance
    std::vector<double> heights;                    ///< positive at grains, 0 between them
    double heightsPerSecond = 0.0;
    double skewness = 0.0; ///< of the heights: that of noise is 0
};

constexpr std::size_t minReachSamples = 4; // half width below which derivatives are inaccurate

/// cos^4 kernel of area 1 over 2 reach + 1 samples, and its first two derivatives in time.
struct Smoothing {
    Smoothing(std::size_t samples, double rateHz)
        : reach{samples} {
        const auto steps = static_cast<double>(reach + 1);
        const double phaseStep = 0.5 * std::numbers::pi / steps, perSecond = phaseStep * rateHz;
        double area = 0.0;
        for (std::size_t i = 0; i <= 2 * reach; ++i) {
            const double phase = phaseStep * (static_cast<double>(i) - static_cast<double>(reach)),
                         c = std::cos(phase), s = std::sin(phase);
            value.push_back(c * c * c * c);
            slope.push_back(-4.0 * perSecond * c * c * c * s);
            bend.push_back(perSecond * perSecond * (12.0 * c * c * s * s - 4.0 * c * c * c * c));
            area += value.back();
        }
        for (auto* kernel : {&value, &slope, &bend})
            for (double& x : *kernel) x /= area;
    }
    std::size_t reach;
    std::vector<double> value, slope, bend;
};

/// `kernel` * x at every `step`-th sample, where the kernel fits completely.
std::vector<double> convolve(std::span<const double> x, const std::vector<double>& kernel, std::size_t step) {
    std::vector<double> all;
    for (std::size_t n = kernel.size(); n <= x.size(); n += step) {
        double sum = 0.0;
        for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * x[n - 1 - k];
        all.push_back(sum);
    }
    return all;
}

Eigen::Map<const Eigen::ArrayXd> asArray(const std::vector<double>& x) {
    return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// Finds c = {2 tau, omega^2 + tau^2, minus the mean of the excitation} such that bend + c[0] slope + c[1]
/// value + c[2] is small most of the time. Noise in the regressors would make the decay look faster; values
/// `lag` earlier have independent noise and do not depend on later impacts.
std::optional<Eigen::Vector3d> fitResonance(const std::vector<double>& value,
                                            const std::vector<double>& slope, const std::vector<double>& bend,
                                            Eigen::Index lag) {
    constexpr int rounds = 20;
    constexpr double minResidualShare = 0.02; // of the rms: limits the weight of small residuals
    const Eigen::Index rows = static_cast<Eigen::Index>(value.size()) - lag;
    if (rows < 100) return std::nullopt; // too few for three coefficients
    Eigen::MatrixX3d basis(rows + lag, 3);
    basis << asArray(slope), asArray(value), Eigen::ArrayXd::Ones(rows + lag);
    Eigen::RowVector3d scale = (basis.colwise().squaredNorm() / static_cast<double>(rows)).cwiseSqrt();
    if (!(scale.minCoeff() > 0.0)) return std::nullopt;
    basis.array().rowwise() /= scale.array();
    const Eigen::VectorXd target = -asArray(bend).tail(rows);
    Eigen::ArrayXd weights = Eigen::ArrayXd::Ones(rows);
    Eigen::Vector3d found;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::Matrix3Xd past = (basis.topRows(rows).array().colwise() * weights).matrix().transpose();
        found = (past * basis.bottomRows(rows)).fullPivLu().solve(past * target);
        const Eigen::ArrayXd residuals = (target - basis.bottomRows(rows) * found).array().abs();
        weights = 1.0 / residuals.max(minResidualShare * std::sqrt(residuals.square().mean()));
        if (!weights.allFinite()) return std::nullopt;
    }
    return (found.array() / scale.transpose().array()).matrix();
}

double computeSkewness(const std::vector<double>& x) {
    const auto deviations = asArray(x) - asArray(x).mean();
    return deviations.cube().mean() / std::pow(deviations.square().mean(), 1.5);
}

/// Smooths `samples` over halfWidthSeconds to both sides. x'' + 2 tau x' + (omega^2 + tau^2) x is the
/// excitation by grains alone; tau and omega are chosen so that it is 0 most of the time. None if no decaying
/// sinusoid fits, or if the width is only a few samples. Message thread (M) only.
std::optional<ScrapePulses> scrapePulses(std::span<const double> samples, double rateHz,
                                         double halfWidthSeconds) {
    const auto reach = static_cast<std::size_t>(std::lround(halfWidthSeconds * rateHz));
    if (reach < minReachSamples || samples.size() < 100 * reach) return std::nullopt;
    const Smoothing smoothing{reach, rateHz};
    const std::size_t step = std::max<std::size_t>(1, reach / 8);
    const auto value = convolve(samples, smoothing.value, step),
               slope = convolve(samples, smoothing.slope, step),
               bend = convolve(samples, smoothing.bend, step);
    const auto coefficients =
        fitResonance(value, slope, bend, static_cast<Eigen::Index>(2 * reach / step + 2));
    if (!coefficients) return std::nullopt;
    const double tau = 0.5 * (*coefficients)[0], omega2 = (*coefficients)[1] - tau * tau;
    if (!(tau > 0.0) || !(omega2 > tau * tau)) return std::nullopt;
    ScrapePulses pulses;
    pulses.frequencyHz = std::sqrt(omega2) / (2.0 * std::numbers::pi);
    pulses.decayPerSecond = tau;
    pulses.heightsPerSecond = rateHz / static_cast<double>(step);
    const double unitHeight = smoothing.value[reach] * rateHz * std::sqrt(omega2);
    for (std::size_t n = 0; n < value.size(); ++n)
        pulses.heights.push_back(
            (bend[n] + (*coefficients)[0] * slope[n] + (*coefficients)[1] * value[n] + (*coefficients)[2]) /
            unitHeight);
    pulses.skewness = computeSkewness(pulses.heights);
    if (pulses.skewness < 0.0) { // recorded with inverted polarity
        for (double& height : pulses.heights) height = -height;
        pulses.skewness = -pulses.skewness;
    }
    return pulses;
}

/// x', smoothed over halfWidthSeconds to both sides: one value for each sample where the kernel fits.
std::vector<double> smoothSlope(std::span<const double> samples, double rateHz, double halfWidthSeconds) {
    const auto reach = static_cast<std::size_t>(std::lround(halfWidthSeconds * rateHz));
    return convolve(samples, Smoothing{std::max(reach, minReachSamples), rateHz}.slope, 1);
}

/// Estimates from the pulses of a scrape.
struct GrainTrain {
    double perSecond = 0.0;
    double strength = 0.0;   ///< mean; 1 = full scale
    double unevenness = 0.0; ///< standard deviation of the spacings, in spacings: ridges 0, at random 0.37
    double lostShare = 0.0;  ///< estimated share of grains that were missed, too weak for the noise or too
                             ///< close to another. perSecond and strength are corrected for them
    std::size_t grainCount = 0;
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of the material's vibration

    /// Any thread. A value in between is neither, and unreliable.
    bool isEven() const noexcept { return unevenness <= 0.15; }
    bool isRandom() const noexcept { return unevenness >= 0.3; }
};

constexpr double minHalfWidthSeconds = 0.000125, maxHalfWidthSeconds = 0.012;
constexpr double minSkewness = 1.2;
constexpr std::size_t minGrains = 20;
constexpr double maxLostShare = 0.3;
constexpr double maxHeightSpread = 0.8; // coefficient of variation of heights: random grains have 0.46,
                                        // ringing of another partial above 1

/// RMS of the negative values: noise is symmetric, pulses are positive.
double noiseRms(std::span<const double> x) {
    double sum = 0.0, count = 0.0;
    for (const double height : x)
        if (height < 0.0) sum += height * height, count += 1.0;
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

struct ProminentPeaks {
    std::vector<Peak> peaks; ///< peaks above the threshold
    double threshold, mean;  ///< mean: estimated height of all grains, including those below the threshold
};

/// For uniformly distributed heights the mean above the threshold is (mean x maxStrength + threshold) / 2.
ProminentPeaks prominentPeaks(const std::vector<Peak>& peaks, double noise) {
    constexpr double maxStrength = GrainChance::minStrength + GrainChance::strengthRange, noiseFactor = 5.0,
                     minShare = 0.12;
    ProminentPeaks prominent{{}, noiseFactor * noise, 0.0};
    for (int round = 0; round < 10; ++round) {
        prominent.peaks.clear();
        double sum = 0.0;
        for (const Peak& peak : peaks)
            if (peak.height > prominent.threshold) sum += peak.height, prominent.peaks.push_back(peak);
        if (prominent.peaks.size() < minGrains) break;
        const double meanAbove = sum / static_cast<double>(prominent.peaks.size());
        prominent.mean =
            prominent.threshold > GrainChance::minStrength * meanAbove
                ? std::max(0.3 * meanAbove, (2.0 * meanAbove - prominent.threshold) / maxStrength)
                : meanAbove;
        prominent.threshold = std::max(noiseFactor * noise, minShare * prominent.mean);
    }
    return prominent;
}

double heightSpread(const std::vector<Peak>& peaks) {
    double sum = 0.0, squares = 0.0;
    for (const Peak& peak : peaks) sum += peak.height, squares += peak.height * peak.height;
    return std::sqrt(std::max(0.0, squares * static_cast<double>(peaks.size()) / (sum * sum) - 1.0));
}

/// Spacings of consecutive peaks, without pauses, which are longer than random spacings.
std::vector<double> findGaps(const std::vector<Peak>& peaks) {
    constexpr double pauseMedians = 4.0; // medians
    std::vector<double> gaps;
    for (std::size_t i = 1; i < peaks.size(); ++i) gaps.push_back(peaks[i].position - peaks[i - 1].position);
    std::vector<double> sorted = gaps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::erase_if(gaps, [maxGap = pauseMedians * *middle](double gap) { return gap > maxGap; });
    return gaps;
}

double meanValue(const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double gapUnevenness(const std::vector<double>& gaps) {
    const double mean = meanValue(gaps);
    double sum = 0.0;
    for (const double gap : gaps) sum += (gap / mean - 1.0) * (gap / mean - 1.0);
    return std::sqrt(sum / static_cast<double>(gaps.size()));
}

/// Share of random grains that follow the one before at less than this, in spacings: a difference of two
/// uniform distributions.
double shareCloserThan(double spacings) {
    constexpr double range = GrainChance::spacingRange;
    return std::pow(std::max(0.0, spacings - (1.0 - range)) / range, 2.0) / 2.0;
}

std::optional<GrainTrain> grainTrainAt(std::span<const double> samples, double rateHz,
                                       double halfWidthSeconds) {
    const auto pulses = scrapePulses(samples, rateHz, halfWidthSeconds);
    if (!pulses || !(pulses->skewness >= minSkewness)) return std::nullopt;
    const ProminentPeaks prominent = prominentPeaks(findPeaks(pulses->heights), noiseRms(pulses->heights));
    if (prominent.peaks.size() < minGrains || heightSpread(prominent.peaks) > maxHeightSpread)
        return std::nullopt;
    GrainTrain train;
    train.frequencyHz = pulses->frequencyHz;
    train.decayPerSecond = pulses->decayPerSecond;
    train.grainCount = prominent.peaks.size();
    const std::vector<double> gaps = findGaps(prominent.peaks);
    train.perSecond = pulses->heightsPerSecond / meanValue(gaps);
    train.unevenness = gapUnevenness(gaps);
    const double weakShare = std::clamp((prominent.threshold / prominent.mean - GrainChance::minStrength) /
                                            GrainChance::strengthRange,
                                        0.0, 0.95);
    constexpr double mergeWidths = 0.75; // of the half width: closer pulses merge
    const double mergedShare =
        shareCloserThan(mergeWidths * halfWidthSeconds * train.perSecond / (1.0 - weakShare));
    train.lostShare = weakShare + mergedShare;
    if (train.isEven()) { // ridges: all alike, and none close to another
        train.strength = 0.0;
        for (const Peak& peak : prominent.peaks)
            train.strength += peak.height / static_cast<double>(train.grainCount);
        return train;
    }
    train.strength = prominent.mean;
    train.perSecond *= (1.0 + mergedShare) / (1.0 - weakShare);
    return train;
}

/// Uses the pulse width at which fewest grains are lost. None if fewer than 20 stand out, or more than 30 %
/// are lost. Message thread (M) only.
std::optional<GrainTrain> grainTrain(std::span<const double> samples, double rateHz) {
    std::optional<GrainTrain> best;
    for (double width = minHalfWidthSeconds; width < maxHalfWidthSeconds && !(best && best->lostShare == 0.0);
         width *= std::sqrt(2.0)) {
        const auto train = grainTrainAt(samples, rateHz, width);
        if (train && train->lostShare <= maxLostShare && (!best || train->lostShare < best->lostShare))
            best = train;
    }
    return best;
}

constexpr double minSeconds = 0.5, maxSeconds = 8.0;
constexpr std::size_t maxSamples = 400'000; // a second of computing, 50 MB

std::vector<double> middlePart(const std::vector<float>& x, double rateHz) {
    const std::size_t size = std::min({x.size(), maxSamples, static_cast<std::size_t>(maxSeconds * rateHz)}),
                      from = (x.size() - size) / 2;
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(from);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

/// Autocorrelation normalised by the energy of the stronger of the two overlapping parts, so that a decaying
/// signal does not look similar to itself.
std::vector<double> normalisedAutocorrelation(std::span<const double> x) {
    std::vector<double> similarity = autocorrelation(x), energy{0.0};
    for (const double sample : x) energy.push_back(energy.back() + sample * sample);
    for (std::size_t lag = 0; lag < similarity.size(); ++lag) {
        const double stronger = std::max(energy[x.size() - lag], energy[x.size()] - energy[lag]);
        similarity[lag] = stronger > 0.0 ? similarity[lag] / stronger : 0.0;
    }
    return similarity;
}

Peak highestWithin(std::span<const double> x, std::size_t from, std::size_t to) {
    return peakAt(x, static_cast<std::size_t>(std::max_element(x.begin() + static_cast<std::ptrdiff_t>(from),
                                                               x.begin() + static_cast<std::ptrdiff_t>(to)) -
                                              x.begin()));
}

/// Rate of a steady repetition (within 0.1 %), as of ridges that are passed too fast to be separated from the
/// resonance; 0 if there is none. Uses the autocorrelation of the slope: at large lags the resonance has
/// decayed, the repetition has not.
double repetitionsPerSecond(std::span<const double> samples, double rateHz) {
    constexpr double smoothSeconds = 0.00025, minSimilarity = 0.6;
    const std::vector<double> slope = smoothSlope(samples, rateHz, smoothSeconds);
    if (slope.size() < 200) return 0.0;
    // without the start of the recording
    const auto similarity = normalisedAutocorrelation(std::span{slope}.subspan(slope.size() / 5));
    const std::size_t n = similarity.size();
    const double laterSimilarity = highestWithin(similarity, n / 4, n / 2).height; // at such lags a resonance
                                                                                   // has decayed
    if (laterSimilarity < minSimilarity) return 0.0;
    double lag = 0.0; // of the first peak that is about as high as later ones
    for (std::size_t i = 1; lag == 0.0 && i + 1 < n / 2; ++i)
        if (isPeak(similarity, i))
            if (const Peak peak = peakAt(similarity, i);
                peak.height >= 1.0 - 3.0 * (1.0 - laterSimilarity) - 0.003)
                lag = peak.position;
    // larger multiples of the lag make it more precise
    for (double multiple = 2.0; lag > 4.0 && lag * multiple < 0.5 * static_cast<double>(n) - lag;
         multiple *= 2.0)
        lag = highestWithin(similarity, static_cast<std::size_t>((multiple - 0.25) * lag),
                            static_cast<std::size_t>((multiple + 0.25) * lag) + 2)
                  .position /
              multiple;
    return lag > 4.0 ? rateHz / lag : 0.0;
}

/// If ridges pass at more than the resonance, both are hard to separate: only the repetition rate is certain.
void setResonance(ScrapedTexture& result, const GrainTrain& train) {
    if (result.texture.pattern == GrainPattern::regular && result.grainsPerSecond > train.frequencyHz) return;
    result.frequencyHz = train.frequencyHz;
    result.decayPerSecond = train.decayPerSecond;
    result.strength = train.strength;
    result.grainCount = train.grainCount;
    result.lostShare = train.lostShare;
}

} // namespace

Result<ScrapedTexture> extractTexture(const std::vector<float>& samples, double rateHz,
                                      const Scrape& scrape) {
    if (auto error = recordingError(samples, rateHz, minSeconds); !error.empty())
        return Failure{std::move(error)};
    if (isSilent(samples)) return Failure{"expected a scrape, found silence"};
    if (auto error = clippingError(samples, rateHz); !error.empty()) return Failure{std::move(error)};
    const std::vector<double> x = middlePart(samples, rateHz);
    const auto train = grainTrain(x, rateHz);
    const bool isRandom = train && train->isRandom(), isCounted = isRandom || (train && train->isEven());
    ScrapedTexture result;
    result.texture.pattern = isRandom ? GrainPattern::random : GrainPattern::regular;
    result.grainsPerSecond = isCounted ? train->perSecond : repetitionsPerSecond(x, rateHz);
    if (!(result.grainsPerSecond > 0.0))
        return Failure{"expected a scrape whose grains stand out or repeat, found none that do"};
    if (isCounted) setResonance(result, *train);
    result.texture.grainMetres = scrape.metresPerSecond / result.grainsPerSecond;
    if (result.strength > 0.0)
        result.texture.roughness =
            result.strength * scrape.massKg / grainImpulse(1.0, scrape.loadNewtons, scrape.metresPerSecond);
    if (const auto error = errorOf(result.texture); !error.empty()) return Failure{std::string{error}};
    return result;
}

} // namespace physvib
