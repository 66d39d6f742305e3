// SPDX-License-Identifier: MIT
// Model selection for partials: adds one per round while the cost (unexplained energy, and a penalty per
// parameter) falls; then tries other start values, and the model of Eq. 5.1.
#include "Measure/HitFit.h"
#include "Measure/HitExcerpt.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/Polynomials>

namespace physvib {

namespace {

// Start values for overlapping partials by linear prediction (Prony 1795): prediction coefficients by least
// squares, and the roots of their polynomial as eigenvalues of its companion matrix (Eigen).

/// Roots of z^n + c[0] z^(n-1) + ... + c[n-1]; none if there are no coefficients.
std::vector<std::complex<double>> rootsOf(std::vector<double> c) {
    if (c.empty()) return {};
    c.insert(c.begin(), 1.0);
    const Eigen::VectorXd ascending =
        Eigen::Map<const Eigen::VectorXd>(c.data(), static_cast<Eigen::Index>(c.size())).reverse();
    const auto roots = Eigen::PolynomialSolver<double, Eigen::Dynamic>(ascending).roots();
    return {roots.begin(), roots.end()};
}

std::vector<double> meansOf(std::span<const double> samples, std::size_t blocks) {
    const std::size_t length = samples.size() / blocks;
    std::vector<double> means(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
        for (std::size_t i = 0; i < length; ++i)
            means[b] += samples[b * length + i] / static_cast<double>(length);
    return means;
}

/// c with x[n] + c[0] x[n-1] + ... = 0 in the least-squares sense; empty if undetermined.
std::vector<double> predictionCoefficients(const std::vector<double>& x, std::size_t order) {
    NormalEquations equations(order);
    std::vector<NormalEquations::Column> columns(order);
    for (std::size_t n = order; n < x.size(); ++n) {
        for (std::size_t j = 0; j < order; ++j) columns[j][0] = -x[n - 1 - j];
        equations.add(columns, std::span(&x[n], 1));
    }
    return equations.step(1e-14);
}

struct PredictedPartial {
    double omega = 0.0, tau = 0.0; ///< rad/s, 1/s
};

/// Frequencies and decays of `partials` decaying sinusoids; exact if the samples are so many sinusoids
/// without noise. Computed from the means of `blocks` blocks of equal length: the means of a decaying
/// sinusoid are one of the same frequency and decay. Fewer results if the roots are not conjugate pairs, none
/// if there are too few samples. `samples` begin after the onset. Message thread (M) only.
std::vector<PredictedPartial> predictPartials(std::span<const double> samples, double rateHz,
                                              std::size_t partials, std::size_t blocks) {
    std::vector<PredictedPartial> found;
    if (samples.size() < blocks || blocks < 4 * partials) return found;
    const std::size_t blockFrames = samples.size() / blocks; // whole ones
    const double blockRateHz = rateHz / static_cast<double>(blockFrames);
    for (const std::complex<double> root :
         rootsOf(predictionCoefficients(meansOf(samples, blocks), 2 * partials)))
        if (root.imag() > 1e-6 && std::isfinite(root.real()))
            found.push_back(
                {std::arg(root) * blockRateHz, std::max(-std::log(std::abs(root)) * blockRateHz, 1.0)});
    std::ranges::sort(found, {}, &PredictedPartial::omega);
    return found;
}

constexpr double roundingShare = 1e-11;     // of the energy: a smaller residual is rounding
constexpr double shortHitRatio = 8.0;       // omega / tau up to which other starts are tried
constexpr double penaltyPerParameter = 1.5; // per parameter, in units of ln N: for it and its search (Schwarz
                                            // 1978)

} // namespace

HitFit::HitFit(std::vector<double> samples, std::size_t initialOnset, double rateHz, std::size_t maxPartials)
    : samples_{std::move(samples)}
    , onset_{initialOnset}
    , rateHz_{rateHz}
    , maxPartials_{maxPartials}
    , energy_{signalEnergy(samples_)}
    , fit_{afterOnset(), rateHz} {
    addPartials();
    if (fit_.partials().empty()) return;
    cost_ = modelCost(unexplainedEnergy(), 4 * fit_.partials().size());
    tryCommonOnset(fit_.partials());
    tryOtherStarts();
}

PartialError HitFit::stdError(std::size_t partial) const {
    const PartialError error = commonOnset_ ? commonOnset_->stdError(partial) : fit_.stdError(partial);
    const double noiseFactor = std::sqrt(std::max(1.0, noiseDensityAround(partials()[partial])));
    return {noiseFactor * error.omega, noiseFactor * error.tau};
}

// Coloured noise counts by its density around the frequency (Whittle 1953): the density of the residual,
// weighted by the partial's decay, over that of white noise of equal power. It is measured beside the
// partial, because the fit leaves nothing at the partial itself.
double HitFit::noiseDensityAround(const Partial& partial) const {
    std::vector<double> residuals = samples_;
    double weight = 0.0, density = 0.0;
    const double onset = onsetSeconds();
    const auto first = static_cast<std::size_t>(std::ceil(onset * rateHz_));
    for (const Partial& p : partials()) {
        DecayingPhasor phasor{p.omega, p.tau, rateHz_, static_cast<double>(first) / rateHz_ - onset};
        for (std::size_t i = first; i < residuals.size(); ++i, phasor.next())
            residuals[i] -= p.cosine * phasor.cosine() + p.sine * phasor.sine();
    }
    const auto decaying = std::span<const double>(residuals).subspan(first);
    for (std::size_t i = 0; i < decaying.size(); ++i)
        weight += std::exp(-2.0 * partial.tau * static_cast<double>(i) / rateHz_);
    // distances in units of the decay rate, at which the partial's own line has fallen off
    constexpr std::array<double, 10> offsets{-6, -5, -4, -3, -2, 2, 3, 4, 5, 6};
    for (const double offset : offsets) {
        const auto point =
            spectrumValue(decaying, rateHz_, std::abs(partial.omega + offset * partial.tau), partial.tau);
        density += (point.re * point.re + point.im * point.im) / offsets.size();
    }
    return density / weight * static_cast<double>(residuals.size()) / signalEnergy(residuals);
}

double HitFit::energyBeforeOnset() const { return signalEnergy(std::span(samples_).first(onset_)); }

double HitFit::modelCost(double unexplained, std::size_t parameterCount) const {
    const double count = static_cast<double>(samples_.size());
    return count * std::log(std::max(unexplained, roundingShare * energy_)) +
           penaltyPerParameter * static_cast<double>(parameterCount) * std::log(count);
}

void HitFit::addPartials() {
    const auto cost = [this] { return modelCost(unexplainedEnergy(), 4 * fit_.partials().size()); };
    double minimum = cost();
    while (fit_.partials().size() < maxPartials_ && unexplainedEnergy() > roundingShare * energy_) {
        const std::size_t onset = onset_;
        const std::vector<Partial> partials = fit_.partials();
        fit_.addHighestPeak();
        fit_.refine();
        if (moveOnset()) fit_.refine();
        const double newCost = cost();
        if (!(newCost < minimum)) return restart(onset, partials);
        minimum = newCost;
    }
}

void HitFit::tryFreePhases(const std::vector<Partial>& starts) {
    PartialFit fit{afterOnset(), rateHz_};
    for (const Partial& p : starts) fit.add(p);
    fit.solveLinear();
    fit.refine();
    const double cost = modelCost(energyBeforeOnset() + fit.residualEnergy(), 4 * starts.size());
    if (!(cost < cost_)) return;
    cost_ = cost;
    fit_ = fit;
    commonOnset_.reset();
}

void HitFit::tryCommonOnset(const std::vector<Partial>& starts) {
    CommonOnsetFit fit{samples_, rateHz_, onset_, starts};
    fit.refine();
    const double cost = modelCost(fit.residualEnergy(), 3 * starts.size());
    if (!(cost < cost_)) return;
    cost_ = cost;
    commonOnset_ = std::move(fit);
}

// Partials that decay within two periods form one broad spectral peak, on which the search above fails.
void HitFit::tryOtherStarts() {
    const std::vector<Partial> found = fit_.partials();
    const auto slowestDecay = std::ranges::min(found, {}, &Partial::tau);
    const auto strongest =
        std::ranges::max(found, {}, [this](const Partial& p) { return p.spectralPeak(seconds()); });
    if (strongest.omega > shortHitRatio * strongest.tau) return;
    for (const double decayTimes : {2.0, 4.0})
        for (const std::size_t blocks : {16u, 48u})
            for (std::size_t count = 1; count <= std::min<std::size_t>(4, maxPartials_); ++count) {
                if (unexplainedEnergy() < roundingShare * energy_ && count >= partials().size()) break;
                const auto length =
                    std::min(afterOnset().size(), toSamples(decayTimes / slowestDecay.tau, rateHz_));
                std::vector<Partial> starts;
                for (const PredictedPartial& p :
                     predictPartials(afterOnset().first(length), rateHz_, count, blocks))
                    starts.push_back({p.omega, p.tau, 0.0, 1.0});
                if (starts.empty()) continue;
                tryCommonOnset(starts);
                tryFreePhases(starts);
            }
}

// A sample x that the model m covers reduces the unexplained energy by 2 x m - m^2. Hum tells no onset: the
// hit would begin too late in what it explains.
bool HitFit::moveOnset() {
    const std::size_t reach = std::min(samples_.size() / 2, onset_ + toSamples(onsetReachSeconds, rateHz_));
    double gain = 0.0, maxGain = 0.0;
    std::size_t best = reach;
    for (std::size_t i = reach; i-- > 0;) {
        double model = 0.0;
        for (const Partial& p : fit_.partials())
            if (p.tau >= minTau)
                model += p.value((static_cast<double>(i) - static_cast<double>(onset_)) / rateHz_);
        gain += model * (2.0 * samples_[i] - model);
        if (gain > maxGain) {
            maxGain = gain;
            best = i;
        }
    }
    if (best == onset_ || !(maxGain > 0.0)) return false;
    const double shiftSeconds = (static_cast<double>(best) - static_cast<double>(onset_)) / rateHz_;
    std::vector<Partial> moved;
    for (const Partial& p : fit_.partials()) moved.push_back(p.shifted(shiftSeconds));
    restart(best, moved);
    return true;
}

void HitFit::restart(std::size_t onset, const std::vector<Partial>& partials) {
    onset_ = onset;
    fit_ = PartialFit{afterOnset(), rateHz_};
    for (const Partial& p : partials) fit_.add(p);
}

// Least-squares fit of Eq. 5.1. Parameters in the order of the equations: the onset, then omega, tau and
// amplitude of each partial.

std::size_t CommonOnsetFit::firstSample(const State& state) const {
    return std::min(samples_.size(),
                    static_cast<std::size_t>(std::max(0.0, std::ceil(state.onset * rateHz_))));
}

std::vector<double> CommonOnsetFit::residual(const State& state) const {
    std::vector<double> residuals(samples_.begin(), samples_.end());
    const std::size_t first = firstSample(state);
    for (const CommonOnsetPartial& p : state.partials) {
        DecayingPhasor phasor{p.omega, p.tau, rateHz_, static_cast<double>(first) / rateHz_ - state.onset};
        for (std::size_t i = first; i < residuals.size(); ++i, phasor.next())
            residuals[i] -= p.amplitude * phasor.sine();
    }
    return residuals;
}

double CommonOnsetFit::residualEnergy(const State& state) const { return signalEnergy(residual(state)); }

NormalEquations CommonOnsetFit::makeEquations(const State& state) const {
    NormalEquations equations(1 + parametersPerPartial * state.partials.size());
    const std::vector<double> residuals = residual(state);
    const std::size_t first = firstSample(state);
    const double begin = static_cast<double>(first) / rateHz_ - state.onset;
    std::vector<DecayingPhasor> phasors;
    for (const CommonOnsetPartial& p : state.partials) phasors.emplace_back(p.omega, p.tau, rateHz_, begin);
    std::vector<NormalEquations::Column> columns(equations.size());
    for (std::size_t start = first; start < residuals.size(); start += NormalEquations::blockRows) {
        const std::size_t count = std::min(NormalEquations::blockRows, residuals.size() - start);
        columns[0].fill(0.0);
        for (std::size_t k = 0; k < state.partials.size(); ++k)
            for (std::size_t i = 0; i < count; ++i, phasors[k].next()) {
                const CommonOnsetPartial& p = state.partials[k];
                const double t = begin + static_cast<double>(start - first + i) / rateHz_,
                             c = phasors[k].cosine(), s = phasors[k].sine();
                columns[0][i] += p.amplitude * (p.tau * s - p.omega * c);
                columns[1 + parametersPerPartial * k][i] = t * p.amplitude * c;
                columns[2 + parametersPerPartial * k][i] = -t * p.amplitude * s;
                columns[3 + parametersPerPartial * k][i] = s;
            }
        equations.add(columns, std::span(residuals).subspan(start, count));
    }
    return equations;
}

CommonOnsetFit::State CommonOnsetFit::solveAmplitudes(double onset, State state) const {
    state.onset = onset;
    for (CommonOnsetPartial& p : state.partials) p.amplitude = 0.0;
    const auto amplitudes =
        makeEquations(state).subset(parametersPerPartial, parametersPerPartial, 1).step(1e-12);
    for (std::size_t k = 0; k < amplitudes.size(); ++k) state.partials[k].amplitude = amplitudes[k];
    return state;
}

CommonOnsetFit::State CommonOnsetFit::takeStep(const State& from, std::span<const double> step) const {
    State moved = from;
    moved.onset = std::clamp(from.onset + step[0], 0.0, 0.5 * static_cast<double>(samples_.size()) / rateHz_);
    for (std::size_t k = 0; k < moved.partials.size(); ++k) {
        const auto change = step.subspan(1 + parametersPerPartial * k, parametersPerPartial);
        CommonOnsetPartial& p = moved.partials[k];
        p = {PartialFit::clampedOmega(p.omega + change[0], rateHz_),
             PartialFit::clampedTau(p.tau + change[1]), p.amplitude + change[2]};
    }
    return moved;
}

// A partial is at rest where its phase is a multiple of pi. For each partial, the nearest such time is tried.
CommonOnsetFit::CommonOnsetFit(std::span<const double> samples, double rateHz, std::size_t onset,
                               std::span<const Partial> partials)
    : samples_{samples}
    , rateHz_{rateHz} {
    for (const Partial& p : partials) state_.partials.push_back({p.omega, p.tau, 0.0});
    const double guessSeconds = static_cast<double>(onset) / rateHz;
    state_ = solveAmplitudes(guessSeconds, state_);
    double minimum = residualEnergy();
    for (const Partial& p : partials) {
        const double restSeconds =
            guessSeconds - std::remainder(std::atan2(p.cosine, p.sine), std::numbers::pi) / p.omega;
        State trial = solveAmplitudes(std::max(restSeconds, 0.0), state_);
        if (const double energy = residualEnergy(trial); energy < minimum) {
            minimum = energy;
            state_ = std::move(trial);
        }
    }
}

bool CommonOnsetFit::refine() {
    return minimise(
        state_, [this](const State& s) { return residualEnergy(s); },
        [this](const State& s) { return makeEquations(s); },
        [this](const State& s, std::span<const double> step) { return takeStep(s, step); });
}

std::vector<Partial> CommonOnsetFit::partials() const {
    std::vector<Partial> all;
    for (const CommonOnsetPartial& p : state_.partials) all.push_back({p.omega, p.tau, 0.0, p.amplitude});
    return all;
}

PartialError CommonOnsetFit::stdError(std::size_t partial) const {
    const NormalEquations equations = makeEquations(state_);
    if (samples_.size() <= equations.size()) return {HUGE_VAL, HUGE_VAL};
    const double variance = residualEnergy() / static_cast<double>(samples_.size() - equations.size());
    return {equations.stdError(1 + parametersPerPartial * partial, variance),
            equations.stdError(2 + parametersPerPartial * partial, variance)};
}

} // namespace physvib
