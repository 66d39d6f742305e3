// SPDX-License-Identifier: GPL-3.0-or-later
// Finds typefaces that have letters. Before JUCE 8, a missing letter has the outline of a non-character.
#include "Mixer/Widgets/Typefaces.h"
#include "Host/Views/Look.h"
#include <array>
#include <set>

namespace physvib {
namespace {

constexpr std::array preferredTypefaces{"NanumGothic", "Noto Sans CJK KR", "Noto Sans CJK SC",
                                        "UnDotum"}; // typefaces known to be legible

#if JUCE_MAJOR_VERSION >= 8
auto makeLetterTest(juce::Typeface& typeface) {
    return [&](juce::juce_wchar letter) { return typeface.getNominalGlyphForCodepoint(letter).has_value(); };
}
#else
constexpr juce::juce_wchar nonCharacter = 0xfffe; // a non-character of Unicode

juce::String letterOutline(juce::Typeface& typeface, juce::juce_wchar letter) {
    juce::Array<int> glyphs;
    juce::Array<float> places;
    juce::Path path;
    typeface.getGlyphPositions(juce::String::charToString(letter), glyphs, places);
    for (const int glyph : glyphs) typeface.getOutlineForGlyph(glyph, path);
    return path.toString();
}

auto makeLetterTest(juce::Typeface& typeface) {
    return [&, box = letterOutline(typeface, nonCharacter)](juce::juce_wchar letter) {
        return letterOutline(typeface, letter) != box;
    };
}
#endif

/// The typeface in use for all text; empty: the default.
juce::String& currentTypeface() {
    static juce::String name;
    return name;
}

juce::String findLetters(const Translation& words) {
    std::set<juce::juce_wchar> letters;
    for (const auto& [english, text] : words.texts)
        for (const auto letter : juce::String::fromUTF8(text.c_str()))
            if (letter > 0x7f) letters.insert(letter);
    juce::String all;
    for (const auto letter : letters) all += letter;
    return all;
}

} // namespace

bool hasLetters(const juce::String& typeface, const juce::String& letters) {
    auto font = text::font(text::large);
    if (typeface.isNotEmpty()) font.setTypefaceName(typeface);
    const auto face = font.getTypefacePtr();
    if (face == nullptr) return false;
    const auto hasLetter = makeLetterTest(*face);
    for (const auto letter : letters)
        if (!hasLetter(letter)) return false;
    return true;
}

std::optional<juce::String> typefaceFor(const Translation& words) { return typefaceFor(findLetters(words)); }

std::optional<juce::String> typefaceFor(const juce::String& letters) {
    if (hasLetters({}, letters)) return juce::String{};
    const auto installed = juce::Font::findAllTypefaceNames();
    juce::StringArray names;
    for (const char* name : preferredTypefaces)
        if (installed.contains(name)) names.add(name);
    names.addArray(installed);
    for (const auto& name : names)
        if (hasLetters(name, letters)) return name;
    return {};
}

TypefaceOverride::TypefaceOverride(const juce::String& typeface)
    : previous_{currentTypeface()} {
    apply(typeface);
}

void TypefaceOverride::apply(const juce::String& typeface) {
    currentTypeface() = typeface;
    juce::LookAndFeel::getDefaultLookAndFeel().setDefaultSansSerifTypefaceName(typeface);
    juce::Typeface::clearTypefaceCache();
}

bool DisplayTypeface::ensureLetters(const juce::String& shownText) {
    juce::String extra;
    for (const auto letter : shownText)
        if (letter > 0x7f && !letters_.containsChar(letter) && !extra.containsChar(letter)) extra += letter;
    if (extra.isEmpty()) return false;
    letters_ += extra;
    if (hasLetters({}, extra)) return false;
    const auto typeface = typefaceFor(letters_);
    if (!typeface) return false; // not installed: JUCE draws boxes
    font_.reset();               // only one may exist
    font_ = std::make_unique<TypefaceOverride>(*typeface);
    return true;
}

} // namespace physvib
