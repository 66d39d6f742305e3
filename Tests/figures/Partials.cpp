// SPDX-License-Identifier: MIT
// How much of recorded hits one, two, four and six decaying sinusoids leave, from 20 to 1,000 Hz and through
// actuators of known resonance: a table by recordings.sh, which takes the recordings. Usage:
// physvib-partial-figures FILE.wav...
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/HitExcerpt.h"
#include "Measure/HitFit.h"
#include <array>
#include <cstdio>
#include <optional>

using namespace physvib;

namespace {

constexpr double lowHz = 20.0, highHz = 1000.0; // what skin feels
constexpr std::array<std::size_t, 4> counts{1, 2, 4, 6};

struct Actuator {
    const char* name;
    Resonator resonator; // unknown: flat
};
// The profiles know resonances; no Q is published: of a coin that rings, a flat coil that is damped, a piezo
// bender.
constexpr std::array<Actuator, 5> actuators{{{"flat", {}},
                                             {"110 Hz, Q 2 (haptuator-2)", {110.0, 2.0}},
                                             {"205 Hz, Q 5 (lra-205)", {205.0, 5.0}},
                                             {"205 Hz, Q 20 (lra-205)", {205.0, 20.0}},
                                             {"230 Hz, Q 10 (piezo-230)", {230.0, 10.0}}}};

/// Low-passed at highHz, and every `step`th sample of it.
std::vector<float> thinned(const std::vector<float>& x, double rateHz, std::size_t step) {
    constexpr int reach = 600;
    std::vector<double> kernel(2 * reach + 1);
    for (int i = -reach; i <= reach; ++i) {
        const double t = 2.0 * std::numbers::pi * highHz * i / rateHz,
                     window = std::cos(0.5 * std::numbers::pi * i / (reach + 1));
        kernel[static_cast<std::size_t>(i + reach)] =
            (i == 0 ? 1.0 : std::sin(t) / t) * window * window * 2.0 * highHz / rateHz;
    }
    std::vector<float> y;
    for (std::size_t n = 0; n < x.size(); n += step) {
        double sum = 0.0;
        for (int i = -reach; i <= reach; ++i)
            if (const auto at = static_cast<std::ptrdiff_t>(n) + i;
                at >= 0 && at < static_cast<std::ptrdiff_t>(x.size()))
                sum += kernel[static_cast<std::size_t>(i + reach)] *
                       static_cast<double>(x[static_cast<std::size_t>(at)]);
        y.push_back(static_cast<float>(sum));
    }
    return y;
}

/// Energy of the samples behind the actuator, within the band.
double energyThrough(const std::vector<double>& x, double rateHz, const Resonator& resonator) {
    double sum = 0.0;
    const double seconds = static_cast<double>(x.size()) / rateHz;
    for (double hz = std::ceil(lowHz * seconds) / seconds; hz <= highHz; hz += 1.0 / seconds) {
        std::complex<double> point;
        const auto turn = std::polar(1.0, -2.0 * std::numbers::pi * hz / rateHz);
        for (auto at = x.rbegin(); at != x.rend(); ++at) point = *at + turn * point;
        sum += std::norm(point * (resonator.isKnown() ? resonator.at(hz) : 1.0));
    }
    return sum;
}

using Residuals = std::array<std::array<double, counts.size()>, actuators.size()>; // dB

std::optional<Residuals> residualsOf(const std::vector<float>& recorded, double rateHz) {
    const auto step = static_cast<std::size_t>(rateHz / (4.0 * highHz));
    const std::vector<float> samples = thinned(recorded, rateHz, step);
    const double rate = rateHz / static_cast<double>(step);
    if (!recordingError(samples, rate, 0.01).empty() || isSilent(samples)) return std::nullopt;
    const HitExcerpt hit = strongestHit(samples, rate);
    const std::size_t begin = hit.begin - std::min(hit.begin, toSamples(onsetReachSeconds, rate));
    std::vector<double> all;
    for (std::size_t i = begin; i < hit.end; ++i) all.push_back(static_cast<double>(samples[i]) - hit.offset);
    if (static_cast<double>(all.size()) < 0.03 * rate) return std::nullopt;
    Residuals found{};
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const HitFit fit{all, hit.begin - begin, rate, counts[k]};
        std::vector<double> left = all;
        for (std::size_t i = 0; i < left.size(); ++i)
            if (const double t = static_cast<double>(i) / rate - fit.onsetSeconds(); t >= 0.0)
                for (const Partial& partial : fit.partials()) left[i] -= partial.value(t);
        for (std::size_t a = 0; a < actuators.size(); ++a)
            found[a][k] = 10.0 * std::log10(energyThrough(left, rate, actuators[a].resonator) /
                                            energyThrough(all, rate, actuators[a].resonator));
    }
    return found;
}

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

} // namespace

int main(int count, char** words) {
    std::vector<Residuals> all;
    for (int i = 1; i < count; ++i)
        if (const auto recording = readRecording(words[i]))
            if (const auto found =
                    residualsOf(loudestChannel(recording.value.channels), recording.value.sampleRateHz))
                all.push_back(*found);
    if (all.empty()) return std::fprintf(stderr, "expected recordings of hits\n"), 1;
    std::printf("| residual of %zu recordings, dB (median) | 1 partial | 2 | 4 | 6 | 4 gain 3 dB or more "
                "|\n| --- | --- | --- | --- | --- | --- |\n",
                all.size());
    for (std::size_t a = 0; a < actuators.size(); ++a) {
        std::printf("| %s |", actuators[a].name);
        std::size_t gain = 0;
        for (std::size_t k = 0; k < counts.size(); ++k) {
            std::vector<double> values;
            for (const Residuals& each : all) values.push_back(each[a][k]);
            std::printf(" %.1f |", medianOf(values));
        }
        for (const Residuals& each : all) gain += each[a][0] - each[a][2] >= 3.0 ? 1 : 0;
        std::printf(" %zu |\n", gain);
    }
    return 0;
}
