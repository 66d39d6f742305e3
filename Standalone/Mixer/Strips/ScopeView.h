// SPDX-License-Identifier: GPL-3.0-or-later
// Scope of the last second, one trace per actuator, with their spectra.
#pragma once
#include "Mixer/Strips/SpectrumView.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class ScopeView final : public Tab {
public:
    explicit ScopeView(Desk& desk);

    void takeMix() override { repaint(); }
    void refresh(const DeskMoment&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isQuiet() const;
    void drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const;

    Desk& desk_;
    SpectrumView spectrum_;
    juce::Rectangle<int> lanes_;
    std::int64_t shown_ = -1;
    bool wasQuiet_ = false;
};

} // namespace physvib
