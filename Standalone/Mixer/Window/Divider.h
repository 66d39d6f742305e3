// SPDX-License-Identifier: GPL-3.0-or-later
// Handle between two panels: drag it, or move it with the arrow keys; a double click makes it automatic.
#pragma once
#include "Host/Views/Look.h"
#include <functional>

namespace physvib {

/// Message thread only.
class Divider final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `isUpright`: it lies between left and right.
    Divider(const juce::String& title, bool isUpright);

    std::function<void(int pixels)> onMove; ///< to the right or down, since the last call
    std::function<void()> onReset;

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseEnter(const juce::MouseEvent&) override { repaint(); }
    void mouseExit(const juce::MouseEvent&) override { repaint(); }
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent&) override;

private:
    const bool isUpright_;
};

} // namespace physvib
