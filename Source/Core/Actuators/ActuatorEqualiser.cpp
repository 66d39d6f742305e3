// SPDX-License-Identifier: MIT
// Design of the equaliser's second-order sections, and its maximum flat level.
#include "Core/Actuators/ActuatorEqualiser.h"
#include <algorithm>

namespace physvib {
namespace {

// Q of the three sections of a sixth-order Butterworth filter
constexpr double butterworthQ[] = {0.51763809020504148, 0.70710678118654752, 1.9318516525781366};
constexpr double edgeRatio = 0.80; // corner of a slope relative to the band's edge: costs 0.3 dB at the edge
constexpr double highestShare = 0.45; // of the sample rate: above, the converter's own filter suffices
constexpr RootPair atZero{-2.0, 1.0}; // double zero at 0 Hz
constexpr RootPair atTop{2.0, 1.0};   // double zero at half the rate, where the bilinear transform puts it

} // namespace

ActuatorEqualiser::ActuatorEqualiser(const EqualisedActuator& actuator, int sampleRateHz) noexcept
    : sampleRateHz_{static_cast<double>(sampleRateHz)}
    , band_{actuator.band} {
    const auto& [resonator, band] = actuator;
    if (!actuator.isKnown() || band.highHz >= 0.5 * sampleRateHz_) return;
    const double lowHz = edgeRatio * band.lowHz, highHz = band.highHz / edgeRatio;
    const auto poles = [this](double hz, double q) { return RootPair::exact(hz, q, sampleRateHz_); };
    sections_[0] = {1.0, poles(resonator.resonanceHz, resonator.q), poles(lowHz, butterworthQ[0])};
    // the other two zeros at 0 Hz cancel those of H
    sections_[1] = {1.0, atZero, poles(lowHz, butterworthQ[1])};
    sections_[2] = {1.0, atZero, poles(lowHz, butterworthQ[2])};
    sectionCount_ = 3;
    if (highHz < highestShare * sampleRateHz_)
        for (const double q : butterworthQ)
            sections_[static_cast<std::size_t>(sectionCount_++)] = {
                1.0, atTop, RootPair::bilinear(highHz, q, sampleRateHz_)};
    const double middleHz = std::sqrt(band.lowHz * band.highHz);
    sections_[0].scale(1.0 / portable::abs(at(middleHz) * resonator.at(middleHz)));
}

bool ActuatorEqualiser::process(float* io, int frames, bool isSilent) noexcept {
    if (!isOn() || (isSilent && isAtRest())) return isSilent;
    for (int n = 0; n < frames; ++n) {
        double x = static_cast<double>(io[n]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(sectionCount_); ++k) x = sections_[k].process(x);
        io[n] = static_cast<float>(x);
    }
    return false;
}

bool ActuatorEqualiser::isAtRest() const noexcept {
    return std::ranges::all_of(sections_, [](const Biquad& section) { return section.isAtRest(); });
}

std::complex<double> ActuatorEqualiser::at(double frequencyHz) const noexcept {
    std::complex<double> product = 1.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(sectionCount_); ++k)
        product *= sections_[k].at(frequencyHz, sampleRateHz_);
    return product;
}

double ActuatorEqualiser::flatLevel(double driveLimit) const noexcept {
    if (!isOn()) return 0.0;
    constexpr int steps = 400; // a resonance of Q 100 is wider than one step of a four-octave band
    double largest = 0.0;
    for (int i = 0; i <= steps; ++i)
        largest =
            std::max(largest, portable::abs(at(band_.lowHz * portable::pow(band_.highHz / band_.lowHz,
                                                                           static_cast<double>(i) / steps))));
    return driveLimit / largest;
}

} // namespace physvib
