// SPDX-License-Identifier: MIT
// Least-squares fit of Eq. 5.1. Parameters in the order of the equations: the onset, then omega, tau and
// amplitude of each partial.
#include "Measure/StruckFit.h"
#include "Measure/DecayingPhasor.h"
#include <algorithm>
#include <numbers>

namespace physvib {
namespace {

constexpr std::size_t numbersEach = 3;

} // namespace

std::size_t StruckFit::firstOf(const State& state) const {
    return std::min(samples_.size(),
                    static_cast<std::size_t>(std::max(0.0, std::ceil(state.onset * rateHz_))));
}

std::vector<double> StruckFit::residual(const State& state) const {
    std::vector<double> rest(samples_.begin(), samples_.end());
    const std::size_t first = firstOf(state);
    for (const StruckPartial& p : state.partials) {
        DecayingPhasor phasor{p.omega, p.tau, rateHz_, static_cast<double>(first) / rateHz_ - state.onset};
        for (std::size_t i = first; i < rest.size(); ++i, phasor.next())
            rest[i] -= p.amplitude * phasor.sine();
    }
    return rest;
}

double StruckFit::energyOf(const State& state) const { return physvib::energyOf(residual(state)); }

NormalEquations StruckFit::equationsOf(const State& state) const {
    NormalEquations equations(1 + numbersEach * state.partials.size());
    const std::vector<double> rest = residual(state);
    const std::size_t first = firstOf(state);
    const double begin = static_cast<double>(first) / rateHz_ - state.onset;
    std::vector<DecayingPhasor> phasors;
    for (const StruckPartial& p : state.partials) phasors.emplace_back(p.omega, p.tau, rateHz_, begin);
    std::vector<NormalEquations::Column> columns(equations.size());
    for (std::size_t at = first; at < rest.size(); at += NormalEquations::block) {
        const std::size_t count = std::min(NormalEquations::block, rest.size() - at);
        columns[0].fill(0.0);
        for (std::size_t k = 0; k < state.partials.size(); ++k)
            for (std::size_t i = 0; i < count; ++i, phasors[k].next()) {
                const StruckPartial& p = state.partials[k];
                const double t = begin + static_cast<double>(at - first + i) / rateHz_,
                             c = phasors[k].cosine(), s = phasors[k].sine();
                columns[0][i] += p.amplitude * (p.tau * s - p.omega * c);
                columns[1 + numbersEach * k][i] = t * p.amplitude * c;
                columns[2 + numbersEach * k][i] = -t * p.amplitude * s;
                columns[3 + numbersEach * k][i] = s;
            }
        equations.add(columns, std::span(rest).subspan(at, count));
    }
    return equations;
}

StruckFit::State StruckFit::solvedAt(double onset, State state) const {
    state.onset = onset;
    for (StruckPartial& p : state.partials) p.amplitude = 0.0;
    const auto amplitudes = equationsOf(state).each(numbersEach, numbersEach, 1).step(1e-12);
    for (std::size_t k = 0; k < amplitudes.size(); ++k) state.partials[k].amplitude = amplitudes[k];
    return state;
}

StruckFit::State StruckFit::moved(const State& from, std::span<const double> step) const {
    State to = from;
    to.onset = std::clamp(from.onset + step[0], 0.0, 0.5 * static_cast<double>(samples_.size()) / rateHz_);
    for (std::size_t k = 0; k < to.partials.size(); ++k) {
        const auto by = step.subspan(1 + numbersEach * k, numbersEach);
        StruckPartial& p = to.partials[k];
        p = {PartialFit::allowedOmega(p.omega + by[0], rateHz_), PartialFit::allowedTau(p.tau + by[1]),
             p.amplitude + by[2]};
    }
    return to;
}

// A partial is at rest where its phase is a multiple of pi: tries, for each partial, such a moment nearest to
// the guess.
StruckFit::StruckFit(std::span<const double> samples, double rateHz, std::size_t onset,
                     std::span<const Partial> partials)
    : samples_{samples}
    , rateHz_{rateHz} {
    for (const Partial& p : partials) state_.partials.push_back({p.omega, p.tau, 0.0});
    const double guess = static_cast<double>(onset) / rateHz;
    state_ = solvedAt(guess, state_);
    double least = residualEnergy();
    for (const Partial& p : partials) {
        const double at = guess - std::remainder(std::atan2(p.cosine, p.sine), std::numbers::pi) / p.omega;
        State trial = solvedAt(std::max(at, 0.0), state_);
        if (const double energy = energyOf(trial); energy < least) {
            least = energy;
            state_ = std::move(trial);
        }
    }
}

bool StruckFit::refine() {
    return descend(
        state_, [this](const State& s) { return energyOf(s); },
        [this](const State& s) { return equationsOf(s); },
        [this](const State& s, std::span<const double> step) { return moved(s, step); });
}

std::vector<Partial> StruckFit::partials() const {
    std::vector<Partial> all;
    for (const StruckPartial& p : state_.partials) all.push_back({p.omega, p.tau, 0.0, p.amplitude});
    return all;
}

PartialError StruckFit::errorOf(std::size_t partial) const {
    const NormalEquations equations = equationsOf(state_);
    if (samples_.size() <= equations.size()) return {HUGE_VAL, HUGE_VAL};
    const double variance = residualEnergy() / static_cast<double>(samples_.size() - equations.size());
    return {equations.errorOf(1 + numbersEach * partial, variance),
            equations.errorOf(2 + numbersEach * partial, variance)};
}

} // namespace physvib
