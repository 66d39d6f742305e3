// SPDX-License-Identifier: GPL-3.0-or-later
// The gain lane of one strip or group, over what it has played: points that are added, moved and taken away.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

class LaneRow final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// Strips come first, then groups. `desk` outlives it.
    LaneRow(Desk& desk, std::size_t number);

    void takeMix();
    void show(double spanSeconds); ///< the time that its width is
    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent&) override { isDragging_ = false; }
    void focusGained(FocusChangeType) override { repaint(); }
    void paint(juce::Graphics& g) override;

    static juce::NormalisableRange<double> scale(); ///< of gains, upwards: a fader's

private:
    bool isThere() const {
        return number_ < desk_.mix().strips.size() + desk_.mix().groups.size();
    } // else it goes in a moment
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
