// SPDX-License-Identifier: MIT
// Model selection for partials: adds one per round while the cost falls, then tries other starts, and the
// model of Eq. 5.1.
#include "Measure/HitFit.h"
#include "Measure/DecayingPhasor.h"
#include "Measure/HitExcerpt.h"
#include "Measure/LinearPrediction.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <array>

namespace physvib {
namespace {

constexpr std::size_t mostPartials = 6;
constexpr double cleanShare = 1e-11; // of the energy: a smaller residual is rounding
constexpr double shortHit = 8.0;     // omega / tau
constexpr double penalty = 1.5;      // per parameter, in units of ln N: for the parameter and for its search
                                     // (Schwarz 1978)

} // namespace

HitFit::HitFit(std::vector<double> samples, std::size_t guess, double rateHz)
    : samples_{std::move(samples)}
    , onset_{guess}
    , rateHz_{rateHz}
    , energy_{energyOf(samples_)}
    , fit_{rest(), rateHz} {
    addPartials();
    if (fit_.partials().empty()) return;
    cost_ = costOf(unexplainedEnergy(), 4 * fit_.partials().size());
    tryStruck(fit_.partials());
    tryOtherStarts();
}

PartialError HitFit::errorOf(std::size_t partial) const {
    const PartialError white = struck_ ? struck_->errorOf(partial) : fit_.errorOf(partial);
    const double more = std::sqrt(std::max(1.0, noiseAbout(partials()[partial])));
    return {more * white.omega, more * white.tau};
}

// Coloured noise counts by its density around the frequency (Whittle 1953): the density of the residual,
// weighted by the partial's decay, over that of white noise of equal power. It is measured beside the
// partial, because the fit leaves nothing at the partial itself.
double HitFit::noiseAbout(const Partial& partial) const {
    std::vector<double> left = samples_;
    double weight = 0.0, density = 0.0;
    const double onset = onsetSeconds();
    const auto first = static_cast<std::size_t>(std::ceil(onset * rateHz_));
    for (const Partial& p : partials()) {
        DecayingPhasor phasor{p.omega, p.tau, rateHz_, static_cast<double>(first) / rateHz_ - onset};
        for (std::size_t i = first; i < left.size(); ++i, phasor.next())
            left[i] -= p.cosine * phasor.cosine() + p.sine * phasor.sine();
    }
    const auto rest = std::span<const double>(left).subspan(first);
    for (std::size_t i = 0; i < rest.size(); ++i)
        weight += std::exp(-2.0 * partial.tau * static_cast<double>(i) / rateHz_);
    // distances in units of the decay, at which the partial's own line has fallen off
    constexpr std::array<double, 10> besides{-6, -5, -4, -3, -2, 2, 3, 4, 5, 6};
    for (const double by : besides) {
        const auto point =
            pointOfSpectrum(rest, rateHz_, std::abs(partial.omega + by * partial.tau), partial.tau);
        density += (point.re * point.re + point.im * point.im) / besides.size();
    }
    return density / weight * static_cast<double>(left.size()) / energyOf(left);
}

double HitFit::energyBeforeOnset() const { return energyOf(std::span(samples_).first(onset_)); }

double HitFit::costOf(double unexplained, std::size_t numbers) const {
    const double count = static_cast<double>(samples_.size());
    return count * std::log(std::max(unexplained, cleanShare * energy_)) +
           penalty * static_cast<double>(numbers) * std::log(count);
}

void HitFit::addPartials() {
    const auto cost = [this] { return costOf(unexplainedEnergy(), 4 * fit_.partials().size()); };
    double least = cost();
    while (fit_.partials().size() < mostPartials && unexplainedEnergy() > cleanShare * energy_) {
        const std::size_t onset = onset_;
        const std::vector<Partial> partials = fit_.partials();
        fit_.addHighest();
        fit_.refine();
        if (moveOnset()) fit_.refine();
        const double now = cost();
        if (!(now < least)) return restart(onset, partials);
        least = now;
    }
}

void HitFit::tryFree(const std::vector<Partial>& starts) {
    PartialFit fit{rest(), rateHz_};
    for (const Partial& p : starts) fit.add(p);
    fit.solveLinear();
    fit.refine();
    const double cost = costOf(energyBeforeOnset() + fit.residualEnergy(), 4 * starts.size());
    if (!(cost < cost_)) return;
    cost_ = cost;
    fit_ = fit;
    struck_.reset();
}

void HitFit::tryStruck(const std::vector<Partial>& starts) {
    StruckFit fit{samples_, rateHz_, onset_, starts};
    fit.refine();
    const double cost = costOf(fit.residualEnergy(), 3 * starts.size());
    if (!(cost < cost_)) return;
    cost_ = cost;
    struck_ = std::move(fit);
}

// Partials that decay within two periods form one broad spectral peak, on which the search above fails.
void HitFit::tryOtherStarts() {
    const std::vector<Partial> found = fit_.partials();
    const auto longest = std::ranges::min(found, {}, &Partial::tau);
    const auto strongest =
        std::ranges::max(found, {}, [this](const Partial& p) { return p.spectralPeak(seconds()); });
    if (strongest.omega > shortHit * strongest.tau) return;
    for (const double lives : {2.0, 4.0})
        for (const std::size_t blocks : {16u, 48u})
            for (std::size_t count = 1; count <= 4; ++count) {
                if (unexplainedEnergy() < cleanShare * energy_ && count >= partials().size()) break;
                const auto length = std::min(rest().size(), samplesIn(lives / longest.tau, rateHz_));
                std::vector<Partial> starts;
                for (const PredictedPartial& p :
                     predictPartials(rest().first(length), rateHz_, count, blocks))
                    starts.push_back({p.omega, p.tau, 0.0, 1.0});
                if (starts.empty()) continue;
                tryStruck(starts);
                tryFree(starts);
            }
}

// A sample x that the model m covers reduces the unexplained energy by 2 x m - m^2.
bool HitFit::moveOnset() {
    const std::size_t reach = std::min(samples_.size() / 2, onset_ + samplesIn(onsetReachSeconds, rateHz_));
    double gain = 0.0, most = 0.0;
    std::size_t best = reach;
    for (std::size_t i = reach; i-- > 0;) {
        double model = 0.0;
        for (const Partial& p : fit_.partials())
            model += p.at((static_cast<double>(i) - static_cast<double>(onset_)) / rateHz_);
        gain += model * (2.0 * samples_[i] - model);
        if (gain > most) {
            most = gain;
            best = i;
        }
    }
    if (best == onset_) return false;
    const double by = (static_cast<double>(best) - static_cast<double>(onset_)) / rateHz_;
    std::vector<Partial> moved;
    for (const Partial& p : fit_.partials()) moved.push_back(p.shifted(by));
    restart(best, moved);
    return true;
}

void HitFit::restart(std::size_t onset, const std::vector<Partial>& partials) {
    onset_ = onset;
    fit_ = PartialFit{rest(), rateHz_};
    for (const Partial& p : partials) fit_.add(p);
}

} // namespace physvib
