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
class PeakMeter final : public ReadOut {
public:
    explicit PeakMeter(const juce::String& title) { setTitle(title); }
    void set(float peak, float hold);
    void paint(juce::Graphics& g) override;

private:
    float peak_ = 0.0f, hold_ = 0.0f; // as heights of the meter
};

/// How much the limiter holds back, or the guard, if that is more: a bar that grows downwards to 20 dB. M.
class LimiterBar final : public juce::Component {
public:
    bool set(float limiterGain, float guardGain); ///< true: the display has changed
    bool isHolding() const noexcept { return db_ < -0.05f; }
    bool isGuard() const noexcept { return isGuard_; }
    juce::String decibels() const { return readable::words(isHolding() ? db_ : 0.0, 1); }
    void paint(juce::Graphics& g) override;

private:
    float db_ = 0.0f;
    bool isGuard_ = false;
};

/// A fader in dB; its lowest position is silence. It goes where it is dragged, not where it is clicked, since
/// hands may be on the actuators; a double click gives the default.
class Fader final : public juce::Slider {
public:
    /// Sets range and default in dB, and the title. M.
    void setUp(double leastDb, double mostDb, const juce::String& title, double defaultDb = 0.0);
    /// Makes it a plain horizontal slider. M.
    void lieDown() { setSliderStyle(LinearHorizontal), getProperties().remove(faderProperty); }
    void resized() override;
};

/// The fader's own marks right of its groove, in its parent, with figures if there is room up to `right`. M.
void drawScale(juce::Graphics& g, const Fader& fader, int right);

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
    static constexpr int room = 10; // space left of the meter, for the mark
};

/// A level as strips show it, without its unit.
inline juce::String inG(double g) { return readable::words(g, g < 9.995 ? 2 : 1); }

/// What strips of the mixer and of the plug-in have in common. M only.
class StripParts : public juce::Component {
protected:
    explicit StripParts(const juce::String& label);
    virtual void change(const juce::String& name, const std::function<void(Strip&)>& how) = 0;
    void show(const Strip& strip, double mostG);
    /// Places meter and fader from `left` on, above the figures. The buttons lie between them, or with
    /// `areBeside` in a column, which makes the fader longer.
    void place(juce::Rectangle<int> area, int left, bool areBeside = false);
    /// The fader's gain, or `why` it plays nothing, stands beside the name, unless it is 0 dB or the name
    /// needs the room; the meter's scale is right of the meter.
    void paint(juce::Graphics& g, int enchanter, const juce::String& name, const juce::String& why);

    PeakMeter meter_;
    Fader fader_;
    CeilingHandle ceiling_;
    juce::TextButton mute_{"M"}, solo_{"S"}, polarity_{juce::String::charToString(0x00f8)}, delay_{"ms"};
    juce::Label level_, most_; // in g

private:
    void askDelay();
    double delayMs_ = 0.0;
};

} // namespace physvib
