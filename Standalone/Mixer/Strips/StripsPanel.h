// SPDX-License-Identifier: GPL-3.0-or-later
// Channel strips (StripView): group, meter with held peak and ceiling, fader, mute, solo, polarity, delay,
// level in g, output, tests. Their panel has groups, an empty place for the next strip and the master strip.
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"

namespace physvib {

/// View of the channel strip of an actuator. Message thread.
class StripView final : public StripParts, public juce::FileDragAndDropTarget {
public:
    /// Widths of a strip in pixels; strips share the width of the panel. From `roomyWidth` on, wide buttons
    /// are beside the fader; from `fullWidth` on, the scale has figures.
    static constexpr int width = 78, roomyWidth = 108, fullWidth = 128, maxWidth = 140;

    StripView(MixerModel& model, int strip);
    void mixChanged();
    void refresh(const MixerSnapshot& snapshot);
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
    bool isValid() const { return index_ < model_.mix().strips.size(); } // false: its strip was removed
    const Strip& strip() const { return model_.mix().strips[index_]; }
    void change(const juce::String& name, const std::function<void(Strip&)>& modify) override {
        change(name, false, modify);
    }
    void change(const juce::String& name, bool continuesEdit, const std::function<void(Strip&)>& modify);
    void fillOutputs();

    MixerModel& model_;
    const std::size_t index_;
    juce::ComboBox output_;
    std::unique_ptr<juce::TextButton> group_, test_;
    IconButton sweep_;
    bool hasOutput_ = false;  // whether its output is available, as displayed
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
    void change(const juce::String& name, bool continuesEdit, Change change);
    void rename();

    MixerModel& model_;
    const std::size_t index_;
    juce::Label name_, level_;
    Fader fader_;
    juce::TextButton mute_{"M"};
    std::unique_ptr<juce::TextButton> remove_;
};

/// The row of strips and groups, which scrolls, and the master strip at its right. Message thread.
class StripsPanel final : public juce::Component {
public:
    explicit StripsPanel(MixerModel& model);
    void mixChanged();
    void refresh(const MixerSnapshot& snapshot);
    int widthFor(int width) const;  ///< pixels of the panel that show all strips at that width
    void showOutputs(int actuator); ///< opens the list of outputs of its strip
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;
    void focusOfChildComponentChanged(FocusChangeType) override; ///< scrolls to the focused strip

private:
    /// The place of the next strip.
    struct AttachPlace final : AttachButton {
        using AttachButton::AttachButton;
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
    };

    static constexpr int stripGap = 6, attachWidth = 52;
    int fixedWidth() const; ///< pixels of the row without its strips

    MixerModel& model_;
    struct Row final : juce::Viewport {
        void visibleAreaChanged(const juce::Rectangle<int>& area) override;
        int stripPitch = 0; ///< width of a strip and the gap after it, pixels
    } viewport_;
    juce::Component row_;
    std::vector<std::unique_ptr<StripView>> strips_;
    std::vector<std::unique_ptr<GroupView>> groups_;
    juce::StringArray labels_, groupNames_;
    AttachPlace attach_{model_, "Attach an actuator", "Attach an actuator: press, or drag it onto the field"};
    MasterStrip master_;
};

} // namespace physvib
