// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the rows of the list of materials.
#include "Mixer/Materials/MaterialColumns.h"
#include "Mixer/Materials/MaterialsTab.h"
#include <cmath>

namespace physvib {

namespace {

constexpr double decibelsOfDecay = 60.0;

} // namespace

juce::String MaterialsTab::Rows::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& m = tab_.desk_.world()
                        .scene()
                        .materials[static_cast<std::size_t>(tab_.order_[static_cast<std::size_t>(row)])];
    return utf8(m.name) + (m.frequencyHz > 0.0 ? ", " + frequencyText(m.frequencyHz) + " hertz, decays by " +
                                                     decayText(m.decayPerSecond) + " per second"
                                               : juce::String{", silent"});
}

void MaterialsTab::Rows::listBoxItemClicked(int, const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu() || !tab_.feel_.isEnabled()) return;
    if (MaterialColumns{e.eventComponent->getLocalBounds()}.sign.contains(e.getPosition()))
        tab_.feelAt(tab_.spot_);
}

void MaterialsTab::Rows::paintListBoxItem(int row, juce::Graphics& g, int width, int height,
                                          bool isSelected) {
    if (row >= getNumRows()) return;
    const int index = tab_.order_[static_cast<std::size_t>(row)];
    const auto& m = tab_.desk_.world().scene().materials[static_cast<std::size_t>(index)];
    if (isSelected) {
        g.setColour(shade(tab_, Shade::accent).withAlpha(0.16f));
        g.fillRect(0, 0, width, height);
    }
    const MaterialColumns at{{width, height}};
    const bool sounds = m.frequencyHz > 0.0;
    g.setColour(palette::material(index).withMultipliedAlpha(sounds ? 1.0f : 0.5f));
    g.fillEllipse(at.dot.withWidth(14).toFloat().withSizeKeepingCentre(12.0f, 12.0f));
    g.setFont(juce::Font{text::medium});
    g.setColour(shade(tab_, sounds ? Shade::text : Shade::muted));
    g.drawText(utf8(m.name), at.name, juce::Justification::centredLeft, true);
    if (!sounds)
        return g.drawText("silent here", at.frequency.getUnion(at.length), juce::Justification::centredRight,
                          true);
    g.drawText(frequencyText(m.frequencyHz), at.frequency, juce::Justification::centredRight, true);
    g.drawText(decayText(m.decayPerSecond), at.decay, juce::Justification::centredRight, true);
    g.drawText(number(1e3 * decibelsOfDecay / 20.0 * std::log(10.0) / m.decayPerSecond, 0) + " ms", at.length,
               juce::Justification::centredRight, true);
    juce::Path sign;
    sign.addTriangle(-4.0f, -5.5f, -4.0f, 5.5f, 5.5f, 0.0f);
    g.setColour(shade(tab_, isSelected ? Shade::accent : Shade::muted));
    g.fillPath(sign,
               juce::AffineTransform::translation(at.sign.toFloat().getCentre().translated(6.0f, 0.0f)));
}

} // namespace physvib
