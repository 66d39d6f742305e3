// SPDX-License-Identifier: GPL-3.0-or-later
// Plots of a material: spectrum and waveform of an impact, its frequency and decay over a recording.
#pragma once
#include "Contacts/Grains.h"
#include "Measure/MaterialExtractor.h"
#include "Mixer/Widgets/Parts.h"
#include <cmath>
#include <filesystem>
#include <functional>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// Waveform and spectrum of a contact for display, from a recording or from a material's mode.
/// An impact from its onset.
struct HitCourse {
    double rateHz = 0.0;
    std::vector<float> samples; ///< normalised to a peak of 1
    SpectrumLevels levels{};    ///< normalised to a peak of 0 dB
    double seconds() const noexcept { return static_cast<double>(samples.size()) / rateHz; }
};

/// A contact recording and its fitted mode.
struct RecordedHit {
    std::string name; ///< file name
    ContactSound sound;
    HitCourse course;
    double amplitude = 0.0; ///< of the fitted mode at the onset, in units of the course
};

/// Measures the strongest impact of a file, on any thread but the render thread; or one line with the file's
/// name. Takes up to two seconds.
Result<RecordedHit> measureHit(const std::filesystem::path& path);

/// sin(2 pi f t) exp(-tau t) until a decay of 60 dB, at most one second.
HitCourse courseOf(double frequencyHz, double decayPerSecond);

/// Input of both plots; they redraw when it changes.
struct ShownHit {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< 0 Hz: empty plot
    juce::Colour colour;
    const RecordedHit* recording = nullptr; ///< must stay valid until the next show()
    bool operator==(const ShownHit&) const = default;
};

class SpectrumPlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    SpectrumPlot() { setTitle("Spectrum of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    SpectrumLevels levels_{};
};

class CoursePlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    CoursePlot() { setTitle("Decay of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    HitCourse course_;
};

/// Quality of a measurement: "residual -31 dB, confidence high".
juce::String confidenceText(const ContactSound& sound);

/// Controls for the surface grains of a material: distance, strength, pattern, and share when rolling.
/// Message thread.
class TextureRow final : public juce::Component {
public:
    TextureRow();

    /// nullopt: no surface to edit.
    void show(const std::optional<Texture>& texture);
    /// Called with the new texture; `what` names the changed value, and `continuesEdit` is true during a drag
    /// (see onSlide).
    std::function<void(const Texture& texture, const juce::String& what, bool continuesEdit)> onChange;

    void resized() override;

private:
    void prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip);
    void change(const juce::String& what, bool continuesEdit);

    juce::Slider grain_, roughness_, rolling_;
    juce::ComboBox pattern_;
};

/// Slider ranges that emphasise the perceivable values of a parameter.
/// Logarithmic range: the middle 90 % of the slider cover the perceivable values from `low` to `high`, and
/// its ends the rest of the possible ones.
inline juce::NormalisableRange<double> feltRange(double least, double low, double high, double most) {
    constexpr double end = 0.05;
    const auto part = [](double from, double to, double share) { return from * std::pow(to / from, share); };
    const auto shareOf = [](double from, double to, double value) {
        return std::log(value / from) / std::log(to / from);
    };
    return {least, most,
            [=](double, double, double s) {
                return s < end         ? part(least, low, s / end)
                       : s > 1.0 - end ? part(high, most, (s - 1.0 + end) / end)
                                       : part(low, high, (s - end) / (1.0 - 2.0 * end));
            },
            [=](double, double, double v) {
                return v < low    ? end * shareOf(least, low, v)
                       : v > high ? 1.0 - end + end * shareOf(high, most, v)
                                  : end + (1.0 - 2.0 * end) * shareOf(low, high, v);
            }};
}

/// The same, with 0 at the left end.
inline juce::NormalisableRange<double> feltRangeWithZero(double least, double low, double high, double most) {
    const auto felt = feltRange(least, low, high, most);
    return {0.0, most, [=](double, double, double s) { return s <= 0.0 ? 0.0 : felt.convertFrom0to1(s); },
            [=](double, double, double v) { return v < least ? 0.0 : felt.convertTo0to1(v); }};
}

/// Columns in a row of the list of materials, and formatting of its numbers.
struct MaterialColumns {
    juce::Rectangle<int> dot, name, frequency, decay, length, sign;
    explicit MaterialColumns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        dot = row.removeFromLeft(22);
        sign = row.removeFromRight(40);
        const int number = std::min(92, row.getWidth() * 22 / 100);
        length = row.removeFromRight(number);
        decay = row.removeFromRight(number);
        frequency = row.removeFromRight(number);
        name = row;
    }
};

inline juce::String frequencyText(double hz) { return number(hz, 1); }
inline juce::String decayText(double perSecond) { return number(perSecond, 2); }

} // namespace physvib
