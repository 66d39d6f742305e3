// SPDX-License-Identifier: GPL-3.0-or-later
// Contrasts of all texts and controls of a component, measured in a picture of it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <juce_gui_basics/juce_gui_basics.h>
#include <map>
#include <optional>
#include <vector>

// Draws as JUCE does, and tells of each letter: JUCE 7 draws one at a time, 8 many, 9 hides its state.
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

/// As WCAG 2 has it: of 1 (none) to 21 (black on white).
inline double contrast(juce::Colour a, juce::Colour b) {
    const auto luminance = [](juce::Colour c) {
        const auto linear = [](float v) {
            return v <= 0.04045f ? v / 12.92 : std::pow((static_cast<double>(v) + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(c.getFloatRed()) + 0.7152 * linear(c.getFloatGreen()) +
               0.0722 * linear(c.getFloatBlue());
    };
    const double la = luminance(a), lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

using Pixels = std::vector<juce::Colour>;

inline Pixels pixelsOf(const juce::Image& image, juce::Rectangle<int> area) {
    area = area.getIntersection(image.getBounds());
    Pixels all;
    if (area.isEmpty()) return all;
    const juce::Image::BitmapData data{image, area.getX(), area.getY(), area.getWidth(), area.getHeight()};
    for (int y = 0; y < area.getHeight(); ++y)
        for (int x = 0; x < area.getWidth(); ++x) all.push_back(data.getPixelColour(x, y));
    return all;
}

inline std::map<juce::uint32, int> countsOf(const Pixels& pixels) {
    std::map<juce::uint32, int> counts;
    for (const auto pixel : pixels) ++counts[pixel.getARGB()];
    return counts;
}

inline juce::Colour commonest(const Pixels& pixels) {
    const auto counts = countsOf(pixels);
    return juce::Colour{std::ranges::max_element(counts, {}, [](const auto& c) { return c.second; })->first};
}

/// One run of letters on one ground.
struct DrawnText {
    juce::Rectangle<int> area; // in pixels of the picture
    juce::Colour ground, ink;
    double contrast = 0.0;
};

/// Draws as JUCE does, and measures each letter by what it changed in the picture.
class MeasuringRenderer final : public LetterRenderer {
public:
    explicit MeasuringRenderer(const juce::Image& image)
        : LetterRenderer{image}
        , image_{image} {}

    /// Those that nothing was drawn over since.
    std::vector<DrawnText> texts() const {
        std::vector<DrawnText> all;
        const Letter* last = nullptr;
        for (const Letter& letter : letters_) {
            const auto now = pixelsOf(image_, letter.cell);
            int same = 0;
            for (std::size_t i = 0; i < now.size(); ++i) same += now[i] == letter.after[i] ? 1 : 0;
            if (10 * same < 6 * static_cast<int>(now.size())) continue; // the next letter may overlap
            // thin letters do not reach the colour of their text
            const bool keepGoing = last != nullptr && last->baseline == letter.baseline &&
                                   last->ground == letter.ground && letter.cell.getX() >= last->cell.getX() &&
                                   letter.cell.getX() - last->cell.getX() < 2 * letter.cell.getWidth();
            if (!keepGoing) all.push_back({letter.cell, letter.ground, letter.ink, letter.contrast});
            auto& text = all.back();
            text.area = text.area.getUnion(letter.cell);
            if (letter.contrast > text.contrast) text.contrast = letter.contrast, text.ink = letter.ink;
            last = &letter;
        }
        return all;
    }

private:
    void draw(int glyph, const juce::AffineTransform& at, const std::function<void()>& drawn) override {
        const float high = pixelsHigh();
        const auto cell =
            juce::Rectangle<float>{at.getTranslationX(), at.getTranslationY() - high, high, 1.3f * high}
                .getSmallestIntegerContainer()
                .getIntersection(image_.getBounds());
        const auto before = pixelsOf(image_, cell);
        drawn();
        const auto after = pixelsOf(image_, cell);
        Pixels under;
        double most = 0.0;
        juce::Colour ink;
        const auto middle =
            (this->ink(glyph) + juce::Point{at.getTranslationX(), at.getTranslationY()}).getCentre();
        if (after == before && !this->ink(glyph).isEmpty() && clip().contains(middle))
            under = before, most = 1.0, ink = commonest(before); // as its ground
        for (std::size_t i = 0; i < after.size(); ++i)
            if (after[i] != before[i]) {
                under.push_back(before[i]);
                if (const double c = contrast(after[i], before[i]); c > most) most = c, ink = after[i];
            }
        // a space, or a letter that a scrolled page cuts
        const float base = std::floor(at.getTranslationY());
        if (under.empty() || clip().getBottom() < base || clip().getY() > base - std::floor(0.7f * high))
            return;
        letters_.push_back({cell, after, commonest(under), ink, most, at.getTranslationY()});
    }

    struct Letter {
        juce::Rectangle<int> cell;
        Pixels after;
        juce::Colour ground, ink;
        double contrast;
        float baseline;
    };
    juce::Image image_;
    std::vector<Letter> letters_;
};

struct Picture {
    juce::Image image;
    std::vector<DrawnText> texts;
};

inline Picture pictureOf(juce::Component& root, float scale) {
    juce::Image image{juce::Image::RGB, juce::roundToInt(scale * static_cast<float>(root.getWidth())),
                      juce::roundToInt(scale * static_cast<float>(root.getHeight())), true,
                      juce::SoftwareImageType{}};
    MeasuringRenderer renderer{image};
    {
        juce::Graphics g{renderer};
        g.addTransform(juce::AffineTransform::scale(scale));
        root.paintEntireComponent(g, true);
    }
    return {image, renderer.texts()};
}

/// The most that colours of a control, 12 pixels at least of each, differ from what surrounds it.
inline double contrastOfControl(const juce::Image& image, juce::Rectangle<int> area) {
    const auto outside = area.expanded(4).getIntersection(image.getBounds());
    auto ring = pixelsOf(image, outside.withHeight(3));
    for (const auto& side : {outside.withTop(outside.getBottom() - 3), outside.withWidth(3),
                             outside.withLeft(outside.getRight() - 3)})
        std::ranges::copy(pixelsOf(image, side), std::back_inserter(ring));
    const auto ground = commonest(ring);
    double most = 1.0;
    for (const auto& [argb, count] : countsOf(pixelsOf(image, area)))
        if (count >= 12) most = std::max(most, contrast(juce::Colour{argb}, ground));
    return most;
}

} // namespace physvib::test
