// SPDX-License-Identifier: GPL-3.0-or-later
// Channel strips: group, meter with held peak and ceiling, fader, mute, solo, polarity, delay, the level in
// g, output, tests. Their panel, with groups, an empty place for the next strip, and the master strip.
#pragma once
#include "Mixer/Widgets/Parts.h"

namespace physvib {

class StripView final : public StripParts, public juce::FileDragAndDropTarget {
public:
    /// In pixels; strips share the width of the panel. From `easyWidth` on, wide buttons are beside the
    /// fader, from `wholeWidth` on, the figures of the scale are shown, too.
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

    MixerModel& model_;
    const std::size_t index_;
    juce::Label name_, level_;
    Fader fader_;
    juce::TextButton mute_{"M"};
    std::unique_ptr<juce::TextButton> remove_;
};

class StripsPanel final : public juce::Component {
public:
    explicit StripsPanel(MixerModel& model);
    void mixChanged();
    void refresh(const MixerMoment& moment);
    int widthFor(int strip) const; ///< at which all strips of that width are visible
    /// Opens the list of outputs of a strip.
    void showOutputs(int enchanter);
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
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
