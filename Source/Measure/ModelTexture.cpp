// SPDX-License-Identifier: MIT
// Converts an autoregressive texture model to grains: position, width and strength of its spectral peak.
#include "Contacts/Grains.h"
#include "Core/Limits.h"
#include "Measure/TextureExtractor.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

namespace physvib {
namespace {

constexpr double lowHz = 20.0, highHz = 1000.0, stepHz = 0.5; // tactile range
constexpr double grainsPerPeriod = 2.0;

/// True if the model decays without noise: all reflection coefficients below 1 (backward Levinson recursion).
bool isStable(std::vector<double> a) {
    while (!a.empty()) {
        const double k = a.back(), rest = 1.0 - k * k;
        if (!(std::abs(k) < 1.0)) return false;
        std::vector<double> shorter(a.size() - 1);
        for (std::size_t i = 0; i < shorter.size(); ++i) shorter[i] = (a[i] - k * a[a.size() - 2 - i]) / rest;
        a = std::move(shorter);
    }
    return true;
}

/// Power density in (m/s^2)^2 per Hz, every stepHz from lowHz on.
std::vector<double> spectrumOf(const AutoregressiveModel& model) {
    std::vector<double> all;
    for (double hz = lowHz; hz <= std::min(highHz, 0.5 * model.rateHz); hz += stepHz) {
        const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * hz / model.rateHz);
        std::complex<double> sum = 0.0;
        for (std::size_t k = model.coefficients.size(); k-- > 0;) sum = (sum + model.coefficients[k]) * turn;
        all.push_back(2.0 * model.variance / model.rateHz / std::norm(1.0 + sum));
    }
    return all;
}

/// Half-power width of a peak in Hz; for a peak at an end of the band, twice the visible half.
double halfWidthHz(const std::vector<double>& spectrum, std::size_t peak) {
    std::size_t low = peak, high = peak;
    while (low > 0 && spectrum[low] > 0.5 * spectrum[peak]) --low;
    while (high + 1 < spectrum.size() && spectrum[high] > 0.5 * spectrum[peak]) ++high;
    const bool endsLow = spectrum[low] > 0.5 * spectrum[peak],
               endsHigh = spectrum[high] > 0.5 * spectrum[peak];
    if (endsLow && !endsHigh) low = peak - std::min(peak, high - peak), high += high - peak - (peak - low);
    if (endsHigh && !endsLow) high = peak + (peak - low);
    return stepHz * static_cast<double>(high - low);
}

/// Average power per grain, in units of a grain's power. Random spacings keep some of the regularity of their
/// mean rate, see decision 66.
double unevenPower() {
    const double angle = std::numbers::pi * GrainChance::spacingRange / grainsPerPeriod,
                 order = std::sin(angle) / angle;
    const double mean = GrainChance::leastStrength + 0.5 * GrainChance::strengthRange;
    return mean * mean + GrainChance::strengthRange * GrainChance::strengthRange / 12.0 -
           mean * mean * order * order;
}

} // namespace

Result<ScrapedTexture> textureOf(const AutoregressiveModel& model, const Scrape& scrape) {
    if (!isStable(model.coefficients))
        return Failure{"expected a model that comes to rest without noise, found one that grows"};
    const std::vector<double> spectrum = spectrumOf(model);
    const auto highest = std::ranges::max_element(spectrum);
    if (highest == spectrum.end() || !(*highest > 0.0) || !std::isfinite(*highest))
        return Failure{"expected a model that is felt from 20 to 1000 Hz, found none"};
    const auto peak = static_cast<std::size_t>(highest - spectrum.begin());
    double power = 0.0;
    for (const double density : spectrum) power += density * stepHz;
    ScrapedTexture found;
    found.frequencyHz = lowHz + stepHz * static_cast<double>(peak);
    found.decayPerSecond =
        std::clamp(std::numbers::pi * halfWidthHz(spectrum, peak), 0.5, limits::maxDecayPerSecond);
    found.grainsPerSecond = grainsPerPeriod * found.frequencyHz;
    found.texture.grainMetres = scrape.metresPerSecond / found.grainsPerSecond;
    const double omega = 2.0 * std::numbers::pi * found.frequencyHz, tau = found.decayPerSecond;
    // energy of exp(-tau t) sin(omega t)
    const double ringing = omega * omega / (4.0 * tau * (omega * omega + tau * tau));
    found.strength = std::sqrt(power / (found.grainsPerSecond * unevenPower() * ringing));
    found.texture.roughness = found.strength / omega * scrape.massKg /
                              grainImpulse(1.0, scrape.loadNewtons, scrape.metresPerSecond);
    if (const auto fault = faultOf(found.texture); !fault.empty()) return Failure{std::string{fault}};
    return found;
}

} // namespace physvib
