// SPDX-License-Identifier: GPL-3.0-or-later
// Draws facts column by column from the top.
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

namespace {

constexpr int lowestRow = 18, highestRow = 26, afterName = 14;

} // namespace

FactList::FactList(const juce::String& title, int columns)
    : columns_{columns} {
    setTitle(title);
}

void FactList::set(std::vector<Fact> facts) {
    if (facts == facts_) return;
    facts_ = std::move(facts);
    juce::StringArray words;
    for (const auto& fact : facts_) words.add(fact.name + ": " + fact.value);
    setDescription(words.joinIntoString("; "));
    repaint();
}

void FactList::paint(juce::Graphics& g) {
    if (facts_.empty()) return;
    const int rows = (static_cast<int>(facts_.size()) + columns_ - 1) / columns_,
              height = juce::jlimit(lowestRow, highestRow, getHeight() / rows);
    const int width = (getWidth() - (columns_ - 1) * gap) / columns_;
    const juce::Font font{text::medium};
    int nameWidth = 0;
    for (const auto& fact : facts_)
        nameWidth = std::max(nameWidth, font.getStringWidth(fact.name) + afterName);
    g.setFont(font);
    for (int i = 0; i < static_cast<int>(facts_.size()); ++i) {
        const auto& fact = facts_[static_cast<std::size_t>(i)];
        juce::Rectangle<int> row{i / rows * (width + gap), i % rows * height, width, height};
        g.setColour(shade(*this, Shade::muted));
        g.drawText(fact.name, row.removeFromLeft(nameWidth), juce::Justification::centredLeft, true);
        g.setColour(shade(*this, fact.shade));
        g.drawFittedText(fact.value, row, juce::Justification::centredLeft, 1, 0.8f);
    }
}

} // namespace physvib
