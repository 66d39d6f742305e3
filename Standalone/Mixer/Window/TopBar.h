// SPDX-License-Identifier: GPL-3.0-or-later
// Bar that is always visible: scene and time, device status, and the silence button.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

class TopBar final : public juce::Component {
public:
    explicit TopBar(Desk& desk);

    void refresh(const DeskMoment& moment);
    void takeMix(); ///< the mixer state changed
    void togglePause();

    std::function<void(juce::Component& from)> onMenu;
    std::function<void()> onRecord, onOpenScene;
    std::function<void(const juce::File&)> onOwnScene;
    void setOwnScenes(const juce::Array<juce::File>& files); ///< listed below the built-in ones
    void setRecording(bool isRecording);

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void chooseScene();
    void listScenes();
    juce::Array<juce::File> own_;

    Desk& desk_;
    int looks_ = 0;
    juce::TextButton menu_{"PhysVib"}, slow_, record_, silence_{"SILENCE  Esc"};
    juce::ComboBox scene_;
    SignButton pause_{Sign::pause, "Pause the world"}, step_{Sign::step, "One step of the world"},
        restart_{Sign::restart, "Start the scene anew"};
    juce::Label seedName_, seed_, time_;
    TwoLines device_{"Device state"}, board_{"Board state"}, load_{"Load"};
};

} // namespace physvib
