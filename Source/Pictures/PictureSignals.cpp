// SPDX-License-Identifier: MIT
// Draws the signal panels: all channels over time, and a close-up of the strongest impact.
#include "Pictures/PictureParts.h"
#include <algorithm>
#include <numeric>

namespace physvib::picture {
namespace {

constexpr std::size_t mostZoomLanes = 8;

std::vector<int> everyChannel(const WaveformEnvelope& wave) {
    std::vector<int> channels(static_cast<std::size_t>(wave.channels()));
    std::iota(channels.begin(), channels.end(), 0);
    return channels;
}

std::vector<int> loudestChannels(const WaveformEnvelope& wave) {
    auto channels = everyChannel(wave);
    std::ranges::stable_sort(channels, std::greater{}, [&](int c) { return wave.peak(c); });
    channels.resize(std::min(channels.size(), mostZoomLanes));
    std::ranges::sort(channels);
    return channels;
}

void drawChannels(const Canvas& canvas, const PictureInput& input, const std::vector<double>& grid,
                  Area area) {
    const auto heading = area.removeFromTop(headingHeight);
    area.removeFromTop(6);
    if (input.waveform == nullptr) return canvas.heading("CHANNELS", "no sound", heading);
    canvas.heading("CHANNELS", fullHeight(*input.waveform), heading);
    drawLanes(canvas, input, *input.waveform, everyChannel(*input.waveform),
              {0.0, input.durationSeconds, laneOf(canvas, input, area)}, grid);
}

} // namespace

void drawZoom(const Canvas& canvas, const PictureInput& input, Area panel) {
    canvas.panel(panel);
    panel = panel.reduced(20, 12);
    const auto heading = panel.removeFromTop(headingHeight);
    const auto strongest = strongestEvent(input.events);
    if (strongest < 0 || input.zoom == nullptr) {
        canvas.heading("STRONGEST HIT", {}, heading);
        return canvas.text("no hit", panel, Align::centre, palette::muted, mediumText);
    }
    const auto& zoom = *input.zoom;
    const auto shown = loudestChannels(zoom);
    const auto part = zoom.channels() > static_cast<int>(shown.size())
                          ? ", 8 LOUDEST OF " + std::to_string(zoom.channels()) + " CHANNELS"
                          : std::string();
    canvas.heading("STRONGEST HIT, 100 MS" + part, fullHeight(zoom), heading);
    const auto axisRow = panel.removeFromBottom(axisHeight);
    const double rate = input.sampleRateHz;
    const double onset = static_cast<double>(input.events[static_cast<std::size_t>(strongest)].timeNs) * 1e-9;
    const double from = static_cast<double>(zoom.firstFrame()) / rate - onset;
    const Axis axis{1e3 * from, 1e3 * (from + static_cast<double>(zoom.frameCount()) / rate),
                    laneOf(canvas, input, panel.withTrimmedTop(6))};
    const auto grid = ticks(axis.from, axis.to, 10);
    drawLanes(canvas, input, zoom, shown, axis, grid);
    axis.drawGrid(canvas, {0.0}, palette::now.withAlpha(0.6f));
    axis.drawLabels(canvas, grid, "ms", axisRow);
}

void drawSignals(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel) {
    canvas.panel(panel);
    panel = panel.reduced(20, 12);
    const int channels = input.waveform != nullptr ? input.waveform->channels() : 0;
    const auto grid = ticks(0.0, input.durationSeconds, 12);
    drawChannels(canvas, input, grid, panel.removeFromTop(headingHeight + 6 + lanesHeight(channels)));
    panel.removeFromTop(8);
    auto heading = panel.removeFromTop(headingHeight);
    panel.removeFromTop(6);
    const auto axisRow = panel.removeFromBottom(axisHeight);
    const Axis hits{0.0, input.durationSeconds, laneOf(canvas, input, panel)};
    canvas.heading("HITS", {}, heading);
    heading = heading.withLeft(hits.lane.x);
    const auto meaning = std::string("height: amplitude in dBFS, colour: ") + colours.meaning();
    canvas.text(meaning, heading.removeFromLeft(canvas.textWidth(meaning, smallText) + 24), Align::left,
                palette::muted);
    drawLegend(canvas, colours, heading);
    canvas.well(hits.lane);
    hits.drawGrid(canvas, grid, palette::line);
    drawHits(canvas, input, colours, hits);
    hits.drawLabels(canvas, grid, "s", axisRow);
}

} // namespace physvib::picture
