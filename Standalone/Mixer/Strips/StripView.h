// SPDX-License-Identifier: GPL-3.0-or-later
// A channel strip: group, meter with held peak and ceiling, fader, mute, solo, polarity, delay, the level in
// g, output, tests.
#pragma once
#include "Host/Views/StripParts.h"
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/MasterStrip.h"
#include "Mixer/Widgets/Parts.h"

namespace physvib {

class StripView final : public StripParts, public juce::FileDragAndDropTarget {
public:
    /// They share the panel; from `easyWidth` on buttons as wide as a pointer needs are beside the fader,
    /// from `wholeWidth` on with the scale's figures.
    static constexpr int width = 78, easyWidth = 108, wholeWidth = 128, mostWidth = 140;

    StripView(MixerModel& model, int strip);
    void mixChanged();
    void refresh(const MixerMoment& moment);
    void showOutputs() { output_.showPopup(); }
    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void paint(juce::Graphics& g) override;
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;
    bool isInterestedInFileDrag(const juce::StringArray& files) override { return isClipDrag(files); }
    void fileDragEnter(const juce::StringArray&, int, int) override { setDropping(true); }
    void fileDragExit(const juce::StringArray&) override { setDropping(false); }
    void filesDropped(const juce::StringArray& files, int, int) override;

private:
    void setDropping(bool isDropping);
    bool isThere() const { return index_ < model_.mix().strips.size(); } // false: its strip was removed
    const Strip& strip() const { return model_.mix().strips[index_]; }
    void change(const juce::String& name, const std::function<void(Strip&)>& how) override {
        change(name, how, false);
    }
    void change(const juce::String& name, const std::function<void(Strip&)>& how, bool continuesEdit);
    void fillOutputs();

    MixerModel& model_;
    const std::size_t index_;
    juce::ComboBox output_;
    std::unique_ptr<juce::TextButton> group_, test_;
    SignButton sweep_;
    bool isPlaced_ = false;   // its output, as shown
    bool isDropping_ = false; // a clip is being dragged over it
};

} // namespace physvib
