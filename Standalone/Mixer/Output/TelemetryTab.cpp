// SPDX-License-Identifier: GPL-3.0-or-later
// Formats counters of session and device, and draws the table that shows them; amber marks losses.
#include "Core/Units.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Output/OutputTab.h"
#include <numeric>

namespace physvib {
namespace {

constexpr std::size_t maxLoads = 300;      // ten seconds of updates
constexpr double updateIntervalMs = 500.0; // figures that change faster are illegible

juce::String toText(std::uint64_t n) { return juce::String{static_cast<juce::int64>(n)}; }
juce::String hits(std::uint64_t n) { return countText(n, "hit"); }
juce::String percent(float share) { return number(100.0 * static_cast<double>(share), 1) + " %"; }
Shade lossShade(std::uint64_t n) { return n > 0 ? Shade::highlight : Shade::text; }

StatusRow clockRow(const MixerModel& model, const MixerSnapshot& snapshot) {
    const auto& output = model.output();
    if (!snapshot.device.isRunning) return {"Clock", "none runs: the world waits", Shade::limit};
    const auto name = utf8(output.device());
    const bool isNone = name.startsWith(juce::String{nullDeviceType} + ":");
    return {"Clock",
            (isNone ? juce::String{"no device"} : name) + ", " + juce::String{output.sampleRateHz()} + " Hz",
            isNone ? Shade::highlight : Shade::text};
}

StatusRow marginRow(const MixerSnapshot& snapshot, int rateHz) {
    const auto frames = snapshot.session.minMarginFrames;
    if (frames == noMargin || rateHz == 0) return {"Margin", "no hit yet", Shade::muted};
    return {"Margin", number(1e3 * static_cast<double>(frames) / rateHz, 1) + " ms at least",
            frames < 0 ? Shade::highlight : Shade::text};
}

StatusRow guardRow(const AudioOutputStatus& device) {
    const double reduction = toDecibels(std::max(static_cast<double>(device.guardGain), 1e-3));
    const auto times =
        device.guardEpisodes > 0 ? ", acted " + countText(device.guardEpisodes, "time") : juce::String{};
    return {"Guard", number(reduction, 1) + " dB" + times, reduction < -0.05 ? Shade::limit : Shade::text};
}

StatusRow exposureRow(double a8) {
    const auto text = "A(8) " + number(a8, 2) + " m/s^2 (action value " +
                      number(exposureActionMetresPerSecond2, 1) + ", limit " +
                      number(exposureLimitMetresPerSecond2, 0) + ")";
    return {"Exposure", text,
            a8 >= exposureLimitMetresPerSecond2    ? Shade::limit
            : a8 >= exposureActionMetresPerSecond2 ? Shade::highlight
                                                   : Shade::text};
}

constexpr int minRowPixels = 18, maxRowPixels = 26, nameGap = 14;

/// The number of lines that the text needs at that width, broken between words.
int countLines(const juce::String& value, const juce::Font& font, int width) {
    if (text::pixelWidth(font, value) <= width) return 1;
    juce::AttributedString all;
    all.append(value, font);
    juce::TextLayout layout;
    layout.createLayout(all, static_cast<float>(std::max(1, width)));
    return std::max(1, layout.getNumLines());
}

} // namespace

std::vector<StatusRow> telemetryRows(const MixerModel& model, const MixerSnapshot& snapshot,
                                     float medianLoad) {
    const auto& output = model.output();
    const auto& render = snapshot.session.render;
    const auto& session = model.session();
    const auto refused = snapshot.session.refused + render.rejected;
    const double reduction = toDecibels(std::max(static_cast<double>(render.limiterGain), 1e-6));
    std::vector<StatusRow> rows{
        {"Played", hits(render.played) + ", " + juce::String{render.pending} + " waiting"},
        {"Late", hits(render.late), lossShade(render.late)},
        {"Dropped", hits(session.world().drops()) + " in a step", lossShade(session.world().drops())},
        {"Refused",
         toText(snapshot.session.refused) + " without room, " + toText(render.rejected) + " unplayable",
         lossShade(refused)},
        {"Elsewhere", hits(render.withoutPart) + " of a part without an actuator",
         lossShade(render.withoutPart)},
        marginRow(snapshot, output.sampleRateHz()),
        {"Stalls", number(1e-6 * static_cast<double>(session.world().stalledNs()), 0) + " ms of the world"},
        {"Modes", juce::String{render.liveModes} + " ringing, " + toText(render.stolen) + " ended early",
         lossShade(render.stolen)},
        {"Limiter", number(reduction, 1) + " dB", reduction < -0.05 ? Shade::limit : Shade::text},
        guardRow(snapshot.device),
        exposureRow(snapshot.dailyExposure),
        clockRow(model, snapshot),
        {"Render call", "median " + percent(medianLoad) + ", worst " + percent(snapshot.device.worstLoad),
         snapshot.device.worstLoad > 1.0f ? Shade::highlight : Shade::text},
        {"Blocks", toText(snapshot.device.blocks) + " of " + juce::String{output.blockFrames()} + " frames"},
        {"Xruns",
         snapshot.device.deviceXruns < 0 ? juce::String{"not counted by the device"}
                                         : juce::String{snapshot.device.deviceXruns},
         snapshot.device.deviceXruns > 0 ? Shade::highlight : Shade::text},
        {"Not told", hits(render.unsent) + ", " + toText(model.signals().framesLost()) + " frames",
         lossShade(render.unsent)},
        {"Not finite", toText(render.nonFinite) + " samples", lossShade(render.nonFinite)}};
    const auto sinks = model.session().sinks().states();
    if (sinks.empty()) rows.push_back({"Board", "none", Shade::muted});
    for (const SinkState& sink : sinks)
        for (const auto& [name, value, isWrong] : sink.details)
            rows.push_back({utf8(name), utf8(value), isWrong ? Shade::highlight : Shade::text});
    return rows;
}

TelemetryTab::TelemetryTab(MixerModel& model)
    : model_{model} {
    setTitle("Telemetry");
    addAndMakeVisible(statusTable_);
}

float TelemetryTab::medianLoad() const {
    std::vector<float> sorted(loads_.begin(), loads_.end());
    if (sorted.empty()) return 0.0f;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    return *middle;
}

void TelemetryTab::refresh(const MixerSnapshot& snapshot) {
    if (snapshot.device.isRunning) loads_.push_back(snapshot.device.load);
    if (loads_.size() > maxLoads) loads_.pop_front();
    const double now = nowMs();
    if (now - updatedAtMs_ < updateIntervalMs) return;
    updatedAtMs_ = now;
    statusTable_.set(telemetryRows(model_, snapshot, medianLoad()));
}

StatusTable::StatusTable(const juce::String& title, int maxColumns)
    : maxColumns_{maxColumns} {
    setTitle(title);
}

// Uses as many columns as show every value in one line; in a single column, long values have several lines.
StatusTable::Layout StatusTable::layoutFor(int width) const {
    const auto font = text::font(text::medium);
    Layout layout;
    int maxValueWidth = 0;
    for (const auto& row : rows_) {
        layout.nameWidth = std::max(layout.nameWidth, text::pixelWidth(font, row.name) + nameGap);
        maxValueWidth = std::max(maxValueWidth, text::pixelWidth(font, row.value) + 1);
    }
    const auto room = [&](int columns) { return (width - (columns - 1) * gap) / columns - layout.nameWidth; };
    for (layout.columns = maxColumns_; layout.columns > 1 && room(layout.columns) < maxValueWidth;)
        --layout.columns;
    const int count = static_cast<int>(rows_.size());
    layout.rows = (count + layout.columns - 1) / layout.columns;
    for (const auto& row : rows_)
        layout.rowLines.push_back(layout.columns > 1 ? 1 : countLines(row.value, font, room(1)));
    layout.lines =
        layout.columns > 1 ? layout.rows : std::accumulate(layout.rowLines.begin(), layout.rowLines.end(), 0);
    return layout;
}

int StatusTable::heightFor(int width) const { return layoutFor(width).lines * minRowPixels; }

void StatusTable::set(std::vector<StatusRow> rows) {
    if (rows == rows_) return;
    rows_ = std::move(rows);
    juce::StringArray lines;
    for (const auto& row : rows_) lines.add(row.name + ": " + row.value);
    setDescription(lines.joinIntoString("; "));
    repaint();
}

void StatusTable::paint(juce::Graphics& g) {
    if (rows_.empty()) return;
    const auto layout = layoutFor(getWidth());
    const int lineHeight = juce::jlimit(minRowPixels, maxRowPixels, getHeight() / layout.lines),
              width = (getWidth() - (layout.columns - 1) * gap) / layout.columns;
    const auto font = text::font(text::medium);
    g.setFont(font);
    int y = 0;
    for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
        const auto& row = nth(rows_, i);
        const int lines = nth(layout.rowLines, i);
        if (i % layout.rows == 0) y = 0;
        juce::Rectangle<int> area{i / layout.rows * (width + gap), y, width, lines * lineHeight};
        y = area.getBottom();
        g.setColour(shade(*this, Shade::muted));
        g.drawText(row.name, area.removeFromLeft(layout.nameWidth).withHeight(lineHeight),
                   juce::Justification::centredLeft, true);
        g.setColour(shade(*this, row.shade));
        g.drawFittedText(row.value, area, juce::Justification::centredLeft, lines, 1.0f);
    }
}

} // namespace physvib
