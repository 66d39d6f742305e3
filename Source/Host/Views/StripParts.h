// SPDX-License-Identifier: GPL-3.0-or-later
// Channel strips of mixer and plug-in, and their parts: meter, fader, and a ceiling handle that is dragged
// along the meter.
#pragma once
#include "Host/Views/Look.h"
#include "Live/Documents/Mix.h"
#include <functional>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

constexpr float meterFloorDb = -60.0f; ///< weaker vibration is imperceptible: full scale is several g

/// Height of that peak on a meter, 0 to 1.
inline float meterHeight(float peak) {
    return juce::jlimit(0.0f, 1.0f, 1.0f - juce::Decibels::gainToDecibels(peak, meterFloorDb) / meterFloorDb);
}

/// A bar from -60 dB to full scale, with a peak-hold mark.
class PeakMeter final : public ReadOnlyText {
public:
    explicit PeakMeter(const juce::String& title) { setTitle(title); }
    void set(float peak, float hold);
    void paint(juce::Graphics& g) override;

private:
    float peak_ = 0.0f, hold_ = 0.0f; // as heights of the meter
};

/// Gain reduction of the limiter, or of the guard if that is more: a bar that grows down to 20 dB. M.
class LimiterBar final : public juce::Component {
public:
    bool set(float limiterGain, float guardGain); ///< gains, 0 to 1; returns true if the display has changed
    bool isHolding() const noexcept { return db_ < -0.05f; }
    bool isGuard() const noexcept { return isGuard_; }
    juce::String decibels() const { return readable::numberString(isHolding() ? db_ : 0.0, 1); }
    void paint(juce::Graphics& g) override;

private:
    float db_ = 0.0f;
    bool isGuard_ = false;
};

/// A fader in dB; its lowest position is silence. A click does not move it, only a drag, since hands may be
/// on the actuators; a double click sets the default.
class Fader final : public juce::Slider {
public:
    /// Sets range and default in dB, and the title. M.
    void configure(double minDb, double maxDb, const juce::String& title, double defaultDb = 0.0);
    /// Makes it a plain horizontal slider. M.
    void setHorizontal() { setSliderStyle(LinearHorizontal), getProperties().remove(faderProperty); }
    void resized() override;
};

/// Draws the fader's marks in its parent, right of the groove, with figures if there is room to `right`. M.
void drawFaderScale(juce::Graphics& g, const Fader& fader, int right);

/// Slider for the ceiling of a strip, the highest level of its actuator, in dB of full scale. It only reacts
/// to dragging: a click, a double click or the wheel could raise the limit by accident while the actuator
/// touches skin.
class CeilingHandle final : public juce::Slider {
public:
    explicit CeilingHandle(const juce::String& label);
    /// Places it over a meter with these bounds. M.
    void placeOver(juce::Rectangle<int> meter);
    void paint(juce::Graphics& g) override;

private:
    static constexpr int markWidth = 10; // space left of the meter, for the mark
};

/// A level in g as strips show it, without the unit.
inline juce::String gText(double g) { return readable::numberString(g, g < 9.995 ? 2 : 1); }

/// The common parts of the mixer's and the plug-in's channel strips. M only.
class StripParts : public juce::Component {
protected:
    explicit StripParts(const juce::String& label);
    virtual void change(const juce::String& name, const std::function<void(Strip&)>& edit) = 0;
    void show(const Strip& strip, double ceilingG);
    /// Places meter and fader from `left` on, above the figures. The buttons lie between them, or with
    /// `hasButtonColumn` in a column, which makes the fader longer.
    void place(juce::Rectangle<int> area, int left, bool hasButtonColumn = false);
    /// Draws the name and beside it, if there is room, the fader's gain unless it is 0 dB, or `why` the strip
    /// is silent; and the meter's scale.
    void paint(juce::Graphics& g, int actuator, const juce::String& name, const juce::String& why);

    PeakMeter meter_;
    Fader fader_;
    CeilingHandle ceiling_;
    juce::TextButton mute_{"M"}, solo_{"S"}, polarity_{juce::String::charToString(0x00f8)}, delay_{"ms"};
    juce::Label level_, ceilingLabel_; // in g

private:
    void showDelayMenu();
    double delayMs_ = 0.0;
};

} // namespace physvib
