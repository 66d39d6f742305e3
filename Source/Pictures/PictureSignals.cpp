// SPDX-License-Identifier: MIT
// Draws the signal panels: all channels over time, and a close-up of the strongest impact.
#include "Core/EnchanterLayout.h"
#include "Pictures/PictureParts.h"
#include <algorithm>
#include <cmath>
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

namespace {

constexpr int mostWaves = 16; // above, a lane is too low for a waveform and becomes a strip of brightness
constexpr double stripFloorDecibels = -60.0; // of the loudest

// The filled outline between the highest and lowest samples, at least a line thick and without gaps.
void drawWave(const Canvas& canvas, const WaveformEnvelope& wave, int channel, Area lane) {
    const float scale = wave.peak();
    const auto middle = static_cast<float>(lane.y) + 0.5f * static_cast<float>(lane.height);
    const float gain = scale > 0.0f ? (0.5f * static_cast<float>(lane.height) - 1.0f) / scale : 0.0f;
    const float step = static_cast<float>(lane.width) / WaveformEnvelope::columns;
    std::vector<Spot> below;
    Path outline;
    SampleRange before = wave.column(channel, 0);
    for (int i = 0; i < WaveformEnvelope::columns; ++i) {
        const auto now = wave.column(channel, i);
        const float high = std::max(now.highest, before.lowest), low = std::min(now.lowest, before.highest);
        const float x = static_cast<float>(lane.x) + (static_cast<float>(i) + 0.5f) * step;
        const Spot top{x, middle - gain * high - 0.4f};
        below.push_back({x, middle - gain * low + 0.4f});
        i == 0 ? outline.startNewSubPath(top) : outline.lineTo(top);
        before = now;
    }
    for (auto point = below.rbegin(); point != below.rend(); ++point) outline.lineTo(*point);
    outline.closeSubPath();
    canvas.graphics.setColour(palette::enchanter(channel));
    canvas.graphics.fillPath(outline);
    // The line keeps steep slopes as visible as flat ones.
    canvas.graphics.strokePath(outline, 0.8f);
}

// Rows `from` to `to` of `count` that share the height without gaps.
Area part(Area whole, int from, int to, int count) {
    const int top = whole.height * from / count, bottom = whole.height * to / count;
    return whole.withY(whole.y + top).withHeight(bottom - top);
}

void drawStrip(const Canvas& canvas, const WaveformEnvelope& wave, int channel, Area lane) {
    const float step = static_cast<float>(lane.width) / WaveformEnvelope::columns;
    if (wave.peak() == 0.0f) return;
    for (int i = 0; i < WaveformEnvelope::columns; ++i) {
        const auto range = wave.column(channel, i);
        const double level =
            decibels(std::max(std::abs(range.lowest), std::abs(range.highest)) / wave.peak());
        const auto alpha = static_cast<float>(std::pow(std::max(0.0, 1.0 - level / stripFloorDecibels), 1.5));
        canvas.graphics.setColour(palette::enchanter(channel).withAlpha(std::min(alpha, 1.0f)));
        canvas.graphics.fillRect({static_cast<float>(lane.x) + static_cast<float>(i) * step,
                                  static_cast<float>(lane.y), step, static_cast<float>(lane.height)});
    }
}

void drawLabelAndPeak(const Canvas& canvas, std::string_view label, Colour colour, bool bold, float peak,
                      Area panelRow, Area lane) {
    const Area row = panelRow.withSizeKeepingCentre(panelRow.width, std::max(panelRow.height, 18));
    canvas.text(label, row.withRight(lane.x - 8), Align::left, colour, smallText, bold);
    canvas.text(decibelText(peak), row.withLeft(lane.right()), Align::right,
                peak > 1.0f ? palette::limit : palette::muted);
}

Area besides(const Canvas& canvas, const PictureInput& input, Area lane) {
    return {lane.x - laneOf(canvas, input, {}).x, lane.y,
            laneOf(canvas, input, {}).x + lane.width + peakWidth, lane.height};
}

void drawWaves(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid) {
    const int count = static_cast<int>(channels.size());
    for (int i = 0; i < count; ++i) {
        const int channel = channels[static_cast<std::size_t>(i)];
        const Area row = part(axis.lane, i, i + 1, count);
        const Area lane = row.reduced(0, row.height >= 20 ? 2 : 1);
        canvas.well(lane);
        Axis{axis.from, axis.to, lane}.drawGrid(canvas, grid, palette::line);
        drawWave(canvas, wave, channel, lane);
        drawLabelAndPeak(canvas, laneLabelOf(input, channel), palette::enchanter(channel), true,
                         wave.peak(channel), besides(canvas, input, row), lane);
    }
}

// A label and the peak of its group stand where there is room for a line of text.
void drawStrips(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
                const std::vector<int>& channels, const Axis& axis) {
    const int count = static_cast<int>(channels.size());
    const int group = (count * 18 + axis.lane.height - 1) / axis.lane.height;
    canvas.well(axis.lane);
    for (int i = 0; i < count; ++i)
        drawStrip(canvas, wave, channels[static_cast<std::size_t>(i)],
                  part(axis.lane, i, i + 1, count).withTrimmedBottom(1));
    for (int i = 0; i < count; i += group) {
        const int end = std::min(i + group, count);
        float peak = 0.0f;
        for (int k = i; k < end; ++k) peak = std::max(peak, wave.peak(channels[static_cast<std::size_t>(k)]));
        const auto first = labelOf(input, channels[static_cast<std::size_t>(i)]);
        const auto last = labelOf(input, channels[static_cast<std::size_t>(end) - 1]);
        drawLabelAndPeak(canvas, end - i > 1 ? first + "\xe2\x80\x93" + last : first, palette::muted, false,
                         peak, besides(canvas, input, part(axis.lane, i, end, count)), axis.lane);
    }
}

} // namespace

void drawLanes(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid) {
    if (static_cast<int>(channels.size()) <= mostWaves)
        return drawWaves(canvas, input, wave, channels, axis, grid);
    drawStrips(canvas, input, wave, channels, axis);
}

std::string fullHeight(const WaveformEnvelope& wave) {
    if (wave.peak() == 0.0f) return "silence";
    return "full height \xc2\xb1" + number(wave.peak(), 3) + " = " + decibelText(wave.peak());
}

std::string labelOf(const PictureInput& input, int channel) {
    const auto index = static_cast<std::size_t>(channel);
    if (index < input.labels.size()) return cleanLine(input.labels[index]);
    return input.layout.count <= 26 ? std::string(1, static_cast<char>('A' + channel))
                                    : std::to_string(channel + 1);
}

std::string_view builtInPart(PartNumber part) noexcept {
    const auto found = std::ranges::find(bodyParts, part, partNamed);
    return found == bodyParts.end() ? std::string_view{} : *found;
}

std::string laneLabelOf(const PictureInput& input, int channel) {
    const std::string label = labelOf(input, channel);
    const auto part = builtInPart(input.layout.places[static_cast<std::size_t>(channel)].part);
    return part.empty() || part == label ? label : label + " " + std::string{part};
}

Area laneOf(const Canvas& canvas, const PictureInput& input, Area row) {
    int widest = 38;
    for (int c = 0; c < input.layout.count; ++c)
        widest = std::max(widest, canvas.textWidth(laneLabelOf(input, c), smallText, true));
    return row.withTrimmedLeft(std::min(widest, 130) + 14).withTrimmedRight(peakWidth);
}

int lanesHeight(int channels) noexcept {
    return channels <= 1 ? 100 : channels == 2 ? 140 : channels <= 8 ? 196 : 256;
}

} // namespace physvib::picture
