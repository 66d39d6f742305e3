// SPDX-License-Identifier: GPL-3.0-or-later
// Widgets that the panels of the mixer share: buttons, captions, dividers, the tilt knob, tabs, spectra with
// their axis, and the strip of the total output.
#pragma once
#include "Host/Views/Look.h"
#include "Host/Views/StripParts.h"
#include "Mixer/Model/MixerModel.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

constexpr auto dontNotify = juce::dontSendNotification; ///< for setters of controls: no callback is called

enum class Icon { play, pause, step, restart, plus, sweep, save, undo, redo };

/// Button with a drawn icon; `name` is for screen readers and the tooltip.
class IconButton final : public juce::Button {
public:
    IconButton(Icon icon, const juce::String& name);
    void setIcon(Icon icon, const juce::String& name);
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    Icon icon_;
};

/// Two lines of text, the second less prominent; side by side where the height is too small for both.
class TwoLineText final : public ReadOnlyText, public juce::SettableTooltipClient {
public:
    explicit TwoLineText(const juce::String& title) { setTitle(title); }
    std::function<void()> onClick = [] {};
    void mouseUp(const juce::MouseEvent&) override { onClick(); }
    void set(const juce::String& first, const juce::String& second, Shade firstShade = Shade::text);
    void paint(juce::Graphics& g) override;

private:
    juce::String first_, second_;
    Shade shade_ = Shade::text;
};

/// Draws a rounded background; contents keep `panelInset` from its edge.
void drawPanel(juce::Graphics& g, const juce::Component& component);
/// Draws the background of a card over the window, which asks the user.
void drawCard(juce::Graphics& g, const juce::Component& component);
constexpr int panelInset = 14, gap = 12, rowHeight = 30;

/// Sets colour and font of the text that is drawn next.
inline void setInk(juce::Graphics& g, const juce::Component& component, Shade tone, float height,
                   int style = juce::Font::plain) {
    g.setColour(shade(component, tone));
    g.setFont(text::font(height, style));
}
inline void fillRound(juce::Graphics& g, const juce::Component& component, Shade tone,
                      juce::Rectangle<float> area, float corner, float alpha = 1.0f) {
    g.setColour(shade(component, tone).withMultipliedAlpha(alpha));
    g.fillRoundedRectangle(area, corner);
}

inline void drawSelectedRow(juce::Graphics& g, const juce::Component& component, int width, int height,
                            float alpha = 0.16f) {
    g.setColour(shade(component, Shade::accent).withAlpha(alpha));
    g.fillRect(0, 0, width, height);
}

/// A button that looks like a text link.
std::unique_ptr<juce::TextButton> makeLinkButton(const juce::String& label, const juce::String& name,
                                                 std::function<void()> onClick = {});

/// The number among other words, with a decimal point or comma. Commas of whole numbers, and before a point,
/// are of thousands.
double typedNumber(const juce::String& typed, bool isWhole);

/// Calls `onChange` with every new value of the slider. `continuesEdit` is true for all but the first value
/// of a drag. What is typed is read by typedNumber().
void onSliderChange(juce::Slider& slider, std::function<void(bool continuesEdit)> onChange);

/// Makes every control under `root` reachable by keyboard, with a visible focus.
void prepareControls(juce::Component& root);

/// A small caption beside a control; its colour follows the theme.
class Caption final : public juce::Label {
public:
    explicit Caption(const juce::String& text = {}, Shade tone = Shade::muted);
    void setTone(Shade tone) { tone_ = tone, updateColour(); }
    void lookAndFeelChanged() override { updateColour(); }
    void parentHierarchyChanged() override { updateColour(); }

private:
    void updateColour() { setColour(textColourId, shade(*this, tone_)); }
    Shade tone_;
};

/// Adds visible children; addHidden() adds invisible ones.
void addAll(juce::Component& parent, std::initializer_list<juce::Component*> children);
void addHidden(juce::Component& parent, std::initializer_list<juce::Component*> children);
void setVisible(std::initializer_list<juce::Component*> components, bool areVisible);

/// Sets a title, for screen readers, and a tooltip.
template <class Control>
void describe(Control& control, const juce::String& title, const juce::String& tooltip) {
    control.setTitle(title);
    control.setTooltip(tooltip);
}

/// Calls `callback` with the component after the current event, unless it was deleted: for actions that
/// delete the component whose event is being handled.
template <class T, class Callback>
void callLater(T& component, Callback callback) {
    juce::MessageManager::callAsync(
        [safe = juce::Component::SafePointer<T>{&component}, callback = std::move(callback)] {
            if (safe != nullptr) callback(*safe);
        });
}

/// A button that attaches an actuator: in the middle of the field when pressed, or where it is dragged to.
class AttachButton : public juce::Button {
public:
    AttachButton(MixerModel& model, const juce::String& title, const juce::String& tooltip);
    void mouseDrag(const juce::MouseEvent& e) override;
};

inline juce::String ellipsis() { return juce::String::charToString(0x2026); } ///< ends dialogue labels

/// Handle between two panels, moved by mouse or arrow keys; a double click resets it. Message thread.
class Divider final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `isVertical`: it separates a left and a right panel.
    Divider(const juce::String& title, bool isVertical);

    std::function<void(int pixels)> onMove; ///< to the right or down, since the last call
    std::function<void()> onReset;

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseEnter(const juce::MouseEvent&) override { repaint(); }
    void mouseExit(const juce::MouseEvent&) override { repaint(); }
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent&) override { onReset(); }

private:
    const bool isVertical_;
};

/// Knob for the direction of gravity in degrees, clockwise on the screen; arrow keys in the world turn it,
/// too. Message thread.
class TiltKnob final : public juce::Slider {
public:
    static constexpr double keyDegrees = 5.0;

    TiltKnob() {
        setTitle("Tilt");
        setTooltip("Tilt: which way gravity pulls; double click: down (arrow keys in the world)");
        setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
        setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
        setRotaryParameters(0.0f, juce::MathConstants<float>::twoPi, false);
        setRange(-180.0, 180.0, 1.0);
        setValue(0.0, dontNotify);
        setDoubleClickReturnValue(true, 0.0);
    }
    double angleRadians() const { return juce::degreesToRadians(-getValue()); } ///< for a TiltAction

    /// Turns to that angle, wrapped to +-180 degrees.
    void turnTo(double degrees) {
        while (degrees > 180.0) degrees -= 360.0;
        while (degrees < -180.0) degrees += 360.0;
        setValue(degrees);
    }
    // the same keys apply when the knob has the focus
    bool keyPressed(const juce::KeyPress& key) override {
        return handleKey(key) || juce::Slider::keyPressed(key);
    }

    /// Left and right turn; down and up set gravity down and up. False for other keys.
    bool handleKey(const juce::KeyPress& key) {
        if (key == juce::KeyPress::leftKey) return turnTo(getValue() + keyDegrees), true;
        if (key == juce::KeyPress::rightKey) return turnTo(getValue() - keyDegrees), true;
        if (key == juce::KeyPress::downKey) return turnTo(0.0), true;
        if (key == juce::KeyPress::upKey) return turnTo(180.0), true;
        return false;
    }
};

/// The frequency axis of all spectra: the range of vibration perception, in octaves of equal width.
struct FrequencyAxis {
    static constexpr double lowHz = 20.0, highHz = 1000.0;
    static constexpr int pointCount = 160;
    static constexpr float floorDb = -80.0f; ///< lower levels are not drawn

    /// 0 to 1 from the left; outside that for frequencies out of range.
    static double shareFromHz(double hz);
    static double hzFromShare(double share) { return lowHz * std::pow(highHz / lowHz, share); }
    static double hzAtPoint(int point) { return hzFromShare(static_cast<double>(point) / (pointCount - 1)); }
};

/// Level in dB for each point of the axis, at least the floor.
using SpectrumLevels = std::array<float, FrequencyAxis::pointCount>;

/// Converts magnitudes of bins with a spacing of `binHz`, the first at 0 Hz. Each point gets the highest bin
/// of its range; `fullScale` is 0 dB.
SpectrumLevels toSpectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale);

/// Spectrum of the recent samples of a channel with a Hann window: a full-scale sine is 0 dB, within 0.3 dB.
SpectrumLevels channelSpectrum(const SpectrumTrace& trace, int channel);

/// Draws lines and labels of the axis at the bottom of `area`, and returns the area left for curves.
juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area);

/// Draws heights of 0 to 1 per point as a filled curve.
void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::pointCount> heights,
                  juce::Rectangle<float> area, juce::Colour colour);

/// A page of a panel with tabs. To add one, derive from it and name it in the table of Window/MixerView.cpp.
class Tab : public juce::Component {
public:
    virtual void mixChanged() {}                   ///< the mixer state changed
    virtual void refresh(const MixerSnapshot&) {}  ///< while visible, at most about 30 times a second
    virtual int minHeight(int) const { return 0; } ///< pixels at a width; a lower panel scrolls
};

/// Panel with tabs: a row of names, and the page of the selected one. Folded, it shows only the names: a
/// press on a name opens its page, a press on the name of the open page folds the panel.
class TabPanel final : public juce::Component {
public:
    enum class Fold { none, column, row };  ///< how the names lie if it is folded
    static constexpr int foldedPixels = 30; ///< pixels across the names

    explicit TabPanel(const juce::String& title); ///< `title` is for screen readers
    ~TabPanel() override;
    void add(const juce::String& name, std::unique_ptr<Tab> tab);
    void choose(const juce::String& name); ///< also opens it
    void setFold(Fold fold);
    std::function<void(bool isOpen)> onOpen; ///< the user opens a page, or folds the panel
    juce::StringArray names() const;
    /// The tab of that class; null: there is none.
    template <class T>
    T* find() const {
        for (const Page& page : pages_)
            if (auto* const tab = dynamic_cast<T*>(page.tab.get())) return tab;
        return nullptr;
    }
    void mixChanged() {
        for (auto& page : pages_) page.tab->mixChanged();
    }
    void refresh(const MixerSnapshot& snapshot);
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;

private:
    class TabButton;
    struct Page {
        std::unique_ptr<TabButton> button;
        std::unique_ptr<Tab> tab;
        std::unique_ptr<juce::Viewport> viewport; // of the tab
        int minHeight = 0;                        // its height when it was placed
    };
    std::vector<Page> pages_;
    std::size_t selectedPage_ = 0;
    Fold fold_ = Fold::none;
};

/// Level in g of a strip's peak after the master level. Message thread.
double stripLevelG(const MixerModel& model, std::size_t strip, float peak);
/// The highest possible level of a strip in g, by its ceiling. Message thread.
double stripCeilingG(const MixerModel& model, std::size_t strip);

/// Strip of the total output: level, limiter, ceiling.
class MasterStrip final : public juce::Component {
public:
    static constexpr int width = 90, flatTextWidth = 112;
    static constexpr int metersTop = 48; ///< y of the meters, of strips as well

    /// `isFlat`: drawn in one row without a meter, for views without strips.
    explicit MasterStrip(MixerModel& model, bool isFlat = false);
    /// Warning that a flat strip shows in place of its ceiling; empty: none. Call it before mixChanged().
    void setWarning(const juce::String& warning) { warning_ = warning; }
    const juce::String& warning() const noexcept { return warning_; }
    void mixChanged();
    void refresh(const MixerSnapshot& snapshot);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void paintFlat(juce::Graphics& g) const;
    juce::String limiterLabel() const {
        return (limiter_.isGuard() ? "guard " : "limiter ") + limiter_.decibels();
    }
    double highestCeilingG() const;

    MixerModel& model_;
    const bool isFlat_;
    juce::String warning_;
    PeakMeter meter_{"Master level"};
    LimiterBar limiter_;
    Fader fader_;
    juce::Rectangle<int> limiterArea_, ceilingNameArea_, ceilingArea_;
};

} // namespace physvib
