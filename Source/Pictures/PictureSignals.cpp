// SPDX-License-Identifier: MIT
// Draws the signal panels: all channels over time, and a close-up of the strongest impact.
#include "Core/EnchanterLayout.h"
#include "Pictures/PictureParts.h"
#include "Scene/World/BodyLists.h"
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <span>

namespace physvib::picture {
namespace {

constexpr std::size_t maxZoomLanes = 8;

std::vector<int> loudestChannels(const WaveformEnvelope& wave) {
    auto channels = allChannels(wave);
    std::ranges::stable_sort(channels, std::greater{}, [&](int c) { return wave.peak(c); });
    channels.resize(std::min(channels.size(), maxZoomLanes));
    std::ranges::sort(channels);
    return channels;
}

void drawChannels(const Canvas& canvas, const PictureInput& input, const std::vector<double>& grid,
                  Area area) {
    const auto heading = area.removeFromTop(headingHeight);
    area.removeFromTop(6);
    if (input.waveform == nullptr) return canvas.heading("CHANNELS", "no sound", heading);
    canvas.heading("CHANNELS", fullScaleText(*input.waveform), heading);
    drawLanes(canvas, input, *input.waveform, allChannels(*input.waveform),
              {0.0, input.durationSeconds, laneArea(canvas, input, area)}, grid);
}

} // namespace

void drawZoom(const Canvas& canvas, const PictureInput& input, Area panel) {
    canvas.panel(panel);
    panel = panel.reduced(20, 12);
    const auto heading = panel.removeFromTop(headingHeight);
    const auto* const strongest = strongestEvent(input.events);
    if (!strongest || input.zoom == nullptr) {
        canvas.heading("STRONGEST HIT", {}, heading);
        return canvas.text("no hit", panel, Align::centre, palette::muted, mediumText);
    }
    const auto& zoom = *input.zoom;
    const auto shown = loudestChannels(zoom);
    const auto part = zoom.channels() > static_cast<int>(shown.size())
                          ? ", 8 LOUDEST OF " + std::to_string(zoom.channels()) + " CHANNELS"
                          : std::string();
    canvas.heading("STRONGEST HIT, 100 MS" + part, fullScaleText(zoom), heading);
    const auto axisRow = panel.removeFromBottom(axisHeight);
    const double rate = input.sampleRateHz;
    const double onset = static_cast<double>(strongest->timeNs) * 1e-9;
    const double from = static_cast<double>(zoom.firstFrame()) / rate - onset;
    const Axis axis{1e3 * from, 1e3 * (from + static_cast<double>(zoom.frameCount()) / rate),
                    laneArea(canvas, input, panel.withTrimmedTop(6))};
    const auto grid = ticks(axis.from, axis.to, 10);
    drawLanes(canvas, input, zoom, shown, axis, grid);
    axis.drawGrid(canvas, {0.0}, palette::highlight.withAlpha(0.6f));
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
    const Axis hits{0.0, input.durationSeconds, laneArea(canvas, input, panel)};
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

constexpr int maxWaveLanes = 16; // above, a lane is too low for a waveform and becomes a strip of brightness
constexpr double stripFloorDb = -60.0; // of the loudest

// The filled outline between the highest and lowest samples, at least a line thick and without gaps.
void drawWave(const Canvas& canvas, const WaveformEnvelope& wave, int channel, Area lane) {
    const float scale = wave.peak();
    const auto middle = static_cast<float>(lane.y) + 0.5f * static_cast<float>(lane.height);
    const float gain = scale > 0.0f ? (0.5f * static_cast<float>(lane.height) - 1.0f) / scale : 0.0f;
    const float step = static_cast<float>(lane.width) / WaveformEnvelope::columns;
    std::vector<Point> below;
    Path outline;
    SampleRange before = wave.column(channel, 0);
    for (int i = 0; i < WaveformEnvelope::columns; ++i) {
        const auto now = wave.column(channel, i);
        const float high = std::max(now.highest, before.lowest), low = std::min(now.lowest, before.highest);
        const float x = static_cast<float>(lane.x) + (static_cast<float>(i) + 0.5f) * step;
        const Point top{x, middle - gain * high - 0.4f};
        below.push_back({x, middle - gain * low + 0.4f});
        i == 0 ? outline.startNewSubPath(top) : outline.lineTo(top);
        before = now;
    }
    for (auto point = below.rbegin(); point != below.rend(); ++point) outline.lineTo(*point);
    outline.closeSubPath();
    canvas.graphics.setColour(palette::actuator(channel));
    canvas.graphics.fillPath(outline);
    // The line keeps steep slopes as visible as flat ones.
    canvas.graphics.strokePath(outline, 0.8f);
}

// Rows `from` to `to` of `count` that share the height without gaps.
Area rowsOf(Area whole, int from, int to, int count) {
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
        const auto alpha = static_cast<float>(std::pow(std::max(0.0, 1.0 - level / stripFloorDb), 1.5));
        canvas.graphics.setColour(palette::actuator(channel).withAlpha(std::min(alpha, 1.0f)));
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

Area panelRowOf(const Canvas& canvas, const PictureInput& input, Area lane) {
    return {lane.x - laneArea(canvas, input, {}).x, lane.y,
            laneArea(canvas, input, {}).x + lane.width + peakWidth, lane.height};
}

void drawWaves(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid) {
    const int count = static_cast<int>(channels.size());
    for (int i = 0; i < count; ++i) {
        const int channel = channels[static_cast<std::size_t>(i)];
        const Area row = rowsOf(axis.lane, i, i + 1, count);
        const Area lane = row.reduced(0, row.height >= 20 ? 2 : 1);
        canvas.well(lane);
        Axis{axis.from, axis.to, lane}.drawGrid(canvas, grid, palette::line);
        drawWave(canvas, wave, channel, lane);
        drawLabelAndPeak(canvas, laneLabel(input, channel), palette::actuator(channel), true,
                         wave.peak(channel), panelRowOf(canvas, input, row), lane);
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
                  rowsOf(axis.lane, i, i + 1, count).withTrimmedBottom(1));
    for (int i = 0; i < count; i += group) {
        const int end = std::min(i + group, count);
        float peak = 0.0f;
        for (int k = i; k < end; ++k) peak = std::max(peak, wave.peak(channels[static_cast<std::size_t>(k)]));
        const auto first = actuatorLabel(input, channels[static_cast<std::size_t>(i)]);
        const auto last = actuatorLabel(input, channels[static_cast<std::size_t>(end) - 1]);
        drawLabelAndPeak(canvas, end - i > 1 ? first + "\xe2\x80\x93" + last : first, palette::muted, false,
                         peak, panelRowOf(canvas, input, rowsOf(axis.lane, i, end, count)), axis.lane);
    }
}

} // namespace

std::vector<int> allChannels(const WaveformEnvelope& wave) {
    std::vector<int> channels(static_cast<std::size_t>(wave.channels()));
    std::iota(channels.begin(), channels.end(), 0);
    return channels;
}

void drawLanes(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid) {
    if (static_cast<int>(channels.size()) <= maxWaveLanes)
        return drawWaves(canvas, input, wave, channels, axis, grid);
    drawStrips(canvas, input, wave, channels, axis);
}

std::string fullScaleText(const WaveformEnvelope& wave) {
    if (wave.peak() == 0.0f) return "silence";
    return "full height \xc2\xb1" + number(wave.peak(), 3) + " = " + decibelText(wave.peak());
}

std::string actuatorLabel(const PictureInput& input, int channel) {
    const auto index = static_cast<std::size_t>(channel);
    if (index < input.labels.size()) return cleanLine(input.labels[index]);
    return input.layout.count <= 26 ? std::string(1, static_cast<char>('A' + channel))
                                    : std::to_string(channel + 1);
}

std::string_view builtInPart(PartNumber part) noexcept {
    const auto found = std::ranges::find(bodyParts, part, partNamed);
    return found == bodyParts.end() ? std::string_view{} : *found;
}

std::string laneLabel(const PictureInput& input, int channel) {
    const std::string label = actuatorLabel(input, channel);
    const auto part = builtInPart(input.layout.places[static_cast<std::size_t>(channel)].part);
    return part.empty() || part == label ? label : label + " " + std::string{part};
}

Area laneArea(const Canvas& canvas, const PictureInput& input, Area row) {
    int widest = 38;
    for (int c = 0; c < input.layout.count; ++c)
        widest = std::max(widest, canvas.textWidth(laneLabel(input, c), smallText, true));
    return row.withTrimmedLeft(std::min(widest, 130) + 14).withTrimmedRight(peakWidth);
}

int lanesHeight(int channels) noexcept {
    return channels <= 1 ? 100 : channels == 2 ? 140 : channels <= 8 ? 196 : 256;
}

// Draws the lane of impacts: stems, their scale, and the legend of their colours.

namespace {

constexpr double floorDb = -60.0;
constexpr std::ptrdiff_t maxDots = 600; // of stems' heads: more would hide each other
constexpr int headRoom = 6;

/// Amplitude to height: floorDb at the bottom, 0 dBFS or the next ten above the strongest at the top.
struct LevelAxis {
    double ceiling;
    Area lane;
    float height(double level) const {
        const double share = (level - floorDb) / (ceiling - floorDb);
        return static_cast<float>(std::max(share * (lane.height - headRoom), 2.0)); // always visible
    }
};

std::vector<const CollisionEvent*> loudestFirst(std::span<const CollisionEvent> events) {
    std::vector<const CollisionEvent*> order;
    for (const auto& event : events) order.push_back(&event);
    std::ranges::stable_sort(order, std::greater{}, [](const auto* e) { return std::abs(e->amplitude); });
    return order;
}

void drawStem(const Canvas& canvas, float x, float bottom, float height, Colour colour, bool dot) {
    canvas.graphics.setColour(dot ? colour.withAlpha(0.75f) : colour);
    canvas.graphics.fillRect({dot ? x - 0.75f : std::floor(x), bottom - height, dot ? 1.5f : 1.0f, height});
    canvas.graphics.setColour(colour);
    if (dot) canvas.graphics.fillEllipse({x - 2.5f, bottom - height - 2.5f, 5.0f, 5.0f});
}

void drawLevelLabels(const Canvas& canvas, const LevelAxis& levels) {
    const Area lane = levels.lane;
    for (const double level : {0.0, -20.0, -40.0, -60.0}) {
        const int y = lane.bottom() - roundToInt(levels.height(level));
        const Area row{lane.x - 60, std::clamp(y - 9, lane.y - 4, lane.bottom() - 16), 52, 18};
        canvas.text(number(level, 0), row, Align::right, palette::muted);
    }
}

int entryWidth(const Canvas& canvas, const HitColours::Class& c) {
    return canvas.textWidth(c.name, smallText) + 40;
}

} // namespace

// Strong hits first, so that weaker stems at the same place are drawn over them; at last the strongest again.
void drawHits(const Canvas& canvas, const PictureInput& input, const HitColours& colours, const Axis& axis) {
    const auto order = loudestFirst(input.events);
    const double loudest = order.empty() ? 0.0 : decibels(order.front()->amplitude);
    const LevelAxis levels{std::max(0.0, 10.0 * std::ceil(loudest / 10.0)), axis.lane};
    drawLevelLabels(canvas, levels);
    if (order.empty()) return canvas.text("no hits", axis.lane, Align::centre, palette::muted);
    const auto draw = [&](const CollisionEvent& event, Colour colour, bool dot) {
        const double seconds = static_cast<double>(event.timeNs) * 1e-9;
        if (seconds < axis.from || seconds > axis.to) return;
        drawStem(canvas, axis.x(seconds), static_cast<float>(axis.lane.bottom()),
                 levels.height(decibels(event.amplitude)), colour, dot);
    };
    const bool hasDots = std::ranges::count_if(input.events, isHit) <= maxDots;
    for (const auto* event : order)
        draw(*event, colours.colourOf(*event), hasDots && isHit(*event)); // grains are too dense for dots
    draw(*order.front(), palette::highlight, true);
}

void drawLegend(const Canvas& canvas, const HitColours& colours, Area row) {
    int width = -20; // less the gap, which the last entry needs not
    for (const auto& c : colours.classes()) width += entryWidth(canvas, c);
    const int share = row.width / std::max(static_cast<int>(colours.classes().size()), 1);
    const bool fits = width <= row.width;
    if (fits) row = row.withLeft(row.right() - width);
    for (const auto& c : colours.classes()) {
        Area entry = row.removeFromLeft(fits ? entryWidth(canvas, c) : share);
        canvas.graphics.setColour(c.colour);
        canvas.graphics.fillEllipse(entry.removeFromLeft(18).withSizeKeepingCentre(11, 11).toFloat());
        canvas.text(c.name, fits ? entry : entry.withTrimmedRight(10), Align::left, palette::muted);
    }
}

namespace {

constexpr double anyDecay = -1.0;
constexpr double endless = std::numeric_limits<double>::infinity();

} // namespace

HitColours::HitColours(const PictureInput& input) {
    if (input.scene != nullptr && input.scene->materials.size() <= palette::materialCount)
        classifyByMaterial(input);
    else if (!classifyByBodyPart(input))
        classifyByFrequency(input);
    if (!input.events.empty()) classes_.push_back({"strongest", palette::highlight});
}

Colour HitColours::colourOf(const CollisionEvent& event) const {
    for (const auto& rule : rules_)
        if ((rule.part == 0 || rule.part == event.source.part) && event.frequencyHz >= rule.minHz &&
            event.frequencyHz <= rule.maxHz &&
            (rule.decayPerSecond == anyDecay || rule.decayPerSecond == event.decayPerSecond))
            return rule.colour;
    return palette::grey;
}

// Frequency and decay of a hit identify the material, whichever of the two bodies vibrates.
void HitColours::classifyByMaterial(const PictureInput& input) {
    meaning_ = "material";
    const auto& materials = input.scene->materials;
    std::set<std::size_t> used;
    for (const auto& body : allBodies(*input.scene))
        for (const auto& fixture : body.fixtures) used.insert(static_cast<std::size_t>(fixture.material));
    bool unknown = false;
    for (const auto& event : input.events) {
        const auto found = std::ranges::find_if(materials, [&](const Material& m) {
            return m.frequencyHz == event.frequencyHz && m.decayPerSecond == event.decayPerSecond;
        });
        unknown |= found == materials.end();
        used.insert(static_cast<std::size_t>(found - materials.begin())); // unknown: their number
    }
    for (const auto index : used) {
        if (index >= materials.size()) continue;
        const auto& m = materials[index];
        const auto colour = palette::materialOf(materials, static_cast<int>(index));
        rules_.push_back({m.frequencyHz, m.frequencyHz, m.decayPerSecond, colour});
        const auto name = cleanLine(m.name);
        classes_.push_back(
            {m.frequencyHz > 0.0 ? name + " " + shortNumber(m.frequencyHz) + " Hz" : name, colour});
    }
    if (unknown) classes_.push_back({"other", palette::grey});
}

bool HitColours::classifyByBodyPart(const PictureInput& input) {
    const std::span places{input.layout.places.data(), static_cast<std::size_t>(input.layout.count)};
    const auto channelOf = [&](PartNumber part) {
        return static_cast<int>(std::ranges::find(places, part, &ActuatorPlace::part) - places.begin());
    };
    std::set<int> channels; // the first channel of each part
    for (const auto& event : input.events) {
        const int channel = event.source.part == 0 ? input.layout.count : channelOf(event.source.part);
        if (channel == input.layout.count) return false;
        channels.insert(channel);
    }
    for (const int channel : channels) {
        const PartNumber part = places[static_cast<std::size_t>(channel)].part;
        const auto name = builtInPart(part);
        rules_.push_back({0.0, endless, anyDecay, palette::actuator(channel), part});
        classes_.push_back(
            {name.empty() ? actuatorLabel(input, channel) : std::string{name}, palette::actuator(channel)});
    }
    if (!channels.empty()) meaning_ = "part of the body";
    return !channels.empty();
}

void HitColours::classifyByFrequency(const PictureInput& input) {
    std::set<double> frequenciesHz;
    for (const auto& event : input.events) {
        frequenciesHz.insert(event.frequencyHz);
        if (frequenciesHz.size() > palette::rampCount) break;
    }
    if (frequenciesHz.size() <= palette::rampCount) {
        for (int i = 0; const double f : frequenciesHz) {
            rules_.push_back({f, f, anyDecay, palette::ramp(i)});
            classes_.push_back({shortNumber(f) + " Hz", palette::ramp(i++)});
        }
        return;
    }
    const std::string to = "\xe2\x80\x93";
    constexpr double edges[] = {0.0, 50.0, 100.0, 200.0, 400.0, 800.0, endless}; // tactile octaves
    for (int i = 0; i < palette::rampCount; ++i) {
        rules_.push_back({edges[i], edges[i + 1], anyDecay, palette::ramp(i)});
        const auto name = i == 0                    ? "up to " + shortNumber(edges[1])
                          : edges[i + 1] == endless ? "above " + shortNumber(edges[i])
                                                    : shortNumber(edges[i]) + to + shortNumber(edges[i + 1]);
        classes_.push_back({name + " Hz", palette::ramp(i)});
    }
}

} // namespace physvib::picture
