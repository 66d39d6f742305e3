// SPDX-License-Identifier: GPL-3.0-or-later
// Lanes as columns from the lowest to the highest sample; a square root of the level lets weak hits be seen.
#include "Mixer/ScopeView.h"
#include <cmath>

namespace physvib {

namespace {

constexpr int headHeight = 22, mostLanes = 8, labelWidth = 26;

float shownLevel(float sample) { return std::copysign(std::sqrt(std::min(1.0f, std::abs(sample))), sample); }

} // namespace

ScopeView::ScopeView(Desk& desk)
    : desk_{desk} {
    setTitle("Played now");
    setDescription("Waveforms of the last second, one lane per enchanter");
}

bool ScopeView::isQuiet() const {
    for (int j = 0; j < desk_.mix().count(); ++j)
        for (int i = 0; i < ScopeTrace::columns; i += 8) {
            const auto range = desk_.scope().at(j, i);
            if (range.highest - range.lowest > 1e-5f) return false;
        }
    return true;
}

void ScopeView::refresh() {
    if (desk_.scope().columnsBegun() == shown_) return;
    shown_ = desk_.scope().columnsBegun();
    const bool quiet = isQuiet();
    if (quiet && wasQuiet_) return; // a line stays a line
    wasQuiet_ = quiet;
    repaint();
}

void ScopeView::drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const {
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(lane.toFloat(), 3.0f);
    const auto middle = static_cast<float>(lane.getCentreY()), reach = 0.5f * static_cast<float>(lane.getHeight()) - 2.0f;
    g.setColour(enchanterColour(*this, channel).withMultipliedAlpha(desk_.mix().isSilent(channel) ? 0.35f : 1.0f));
    juce::RectangleList<float> columns;
    const int width = lane.getWidth() - 4;
    for (int x = 0; x < width; ++x) {
        const auto range = desk_.scope().at(channel, x * (ScopeTrace::columns - 1) / std::max(1, width));
        const float top = middle - reach * shownLevel(range.highest), bottom = middle - reach * shownLevel(range.lowest);
        columns.addWithoutMerging({static_cast<float>(lane.getX() + 2 + x), top - 0.5f, 1.0f, std::max(1.2f, bottom - top + 1.0f)});
    }
    g.fillRectList(columns);
}

void ScopeView::paint(juce::Graphics& g) {
    drawPanel(g, *this);
    auto area = getLocalBounds().reduced(panelInset, 8);
    auto head = area.removeFromTop(headHeight);
    g.setFont(juce::Font{text::small, juce::Font::bold});
    g.setColour(shade(*this, Shade::muted));
    g.drawText("PLAYED NOW", head, juce::Justification::centredLeft, false);
    const auto& mix = desk_.mix();
    const int lanes = std::min(mix.count(), mostLanes);
    g.setFont(juce::Font{text::small});
    g.drawText(mix.count() > lanes ? "the first " + juce::String{lanes} + " of " + juce::String{mix.count()} + ", 1 s" : juce::String{"1 s"}, head, juce::Justification::centredRight, false);
    const int height = (area.getHeight() + 6) / lanes;
    for (int j = 0; j < lanes; ++j) {
        auto lane = area.removeFromTop(height).withTrimmedBottom(6);
        g.setColour(enchanterColour(*this, j));
        g.setFont(juce::Font{text::medium, juce::Font::bold});
        g.drawText(utf8(mix.layout.enchanters[static_cast<std::size_t>(j)].label), lane.removeFromLeft(labelWidth), juce::Justification::centredLeft, false);
        drawLane(g, lane, j);
    }
}

} // namespace physvib
