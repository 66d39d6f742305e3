// SPDX-License-Identifier: GPL-3.0-or-later
// Draws facts column by column from the top.
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <numeric>

namespace physvib {

namespace {

constexpr int lowestRow = 18, highestRow = 26, afterName = 14;

/// That the words need at that width, broken between words.
int linesOf(const juce::String& words, const juce::Font& font, int width) {
    if (font.getStringWidth(words) <= width) return 1;
    juce::AttributedString all;
    all.append(words, font);
    juce::TextLayout layout;
    layout.createLayout(all, static_cast<float>(std::max(1, width)));
    return std::max(1, layout.getNumLines());
}

} // namespace

FactList::FactList(const juce::String& title, int mostColumns)
    : mostColumns_{mostColumns} {
    setTitle(title);
}

// As many columns as hold every value in one line; in a single one, a long value has several lines.
FactList::Places FactList::placesIn(int width) const {
    const juce::Font font{text::medium};
    Places p;
    int widest = 0;
    for (const auto& fact : facts_) {
        p.nameWidth = std::max(p.nameWidth, font.getStringWidth(fact.name) + afterName);
        widest = std::max(widest, font.getStringWidth(fact.value) + 1);
    }
    const auto room = [&](int columns) { return (width - (columns - 1) * gap) / columns - p.nameWidth; };
    for (p.columns = mostColumns_; p.columns > 1 && room(p.columns) < widest;) --p.columns;
    const int count = static_cast<int>(facts_.size());
    p.rows = (count + p.columns - 1) / p.columns;
    for (const auto& fact : facts_)
        p.linesOf.push_back(p.columns > 1 ? 1 : linesOf(fact.value, font, room(1)));
    p.lines = p.columns > 1 ? p.rows : std::accumulate(p.linesOf.begin(), p.linesOf.end(), 0);
    return p;
}

int FactList::heightFor(int width) const { return placesIn(width).lines * lowestRow; }

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
    const auto p = placesIn(getWidth());
    const int line = juce::jlimit(lowestRow, highestRow, getHeight() / p.lines),
              width = (getWidth() - (p.columns - 1) * gap) / p.columns;
    const juce::Font font{text::medium};
    g.setFont(font);
    int y = 0;
    for (int i = 0; i < static_cast<int>(facts_.size()); ++i) {
        const auto& fact = facts_[static_cast<std::size_t>(i)];
        const int lines = p.linesOf[static_cast<std::size_t>(i)];
        if (i % p.rows == 0) y = 0;
        juce::Rectangle<int> row{i / p.rows * (width + gap), y, width, lines * line};
        y = row.getBottom();
        g.setColour(shade(*this, Shade::muted));
        g.drawText(fact.name, row.removeFromLeft(p.nameWidth).withHeight(line),
                   juce::Justification::centredLeft, true);
        g.setColour(shade(*this, fact.shade));
        g.drawFittedText(fact.value, row, juce::Justification::centredLeft, lines, 1.0f);
    }
}

} // namespace physvib
