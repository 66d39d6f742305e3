// SPDX-License-Identifier: GPL-3.0-or-later
// Draws each pixel column from its minimum to its maximum, and the spectra with a slow decay.
#include "Mixer/Strips/ScopeView.h"

namespace physvib {
namespace {

constexpr int scopeFootHeight = 16, maxLanes = SpectrumView::maxCurves, minLabelWidth = 26, labelGap = 6,
              laneGap = 6;

constexpr float minVisibleChangeDb = 0.3f;
constexpr int scaleWidth = 30;

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
        for (int i = 0; i < ScopeTrace::columnCount; i += 8) {
            const auto range = model_.signals().scopeTrace().columnAt(j, i);
            if (range.highest - range.lowest > 1e-5f) return false;
        }
    return true;
}

void ScopeView::refresh(const MixerSnapshot&) {
    spectrum_.refresh();
    if (model_.signals().scopeTrace().columnsBegun() == drawnColumns_) return;
    drawnColumns_ = model_.signals().scopeTrace().columnsBegun();
    const bool isQuietNow = isQuiet();
    if (isQuietNow && wasQuiet_) return; // a silent trace needs no redraw
    wasQuiet_ = isQuietNow;
    repaint(lanes_);
}

void ScopeView::drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const {
    fillRound(g, *this, Shade::well, lane.toFloat(), 3.0f);
    const auto middle = static_cast<float>(lane.getCentreY()),
               halfHeight = 0.5f * static_cast<float>(lane.getHeight()) - 2.0f;
    g.setColour(
        actuatorColour(*this, channel).withMultipliedAlpha(model_.mix().isSilent(channel) ? 0.35f : 1.0f));
    juce::RectangleList<float> columns;
    const int width = lane.getWidth() - 4;
    for (int x = 0; x < width; ++x) {
        const auto range = model_.signals().scopeTrace().pixelRange(channel, x, width);
        const float top = middle - halfHeight * displayLevel(range.highest),
                    bottom = middle - halfHeight * displayLevel(range.lowest);
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
    int labelWidth = minLabelWidth;
    for (int j = 0; j < lanes; ++j)
        labelWidth = std::max(labelWidth, text::pixelWidth(bold, labelOf(mix, j)) + labelGap);
    labelWidth = std::min(labelWidth, std::max(minLabelWidth, area.getWidth() / 5)); // longer labels are cut
    const auto foot = area.removeFromBottom(scopeFootHeight).withTrimmedLeft(labelWidth);
    setInk(g, *this, Shade::muted, text::small);
    const auto startText = mix.count() > lanes
                               ? "the first " + juce::String{lanes} + " of " + juce::String{mix.count()}
                               : juce::String{juce::CharPointer_UTF8{"\xe2\x88\x92"
                                                                     "1 s"}};
    const juce::String endText{"now"};
    const auto small = text::font(text::small);
    g.drawText(startText, foot, juce::Justification::centredLeft, true);
    if (text::pixelWidth(small, startText) + text::pixelWidth(small, endText) + gap <= foot.getWidth())
        g.drawText(endText, foot, juce::Justification::centredRight, false);
    area.removeFromBottom(2);
    const int height = (area.getHeight() + laneGap) / lanes;
    for (int j = 0; j < lanes; ++j) {
        auto lane = area.removeFromTop(height).withTrimmedBottom(j + 1 < lanes ? laneGap : 0);
        g.setColour(actuatorColour(*this, j));
        g.setFont(bold);
        g.drawText(labelOf(mix, j), lane.removeFromLeft(labelWidth).withTrimmedRight(2),
                   juce::Justification::centredLeft, true);
        drawLane(g, lane, j);
    }
}

void ScopeView::resized() {
    auto area = getLocalBounds();
    constexpr int minSpectrum = 180, minLanes = 130;
    const int spectrumWidth = std::max(minSpectrum, area.getWidth() * 36 / 100);
    spectrum_.setVisible(area.getWidth() >= spectrumWidth + gap + minLanes);
    if (spectrum_.isVisible()) {
        spectrum_.setBounds(area.removeFromRight(spectrumWidth));
        area.removeFromRight(gap);
    }
    lanes_ = area;
}

SpectrumView::SpectrumView(MixerModel& model)
    : model_{model} {
    setTitle("Spectra");
    setDescription("Levels of what each actuator plays, 20 to 1000 Hz");
    for (auto& levels : levelsDb_) levels.fill(FrequencyAxis::floorDb);
}

void SpectrumView::refresh() {
    const double now = nowMs();
    if (now - updatedAtMs_ < 1000.0 / updatesPerSecond ||
        model_.signals().scopeTrace().columnsBegun() == drawnColumns_)
        return;
    const auto fallDb = static_cast<float>(meterFallDbPerSecond * std::min(1.0, 1e-3 * (now - updatedAtMs_)));
    updatedAtMs_ = now;
    drawnColumns_ = model_.signals().scopeTrace().columnsBegun();
    bool hasChanged = false;
    for (int j = 0; j < std::min(model_.mix().count(), maxCurves); ++j) {
        const auto levels = channelSpectrum(model_.signals().spectrumTrace(), j);
        auto& drawnLevels = nth(levelsDb_, j);
        for (std::size_t k = 0; k < drawnLevels.size(); ++k) {
            const float next = std::max({levels[k], drawnLevels[k] - fallDb, FrequencyAxis::floorDb});
            hasChanged = hasChanged || std::abs(next - drawnLevels[k]) > minVisibleChangeDb;
            drawnLevels[k] = next;
        }
    }
    if (hasChanged) repaint();
}

void SpectrumView::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().withTrimmedBottom(18).toFloat(), 3.0f);
    auto area = getLocalBounds().withTrimmedTop(6).withTrimmedRight(6);
    const auto scaleArea = area.removeFromLeft(scaleWidth);
    area = drawFrequencyAxis(g, *this, area).withTrimmedBottom(2);
    g.setFont(text::font(text::small));
    for (const int db : {0, -20, -40, -60, -80}) {
        const int y = area.getY() + juce::roundToInt(static_cast<float>(area.getHeight() - 1) *
                                                     static_cast<float>(db) / FrequencyAxis::floorDb);
        g.setColour(shade(*this, Shade::line).withMultipliedAlpha(0.7f));
        g.drawHorizontalLine(y, static_cast<float>(area.getX()), static_cast<float>(area.getRight()));
        g.setColour(shade(*this, Shade::muted));
        g.drawText(db == 0 ? juce::String{"dB"} : number(db, 0),
                   juce::Rectangle<int>{scaleWidth - 5, 14}
                       .withCentre({scaleArea.getCentreX() - 2, y})
                       .constrainedWithin(getLocalBounds()),
                   juce::Justification::centredRight, false);
    }
    g.reduceClipRegion(area.withTrimmedBottom(2)); // hides the line at the floor
    for (int j = std::min(model_.mix().count(), maxCurves) - 1; j >= 0; --j) {
        auto heights = levelsDb(j);
        if (std::ranges::all_of(heights, [](float db) { return db <= FrequencyAxis::floorDb; })) continue;
        for (float& level : heights) level = 1.0f - level / FrequencyAxis::floorDb;
        drawSpectrum(g, heights, area.toFloat(),
                     actuatorColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.35f : 1.0f));
    }
}

} // namespace physvib
