// SPDX-License-Identifier: GPL-3.0-or-later
// Panel of the mixer's strips and groups, an empty place for the next strip, and the master strip.
#pragma once
#include "Mixer/Strips/GroupView.h"
#include "Mixer/Strips/StripView.h"

namespace physvib {

class StripsPanel final : public juce::Component {
public:
    explicit StripsPanel(Desk& desk);
    void takeMix();
    void refresh(const DeskMoment& moment);
    int widthFor(int strip) const; ///< with all strips in sight, each so wide
    /// Opens the list of outputs of a strip.
    void showOutputs(int enchanter);
    void paint(juce::Graphics& g) override;
    void resized() override;
    void focusOfChildComponentChanged(FocusChangeType) override; ///< scrolls to the focused strip

private:
    /// Place of the next strip. A click attaches an actuator in the centre of the field; dragging attaches it
    /// where it is dropped.
    class AttachPlace final : public juce::Button {
    public:
        AttachPlace();
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
        void mouseDrag(const juce::MouseEvent& e) override;
    };

    static constexpr int between = 6, attachWidth = 52;
    int fixedWidth() const; ///< of the row, beside its strips
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
