// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra of what the enchanters play, one curve each: they rise at once and fall calmly.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/FrequencyAxis.h"

namespace physvib {

class SpectrumView final : public juce::Component {
public:
    static constexpr int mostCurves = 8, looksPerSecond = 10;

    explicit SpectrumView(Desk& desk);

    /// Looks for what is new, if it is time; repaints if that is to be seen.
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
