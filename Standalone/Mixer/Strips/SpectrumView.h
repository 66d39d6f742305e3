// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra of the actuators' output, one curve each, with fast attack and slow decay.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/FrequencyAxis.h"

namespace physvib {

class SpectrumView final : public juce::Component {
public:
    static constexpr int mostCurves = 8, looksPerSecond = 10;

    explicit SpectrumView(Desk& desk);

    /// Updates if it is time; repaints if the change is visible.
    void refresh();
    const SpectrumLevels& shown(int channel) const { return shown_[static_cast<std::size_t>(channel)]; }
    void paint(juce::Graphics& g) override;

private:
    Desk& desk_;
    std::array<SpectrumLevels, mostCurves> shown_;
    std::int64_t seen_ = -1;
    double lookedAtMs_ = 0.0;
};

} // namespace physvib
