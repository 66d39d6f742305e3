// SPDX-License-Identifier: MIT
// Panels on a page as high as they need.
#include "Lab/Pictures/StudyPage.h"
#include <algorithm>
#include <cmath>

namespace physvib::picture {
namespace {

constexpr int width = 1600, margin = 24, gap = 14, headerHeight = 84, footerHeight = 42, padding = 20;

void drawWatermark(const Canvas& canvas, Area page) {
    constexpr float size = 150.0f;
    Painter& g = canvas.graphics;
    for (int y = page.y + 260; y < page.bottom() - 100; y += 420) {
        const Painter::Saved state(g);
        g.addTransform(
            Transform::rotation(-0.25f, static_cast<float>(page.centre().x), static_cast<float>(y)));
        canvas.text("SIMULATED", Area(page.x, y - 100, page.width, 200), Align::centre,
                    palette::text.withAlpha(0.13f), size, true);
    }
}

} // namespace

std::string studyPagePng(const StudyPage& page, const PictureWords& words) {
    const int across = static_cast<int>(std::min(page.acrossMost, page.count));
    const int rows = (static_cast<int>(page.count) + across - 1) / across;
    const int height = headerHeight + rows * (page.panelHeight + gap) + footerHeight;
    Image image(width, height);
    Painter graphics(image);
    graphics.fillAll(palette::ground);
    const Letters letters;
    const Canvas canvas{graphics, letters};
    Area header(margin, 16, width - 2 * margin, 60);
    const std::string mark = words.isSimulated ? "simulated observer, no person" : "";
    canvas.text(mark, header.withHeight(22), Align::right, palette::now, mediumText, true);
    canvas.text(cleanLine(page.title), header.removeFromTop(36), Align::left, palette::text, largeText, true);
    canvas.text(page.subtitle, header, Align::left, palette::muted);
    const int panelWidth = (width - 2 * margin - (across - 1) * gap) / across;
    for (int i = 0; i < static_cast<int>(page.count); ++i) {
        const Area panel(margin + i % across * (panelWidth + gap),
                         headerHeight + i / across * (page.panelHeight + gap), panelWidth, page.panelHeight);
        canvas.panel(panel);
        page.draw(canvas, static_cast<std::size_t>(i), panel.reduced(padding, 12));
    }
    if (words.isSimulated) drawWatermark(canvas, Area(0, headerHeight - 60, width, height - headerHeight));
    Area footer(margin, height - footerHeight, width - 2 * margin, footerHeight - 6);
    canvas.text(cleanLine(words.source), footer.removeFromLeft(footer.width * 3 / 5), Align::left,
                palette::text);
    canvas.text(cleanLine(words.provenance), footer, Align::right, palette::muted);
    return image.png();
}

Colour shareColour(double share) {
    if (share <= 0.0) return palette::well;
    const auto level = static_cast<float>(0.12 + 0.88 * std::sqrt(share)); // a single wrong answer in a
                                                                           // hundred is visible
    return palette::well.mixedWith(palette::enchanter(0), std::min(level, 1.0f));
}

void drawBar(const Canvas& canvas, Area row, int nameWidth, std::string_view name, double share, double least,
             double most, std::string_view value, Colour colour, double from) {
    canvas.text(name, row.removeFromLeft(nameWidth).withTrimmedRight(12), Align::right, palette::text);
    canvas.text(value, row.removeFromRight(76), Align::right, palette::text);
    const Area lane = row.reduced(0, 2).withTrimmedRight(8);
    canvas.well(lane);
    const auto x = [&](double at) { return static_cast<float>(lane.x + at * lane.width); };
    const auto top = static_cast<float>(lane.y), height = static_cast<float>(lane.height);
    canvas.graphics.setColour(colour.withMultipliedAlpha(0.85f));
    const auto [left, right] = std::minmax({x(from), x(share)}); // by value
    canvas.graphics.fillRounded({left, top, right - left, height}, 3.0f);
    if (!(most > least)) return;
    canvas.graphics.setColour(palette::text);
    canvas.graphics.fillRect({x(least), top + 0.5f * height - 1.0f, x(most) - x(least), 2.0f});
    for (const double end : {least, most})
        canvas.graphics.fillRect({x(end) - 1.0f, top + 0.25f * height, 2.0f, 0.5f * height});
}

} // namespace physvib::picture
