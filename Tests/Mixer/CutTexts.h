// SPDX-License-Identifier: GPL-3.0-or-later
// Finds texts that a component cuts or crushes: JUCE ends a text that has no room with three dots, narrows
// its letters, or lets the component's edge cut them.
#pragma once
#include "Contrast.h"
#include <cmath>
#include <map>
#include <vector>

namespace physvib::test {

struct CutText {
    juce::String words, why;
    juce::Point<int> at, edge; // which edge cuts
};

/// Reads what is drawn at its own size; the letters themselves do not appear.
class ReadingRenderer final : public LetterRenderer {
public:
    using LetterRenderer::LetterRenderer;

    void finish() { endRun(); }
    const std::vector<CutText>& cut() const { return cut_; }
    const juce::StringArray& words() const { return words_; }

private:
    struct Letter {
        juce::juce_wchar sign;
        juce::Point<float> at;
        float height, width;
    };

    void draw(int glyph, const juce::AffineTransform& at, const std::function<void()>&) override {
        if (clip().isEmpty()) return;
        const auto& font = getFont();
        const Letter letter{letterOf(glyph),
                            {at.getTranslationX(), at.getTranslationY()},
                            font.getHeight(),
                            font.getHorizontalScale()};
        const bool keepGoing = !run_.empty() && std::abs(run_.back().at.y - letter.at.y) < 0.5f &&
                               letter.at.x > run_.back().at.x &&
                               letter.at.x - run_.back().at.x < 1.6f * letter.height;
        if (!keepGoing) endRun();
        run_.push_back(letter);
        lookAtEdge(glyph, letter.at);
    }

    juce::juce_wchar letterOf(int glyph) {
        // read once in a process: thousands of signs; the typeface is kept, so that no other has its address
        static auto& known =
            *new std::map<const void*, std::pair<juce::Typeface::Ptr, std::map<int, juce::juce_wchar>>>;
        const auto typeface = getFont().getTypefacePtr();
        auto& [kept, letters] = known[typeface.get()];
        kept = typeface;
        if (letters.empty())
            for (juce::juce_wchar sign = 0x21; sign < 0x2300; ++sign)
                if (const auto its = glyphOf(sign)) letters.emplace(*its, sign);
        const auto found = letters.find(glyph);
        return found == letters.end() ? juce::juce_wchar{'_'} : found->second;
    }

    // Above and below, a page that scrolls cuts as well.
    void lookAtEdge(int glyph, juce::Point<float> at) {
        const auto edges = clip();
        if (at.y > edges.getBottom() || at.y - 0.5f * pixelsHigh() < edges.getY()) return;
        const auto inked = ink(glyph) + at;
        const bool isCutLeft = inked.getX() < edges.getX() - 1.0f;
        if (!isCutLeft && inked.getRight() <= edges.getRight() + 1.0f) return;
        isEdgeCut_ = true;
        edge_ = juce::Point{isCutLeft ? edges.getX() : edges.getRight(), at.y}.toInt();
    }

    void endRun() {
        if (run_.empty()) return;
        juce::String words;
        int dots = 0, most = 0;
        float narrowest = 1.0f;
        for (const auto& letter : run_) {
            words << letter.sign;
            dots = letter.sign == '.' ? dots + 1 : 0;
            most = std::max(most, dots);
            narrowest = std::min(narrowest, letter.width);
        }
        words_.add(words);
        const auto why = most >= 3                 ? "ends in dots"
                         : narrowest < leastNarrow ? "narrowed"
                         : isEdgeCut_              ? "cut by an edge"
                                                   : "";
        if (*why != 0) cut_.push_back({words, why, run_.front().at.toInt(), edge_});
        run_.clear();
        isEdgeCut_ = false;
    }

    static constexpr float leastNarrow = 0.85f; // narrower letters look crushed

    std::vector<Letter> run_;
    std::vector<CutText> cut_;
    bool isEdgeCut_ = false;
    juce::Point<int> edge_;
    juce::StringArray words_;
};

struct ReadTexts {
    std::vector<CutText> cut;
    juce::StringArray words; // without spaces, of all texts
};

inline ReadTexts readTexts(juce::Component& root) {
    const juce::Image image{juce::Image::RGB, root.getWidth(), root.getHeight(), true,
                            juce::SoftwareImageType{}};
    ReadingRenderer renderer{image};
    {
        juce::Graphics g{renderer};
        root.paintEntireComponent(g, true);
    }
    renderer.finish();
    return {renderer.cut(), renderer.words()};
}

} // namespace physvib::test
