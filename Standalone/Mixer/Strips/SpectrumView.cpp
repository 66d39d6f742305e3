// SPDX-License-Identifier: GPL-3.0-or-later
// Updates the spectra ten times a second, and redraws only visible changes.
#include "Mixer/Strips/SpectrumView.h"
#include "Mixer/Window/Parts.h"
#include <cmath>

namespace physvib {

namespace {

constexpr float visibleDb = 0.3f;
constexpr int levelsWidth = 30;

} // namespace

SpectrumView::SpectrumView(Desk& desk)
    : desk_{desk} {
    setTitle("Spectra");
    setDescription("Levels of what each actuator plays, 20 to 1000 Hz");
    for (auto& levels : shown_) levels.fill(FrequencyAxis::floorDb);
}

void SpectrumView::refresh() {
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (now - lookedAtMs_ < 1000.0 / looksPerSecond || desk_.signals().scope().columnsBegun() == seen_)
        return;
    const auto fall = static_cast<float>(meterFallDbPerSecond * std::min(1.0, 1e-3 * (now - lookedAtMs_)));
    lookedAtMs_ = now;
    seen_ = desk_.signals().scope().columnsBegun();
    bool isOther = false;
    for (int j = 0; j < std::min(desk_.mix().count(), mostCurves); ++j) {
        const auto levels = desk_.signals().spectrum().levels(j);
        auto& shown = shown_[static_cast<std::size_t>(j)];
        for (std::size_t k = 0; k < shown.size(); ++k) {
            const float next = std::max({levels[k], shown[k] - fall, FrequencyAxis::floorDb});
            isOther = isOther || std::abs(next - shown[k]) > visibleDb;
            shown[k] = next;
        }
    }
    if (isOther) repaint();
}

void SpectrumView::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(getLocalBounds().withTrimmedBottom(18).toFloat(), 3.0f);
    auto area = getLocalBounds().withTrimmedTop(6).withTrimmedRight(6);
    const auto levels = area.removeFromLeft(levelsWidth);
    area = drawFrequencyAxis(g, *this, area).withTrimmedBottom(2);
    g.setFont(juce::Font{text::small});
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
    for (int j = std::min(desk_.mix().count(), mostCurves) - 1; j >= 0; --j) {
        auto heights = shown(j);
        if (std::ranges::all_of(heights, [](float db) { return db <= FrequencyAxis::floorDb; })) continue;
        for (float& level : heights) level = 1.0f - level / FrequencyAxis::floorDb;
        drawSpectrum(g, heights, area.toFloat(),
                     enchanterColour(*this, j).withMultipliedAlpha(desk_.mix().isSilent(j) ? 0.35f : 1.0f));
    }
}

} // namespace physvib
