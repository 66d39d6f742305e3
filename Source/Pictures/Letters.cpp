// SPDX-License-Identifier: MIT
// Text layout with unhinted FreeType faces, so that a text's width is the sum of its letters.
#include "Pictures/Letters.h"
#include "Io/Text/CleanText.h"
#include "Pictures/FreeType.h"
#include <array>
#include <cstdlib>
#include FT_OUTLINE_H

namespace physvib::picture {
namespace {

/// Plain and bold files of fonts: the first that is installed is used, the others for letters that it lacks.
constexpr std::array<std::array<const char*, 2>, 5> fontFiles{
    {{"DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
     {"LiberationSans-Regular.ttf", "LiberationSans-Bold.ttf"},
     {"NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
     {"NanumGothic.ttf", "NanumGothicBold.ttf"},
     {"NotoSansCJK-Regular.ttc", "NotoSansCJK-Bold.ttc"}}};

Point point(const FT_Vector& p) {
    return {static_cast<float>(p.x) / 64.0f, -static_cast<float>(p.y) / 64.0f};
}

const FT_Outline_Funcs intoPath{
    [](const FT_Vector* to, void* path) { return static_cast<Path*>(path)->startNewSubPath(point(*to)), 0; },
    [](const FT_Vector* to, void* path) { return static_cast<Path*>(path)->lineTo(point(*to)), 0; },
    [](const FT_Vector* control, const FT_Vector* to, void* path) {
        return static_cast<Path*>(path)->conicTo(point(*control), point(*to)), 0;
    },
    [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* path) {
        return static_cast<Path*>(path)->cubicTo(point(*first), point(*second), point(*to)), 0;
    },
    0,
    0};

} // namespace

std::vector<std::filesystem::path> fontFolders() {
    std::vector<std::filesystem::path> folders{"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts",
                                               "C:/Windows/Fonts"};
    if (const char* home = std::getenv("HOME"))
        folders.push_back(std::filesystem::path{home} / ".local/share/fonts");
    return folders;
}

struct Letters::Fonts {
    FreeType library;
    std::array<std::vector<FT_Face>, 2> faces; // plain, bold

    explicit Fonts(const std::vector<std::filesystem::path>& folders) {
        std::array<std::array<std::filesystem::path, 2>, fontFiles.size()> found;
        for (const auto& folder : folders) find(folder, found);
        for (const auto& font : found)
            for (std::size_t bold = 0; bold < 2; ++bold) {
                FT_Face face = nullptr;
                if (!font[bold].empty() && FT_New_Face(library, font[bold].string().c_str(), 0, &face) == 0)
                    faces[bold].push_back(face);
            }
    }
    ~Fonts() {
        for (const auto& group : faces)
            for (FT_Face face : group) FT_Done_Face(face);
    }

    static void find(const std::filesystem::path& folder,
                     std::array<std::array<std::filesystem::path, 2>, fontFiles.size()>& found) {
        std::error_code error;
        for (std::filesystem::recursive_directory_iterator file{folder, error}, end; !error && file != end;
             file.increment(error))
            for (std::size_t font = 0; font < fontFiles.size(); ++font)
                for (std::size_t bold = 0; bold < 2; ++bold)
                    if (found[font][bold].empty() && file->path().filename() == fontFiles[font][bold])
                        found[font][bold] = file->path();
    }

    const std::vector<FT_Face>& facesOf(bool bold) const { return faces[bold && !faces[1].empty()]; }

    /// Calls `visit(face, x)` for each letter, which is loaded then; returns where the line ends.
    template <class Visit>
    float forEachLetter(std::string_view text, float height, bool bold, Visit visit) const {
        float x = 0.0f;
        FT_Face lastFace = nullptr;
        FT_UInt lastGlyph = 0;
        while (!text.empty() && !facesOf(bold).empty()) {
            const auto letter = firstCharacter(text);
            text.remove_prefix(std::max<std::size_t>(letter.bytes, 1));
            FT_Face face = facesOf(bold).front();
            for (FT_Face candidate : facesOf(bold))
                if (FT_Get_Char_Index(candidate, letter.code) != 0) {
                    face = candidate;
                    break;
                }
            const FT_UInt glyph = FT_Get_Char_Index(face, letter.code);
            FT_Set_Char_Size(face, 0, std::lround(64.0f * emSize(face, height)), 72, 72);
            FT_Vector kerning{};
            if (face == lastFace) FT_Get_Kerning(face, lastGlyph, glyph, FT_KERNING_UNFITTED, &kerning);
            if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) continue;
            x += static_cast<float>(kerning.x) / 64.0f;
            visit(face, x);
            x += static_cast<float>(face->glyph->linearHoriAdvance) / 65536.0f;
            lastFace = face, lastGlyph = glyph;
        }
        return x;
    }

    static float emSize(FT_Face face, float height) {
        return height * static_cast<float>(face->units_per_EM) /
               static_cast<float>(std::max(face->ascender - face->descender, 1));
    }
};

Letters::Letters(const std::vector<std::filesystem::path>& folders)
    : fonts_{std::make_unique<Fonts>(folders)} {}

Letters::~Letters() = default;

bool Letters::empty() const noexcept { return fonts_->faces[0].empty() && fonts_->faces[1].empty(); }

float Letters::width(std::string_view text, float height, bool bold) const {
    return fonts_->forEachLetter(text, height, bold, [](FT_Face, float) {});
}

Path Letters::outline(std::string_view text, float height, bool bold) const {
    Path line;
    fonts_->forEachLetter(text, height, bold, [&](FT_Face face, float x) {
        Path letter;
        if (face->glyph->format == FT_GLYPH_FORMAT_OUTLINE)
            FT_Outline_Decompose(&face->glyph->outline, &intoPath, &letter);
        letter.move(Transform{}.translated(x, 0.0f));
        line.append(letter);
    });
    return line;
}

float Letters::ascent(float height, bool bold) const {
    if (empty() || fonts_->facesOf(bold).empty()) return height;
    const FT_Face face = fonts_->facesOf(bold).front();
    return height * static_cast<float>(face->ascender) /
           static_cast<float>(std::max(face->ascender - face->descender, 1));
}

} // namespace physvib::picture
