// SPDX-License-Identifier: GPL-3.0-or-later
// Widgets that all panels of the mixer share: buttons, captions, dividers, the tilt knob, tabs, the axis of
// spectra, and the total output.
#pragma once
#include "Host/Views/Look.h"
#include "Host/Views/StripParts.h"
#include "Mixer/Model/MixerModel.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

constexpr auto quietly = juce::dontSendNotification; ///< for setters of controls: no callback is called

enum class Sign { play, pause, step, restart, plus, sweep, save, undo, redo };

/// Button with a drawn icon; `name` is for screen readers and the tooltip.
class SignButton final : public juce::Button {
public:
    SignButton(Sign sign, const juce::String& name);
    void setSign(Sign sign, const juce::String& name);
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    Sign sign_;
};

/// A line of text with a less prominent one below, or beside it where it is low.
class TwoLines final : public ReadOut, public juce::SettableTooltipClient {
public:
    explicit TwoLines(const juce::String& title) { setTitle(title); }
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
inline void ink(juce::Graphics& g, const juce::Component& c, Shade which, float height,
                int style = juce::Font::plain) {
    g.setColour(shade(c, which));
    g.setFont(text::font(height, style));
}
inline void fillRound(juce::Graphics& g, const juce::Component& c, Shade which, juce::Rectangle<float> area,
                      float corner, float alpha = 1.0f) {
    g.setColour(shade(c, which).withMultipliedAlpha(alpha));
    g.fillRoundedRectangle(area, corner);
}

/// Draws the background of a selected row.
inline void drawChosenRow(juce::Graphics& g, const juce::Component& c, int width, int height,
                          float alpha = 0.16f) {
    g.setColour(shade(c, Shade::accent).withAlpha(alpha));
    g.fillRect(0, 0, width, height);
}

/// A button that looks like a text link.
std::unique_ptr<juce::TextButton> quietButton(const juce::String& words, const juce::String& name,
                                              std::function<void()> onClick = {});

/// Calls `use` with every new value of the slider. `continuesEdit` is true for all but the first value of a
/// drag.
void onSlide(juce::Slider& slider, std::function<void(bool continuesEdit)> use);

/// Makes every control under `root` reachable by keyboard, with a visible focus.
void prepareControls(juce::Component& root);

/// A small caption beside a control; its colour follows the theme.
class Caption final : public juce::Label {
public:
    explicit Caption(const juce::String& words = {}, Shade tone = Shade::muted);
    void setTone(Shade tone) { tone_ = tone, tint(); }
    void lookAndFeelChanged() override { tint(); }
    void parentHierarchyChanged() override { tint(); }

private:
    void tint() { setColour(textColourId, shade(*this, tone_)); }
    Shade tone_;
};

/// Shows these as children; addHidden(): they are shown later.
void addAll(juce::Component& parent, std::initializer_list<juce::Component*> children);
void addHidden(juce::Component& parent, std::initializer_list<juce::Component*> children);
void setVisible(std::initializer_list<juce::Component*> components, bool areVisible);

/// Sets a title, for screen readers, and a tooltip.
template <class Control>
void describe(Control& control, const juce::String& title, const juce::String& tooltip) {
    control.setTitle(title);
    control.setTooltip(tooltip);
}

/// Calls `act` with the component after the present event, unless it has gone: for what would delete the
/// component whose event is still being handled.
template <class T, class Act>
void later(T& component, Act act) {
    juce::MessageManager::callAsync(
        [safe = juce::Component::SafePointer<T>{&component}, act = std::move(act)] {
            if (safe != nullptr) act(*safe);
        });
}

/// A button that attaches an actuator: in the middle of the field when pressed, or where it is dragged to.
class AttachButton : public juce::Button {
public:
    AttachButton(MixerModel& model, const juce::String& title, const juce::String& tooltip);
    void mouseDrag(const juce::MouseEvent& e) override;
};

inline juce::String dots() { return juce::String::charToString(0x2026); } ///< ends dialogue labels

/// Handle between two panels: drag it, or move it with the arrow keys; a double click makes it automatic.
/// Message thread.
class Divider final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `isUpright`: it lies between left and right.
    Divider(const juce::String& title, bool isUpright);

    std::function<void(int pixels)> onMove; ///< to the right or down, since the last call
    std::function<void()> onReset;

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseEnter(const juce::MouseEvent&) override { repaint(); }
    void mouseExit(const juce::MouseEvent&) override { repaint(); }
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent&) override { onReset(); }

private:
    const bool isUpright_;
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
        setValue(0.0, quietly);
        setDoubleClickReturnValue(true, 0.0);
    }
    /// Angle for a TiltAction.
    double angleRadians() const { return juce::degreesToRadians(-getValue()); }

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
    static constexpr int points = 160;
    static constexpr float floorDb = -80.0f; ///< lower levels are not drawn

    /// 0 to 1 from the left; outside that for frequencies out of range.
    static double shareOf(double hz);
    static double hzAt(double share) { return lowHz * std::pow(highHz / lowHz, share); }
    static double hzOf(int point) { return hzAt(static_cast<double>(point) / (points - 1)); }
};

/// Level in dB for each point of the axis, at least the floor.
using SpectrumLevels = std::array<float, FrequencyAxis::points>;

/// Converts magnitudes of bins with a spacing of `binHz`, the first at 0 Hz. Each point gets the highest bin
/// of its range; `fullScale` is 0 dB.
SpectrumLevels spectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale);

/// Spectrum of recent samples with a Hann window: a full-scale sine is 0 dB, within 0.3 dB.
SpectrumLevels levelsOf(const SpectrumTrace& trace, int channel);

/// Draws lines and labels of the axis at the bottom of `area`, and returns the area left for curves.
juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area);

/// Draws heights of 0 to 1 per point as a filled curve.
void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::points> heights,
                  juce::Rectangle<float> area, juce::Colour colour);

/// A page of a panel with tabs. To add one, derive from it and name it in the table of Window/MixerView.cpp.
class Tab : public juce::Component {
public:
    virtual void mixChanged() {}                   ///< the mixer state changed
    virtual void refresh(const MixerMoment&) {}    ///< while visible, at most about 30 times a second
    virtual int minHeight(int) const { return 0; } ///< at a width; a panel that has less lets it scroll
};

/// Panel with tabs: a row of names, and the page of the selected one. It folds to its names alone: a press on
/// one opens its page, a press on that of the open page folds it.
class TabPanel final : public juce::Component {
public:
    enum class Fold { none, column, row }; ///< of the names
    static constexpr int folded = 30;      ///< pixels across the names

    /// `title` for screen readers.
    explicit TabPanel(const juce::String& title);
    ~TabPanel() override;
    void add(const juce::String& name, std::unique_ptr<Tab> tab);
    void choose(const juce::String& name); ///< also opens it
    void setFold(Fold fold);
    std::function<void(bool isOpen)> onOpen; ///< a page is wanted, or none
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
    void refresh(const MixerMoment& moment);
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;

private:
    class Name;
    struct Page {
        std::unique_ptr<Name> name;
        std::unique_ptr<Tab> tab;
        std::unique_ptr<juce::Viewport> view; // of the tab
        int least = 0;                        // its height when it was placed
    };
    std::vector<Page> pages_;
    std::size_t chosen_ = 0;
    Fold fold_ = Fold::none;
};

/// Level in g of a strip's peak after the master level. Message thread.
double gOf(const MixerModel& model, std::size_t strip, float peak);
/// The same of a strip's ceiling: its highest possible level in g. Message thread.
double maxG(const MixerModel& model, std::size_t strip);

/// Strip of the total output: level, limiter, ceiling.
class MasterStrip final : public juce::Component {
public:
    static constexpr int width = 90, flatWords = 112;
    static constexpr int metersTop = 48; ///< y of the meters, of strips as well

    /// `isFlat`: in one row without a meter, for where there are no strips.
    explicit MasterStrip(MixerModel& model, bool isFlat = false);
    /// Warning that a flat strip shows in place of its ceiling; empty: none. Call it before mixChanged().
    void setRemark(const juce::String& remark) { remark_ = remark; }
    const juce::String& remark() const noexcept { return remark_; }
    void mixChanged();
    void refresh(const MixerMoment& moment);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void paintFlat(juce::Graphics& g) const;
    juce::String limiterWords() const {
        return (limiter_.isGuard() ? "guard " : "limiter ") + limiter_.decibels();
    }
    double mostG() const;

    MixerModel& model_;
    const bool isFlat_;
    juce::String remark_;
    PeakMeter meter_{"Master level"};
    LimiterBar limiter_;
    Fader fader_;
    juce::Rectangle<int> limiterText_, ceilingName_, ceiling_;
};

} // namespace physvib
