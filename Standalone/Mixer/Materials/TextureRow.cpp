// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders for grain distance, roughness and rolling, and a list of patterns.
#include "Mixer/Materials/TextureRow.h"
#include "Mixer/Materials/FeltRange.h"
#include "Mixer/Window/Parts.h"
#include "Scene/SceneFields.h"

namespace physvib {
namespace {

// limits of perception at speeds of hands and balls
constexpr double lowGrainMetres = 0.0005, highGrainMetres = 0.2;
constexpr double leastRoughness = 0.001, lowRoughness = 0.05, highRoughness = 20.0;

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

/// Parses millimetres, or metres if the text says so.
double grainOf(const juce::String& words) {
    const auto text = words.trim();
    return text.endsWith("m") && !text.endsWith("mm") ? numberOf(text) : 1e-3 * numberOf(text);
}

} // namespace

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
        feltRangeWithZero(leastRoughness, lowRoughness, highRoughness, Texture::mostRoughness));
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
    pattern_.setTitle("Pattern");
    pattern_.setTooltip(
        "Random as cloth, stone or wood; regular ridges are felt as a tone of speed / spacing");
    pattern_.onChange = [this] { change("Pattern", false); };
    addAndMakeVisible(pattern_);
    show({});
}

void TextureRow::prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip) {
    bar.setTitle(title);
    bar.setTooltip(tooltip);
    bar.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    bar.setSliderStyle(juce::Slider::LinearBar);
    onSlide(bar, [this, title](bool goesOn) { change(title, goesOn); });
    addAndMakeVisible(bar);
}

void TextureRow::change(const juce::String& what, bool goesOn) {
    if (onChange)
        onChange({grain_.getValue(), roughness_.getValue(),
                  static_cast<GrainPattern>(pattern_.getSelectedItemIndex()), rolling_.getValue()},
                 what, goesOn);
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
    for (juce::Component* part : std::initializer_list<juce::Component*>{&grain_, &roughness_, &pattern_}) {
        part->setBounds(row.removeFromLeft(each));
        row.removeFromLeft(between);
    }
    rolling_.setBounds(row);
}

} // namespace physvib
