// SPDX-License-Identifier: GPL-3.0-or-later
// Panel of the mixer's strips and groups, an empty place for the next strip, and the master strip.
#pragma once
#include "Host/Views/StripParts.h"
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Strips/StripView.h"
#include "Mixer/Widgets/Parts.h"

namespace physvib {

/// View of a strip group: name, fader, mute, and members.
class GroupView final : public juce::Component {
public:
    static constexpr int width = StripView::width;

    GroupView(MixerModel& model, int group);
    void mixChanged();
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const StripGroup& group() const { return model_.mix().groups[index_]; }
    template <class Change>
    void change(const juce::String& name, Change change, bool continuesEdit = false);
    void rename();
    void remove();

    MixerModel& model_;
    const std::size_t index_;
    juce::Label name_, level_;
    Fader fader_;
    juce::TextButton mute_{"M"};
    std::unique_ptr<juce::TextButton> remove_;
};

/// Menu of groups for a strip, including a new one. Message thread.
void showGroupMenu(MixerModel& model, std::size_t strip, juce::Component& from);

class StripsPanel final : public juce::Component {
public:
    explicit StripsPanel(MixerModel& model);
    void mixChanged();
    void refresh(const MixerMoment& moment);
    int widthFor(int strip) const; ///< with all strips in sight, each so wide
    /// Opens the list of outputs of a strip.
    void showOutputs(int enchanter);
    void paint(juce::Graphics& g) override;
    void resized() override;
    void focusOfChildComponentChanged(FocusChangeType) override; ///< scrolls to the focused strip

private:
    /// The place of the next strip.
    struct AttachPlace final : AttachButton {
        using AttachButton::AttachButton;
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
    };

    static constexpr int between = 6, attachWidth = 52;
    int fixedWidth() const; ///< of the row, beside its strips
    void makeStrips();
    void makeGroups();

    MixerModel& model_;
    struct Row final : juce::Viewport {
        void visibleAreaChanged(const juce::Rectangle<int>& area) override;
        int step = 0; ///< of a strip and what is between two
    } viewport_;
    juce::Component row_;
    std::vector<std::unique_ptr<StripView>> strips_;
    std::vector<std::unique_ptr<GroupView>> groups_;
    juce::StringArray labels_, groupNames_;
    AttachPlace attach_{model_, "Attach an actuator", "Attach an actuator: press, or drag it onto the field"};
    MasterStrip master_;
};

} // namespace physvib
