// SPDX-License-Identifier: GPL-3.0-or-later
// Bars from -60 dB to full scale, and the limiter's gain.
#include "Host/Views/MeterView.h"

namespace physvib {

namespace {

constexpr int mostLabelled = 16; // more are bars without words

void drawBar(juce::Graphics& g, const juce::Component& c, juce::Rectangle<float> bar, juce::Colour colour, float peak, bool isConnected) {
    g.setColour(shade(c, Shade::well));
    g.fillRoundedRectangle(bar, 3.0f);
    if (!isConnected) {
        g.setColour(shade(c, Shade::line));
        for (float y = bar.getY() + 6.0f; y < bar.getBottom(); y += 8.0f) g.drawLine(bar.getX() + 2.0f, y, bar.getRight() - 2.0f, y - 5.0f, 1.0f);
        return;
    }
    const float height = meterHeight(peak);
    g.setColour(colour);
    g.fillRoundedRectangle(bar.withTrimmedTop(bar.getHeight() * (1.0f - height)), 3.0f);
    g.setColour(shade(c, Shade::line));
    for (const float db : {-12.0f, -24.0f, -36.0f, -48.0f}) {
        const float y = bar.getY() + bar.getHeight() * db / meterFloorDb;
        g.drawLine(bar.getX(), y, bar.getRight(), y, 1.0f);
    }
}

} // namespace

void MeterView::update(const ChannelMeters& meters, const LayoutDescription& layout) {
    meters_ = meters;
    labels_.clear();
    for (const auto& e : layout.enchanters) labels_.push_back(juce::String::fromUTF8(e.label.c_str()));
    repaint();
}

void MeterView::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::panel));
    auto area = getLocalBounds().reduced(14, 12).toFloat();
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
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
        drawBar(g, *this, bar, enchanterColour(*this, j), meters_.peaks[i], meters_.isConnected[i]);
        g.setColour(enchanterColour(*this, j));
        if (words) g.drawText(labels_[i], names.withX(bar.getX()).withWidth(bar.getWidth()), juce::Justification::centred, false);
        g.setColour(shade(*this, Shade::text));
        const float db = juce::Decibels::gainToDecibels(meters_.peaks[i], meterFloorDb);
        if (!peaks.isEmpty()) g.drawText(db <= meterFloorDb ? juce::String{"-inf"} : juce::String{juce::roundToInt(db)}, peaks.withX(bar.getX() - 6.0f).withWidth(bar.getWidth() + 12.0f), juce::Justification::centred, false);
    }
}

} // namespace physvib
