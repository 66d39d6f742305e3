// SPDX-License-Identifier: GPL-3.0-or-later
// Strip above the world that shows recorded user input, and trims it as the scene's script.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Visible while input is recorded, and while the scene has the recorded script and the hand tool is active.
/// Message thread only.
class ScriptStrip final : public juce::Component {
public:
    explicit ScriptStrip(Desk& desk);

    void refresh(bool isHand); ///< a few times a second; true if the hand is the active tool
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void resized() override;

private:
    juce::Rectangle<int> lane() const;
    float placeOf(double seconds) const;
    void show();
    void use();

    Desk& desk_;
    juce::Label words_;
    juce::Slider from_, to_;
    juce::ToggleButton repeats_{"repeat"};
    juce::TextButton end_{"End"}, again_{"From the start"}, close_{"Close"};
    static constexpr int high = 92, recordingHigh = 40;
    std::shared_ptr<const Scene> shown_,
        closed_; // scene of the displayed script; scene whose strip was closed
    juce::Slider* dragged_ = nullptr;
    bool wasRecording_ = false;
};

} // namespace physvib
