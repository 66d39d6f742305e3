// SPDX-License-Identifier: MIT
// A song whose onsets are known to the frame: drums at uneven times over a chord that stays, and noise.
#pragma once
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace physvib::test {

enum class Drum { kick, snare, hat };

struct DrumHit {
    double seconds;
    Drum drum;
};

struct BeatSong {
    std::vector<float> samples;
    std::vector<DrumHit> hits; ///< in time order

    BeatSong(double seconds, int rateHz, std::uint64_t seed)
        : samples(static_cast<std::size_t>(seconds * rateHz))
        , rateHz_{rateHz}
        , random_{seed, "song"} {
        addChord();
        constexpr double beatSeconds = 0.5; // eighths: kick hat snare hat
        const double until = seconds - 1.0;
        for (int eighth = 0; 0.5 + 0.5 * beatSeconds * eighth < until; ++eighth) {
            // nobody plays on the grid
            const double at = 0.5 + 0.5 * beatSeconds * eighth + 0.02 * random_.uniform();
            strike(at,
                   std::array{Drum::kick, Drum::hat, Drum::snare,
                              Drum::hat}[static_cast<std::size_t>(eighth % 4)],
                   0.4 + 0.6 * random_.uniform());
        }
    }

private:
    void addChord() {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double t = static_cast<double>(i) / rateHz_;
            double chord = 0.0;
            for (const double hz : {110.0, 220.0, 277.2, 329.6, 440.0})
                chord += 0.03 * std::sin(2.0 * std::numbers::pi * hz * t) *
                         (1.0 + 0.3 * std::sin(2.0 * std::numbers::pi * 0.4 * t + hz));
            samples[i] = static_cast<float>(chord + 0.003 * random_.normal());
        }
    }

    void strike(double seconds, Drum drum, double level) {
        hits.push_back({seconds, drum});
        double smooth = 0.0;
        const auto first = static_cast<std::size_t>(std::ceil(seconds * rateHz_));
        for (std::size_t i = first;
             i < std::min(samples.size(), first + static_cast<std::size_t>(rateHz_ / 2)); ++i) {
            const double t = static_cast<double>(i) / rateHz_ - seconds, noise = random_.normal();
            smooth += (1.0 - std::exp(-2.0 * std::numbers::pi * 4000.0 / rateHz_)) * (noise - smooth);
            samples[i] +=
                static_cast<float>(level * std::min(1.0, t / 0.001) * sound(drum, t, noise, smooth));
        }
    }

    static double sound(Drum drum, double t, double noise, double smooth) {
        const auto sine = [t](double hz) { return std::sin(2.0 * std::numbers::pi * hz * t); };
        switch (drum) {
        case Drum::kick:
            return 0.6 *
                   std::sin(2.0 * std::numbers::pi * (55.0 * t + 4.0 * (1.0 - std::exp(-t / 0.03)) * 0.5)) *
                   std::exp(-t / 0.12);
        case Drum::snare: return (0.15 * smooth + 0.3 * sine(190.0)) * std::exp(-t / 0.07);
        default: return 0.12 * (noise - smooth) * std::exp(-t / 0.03);
        }
    }

    int rateHz_;
    SeededRandom random_;
};

} // namespace physvib::test
