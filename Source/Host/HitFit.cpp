// SPDX-License-Identifier: GPL-3.0-or-later
// One partial more per round; a round that is not worth its numbers is undone.
#include "Host/HitFit.h"
#include "Host/HitExcerpt.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr std::size_t mostPartials = 6;
constexpr double cleanShare = 1e-9; // of the energy: below it, what is left is rounding
constexpr double penalty = 6.0;     // in units of ln N, for four numbers and the search for them (Schwarz 1978)

double energyOf(std::span<const double> samples) {
    double sum = 0.0;
    for (const double x : samples) sum += x * x;
    return sum;
}

} // namespace

HitFit::HitFit(std::vector<double> samples, std::size_t guess, double rateHz)
    : samples_{std::move(samples)}
    , onset_{guess}
    , rateHz_{rateHz}
    , energy_{energyOf(samples_)}
    , fit_{rest(), rateHz} {
    run();
}

double HitFit::unexplainedEnergy() const { return energyOf(std::span(samples_).first(onset_)) + fit_.residualEnergy(); }

void HitFit::run() {
    const double count = static_cast<double>(samples_.size()), worth = std::exp(-penalty * std::log(count) / count);
    double unexplained = energy_;
    while (fit_.partials().size() < mostPartials && unexplained > cleanShare * energy_) {
        const std::size_t onset = onset_;
        const std::vector<Partial> partials = fit_.partials();
        fit_.addHighest();
        fit_.refine();
        if (moveOnset()) fit_.refine();
        const double now = unexplainedEnergy();
        if (!(now < worth * unexplained)) return restart(onset, partials);
        unexplained = now;
    }
}

// A sample x that the model covers with m takes 2 x m - m^2 from what is unexplained.
bool HitFit::moveOnset() {
    const std::size_t reach = std::min(samples_.size() / 2, onset_ + samplesIn(onsetReachSeconds, rateHz_));
    double gain = 0.0, most = 0.0;
    std::size_t best = reach;
    for (std::size_t i = reach; i-- > 0;) {
        double model = 0.0;
        for (const Partial& p : fit_.partials()) model += p.at((static_cast<double>(i) - static_cast<double>(onset_)) / rateHz_);
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
