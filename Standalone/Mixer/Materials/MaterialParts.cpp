// SPDX-License-Identifier: GPL-3.0-or-later
// Measurement and plots of an impact, the fitted mode in the accent colour; controls of surface grains.
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

constexpr int headHeight = 18;

juce::Rectangle<int> drawWell(juce::Graphics& g, const juce::Component& c) {
    fillRound(g, c, Shade::well, c.getLocalBounds().toFloat(), 5.0f);
    return c.getLocalBounds().reduced(8, 4);
}

/// Draws the first text of `left` that fits beside `right`.
void drawHead(juce::Graphics& g, const juce::Component& c, juce::Rectangle<int> row,
              const juce::StringArray& left, const juce::String& right, Shade rightShade = Shade::muted) {
    const auto font = text::font(text::small);
    g.setFont(font);
    g.setColour(shade(c, rightShade));
    const auto place = row.removeFromRight(std::min(row.getWidth(), text::pixels(font, right) + 4));
    g.drawText(right, place, juce::Justification::centredRight, true);
    g.setColour(shade(c, Shade::muted));
    for (const auto& words : left)
        if (text::pixels(font, words) < row.getWidth() - 8)
            return g.drawText(words, row, juce::Justification::centredLeft, true);
}

/// A value with as many decimals as its error justifies.
juce::String measured(double value, double error, const juce::String& unit) {
    const int decimals = error > 0.0 && error < 0.1 ? 2 : 1;
    return number(value, decimals) + juce::String::fromUTF8(" \xc2\xb1 ") +
           number(std::max(error, 0.01), decimals) + unit;
}

juce::Colour legible(const juce::Component& c, juce::Colour colour) {
    return shade(c, Shade::panel).getPerceivedBrightness() > 0.5f ? colour.withMultipliedBrightness(0.75f)
                                                                  : colour.brighter(0.15f);
}

constexpr double longestSeconds = 1.0;

HitCourse courseFrom(std::vector<float> samples, double rateHz) {
    HitCourse course{rateHz, std::move(samples)};
    float peak = 1e-9f;
    for (const float x : course.samples) peak = std::max(peak, std::abs(x));
    for (float& x : course.samples) x /= peak;
    const auto heights = magnitudes(std::vector<double>(course.samples.begin(), course.samples.end()));
    const double binHz = rateHz / (2.0 * static_cast<double>(heights.size() - 1));
    const auto first = static_cast<std::size_t>(FrequencyAxis::lowHz / binHz),
               last = std::min(heights.size(), static_cast<std::size_t>(FrequencyAxis::highHz / binHz) + 2);
    const double highest = first < last
                               ? *std::max_element(heights.begin() + static_cast<std::ptrdiff_t>(first),
                                                   heights.begin() + static_cast<std::ptrdiff_t>(last))
                               : 1.0;
    course.levels = spectrumLevels(heights, binHz, std::max(highest, 1e-12));
    return course;
}

// limits of perception at speeds of hands and balls
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

double numberOf(const juce::String& words) {
    return words.retainCharacters("0123456789.,").replaceCharacter(',', '.').getDoubleValue();
}

/// Quality of a measurement: "residual -31 dB, confidence high".
juce::String confidenceText(const ContactSound& sound) {
    const auto residual = sound.residualShare > 1e-12
                              ? number(10.0 * std::log10(sound.residualShare), 0) + " dB"
                              : juce::String{"none"};
    return "residual " + residual + ", confidence " + (sound.isConfident() ? "high" : "low");
}

/// Parses millimetres, or metres if the text says so.
double grainOf(const juce::String& words) {
    const auto text = words.trim();
    return text.endsWith("m") && !text.endsWith("mm") ? numberOf(text) : 1e-3 * numberOf(text);
}

} // namespace

void SpectrumPlot::show(const ShownHit& hit, const HitCourse& course) {
    hit_ = hit;
    levels_ = course.levels;
    setDescription(hit.frequencyHz > 0.0
                       ? number(hit.frequencyHz, 1) + " Hz" +
                             (hit.recording ? ", measured from " + utf8(hit.recording->name) : juce::String{})
                       : juce::String{"Silent"});
    setTooltip(getDescription());
    repaint();
}

void SpectrumPlot::paint(juce::Graphics& g) {
    auto area = drawWell(g, *this);
    if (!(hit_.frequencyHz > 0.0))
        return drawHead(g, *this, area.removeFromTop(headHeight), {"spectrum"}, {});
    const auto head = area.removeFromTop(headHeight);
    area = drawFrequencyAxis(g, *this, area);
    const auto colour = legible(*this, hit_.colour);
    auto heights = levels_;
    // linear scale shows peaks better
    for (float& level : heights) level = juce::Decibels::decibelsToGain(level, FrequencyAxis::floorDb);
    drawSpectrum(g, heights, area.toFloat(), colour);
    const auto x = static_cast<float>(area.getX()) +
                   static_cast<float>(juce::jlimit(0.0, 1.0, FrequencyAxis::shareOf(hit_.frequencyHz))) *
                       static_cast<float>(area.getWidth());
    g.setColour(shade(*this, Shade::accent));
    const float dashes[]{3.0f, 3.0f};
    g.drawDashedLine({x, static_cast<float>(area.getY()), x, static_cast<float>(area.getBottom())}, dashes, 2,
                     1.5f);
    const auto* s = hit_.recording ? &hit_.recording->sound : nullptr;
    drawHead(g, *this, head,
             hit_.recording ? juce::StringArray{utf8(hit_.recording->name), "recorded"}
                            : juce::StringArray{"Drop the recording of a hit here to measure it",
                                                "Drop a recording here", "spectrum"},
             s ? measured(s->frequencyHz, s->frequencyErrorHz, " Hz") : number(hit_.frequencyHz, 1) + " Hz",
             Shade::accent);
}

void CoursePlot::show(const ShownHit& hit, const HitCourse& course) {
    hit_ = hit;
    course_ = course;
    setDescription(!(hit.frequencyHz > 0.0)
                       ? juce::String{"Silent"}
                       : "Decays by " + number(hit.decayPerSecond, 1) + " per second" +
                             (hit.recording ? ", " + confidenceText(hit.recording->sound) : juce::String{}));
    setTooltip(getDescription());
    repaint();
}

void CoursePlot::paint(juce::Graphics& g) {
    auto area = drawWell(g, *this);
    const auto head = area.removeFromTop(headHeight);
    if (!(hit_.frequencyHz > 0.0) || course_.samples.empty()) return drawHead(g, *this, head, {"decay"}, {});
    const float middle = static_cast<float>(area.getCentreY()),
                reach = 0.5f * static_cast<float>(area.getHeight()) - 1.0f;
    const int width = area.getWidth(), count = static_cast<int>(course_.samples.size());
    juce::RectangleList<float> columns;
    for (int x = 0; x < width; ++x) {
        const auto from = course_.samples.begin() + static_cast<std::ptrdiff_t>(x) * count / width,
                   to = course_.samples.begin() + static_cast<std::ptrdiff_t>(x + 1) * count / width;
        const auto [low, high] =
            std::minmax_element(from, std::max(from + 1, std::min(to + 1, course_.samples.end())));
        columns.addWithoutMerging({static_cast<float>(area.getX() + x), middle - reach * *high, 1.0f,
                                   std::max(1.0f, reach * (*high - *low))});
    }
    g.setColour(legible(*this, hit_.colour).withAlpha(0.75f));
    g.fillRectList(columns);
    const double start = hit_.recording ? hit_.recording->amplitude : 1.0;
    juce::Path upper;
    for (int x = 0; x <= width; x += 2) {
        const double envelope =
            std::min(1.0, start * std::exp(-hit_.decayPerSecond * course_.seconds() * x / width));
        const juce::Point<float> p{static_cast<float>(area.getX() + x),
                                   middle - reach * static_cast<float>(envelope)};
        x == 0 ? upper.startNewSubPath(p) : upper.lineTo(p);
    }
    auto lower = upper;
    lower.applyTransform(juce::AffineTransform::verticalFlip(2.0f * middle));
    g.setColour(shade(*this, Shade::accent));
    g.strokePath(upper, juce::PathStrokeType{1.5f});
    g.strokePath(lower, juce::PathStrokeType{1.5f});
    const auto* s = hit_.recording ? &hit_.recording->sound : nullptr;
    const auto length = number(1e3 * course_.seconds(), 0) + " ms";
    const auto sure = s ? confidenceText(*s) : juce::String{};
    drawHead(g, *this, head,
             s ? juce::StringArray{length + ", " + sure, sure, sure.fromLastOccurrenceOf(", ", false, false)}
               : juce::StringArray{length},
             s ? measured(s->decayPerSecond, s->decayErrorPerSecond, " /s")
               : number(hit_.decayPerSecond, 1) + " /s",
             s && !s->isConfident() ? Shade::now : Shade::accent);
}

Result<RecordedHit> measureHit(const std::filesystem::path& path) {
    const auto name = path.filename().string();
    const auto recording = readRecording(path);
    if (!recording)
        return Failure{recording.error.starts_with(path.string())
                           ? name + recording.error.substr(path.string().size())
                           : recording.error};
    const auto& samples = loudestOf(recording.value.channels);
    const double rate = recording.value.sampleRateHz;
    const auto sound = extractMaterial(samples, rate, {FrequencyAxis::lowHz, FrequencyAxis::highHz});
    if (!sound) return Failure{name + ": " + sound.error};
    const auto begin = static_cast<std::size_t>(std::llround(sound.value.beginSeconds * rate));
    const auto end = std::min(
        samples.size(), begin + static_cast<std::size_t>(std::llround(sound.value.lengthSeconds * rate)));
    RecordedHit hit{name, sound.value,
                    courseFrom({samples.begin() + static_cast<std::ptrdiff_t>(begin),
                                samples.begin() + static_cast<std::ptrdiff_t>(end)},
                               rate),
                    0.0};
    const std::vector<double> x(hit.course.samples.begin(), hit.course.samples.end());
    PartialFit fit{x, rate};
    fit.add({2.0 * std::numbers::pi * sound.value.frequencyHz, sound.value.decayPerSecond, 0.0, 0.0});
    fit.solveLinear();
    hit.amplitude = fit.partials().front().amplitude();
    return hit;
}

HitCourse courseOf(double frequencyHz, double decayPerSecond) {
    const double rate = std::max(8000.0, 8.0 * frequencyHz),
                 seconds =
                     std::clamp(std::log(1000.0) / std::max(decayPerSecond, 1e-3), 0.01, longestSeconds);
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / rate;
        samples[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * frequencyHz * t) *
                                        std::exp(-decayPerSecond * t));
    }
    return courseFrom(std::move(samples), rate);
}

TextureRow::TextureRow() {
    setTitle("Surface");
    prepare(grain_, "Grain",
            "Mean spacing of the grains that are felt when something rolls or slides over it; at the left "
            "end it is smooth");
    prepare(roughness_, "Roughness", "How strong its grains are; double click: 1");
    prepare(rolling_, "Rolling", "How much of it is felt of what rolls; what slides is felt whole");
    grain_.setNormalisableRange(
        feltRangeWithZero(Texture::finestMetres, lowGrainMetres, highGrainMetres, Texture::coarsestMetres));
    roughness_.setNormalisableRange(
        feltRangeWithZero(minRoughness, lowRoughness, highRoughness, Texture::mostRoughness));
    rolling_.setRange(0.0, 1.0);
    roughness_.setDoubleClickReturnValue(true, Texture{}.roughness);
    grain_.textFromValueFunction = grainText;
    grain_.valueFromTextFunction = grainOf;
    roughness_.textFromValueFunction = [](double roughness) {
        return "rough " + number(roughness, roughness < 10.0 ? 2 : 1);
    };
    roughness_.valueFromTextFunction = numberOf;
    rolling_.textFromValueFunction = [](double share) { return "rolls " + number(100.0 * share, 0) + " %"; };
    rolling_.valueFromTextFunction = [](const juce::String& words) { return 0.01 * numberOf(words); };
    for (const auto& name : grainPatternNames)
        pattern_.addItem(juce::String{name.data()}, pattern_.getNumItems() + 1);
    describe(pattern_, "Pattern",
             "Random as cloth, stone or wood; regular ridges are felt as a tone of speed / spacing");
    pattern_.onChange = [this] { change("Pattern", false); };
    addAndMakeVisible(pattern_);
    show({});
}

void TextureRow::prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip) {
    describe(bar, title, tooltip);
    bar.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    bar.setSliderStyle(juce::Slider::LinearBar);
    onSlide(bar, [this, title](bool continuesEdit) { change(title, continuesEdit); });
    addAndMakeVisible(bar);
}

void TextureRow::change(const juce::String& what, bool continuesEdit) {
    if (onChange)
        onChange({grain_.getValue(), roughness_.getValue(),
                  static_cast<GrainPattern>(pattern_.getSelectedItemIndex()), rolling_.getValue()},
                 what, continuesEdit);
}

void TextureRow::show(const std::optional<Texture>& texture) {
    const Texture shown = texture.value_or(Texture{});
    grain_.setEnabled(texture.has_value());
    for (juce::Component* of : std::initializer_list<juce::Component*>{&roughness_, &pattern_, &rolling_})
        of->setEnabled(shown.grainMetres > 0.0);
    for (const auto& [bar, value] : {std::pair{&grain_, shown.grainMetres},
                                     {&roughness_, shown.roughness},
                                     {&rolling_, shown.rolling}}) {
        if (!bar->isMouseButtonDown()) bar->setValue(value, juce::dontSendNotification);
        bar->updateText();
    }
    pattern_.setSelectedItemIndex(static_cast<int>(shown.pattern), juce::dontSendNotification);
}

void TextureRow::resized() {
    auto row = getLocalBounds();
    const int between = 6, each = (row.getWidth() - 3 * between) / 4;
    for (const auto& [part, width] : std::initializer_list<std::pair<juce::Component*, int>>{
             {&grain_, each + 12}, {&roughness_, each}, {&pattern_, each - 12}}) {
        part->setBounds(row.removeFromLeft(width));
        row.removeFromLeft(between);
    }
    rolling_.setBounds(row);
}

} // namespace physvib
