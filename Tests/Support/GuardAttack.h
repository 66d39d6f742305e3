// SPDX-License-Identifier: MIT
// Looks for permitted input that holds a coil at nearly direct current behind a guard: lists of strikes, each
// of which may be played, by hill climbing; and envelopes (what half waves of a felt frequency, or clips, add
// up to), by a strategy that adapts the width of its steps. Seeded: it finds the same each time.
#pragma once
#include "Core/Actuators/OutputGuard.h"
#include "Support/ClosedForm.h"
#include "Support/SlowFigures.h"
#include <algorithm>
#include <complex>
#include <functional>
#include <memory>
#include <string>

namespace physvib::test {

/// Worst rms below 5 Hz of a second, by an ideal low-pass, which rings before and after for ever. At `rate`,
/// a multiple of 100.
inline double idealSlowRms(std::span<const float> samples, int rate) {
    const auto bin = static_cast<std::size_t>(rate / 100);
    std::vector<double> bins, ideal, squares{0.0};
    for (std::size_t n = 0; n + bin <= samples.size(); n += bin) {
        double sum = 0.0;
        for (std::size_t k = 0; k < bin; ++k) sum += double(samples[n + k]);
        bins.push_back(sum / static_cast<double>(bin));
    }
    const int count = static_cast<int>(bins.size()), around = 100;
    for (int k = 0; k < count + around; ++k) {
        const double x = std::numbers::pi * k / 100.0;
        ideal.push_back(k == 0 ? 0.1 : std::sin(10.0 * x) / (100.0 * x));
    }
    double worst = 0.0;
    for (int n = -around; n < count + around; ++n) {
        double y = 0.0;
        for (int k = 0; k < count; ++k)
            y += bins[static_cast<std::size_t>(k)] * ideal[static_cast<std::size_t>(std::abs(n - k))];
        squares.push_back(squares.back() + y * y);
        if (const std::size_t at = squares.size() - 1; at >= 100)
            worst = std::max(worst, (squares[at] - squares[at - 100]) / 100.0);
    }
    return std::sqrt(worst);
}

struct SlowStrike {
    double seconds, hz, decay, amplitude, duration; ///< duration 0: until it has decayed
};

struct GuardAttack {
    static constexpr double leadSeconds = 0.3, knotSeconds = 0.05;
    std::vector<SlowStrike> strikes;
    std::vector<double> knots; ///< of an envelope, each knotSeconds from leadSeconds on

    std::vector<float> samples(int rate, double seconds = 5.0) const {
        std::vector<double> sum(static_cast<std::size_t>(seconds * rate));
        for (const auto& s : strikes) {
            const auto first = static_cast<std::size_t>(s.seconds * rate);
            const std::size_t end =
                s.duration > 0.0 ? std::min(sum.size(), first + static_cast<std::size_t>(s.duration * rate))
                                 : sum.size();
            const std::complex<double> turn = std::polar(std::exp(-s.decay / rate), turnOf(s.hz) / rate);
            std::complex<double> at{s.amplitude, 0.0};
            for (std::size_t n = first; n < end; ++n, at *= turn) sum[n] += at.imag();
        }
        for (std::size_t n = 0; !knots.empty() && n < sum.size(); ++n) {
            const double at = (static_cast<double>(n) / rate - leadSeconds) / knotSeconds;
            const auto k = static_cast<std::size_t>(std::max(at, 0.0));
            if (at < 0.0 || k + 1 >= knots.size()) continue;
            sum[n] += std::lerp(knots[k], knots[k + 1], at - static_cast<double>(k));
        }
        std::vector<float> limited(sum.size());
        for (std::size_t n = 0; n < sum.size(); ++n)
            limited[n] = static_cast<float>(std::clamp(sum[n], -1.0, 1.0));
        return limited;
    }

private:
    static double turnOf(double hz) { return 2.0 * std::numbers::pi * hz; }
};

/// Its search keeps the worst by `rms`, of an attack's samples behind a guard.
struct AttackSearch {
    std::function<double(const GuardAttack&)> rms;
    Random random;
    GuardAttack worst{};
    double worstRms = 0.0;

    AttackSearch(std::function<double(const GuardAttack&)> by, std::uint32_t seed)
        : rms{std::move(by)}
        , random{seed} {}

    /// Lists of at most `most` strikes.
    void climb(int evaluations, std::size_t most) {
        for (int i = 0; i < evaluations; ++i) {
            GuardAttack next = worst;
            if (i < evaluations / 5 || worst.strikes.empty()) {
                next = {};
                for (auto count = 1 + pick(most); count > 0; --count) next.strikes.push_back(strike());
            } else {
                for (auto count = 1 + pick(3); count > 0; --count) change(next.strikes, most);
            }
            keep(next);
        }
    }
    /// Envelopes of so many knots.
    void shape(int evaluations, std::size_t count) {
        GuardAttack best;
        const double hz = uniform(0.3, 5.2), phase = uniform(0.0, 6.3), level = uniform(0.03, 0.1);
        for (std::size_t k = 0; k < count; ++k)
            best.knots.push_back(
                level * std::sin(2.0 * std::numbers::pi * hz * GuardAttack::knotSeconds * double(k) + phase));
        double most = rms(best), width = 0.05;
        for (int i = 0; i < evaluations; ++i) {
            GuardAttack next = best;
            const double middle = uniform(0.0, double(count)), spread = std::exp(uniform(-1.0, 2.0)),
                         height = width * gauss(), tilt = uniform(0.0, 1.0) < 0.3 ? uniform(0.2, 1.6) : 0.0;
            for (std::size_t k = 0; k < count; ++k) {
                const double x = (double(k) - middle) / spread;
                next.knots[k] += height * std::exp(-x * x) * std::cos(tilt * (double(k) - middle));
            }
            const double now = rms(next);
            width = std::clamp(width * (now > most ? 1.5 : 0.93), 1e-4, 0.3);
            if (now <= most) continue;
            most = now;
            best = next;
        }
        if (most > worstRms) worstRms = most, worst = best;
    }

private:
    double uniform(double from, double to) { return random.uniform(from, to); }
    double gauss() {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) sum += uniform(0.0, 1.0);
        return sum;
    }
    std::size_t pick(std::size_t below) { return static_cast<std::size_t>(uniform(0.0, double(below))); }

    SlowStrike strike() {
        SlowStrike s{uniform(0.2, 3.0), uniform(0.3, 8.0), 0.0, std::pow(10.0, uniform(-1.7, 0.0)),
                     uniform(0.0, 1.0) < 0.6 ? 0.0 : uniform(0.01, 1.5)};
        s.decay = uniform(0.0, 3.0);
        if (uniform(0.0, 1.0) < 0.5) s.amplitude = -s.amplitude;
        return permitted(s);
    }
    static SlowStrike permitted(SlowStrike s) {
        s.seconds = std::clamp(s.seconds, 0.1, 3.5);
        s.hz = std::clamp(s.hz, 0.1, 40.0);
        s.decay = std::max(s.decay, s.hz < 5.0 ? 1.0 : 0.0);
        if (s.duration < 0.002) s.duration = 0.0;
        return s;
    }
    void change(std::vector<SlowStrike>& list, std::size_t most) {
        SlowStrike& s = list[pick(list.size())];
        const double step = std::pow(10.0, uniform(-2.0, 0.0)) * gauss();
        switch (pick(7)) {
        case 0: s.seconds += 0.2 * step; break;
        case 1: s.hz *= std::exp(0.2 * step); break;
        case 2: s.decay *= std::exp(step); break;
        case 3: s.amplitude *= std::exp(0.5 * step); break;
        case 4:
            s.duration = uniform(0.0, 1.0) < 0.3 ? uniform(-0.5, 1.5) : s.duration * std::exp(0.3 * step);
            break;
        case 5:
            if (list.size() < most) return list.push_back(strike());
            break;
        default:
            if (list.size() > 1) std::swap(s, list.back()), list.pop_back();
            return;
        }
        s = permitted(s);
    }
    void keep(const GuardAttack& next) {
        if (const double now = rms(next); now > worstRms) worstRms = now, worst = next;
    }
};

// The guards that a signal passes on its way to an actuator, for GuardAttack.

struct GuardPath {
    std::string name;
    int rate; ///< of the search: low, since it takes thousands of renders
    std::function<std::vector<float>(std::vector<float>)> leaves;
};

inline SlowFigures figuresBehind(const GuardPath& path, const GuardAttack& attack) {
    return slowFigures(path.leaves(attack.samples(path.rate)), path.rate);
}

/// An OutputGuard whose rate changes (here: to the same) after so many frames, by turns; none: never.
inline GuardPath outputGuardPath(const std::string& name, int rate, GuardPlace place,
                                 std::vector<std::size_t> changes = {}) {
    return {name, rate, [=](std::vector<float> samples) {
                const auto guard = std::make_unique<OutputGuard>();
                guard->prepare(rate, 1, place);
                std::size_t next = 0;
                for (std::size_t n = 0, count; n < samples.size(); n += count) {
                    count = changes.empty() ? samples.size() : changes[next++ % changes.size()];
                    count = std::min(count, samples.size() - n);
                    float* at = samples.data() + n;
                    guard->process(&at, static_cast<int>(count));
                    guard->changeRate(rate);
                }
                return samples;
            }};
}

/// The rule alone, in tiles of the board's half millisecond.
inline GuardPath boardGuardPath() {
    constexpr int rate = 2000;
    return {"board", rate, [](std::vector<float> samples) {
                GuardLaw<1> law;
                law.prepare(1, GuardPlace::last);
                law.setTile(1.0f / rate);
                for (float& x : samples) law.update({(x *= law.endGain(0)) / rate});
                return samples;
            }};
}

inline std::vector<GuardPath> guardPaths() {
    return {outputGuardPath("rendered", 6000, GuardPlace::rendered),
            outputGuardPath("last", 6000, GuardPlace::last),
            outputGuardPath("last, periods change", 6000, GuardPlace::last, {127, 611, 1400, 305}),
            boardGuardPath()};
}

} // namespace physvib::test
