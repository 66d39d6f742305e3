// SPDX-License-Identifier: GPL-3.0-or-later
// The desk's strips and groups side by side, the next strip's empty place, and the master.
#pragma once
#include "Mixer/Strips/GroupView.h"
#include "Mixer/Strips/StripView.h"

namespace physvib {

class StripsPanel final : public juce::Component {
public:
    explicit StripsPanel(Desk& desk);
    void takeMix();
    void refresh(const DeskMoment& moment);
    void paint(juce::Graphics& g) override;
    void resized() override;
    void focusOfChildComponentChanged(FocusChangeType) override; ///< what has the focus is seen

private:
    /// The place where the next strip would be; pressed, it attaches an enchanter in the middle, dragged,
    /// where it is dropped.
    class AttachPlace final : public juce::Button {
    public:
        AttachPlace();
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
        void mouseDrag(const juce::MouseEvent& e) override;
    };

    void makeStrips();
    void makeGroups();

    Desk& desk_;
    juce::Viewport viewport_;
    juce::Component row_;
    std::vector<std::unique_ptr<StripView>> strips_;
    std::vector<std::unique_ptr<GroupView>> groups_;
    juce::StringArray labels_, groupNames_;
    AttachPlace attach_;
    MasterStrip master_;
};

} // namespace physvib
