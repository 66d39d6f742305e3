// SPDX-License-Identifier: GPL-3.0-or-later
// Bar that is always visible: scene and time, device status, and the silence button.
#pragma once
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/Parts.h"
#include "Mixer/World/WorldPanel.h"

namespace physvib {

class TopBar final : public juce::Component {
public:
    explicit TopBar(MixerModel& model);

    void refresh(const MixerMoment& moment);
    void mixChanged(); ///< the mixer state changed
    void togglePause();

    std::function<void(juce::Component& from)> onMenu;
    std::function<void()> onRecord, onSave, onOpenScene, onDevice;
    std::function<void(const juce::File&)> onOwnScene;
    void setOwnScenes(const juce::Array<juce::File>& files); ///< listed below the built-in ones
    void setRecording(bool isRecording);                     ///< counts its seconds
    void setDocument(const juce::String& name) { save_.setTooltip("Save " + name + " (Ctrl+S)"); }
    /// Only the button that silences is left.
    void setShow(bool isShow);
    /// Without the controls of an engineer.
    void setPlay(bool isPlay);
    std::function<void()> onMode; ///< the other mode is wanted

    static constexpr int lineHeight = 52, showWidth = WorldPanel::silenceWidth;
    /// One line, or two in a narrow window, or where a board has something to say there.
    int heightFor(int width) const {
        return isPlay_ || width >= (hasBoard_ ? minFacts : minOneLine) ? lineHeight : lineHeight + secondLine;
    }

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    static constexpr int minOneLine = 1260, minFacts = 1400, secondLine = 24; // with load and board in it,
                                                                              // too
    void placeStates(juce::Rectangle<int> area);
    void showControls();
    bool isShow_ = false, isPlay_ = false, isToldOfLoad_ = false;
    void chooseScene();
    void listScenes();
    juce::Array<juce::File> own_;

    MixerModel& model_;
    const bool hasBoard_;
    int looks_ = 0;
    struct Lost { // in all
        std::uint64_t late = 0, lost = 0;
        bool operator==(const Lost&) const = default;
    } lost_, lostBefore_; // before it was last fine
    double lostAtMs_ = 0.0;
    bool isRecording_ = false;
    std::int64_t recordedFromNs_ = -1; // not seen yet
    juce::TextButton menu_{"Menu"}, slow_, record_, mode_, silence_{"SILENCE  Esc"};
    juce::ComboBox scene_;
    SignButton pause_{Sign::pause, "Pause the world"}, step_{Sign::step, "One step of the world"},
        restart_{Sign::restart, "Start the scene anew"}, save_{Sign::save, "Save the session (Ctrl+S)"},
        undo_{Sign::undo, "Undo"}, redo_{Sign::redo, "Redo"};
    juce::Label seed_, time_;
    TwoLines device_{"Device state"}, board_{"Board state"}, load_{"Load"};
};

} // namespace physvib
