// SPDX-License-Identifier: GPL-3.0-or-later
// Bars from -60 dB to full scale, and the limiter's gain.
#include "MeterView.h"
#include "Host/Palette.h"

namespace physvib {

namespace {

constexpr float floorDb = -60.0f;
constexpr int mostLabelled = 16; // more are bars without words

float heightOf(float peak) { return juce::jlimit(0.0f, 1.0f, 1.0f - juce::Decibels::gainToDecibels(peak, floorDb) / floorDb); }

void drawBar(juce::Graphics& g, juce::Rectangle<float> bar, juce::Colour colour, float peak, bool isConnected) {
    g.setColour(palette::well);
    g.fillRoundedRectangle(bar, 3.0f);
    if (!isConnected) {
        g.setColour(palette::line);
        for (float y = bar.getY() + 6.0f; y < bar.getBottom(); y += 8.0f) g.drawLine(bar.getX() + 2.0f, y, bar.getRight() - 2.0f, y - 5.0f, 1.0f);
        return;
    }
    const float height = heightOf(peak);
    g.setColour(colour);
    g.fillRoundedRectangle(bar.withTrimmedTop(bar.getHeight() * (1.0f - height)), 3.0f);
    g.setColour(palette::line);
    for (const float db : {-12.0f, -24.0f, -36.0f, -48.0f}) {
        const float y = bar.getY() + bar.getHeight() * db / floorDb;
        g.drawLine(bar.getX(), y, bar.getRight(), y, 1.0f);
    }
}

} // namespace

void MeterView::update(const PluginMeters& meters, const LayoutDescription& layout) {
    meters_ = meters;
    labels_.clear();
    for (const auto& e : layout.enchanters) labels_.push_back(juce::String::fromUTF8(e.label.c_str()));
    repaint();
}

void MeterView::paint(juce::Graphics& g) {
    g.fillAll(palette::panel);
    auto area = getLocalBounds().reduced(14, 12).toFloat();
    g.setFont(juce::Font{13.0f});
    g.setColour(palette::muted);
    const auto limiter = juce::Decibels::gainToDecibels(meters_.limiterGain);
    g.drawText("limiter " + (limiter < -0.05f ? juce::String{limiter, 1} : juce::String{"0.0"}) + " dB", area.removeFromBottom(20.0f), juce::Justification::centred, false);
    const int count = static_cast<int>(labels_.size());
    if (count == 0) return;
    const bool words = count <= mostLabelled;
    auto names = area.removeFromBottom(words ? 20.0f : 0.0f), peaks = area.removeFromTop(words && count <= 6 ? 20.0f : 0.0f);
    const float width = area.getWidth() / static_cast<float>(count);
    for (int j = 0; j < count; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const auto bar = area.withX(area.getX() + width * static_cast<float>(j)).withWidth(width).reduced(std::min(6.0f, 0.15f * width), 0.0f);
        drawBar(g, bar, palette::enchanter(j), meters_.peaks[i], meters_.isConnected[i]);
        g.setColour(palette::enchanter(j));
        if (words) g.drawText(labels_[i], names.withX(bar.getX()).withWidth(bar.getWidth()), juce::Justification::centred, false);
        g.setColour(palette::text);
        const float db = juce::Decibels::gainToDecibels(meters_.peaks[i], floorDb);
        if (!peaks.isEmpty()) g.drawText(db <= floorDb ? juce::String{"-inf"} : juce::String{juce::roundToInt(db)}, peaks.withX(bar.getX() - 6.0f).withWidth(bar.getWidth() + 12.0f), juce::Justification::centred, false);
    }
}

} // namespace physvib
