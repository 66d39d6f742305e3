// SPDX-License-Identifier: GPL-3.0-or-later
// Draws each column from its minimum to its maximum; the square root of the level makes weak impacts visible.
#include "Mixer/Strips/ScopeView.h"

namespace physvib {
namespace {

constexpr int scopeFootHeight = 16, maxLanes = SpectrumView::maxCurves, minLabel = 26, afterLabel = 6,
              laneGap = 6;

constexpr float visibleDb = 0.3f;
constexpr int levelsWidth = 30;

} // namespace

ScopeView::ScopeView(MixerModel& model)
    : model_{model}
    , spectrum_{model} {
    addAndMakeVisible(spectrum_);
    setTitle("Played now");
    setDescription("Waveforms of the last second, one lane per actuator");
}

bool ScopeView::isQuiet() const {
    for (int j = 0; j < model_.mix().count(); ++j)
        for (int i = 0; i < ScopeTrace::columns; i += 8) {
            const auto range = model_.signals().scope().at(j, i);
            if (range.highest - range.lowest > 1e-5f) return false;
        }
    return true;
}

void ScopeView::refresh(const MixerMoment&) {
    spectrum_.refresh();
    if (model_.signals().scope().columnsBegun() == shown_) return;
    shown_ = model_.signals().scope().columnsBegun();
    const bool quiet = isQuiet();
    if (quiet && wasQuiet_) return; // a silent trace does not change
    wasQuiet_ = quiet;
    repaint(lanes_);
}

void ScopeView::drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const {
    fillRound(g, *this, Shade::well, lane.toFloat(), 3.0f);
    const auto middle = static_cast<float>(lane.getCentreY()),
               reach = 0.5f * static_cast<float>(lane.getHeight()) - 2.0f;
    g.setColour(
        enchanterColour(*this, channel).withMultipliedAlpha(model_.mix().isSilent(channel) ? 0.35f : 1.0f));
    juce::RectangleList<float> columns;
    const int width = lane.getWidth() - 4;
    for (int x = 0; x < width; ++x) {
        const auto range = model_.signals().scope().shown(channel, x, width);
        const float top = middle - reach * shownLevel(range.highest),
                    bottom = middle - reach * shownLevel(range.lowest);
        columns.addWithoutMerging(
            {static_cast<float>(lane.getX() + 2 + x), top - 0.5f, 1.0f, std::max(1.2f, bottom - top + 1.0f)});
    }
    g.fillRectList(columns);
}

void ScopeView::paint(juce::Graphics& g) {
    const auto& mix = model_.mix();
    auto area = lanes_;
    const int lanes = std::min(mix.count(), maxLanes);
    const auto bold = text::font(text::medium, juce::Font::bold);
    int labelWidth = minLabel;
    for (int j = 0; j < lanes; ++j)
        labelWidth = std::max(labelWidth, text::pixels(bold, labelOf(mix, j)) + afterLabel);
    labelWidth = std::min(labelWidth, std::max(minLabel, area.getWidth() / 5)); // the rest is cut
    const auto foot = area.removeFromBottom(scopeFootHeight).withTrimmedLeft(labelWidth);
    ink(g, *this, Shade::muted, text::small);
    const auto begin = mix.count() > lanes
                           ? "the first " + juce::String{lanes} + " of " + juce::String{mix.count()}
                           : juce::String{juce::CharPointer_UTF8{"\xe2\x88\x92"
                                                                 "1 s"}};
    const juce::String end{"now"};
    const auto small = text::font(text::small);
    g.drawText(begin, foot, juce::Justification::centredLeft, true);
    if (text::pixels(small, begin) + text::pixels(small, end) + gap <= foot.getWidth())
        g.drawText(end, foot, juce::Justification::centredRight, false);
    area.removeFromBottom(2);
    const int height = (area.getHeight() + laneGap) / lanes;
    for (int j = 0; j < lanes; ++j) {
        auto lane = area.removeFromTop(height).withTrimmedBottom(j + 1 < lanes ? laneGap : 0);
        g.setColour(enchanterColour(*this, j));
        g.setFont(bold);
        g.drawText(labelOf(mix, j), lane.removeFromLeft(labelWidth).withTrimmedRight(2),
                   juce::Justification::centredLeft, true);
        drawLane(g, lane, j);
    }
}

void ScopeView::resized() {
    auto area = getLocalBounds();
    constexpr int minSpectrum = 180, minLanes = 130;
    const int wide = std::max(minSpectrum, area.getWidth() * 36 / 100);
    spectrum_.setVisible(area.getWidth() >= wide + gap + minLanes);
    if (spectrum_.isVisible()) {
        spectrum_.setBounds(area.removeFromRight(wide));
        area.removeFromRight(gap);
    }
    lanes_ = area;
}

SpectrumView::SpectrumView(MixerModel& model)
    : model_{model} {
    setTitle("Spectra");
    setDescription("Levels of what each actuator plays, 20 to 1000 Hz");
    for (auto& levels : shown_) levels.fill(FrequencyAxis::floorDb);
}

void SpectrumView::refresh() {
    const double now = nowMs();
    if (now - lookedAtMs_ < 1000.0 / looksPerSecond || model_.signals().scope().columnsBegun() == seen_)
        return;
    const auto fall = static_cast<float>(meterFallDbPerSecond * std::min(1.0, 1e-3 * (now - lookedAtMs_)));
    lookedAtMs_ = now;
    seen_ = model_.signals().scope().columnsBegun();
    bool isOther = false;
    for (int j = 0; j < std::min(model_.mix().count(), maxCurves); ++j) {
        const auto levels = levelsOf(model_.signals().spectrum(), j);
        auto& shown = nth(shown_, j);
        for (std::size_t k = 0; k < shown.size(); ++k) {
            const float next = std::max({levels[k], shown[k] - fall, FrequencyAxis::floorDb});
            isOther = isOther || std::abs(next - shown[k]) > visibleDb;
            shown[k] = next;
        }
    }
    if (isOther) repaint();
}

void SpectrumView::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().withTrimmedBottom(18).toFloat(), 3.0f);
    auto area = getLocalBounds().withTrimmedTop(6).withTrimmedRight(6);
    const auto levels = area.removeFromLeft(levelsWidth);
    area = drawFrequencyAxis(g, *this, area).withTrimmedBottom(2);
    g.setFont(text::font(text::small));
    for (const int db : {0, -20, -40, -60, -80}) {
        const int y = area.getY() + juce::roundToInt(static_cast<float>(area.getHeight() - 1) *
                                                     static_cast<float>(db) / FrequencyAxis::floorDb);
        g.setColour(shade(*this, Shade::line).withMultipliedAlpha(0.7f));
        g.drawHorizontalLine(y, static_cast<float>(area.getX()), static_cast<float>(area.getRight()));
        g.setColour(shade(*this, Shade::muted));
        g.drawText(db == 0 ? juce::String{"dB"} : number(db, 0),
                   juce::Rectangle<int>{levelsWidth - 5, 14}
                       .withCentre({levels.getCentreX() - 2, y})
                       .constrainedWithin(getLocalBounds()),
                   juce::Justification::centredRight, false);
    }
    g.reduceClipRegion(area.withTrimmedBottom(2)); // does not draw the floor
    for (int j = std::min(model_.mix().count(), maxCurves) - 1; j >= 0; --j) {
        auto heights = shown(j);
        if (std::ranges::all_of(heights, [](float db) { return db <= FrequencyAxis::floorDb; })) continue;
        for (float& level : heights) level = 1.0f - level / FrequencyAxis::floorDb;
        drawSpectrum(g, heights, area.toFloat(),
                     enchanterColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.35f : 1.0f));
    }
}

} // namespace physvib
