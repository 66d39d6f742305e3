// SPDX-License-Identifier: GPL-3.0-or-later
// Measures a recorded hit, draws its spectrum and decay with the fitted mode, and edits surface grains.
#include "Live/Recordings/ReadRecording.h"
#include "Measure/HitExcerpt.h"
#include "Measure/PartialFit.h"
#include "Measure/Spectrum.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Scene/SceneFields.h"
#include <juce_audio_basics/juce_audio_basics.h>
#include <numbers>

namespace physvib {
namespace {

constexpr int headingHeight = 18;

juce::Rectangle<int> drawPlotWell(juce::Graphics& g, const juce::Component& plot) {
    fillRound(g, plot, Shade::well, plot.getLocalBounds().toFloat(), 5.0f);
    return plot.getLocalBounds().reduced(8, 4);
}

/// Draws `rightText`, and beside it the first text of `leftTexts` that fits.
void drawHeading(juce::Graphics& g, const juce::Component& plot, juce::Rectangle<int> row,
                 const juce::StringArray& leftTexts, const juce::String& rightText,
                 Shade rightShade = Shade::muted) {
    const auto font = text::font(text::small);
    g.setFont(font);
    g.setColour(shade(plot, rightShade));
    const auto rightArea =
        row.removeFromRight(std::min(row.getWidth(), text::pixelWidth(font, rightText) + 4));
    g.drawText(rightText, rightArea, juce::Justification::centredRight, true);
    g.setColour(shade(plot, Shade::muted));
    for (const auto& leftText : leftTexts)
        if (text::pixelWidth(font, leftText) < row.getWidth() - 8)
            return g.drawText(leftText, row, juce::Justification::centredLeft, true);
}

/// A value with as many decimals as its error justifies.
juce::String valueWithError(double value, double error, const juce::String& unit) {
    const int decimals = error > 0.0 && error < 0.1 ? 2 : 1;
    return number(value, decimals) + juce::String::fromUTF8(" \xc2\xb1 ") +
           number(std::max(error, 0.01), decimals) + unit;
}

juce::Colour readableColour(const juce::Component& plot, juce::Colour colour) {
    return shade(plot, Shade::panel).getPerceivedBrightness() > 0.5f ? colour.withMultipliedBrightness(0.75f)
                                                                     : colour.brighter(0.15f);
}

constexpr double maxWaveformSeconds = 1.0;

HitWaveform normalisedWaveform(std::vector<float> samples, double rateHz) {
    HitWaveform waveform{rateHz, std::move(samples)};
    float peak = 1e-9f;
    for (const float x : waveform.samples) peak = std::max(peak, std::abs(x));
    for (float& x : waveform.samples) x /= peak;
    const auto heights = magnitudes(std::vector<double>(waveform.samples.begin(), waveform.samples.end()));
    const double binHz = rateHz / (2.0 * static_cast<double>(heights.size() - 1));
    const auto first = static_cast<std::size_t>(FrequencyAxis::lowHz / binHz),
               last = std::min(heights.size(), static_cast<std::size_t>(FrequencyAxis::highHz / binHz) + 2);
    const double highest = first < last
                               ? *std::max_element(heights.begin() + static_cast<std::ptrdiff_t>(first),
                                                   heights.begin() + static_cast<std::ptrdiff_t>(last))
                               : 1.0;
    waveform.levels = toSpectrumLevels(heights, binHz, std::max(highest, 1e-12));
    return waveform;
}

// grains and roughness that are perceptible at the speeds of hands and balls
constexpr double lowGrainMetres = 0.0005, highGrainMetres = 0.2;
constexpr double minRoughness = 0.001, lowRoughness = 0.05, highRoughness = 20.0;

juce::String grainText(double metres) {
    if (metres <= 0.0) return "smooth";
    const double mm = 1e3 * metres;
    return "grain " + (metres < 1.0 ? number(mm, mm < 1.0     ? 2
                                                 : mm < 100.0 ? 1
                                                              : 0) +
                                          " mm"
                                    : number(metres, 2) + " m");
}

double parseDecimal(const juce::String& typed) {
    return typed.retainCharacters("0123456789.,").replaceCharacter(',', '.').getDoubleValue();
}

/// Quality of a measurement: "residual -31 dB, confidence high".
juce::String confidenceText(const ContactSound& sound) {
    const auto residual = sound.residualShare > 1e-12
                              ? number(10.0 * std::log10(sound.residualShare), 0) + " dB"
                              : juce::String{"none"};
    return "residual " + residual + ", confidence " + (sound.isConfident() ? "high" : "low");
}

/// Parses millimetres, or metres if the text says so.
double parseGrainMetres(const juce::String& typed) {
    const auto text = typed.trim();
    return text.endsWith("m") && !text.endsWith("mm") ? parseDecimal(text) : 1e-3 * parseDecimal(text);
}

} // namespace

void SpectrumPlot::show(const PlottedHit& hit, const HitWaveform& waveform) {
    hit_ = hit;
    levels_ = waveform.levels;
    setDescription(hit.frequencyHz > 0.0
                       ? number(hit.frequencyHz, 1) + " Hz" +
                             (hit.recording ? ", measured from " + utf8(hit.recording->name) : juce::String{})
                       : juce::String{"Silent"});
    setTooltip(getDescription());
    repaint();
}

void SpectrumPlot::paint(juce::Graphics& g) {
    auto area = drawPlotWell(g, *this);
    if (!(hit_.frequencyHz > 0.0))
        return drawHeading(g, *this, area.removeFromTop(headingHeight), {"spectrum"}, {});
    const auto heading = area.removeFromTop(headingHeight);
    area = drawFrequencyAxis(g, *this, area);
    const auto colour = readableColour(*this, hit_.colour);
    auto heights = levels_;
    // a linear scale shows peaks better than decibels
    for (float& level : heights) level = juce::Decibels::decibelsToGain(level, FrequencyAxis::floorDb);
    drawSpectrum(g, heights, area.toFloat(), colour);
    const auto x = static_cast<float>(area.getX()) +
                   static_cast<float>(juce::jlimit(0.0, 1.0, FrequencyAxis::shareFromHz(hit_.frequencyHz))) *
                       static_cast<float>(area.getWidth());
    g.setColour(shade(*this, Shade::accent));
    const float dashes[]{3.0f, 3.0f};
    g.drawDashedLine({x, static_cast<float>(area.getY()), x, static_cast<float>(area.getBottom())}, dashes, 2,
                     1.5f);
    const auto* sound = hit_.recording ? &hit_.recording->sound : nullptr;
    drawHeading(g, *this, heading,
                hit_.recording ? juce::StringArray{utf8(hit_.recording->name), "recorded"}
                               : juce::StringArray{"Drop the recording of a hit here to measure it",
                                                   "Drop a recording here", "spectrum"},
                sound ? valueWithError(sound->frequencyHz, sound->frequencyErrorHz, " Hz")
                      : number(hit_.frequencyHz, 1) + " Hz",
                Shade::accent);
}

void WaveformPlot::show(const PlottedHit& hit, const HitWaveform& waveform) {
    hit_ = hit;
    waveform_ = waveform;
    setDescription(!(hit.frequencyHz > 0.0)
                       ? juce::String{"Silent"}
                       : "Decays by " + number(hit.decayPerSecond, 1) + " per second" +
                             (hit.recording ? ", " + confidenceText(hit.recording->sound) : juce::String{}));
    setTooltip(getDescription());
    repaint();
}

void WaveformPlot::paint(juce::Graphics& g) {
    auto area = drawPlotWell(g, *this);
    const auto heading = area.removeFromTop(headingHeight);
    if (!(hit_.frequencyHz > 0.0) || waveform_.samples.empty())
        return drawHeading(g, *this, heading, {"decay"}, {});
    const float centreY = static_cast<float>(area.getCentreY()),
                halfHeight = 0.5f * static_cast<float>(area.getHeight()) - 1.0f;
    const int width = area.getWidth(), count = static_cast<int>(waveform_.samples.size());
    juce::RectangleList<float> columns;
    for (int x = 0; x < width; ++x) {
        const auto begin = waveform_.samples.begin() + static_cast<std::ptrdiff_t>(x) * count / width,
                   end = waveform_.samples.begin() + static_cast<std::ptrdiff_t>(x + 1) * count / width;
        const auto [low, high] =
            std::minmax_element(begin, std::max(begin + 1, std::min(end + 1, waveform_.samples.end())));
        columns.addWithoutMerging({static_cast<float>(area.getX() + x), centreY - halfHeight * *high, 1.0f,
                                   std::max(1.0f, halfHeight * (*high - *low))});
    }
    g.setColour(readableColour(*this, hit_.colour).withAlpha(0.75f));
    g.fillRectList(columns);
    const double startAmplitude = hit_.recording ? hit_.recording->amplitude : 1.0;
    juce::Path upperCurve;
    for (int x = 0; x <= width; x += 2) {
        const double envelope =
            std::min(1.0, startAmplitude * std::exp(-hit_.decayPerSecond * waveform_.seconds() * x / width));
        const juce::Point<float> p{static_cast<float>(area.getX() + x),
                                   centreY - halfHeight * static_cast<float>(envelope)};
        x == 0 ? upperCurve.startNewSubPath(p) : upperCurve.lineTo(p);
    }
    auto lowerCurve = upperCurve;
    lowerCurve.applyTransform(juce::AffineTransform::verticalFlip(2.0f * centreY));
    g.setColour(shade(*this, Shade::accent));
    g.strokePath(upperCurve, juce::PathStrokeType{1.5f});
    g.strokePath(lowerCurve, juce::PathStrokeType{1.5f});
    const auto* sound = hit_.recording ? &hit_.recording->sound : nullptr;
    const auto length = number(1e3 * waveform_.seconds(), 0) + " ms";
    const auto confidence = sound ? confidenceText(*sound) : juce::String{};
    drawHeading(g, *this, heading,
                sound ? juce::StringArray{length + ", " + confidence, confidence,
                                          confidence.fromLastOccurrenceOf(", ", false, false)}
                      : juce::StringArray{length},
                sound ? valueWithError(sound->decayPerSecond, sound->decayErrorPerSecond, " /s")
                      : number(hit_.decayPerSecond, 1) + " /s",
                sound && !sound->isConfident() ? Shade::highlight : Shade::accent);
}

Result<RecordedHit> measureHit(const std::filesystem::path& path) {
    const auto name = path.filename().string();
    const auto recording = readRecording(path);
    if (!recording)
        return Failure{recording.error.starts_with(path.string())
                           ? name + recording.error.substr(path.string().size())
                           : recording.error};
    const auto& samples = loudestChannel(recording.value.channels);
    const double rate = recording.value.sampleRateHz;
    const auto sound = extractMaterial(samples, rate, {FrequencyAxis::lowHz, FrequencyAxis::highHz});
    if (!sound) return Failure{name + ": " + sound.error};
    const auto begin = static_cast<std::size_t>(std::llround(sound.value.beginSeconds * rate));
    const auto end = std::min(
        samples.size(), begin + static_cast<std::size_t>(std::llround(sound.value.lengthSeconds * rate)));
    RecordedHit hit{name, sound.value,
                    normalisedWaveform({samples.begin() + static_cast<std::ptrdiff_t>(begin),
                                        samples.begin() + static_cast<std::ptrdiff_t>(end)},
                                       rate),
                    0.0};
    const std::vector<double> x(hit.waveform.samples.begin(), hit.waveform.samples.end());
    PartialFit fit{x, rate};
    fit.add({2.0 * std::numbers::pi * sound.value.frequencyHz, sound.value.decayPerSecond, 0.0, 0.0});
    fit.solveLinear();
    hit.amplitude = fit.partials().front().amplitude();
    return hit;
}

HitWaveform makeModeWaveform(double frequencyHz, double decayPerSecond) {
    const double rate = std::max(8000.0, 8.0 * frequencyHz),
                 seconds =
                     std::clamp(std::log(1000.0) / std::max(decayPerSecond, 1e-3), 0.01, maxWaveformSeconds);
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / rate;
        samples[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * frequencyHz * t) *
                                        std::exp(-decayPerSecond * t));
    }
    return normalisedWaveform(std::move(samples), rate);
}

TextureRow::TextureRow() {
    setTitle("Surface");
    prepare(grain_, "Grain",
            "Mean spacing of the grains that are felt when something rolls or slides over it; at the left "
            "end it is smooth");
    prepare(roughness_, "Roughness", "How strong its grains are; double click: 1");
    prepare(rolling_, "Rolling", "How much of it is felt of what rolls; what slides is felt whole");
    grain_.setNormalisableRange(perceptualRangeWithZero(Texture::finestMetres, lowGrainMetres,
                                                        highGrainMetres, Texture::coarsestMetres));
    roughness_.setNormalisableRange(
        perceptualRangeWithZero(minRoughness, lowRoughness, highRoughness, Texture::maxRoughness));
    rolling_.setRange(0.0, 1.0);
    roughness_.setDoubleClickReturnValue(true, Texture{}.roughness);
    grain_.textFromValueFunction = grainText;
    grain_.valueFromTextFunction = parseGrainMetres;
    roughness_.textFromValueFunction = [](double roughness) {
        return "rough " + number(roughness, roughness < 10.0 ? 2 : 1);
    };
    roughness_.valueFromTextFunction = parseDecimal;
    rolling_.textFromValueFunction = [](double share) { return "rolls " + number(100.0 * share, 0) + " %"; };
    rolling_.valueFromTextFunction = [](const juce::String& typed) { return 0.01 * parseDecimal(typed); };
    for (const auto& name : grainPatternNames)
        pattern_.addItem(juce::String{name.data()}, pattern_.getNumItems() + 1);
    describe(pattern_, "Pattern",
             "Random as cloth, stone or wood; regular ridges are felt as a tone of speed / spacing");
    pattern_.onChange = [this] { notifyChange("Pattern", false); };
    addAndMakeVisible(pattern_);
    show({});
}

void TextureRow::prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip) {
    describe(bar, title, tooltip);
    bar.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    bar.setSliderStyle(juce::Slider::LinearBar);
    onSliderChange(bar, [this, title](bool continuesEdit) { notifyChange(title, continuesEdit); });
    addAndMakeVisible(bar);
}

void TextureRow::notifyChange(const juce::String& valueName, bool continuesEdit) {
    if (onChange)
        onChange({grain_.getValue(), roughness_.getValue(),
                  static_cast<GrainPattern>(pattern_.getSelectedItemIndex()), rolling_.getValue()},
                 valueName, continuesEdit);
}

void TextureRow::show(const std::optional<Texture>& texture) {
    const Texture displayed = texture.value_or(Texture{});
    grain_.setEnabled(texture.has_value());
    for (juce::Component* control :
         std::initializer_list<juce::Component*>{&roughness_, &pattern_, &rolling_})
        control->setEnabled(displayed.grainMetres > 0.0);
    for (const auto& [bar, value] : {std::pair{&grain_, displayed.grainMetres},
                                     {&roughness_, displayed.roughness},
                                     {&rolling_, displayed.rolling}}) {
        if (!bar->isMouseButtonDown()) bar->setValue(value, juce::dontSendNotification);
        bar->updateText();
    }
    pattern_.setSelectedItemIndex(static_cast<int>(displayed.pattern), juce::dontSendNotification);
}

void TextureRow::resized() {
    auto row = getLocalBounds();
    const int spacing = 6, barWidth = (row.getWidth() - 3 * spacing) / 4;
    for (const auto& [part, width] : std::initializer_list<std::pair<juce::Component*, int>>{
             {&grain_, barWidth + 12}, {&roughness_, barWidth}, {&pattern_, barWidth - 12}}) {
        part->setBounds(row.removeFromLeft(width));
        row.removeFromLeft(spacing);
    }
    rolling_.setBounds(row);
}

} // namespace physvib
