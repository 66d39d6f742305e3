// SPDX-License-Identifier: GPL-3.0-or-later
// Draws as JUCE does, and tells of each letter: JUCE 7 draws one at a time, 8 many, 9 hides its state.
#pragma once
#include <array>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>
#include <vector>

namespace physvib::test {

class LetterRenderer : public juce::LowLevelGraphicsSoftwareRenderer {
    using Base = juce::LowLevelGraphicsSoftwareRenderer;

public:
    using Base::Base;

    void setOrigin(juce::Point<int> origin) override {
        Base::setOrigin(origin);
        place() = juce::AffineTransform::translation(origin.toFloat()).followedBy(place());
    }
    void addTransform(const juce::AffineTransform& t) override {
        Base::addTransform(t);
        place() = t.followedBy(place());
    }
    void saveState() override {
        Base::saveState();
        places_.push_back(place());
    }
    void restoreState() override {
        Base::restoreState();
        places_.pop_back();
    }
#if JUCE_MAJOR_VERSION >= 8
    void drawGlyphs(juce::Span<const uint16_t> glyphs, juce::Span<const juce::Point<float>> points,
                    const juce::AffineTransform& t) override {
        for (std::size_t i = 0; i < glyphs.size(); ++i) {
            const std::array glyph{glyphs[i]};
            const std::array point{points[i]};
            draw(glyphs[i], juce::AffineTransform::translation(points[i]).followedBy(t).followedBy(place()),
                 [&] { Base::drawGlyphs(glyph, point, t); });
        }
    }
#else
    void drawGlyph(int glyph, const juce::AffineTransform& t) override {
        draw(glyph, t.followedBy(place()), [&] { Base::drawGlyph(glyph, t); });
    }
#endif

protected:
    /// `at`, as clip(), is in pixels of the picture; the letter appears if `drawn` is called.
    virtual void draw(int glyph, const juce::AffineTransform& at, const std::function<void()>& drawn) = 0;

    juce::Rectangle<float> clip() const { return getClipBounds().toFloat().transformedBy(places_.back()); }
    float pixelsHigh() { return getFont().getHeight() * getPhysicalPixelScaleFactor(); }

    std::optional<int> glyphOf(juce::juce_wchar sign) {
#if JUCE_MAJOR_VERSION >= 8
        const auto glyph = getFont().getTypefacePtr()->getNominalGlyphForCodepoint(sign);
        return glyph ? std::optional{static_cast<int>(*glyph)} : std::nullopt;
#else
        juce::Array<int> glyphs;
        juce::Array<float> offsets;
        getFont().getGlyphPositions(juce::String::charToString(sign), glyphs, offsets);
        return glyphs.size() == 1 ? std::optional{glyphs[0]} : std::nullopt;
#endif
    }

    /// Where a glyph has ink, from where it begins, in pixels of the picture.
    juce::Rectangle<float> ink(int glyph) {
        juce::Path outline;
#if JUCE_MAJOR_VERSION >= 9
        getFont().getTypefacePtr()->getOutlineForGlyph(glyph, outline);
        const float unit = pixelsHigh() * getFont().getHeightInPoints() / getFont().getHeight();
#elif JUCE_MAJOR_VERSION == 8
        getFont().getTypefacePtr()->getOutlineForGlyph(getFont().getMetricsKind(), glyph, outline);
        const float unit = pixelsHigh();
#else
        getFont().getTypefacePtr()->getOutlineForGlyph(glyph, outline);
        const float unit = pixelsHigh();
#endif
        return outline.getBounds().transformedBy(
            juce::AffineTransform::scale(unit * getFont().getHorizontalScale(), unit));
    }

private:
    juce::AffineTransform& place() { return places_.back(); }
    std::vector<juce::AffineTransform> places_{juce::AffineTransform{}};
};

} // namespace physvib::test
