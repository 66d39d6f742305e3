// SPDX-License-Identifier: GPL-3.0-or-later
// Draws recordings in the material's colour, and the fitted mode in the accent colour.
#include "Mixer/Materials/HitPlots.h"
#include "Mixer/Window/Parts.h"
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

namespace {

constexpr int headHeight = 18;

juce::Rectangle<int> drawWell(juce::Graphics& g, const juce::Component& c) {
    g.setColour(shade(c, Shade::well));
    g.fillRoundedRectangle(c.getLocalBounds().toFloat(), 5.0f);
    return c.getLocalBounds().reduced(8, 4);
}

/// Draws the first text of `left` that fits beside `right`.
void drawHead(juce::Graphics& g, const juce::Component& c, juce::Rectangle<int> row,
              const juce::StringArray& left, const juce::String& right, Shade rightShade = Shade::muted) {
    const juce::Font font{text::small};
    g.setFont(font);
    g.setColour(shade(c, rightShade));
    const auto place = row.removeFromRight(std::min(row.getWidth(), font.getStringWidth(right) + 4));
    g.drawText(right, place, juce::Justification::centredRight, true);
    g.setColour(shade(c, Shade::muted));
    for (const auto& words : left)
        if (font.getStringWidth(words) < row.getWidth() - 8)
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

} // namespace

juce::String confidenceText(const ContactSound& sound) {
    const auto residual = sound.residualShare > 1e-12
                              ? number(10.0 * std::log10(sound.residualShare), 0) + " dB"
                              : juce::String{"none"};
    return "residual " + residual + ", confidence " + (sound.isConfident() ? "high" : "low");
}

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

} // namespace physvib
