// SPDX-License-Identifier: GPL-3.0-or-later
// Draws each column from its minimum to its maximum; the square root of the level makes weak impacts visible.
#include "Mixer/Strips/ScopeView.h"
#include <cmath>

namespace physvib {

namespace {

constexpr int scopeFootHeight = 16, mostLanes = SpectrumView::mostCurves, leastLabel = 26, afterLabel = 6,
              laneGap = 6;

float shownLevel(float sample) { return std::copysign(std::sqrt(std::min(1.0f, std::abs(sample))), sample); }

} // namespace

ScopeView::ScopeView(Desk& desk)
    : desk_{desk}
    , spectrum_{desk} {
    addAndMakeVisible(spectrum_);
    setTitle("Played now");
    setDescription("Waveforms of the last second, one lane per actuator");
}

bool ScopeView::isQuiet() const {
    for (int j = 0; j < desk_.mix().count(); ++j)
        for (int i = 0; i < ScopeTrace::columns; i += 8) {
            const auto range = desk_.signals().scope().at(j, i);
            if (range.highest - range.lowest > 1e-5f) return false;
        }
    return true;
}

void ScopeView::refresh(const DeskMoment&) {
    spectrum_.refresh();
    if (desk_.signals().scope().columnsBegun() == shown_) return;
    shown_ = desk_.signals().scope().columnsBegun();
    const bool quiet = isQuiet();
    if (quiet && wasQuiet_) return; // a silent trace does not change
    wasQuiet_ = quiet;
    repaint(lanes_);
}

void ScopeView::drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const {
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(lane.toFloat(), 3.0f);
    const auto middle = static_cast<float>(lane.getCentreY()),
               reach = 0.5f * static_cast<float>(lane.getHeight()) - 2.0f;
    g.setColour(
        enchanterColour(*this, channel).withMultipliedAlpha(desk_.mix().isSilent(channel) ? 0.35f : 1.0f));
    juce::RectangleList<float> columns;
    const int width = lane.getWidth() - 4;
    for (int x = 0; x < width; ++x) {
        const auto range = desk_.signals().scope().shown(channel, x, width);
        const float top = middle - reach * shownLevel(range.highest),
                    bottom = middle - reach * shownLevel(range.lowest);
        columns.addWithoutMerging(
            {static_cast<float>(lane.getX() + 2 + x), top - 0.5f, 1.0f, std::max(1.2f, bottom - top + 1.0f)});
    }
    g.fillRectList(columns);
}

void ScopeView::paint(juce::Graphics& g) {
    const auto& mix = desk_.mix();
    auto area = lanes_;
    const int lanes = std::min(mix.count(), mostLanes);
    const juce::Font bold{text::medium, juce::Font::bold};
    const auto labelOf = [&](int j) {
        return utf8(mix.layout.enchanters[static_cast<std::size_t>(j)].label);
    };
    int labelWidth = leastLabel;
    for (int j = 0; j < lanes; ++j)
        labelWidth = std::max(labelWidth, bold.getStringWidth(labelOf(j)) + afterLabel);
    labelWidth = std::min(labelWidth, std::max(leastLabel, area.getWidth() / 5)); // the rest is cut
    const auto foot = area.removeFromBottom(scopeFootHeight).withTrimmedLeft(labelWidth);
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
    const auto begin = mix.count() > lanes
                           ? "the first " + juce::String{lanes} + " of " + juce::String{mix.count()}
                           : juce::String{juce::CharPointer_UTF8{"\xe2\x88\x92"
                                                                 "1 s"}};
    const juce::String end{"now"};
    const juce::Font small{text::small};
    g.drawText(begin, foot, juce::Justification::centredLeft, true);
    if (small.getStringWidth(begin) + small.getStringWidth(end) + gap <= foot.getWidth())
        g.drawText(end, foot, juce::Justification::centredRight, false);
    area.removeFromBottom(2);
    const int height = (area.getHeight() + laneGap) / lanes;
    for (int j = 0; j < lanes; ++j) {
        auto lane = area.removeFromTop(height).withTrimmedBottom(j + 1 < lanes ? laneGap : 0);
        g.setColour(enchanterColour(*this, j));
        g.setFont(bold);
        g.drawText(labelOf(j), lane.removeFromLeft(labelWidth).withTrimmedRight(2),
                   juce::Justification::centredLeft, true);
        drawLane(g, lane, j);
    }
}

void ScopeView::resized() {
    auto area = getLocalBounds();
    constexpr int leastSpectrum = 180, leastLanes = 130;
    const int wide = std::max(leastSpectrum, area.getWidth() * 36 / 100);
    spectrum_.setVisible(area.getWidth() >= wide + gap + leastLanes);
    if (spectrum_.isVisible()) {
        spectrum_.setBounds(area.removeFromRight(wide));
        area.removeFromRight(gap);
    }
    lanes_ = area;
}

} // namespace physvib
