// SPDX-License-Identifier: GPL-3.0-or-later
// View of the gain lane of a strip or group over its played waveform; points can be added, moved and removed.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

class LaneRow final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `number` counts strips, then groups. `desk` outlives it.
    LaneRow(Desk& desk, std::size_t number);

    void takeMix();
    void show(double spanSeconds); ///< duration shown in its width
    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent&) override { isDragging_ = false; }
    void focusGained(FocusChangeType) override { repaint(); }
    void paint(juce::Graphics& g) override;

    static juce::NormalisableRange<double> scale(); ///< of gains, upwards, as for a fader

private:
    bool isThere() const {
        return number_ < desk_.mix().strips.size() + desk_.mix().groups.size();
    } // false after the strip was removed, until the view follows
    bool isGroup() const { return number_ >= desk_.mix().strips.size(); }
    std::size_t group() const { return number_ - desk_.mix().strips.size(); }
    const GainLane& lane() const;
    std::vector<int> channels() const;
    juce::Point<float> placeOf(const GainPoint& point) const;
    GainPoint pointAt(juce::Point<float> place) const;
    int nearest(juce::Point<float> place) const;
    void edit(const GainLane& lane, bool goesOn = false);
    void add(const GainPoint& point);
    void move(GainPoint point, bool goesOn);
    void removeChosen();
    void showMenu();
    void tellChosen();
    void drawWave(juce::Graphics& g) const;
    void drawLine(juce::Graphics& g) const;

    Desk& desk_;
    const std::size_t number_;
    juce::String name_;
    double spanSeconds_ = 10.0;
    int chosen_ = -1;
    bool isDragging_ = false, isMoved_ = false;
};

} // namespace physvib
