// SPDX-License-Identifier: GPL-3.0-or-later
// Over the top of the world: what hands did as the scene's script, while it is recorded and when it is
// trimmed.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Shown while hands are recorded, and as long as the scene has their script, where no tool has its own
/// things. M only.
class ScriptStrip final : public juce::Component {
public:
    explicit ScriptStrip(Desk& desk);

    void refresh(bool isHand); ///< a few times a second; whether the hand is the tool
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
        closed_; // of the script that is shown; that is not to be shown any more
    juce::Slider* dragged_ = nullptr;
    bool wasRecording_ = false;
};

} // namespace physvib
