// SPDX-License-Identifier: GPL-3.0-or-later
// Finds texts that a component cuts or crushes: JUCE ends a text that has no room with three dots, narrows
// its letters, or lets the component's edge cut them.
#pragma once
#include <cmath>
#include <juce_gui_basics/juce_gui_basics.h>
#include <map>
#include <vector>

namespace physvib::test {

struct CutText {
    juce::String words, why;
    juce::Point<int> at, edge; // in pixels of the root; which edge cuts
};

/// Reads what is drawn; the letters themselves do not appear.
class ReadingRenderer final : public juce::LowLevelGraphicsSoftwareRenderer {
public:
    explicit ReadingRenderer(const juce::Image& image, float scale)
        : juce::LowLevelGraphicsSoftwareRenderer{image}
        , scale_{scale} {}

    void drawGlyph(int glyph, const juce::AffineTransform& t) override {
        if (!stack->clip) return;
        const auto at = stack->transform.getTransformWith(t);
        const auto& font = stack->font;
        const Letter letter{letterOf(glyph),
                            {at.getTranslationX() / scale_, at.getTranslationY() / scale_},
                            font.getHeight(),
                            font.getHorizontalScale()};
        const bool keepGoing = !run_.empty() && std::abs(run_.back().at.y - letter.at.y) < 0.5f &&
                               letter.at.x > run_.back().at.x &&
                               letter.at.x - run_.back().at.x < 1.6f * letter.height;
        if (!keepGoing) endRun();
        run_.push_back(letter);
        lookAtEdge(glyph, at);
    }

    void finish() { endRun(); }
    const std::vector<CutText>& cut() const { return cut_; }
    const juce::StringArray& words() const { return words_; }

private:
    struct Letter {
        juce::juce_wchar sign;
        juce::Point<float> at;
        float height, width;
    };

    juce::juce_wchar letterOf(int glyph) {
        // read once in a process: thousands of signs; the typeface is kept, so that no other has its address
        static auto& known =
            *new std::map<const void*, std::pair<juce::Typeface::Ptr, std::map<int, juce::juce_wchar>>>;
        const auto typeface = stack->font.getTypefacePtr();
        auto& [kept, letters] = known[typeface.get()];
        kept = typeface;
        if (letters.empty())
            for (juce::juce_wchar sign = 0x21; sign < 0x2300; ++sign) {
                juce::Array<int> glyphs;
                juce::Array<float> offsets;
                stack->font.getGlyphPositions(juce::String::charToString(sign), glyphs, offsets);
                if (glyphs.size() == 1) letters.emplace(glyphs[0], sign);
            }
        const auto found = letters.find(glyph);
        return found == letters.end() ? juce::juce_wchar{'_'} : found->second;
    }

    // Above and below, a page that scrolls cuts as well.
    void lookAtEdge(int glyph, const juce::AffineTransform& at) {
        const auto typeface = stack->font.getTypefacePtr();
        juce::Path outline;
        typeface->getOutlineForGlyph(glyph, outline);
        const float high = stack->font.getHeight() * stack->transform.getPhysicalPixelScaleFactor();
        const auto ink = outline.getBounds() * high;
        const auto clip = stack->clip->getClipBounds().toFloat();
        if (at.getTranslationY() > clip.getBottom() || at.getTranslationY() - 0.5f * high < clip.getY())
            return;
        const float left = at.getTranslationX() + ink.getX() * stack->font.getHorizontalScale(),
                    right = at.getTranslationX() + ink.getRight() * stack->font.getHorizontalScale();
        const bool isCutLeft = left < clip.getX() - scale_;
        if (!isCutLeft && right <= clip.getRight() + scale_) return;
        isEdgeCut_ = true;
        edge_ =
            (juce::Point{isCutLeft ? clip.getX() : clip.getRight(), at.getTranslationY()} / scale_).toInt();
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

    const float scale_;
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

inline ReadTexts readTexts(juce::Component& root, float scale) {
    const juce::Image image{juce::Image::RGB, juce::roundToInt(scale * static_cast<float>(root.getWidth())),
                            juce::roundToInt(scale * static_cast<float>(root.getHeight())), true,
                            juce::SoftwareImageType{}};
    ReadingRenderer renderer{image, scale};
    {
        juce::Graphics g{renderer};
        g.addTransform(juce::AffineTransform::scale(scale));
        root.paintEntireComponent(g, true);
    }
    renderer.finish();
    return {renderer.cut(), renderer.words()};
}

} // namespace physvib::test
