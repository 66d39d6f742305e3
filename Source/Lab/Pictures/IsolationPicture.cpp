// SPDX-License-Identifier: MIT
// Gamma over the frequency: a panel per axis, a curve per layer.
#include "Lab/Pictures/StudyPage.h"
#include <algorithm>
#include <map>

namespace physvib {
namespace {

using namespace picture;

struct Sum {
    double sum = 0.0;
    int count = 0;
};
using Curve = std::map<double, Sum>; // over voltages, by frequency
using Curves = std::map<std::string, Curve>;

void drawCurves(const Canvas& canvas, Area inside, const std::string& axis, const Curves& curves,
                const std::map<std::string, int>& colours) {
    canvas.heading("axis " + cleanLine(axis), "gamma (Eq. 3.2), mean of voltages and repetitions",
                   inside.removeFromTop(28));
    double leastHz = 1e9, mostHz = 0.0, most = 1.0, least = 0.0;
    for (const auto& [layer, curve] : curves)
        for (const auto& [hz, gamma] : curve) {
            leastHz = std::min(leastHz, hz), mostHz = std::max(mostHz, hz);
            most = std::max(most, gamma.sum / gamma.count), least = std::min(least, gamma.sum / gamma.count);
        }
    Area legend = inside.removeFromBottom(22 * static_cast<int>(curves.size())),
         labels = inside.removeFromBottom(28);
    Area scale = inside.removeFromLeft(48);
    const Axis hzAxis{leastHz, std::max(mostHz, leastHz + 1.0), inside};
    hzAxis.drawGrid(canvas, ticks(leastHz, mostHz, 8), palette::line);
    hzAxis.drawLabels(canvas, ticks(leastHz, mostHz, 8), "Hz", labels);
    const auto y = [&](double gamma) {
        return static_cast<float>(inside.bottom() - (gamma - least) / (most - least) * inside.height);
    };
    for (const double tick : ticks(least, most, 6)) {
        canvas.graphics.setColour(palette::line);
        canvas.graphics.fillRect(
            {static_cast<float>(inside.x), std::round(y(tick)), static_cast<float>(inside.width), 1.0f});
        canvas.text(shortNumber(tick),
                    scale.withY(roundToInt(y(tick)) - 10).withHeight(20).withTrimmedRight(8), Align::right,
                    palette::muted);
    }
    for (const auto& [layer, curve] : curves) {
        const auto colour = palette::enchanter(colours.at(layer));
        Path path;
        canvas.graphics.setColour(colour);
        for (const auto& [hz, gamma] : curve) {
            const Spot at{hzAxis.x(hz), y(gamma.sum / gamma.count)};
            if (path.empty())
                path.startNewSubPath(at);
            else
                path.lineTo(at);
            canvas.graphics.fillEllipse(boxAround(at, 8.0f, 8.0f));
        }
        canvas.graphics.strokePath(path, 2.5f);
        canvas.text(cleanLine(layer), legend.removeFromTop(22), Align::left, colour);
    }
}

} // namespace

std::string isolationPicture(std::span<const IsolationResult> results, const PictureWords& words) {
    std::map<std::string, Curves> axes;
    std::map<std::string, int> colours;
    for (const IsolationResult& r : results) {
        const auto& c = r.condition;
        const std::string layer = c.material + (c.thickness.empty() ? "" : ", " + c.thickness + " mm");
        colours.try_emplace(layer, static_cast<int>(colours.size()));
        Sum& sum = axes[c.axis][layer][c.frequencyHz];
        sum.sum += r.mean;
        ++sum.count;
    }
    StudyPage page{"Isolation",
                   "how much a layer holds back",
                   axes.size(),
                   2,
                   420 + 22 * static_cast<int>(colours.size()),
                   {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        const auto at = std::next(axes.begin(), static_cast<std::ptrdiff_t>(i));
        drawCurves(canvas, inside, at->first, at->second, colours);
    };
    return studyPagePng(page, words);
}

} // namespace physvib
