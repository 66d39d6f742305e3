// SPDX-License-Identifier: GPL-3.0-or-later
// Rows for all strips and groups, with a time axis.
#include "Mixer/Strips/LanesTab.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {
namespace {

constexpr int labelWidth = 92, leastRow = 34, betweenRows = 6, footHigh = 18;

} // namespace

LanesTab::LanesTab(Desk& desk)
    : desk_{desk} {
    setTitle("Gain lanes");
    viewport_.setViewedComponent(&rows_, false);
    viewport_.setScrollBarsShown(true, false);
    viewport_.setScrollBarThickness(8);
    addAndMakeVisible(viewport_);
    takeMix();
}

void LanesTab::takeMix() {
    const std::size_t wanted = desk_.mix().strips.size() + desk_.mix().groups.size();
    if (rows_.lanes.size() != wanted) {
        rows_.lanes.clear();
        for (std::size_t i = 0; i < wanted; ++i) {
            rows_.lanes.push_back(std::make_unique<LaneRow>(desk_, i));
            rows_.addAndMakeVisible(*rows_.lanes.back());
        }
        prepareControls(rows_);
        resized();
    }
    for (auto& lane : rows_.lanes) lane->takeMix();
    shownSeconds_ = -1.0;
    rows_.repaint();
}

// Covers the scene so far and all points.
double LanesTab::spanSeconds() const {
    double needed = desk_.signals().take().seconds();
    const auto take = [&needed](const GainLane& lane) {
        if (!lane.empty()) needed = std::max(needed, lane.back().seconds);
    };
    for (const Strip& strip : desk_.mix().strips) take(strip.lane);
    for (const StripGroup& group : desk_.mix().groups) take(group.lane);
    double span = 10.0;
    for (int k = 0; span < needed; ++k) span *= k % 3 == 1 ? 1.5 : 2.0; // 20, 30, 60, 120, 180, 360...
    return span;
}

void LanesTab::refresh(const DeskMoment&) {
    const double seconds = desk_.signals().take().seconds(), span = spanSeconds();
    if (seconds == shownSeconds_ && span == spanSeconds_) return;
    shownSeconds_ = seconds;
    if (span != std::exchange(spanSeconds_, span)) repaint(foot_);
    for (auto& lane : rows_.lanes) lane->show(span);
}

void LanesTab::Rows::paint(juce::Graphics& g) {
    g.setFont(juce::Font{text::medium, juce::Font::bold});
    const auto& mix = desk_.mix();
    for (std::size_t i = 0; i < std::min(lanes.size(), mix.strips.size() + mix.groups.size()); ++i) {
        const bool isStrip = i < mix.strips.size();
        g.setColour(isStrip ? enchanterColour(*this, static_cast<int>(i)) : shade(*this, Shade::text));
        const auto words =
            utf8(isStrip ? mix.layout.enchanters[i].label : mix.groups[i - mix.strips.size()].name);
        g.drawFittedText(words, lanes[i]->getBounds().withX(0).withWidth(labelWidth - 8),
                         juce::Justification::centredLeft, 1, 0.8f);
    }
}

void LanesTab::paint(juce::Graphics& g) {
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
    const auto axis = foot_.withTrimmedLeft(labelWidth);
    g.drawText("0", axis, juce::Justification::centredLeft, false);
    g.drawText(number(std::max(10.0, spanSeconds_), 0) + " s of the scene", axis,
               juce::Justification::centredRight, false);
    const auto room = axis.withTrimmedLeft(20).withTrimmedRight(110);
    for (const char* words : {"Click adds a point. Record (Ctrl+R), and the faders you move are written.",
                              "Click adds a point. Ctrl+R records faders.", "Click adds a point."})
        if (g.getCurrentFont().getStringWidth(words) <= room.getWidth())
            return g.drawText(words, room, juce::Justification::centred, false);
}

void LanesTab::resized() {
    auto area = getLocalBounds();
    foot_ = area.removeFromBottom(footHigh);
    area.removeFromBottom(2);
    viewport_.setBounds(area);
    const int count = std::max(1, static_cast<int>(rows_.lanes.size()));
    const int each = std::max(leastRow, (area.getHeight() + betweenRows) / count - betweenRows),
              high = count * (each + betweenRows) - betweenRows;
    rows_.setSize(area.getWidth() - (high > area.getHeight() ? 10 : 0), high);
    auto rest = rows_.getLocalBounds().withTrimmedLeft(labelWidth);
    for (auto& lane : rows_.lanes) lane->setBounds(rest.removeFromTop(each)), rest.removeFromTop(betweenRows);
}

} // namespace physvib
