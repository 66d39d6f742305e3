// SPDX-License-Identifier: GPL-3.0-or-later
// Formats counters of session and device; amber marks losses.
#include "Core/Units.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Output/OutputTab.h"
#include <numeric>

namespace physvib {
namespace {

constexpr std::size_t maxLoads = 300;   // ten seconds of updates
constexpr double showFiguresMs = 500.0; // figures that change faster are illegible

juce::String count(std::uint64_t n) { return juce::String{static_cast<juce::int64>(n)}; }
juce::String hits(std::uint64_t n) { return countOf(n, "hit"); }
juce::String percent(float share) { return number(100.0 * static_cast<double>(share), 1) + " %"; }
Shade noneIsGood(std::uint64_t n) { return n > 0 ? Shade::now : Shade::text; }

Fact clockFact(const MixerModel& model, const MixerMoment& moment) {
    const auto& output = model.output();
    if (!moment.device.isRunning) return {"Clock", "none runs: the world waits", Shade::limit};
    const auto name = utf8(output.device());
    const bool isNone = name.startsWith(juce::String{noDeviceType} + ":");
    return {"Clock",
            (isNone ? juce::String{"no device"} : name) + ", " + juce::String{output.sampleRateHz()} + " Hz",
            isNone ? Shade::now : Shade::text};
}

Fact marginFact(const MixerMoment& moment, int rateHz) {
    const auto frames = moment.session.leastMarginFrames;
    if (frames == noMargin || rateHz == 0) return {"Margin", "no hit yet", Shade::muted};
    return {"Margin", number(1e3 * static_cast<double>(frames) / rateHz, 1) + " ms at least",
            frames < 0 ? Shade::now : Shade::text};
}

Fact guardFact(const AudioOutputStatus& device) {
    const double reduction = toDecibels(std::max(static_cast<double>(device.guardGain), 1e-3));
    const auto times = device.guarded > 0 ? ", acted " + countOf(device.guarded, "time") : juce::String{};
    return {"Guard", number(reduction, 1) + " dB" + times, reduction < -0.05 ? Shade::limit : Shade::text};
}

Fact exposureFact(double daily) {
    const auto words = "A(8) " + number(daily, 2) + " m/s^2 (action value " + number(exposureActionValue, 1) +
                       ", limit " + number(exposureLimitValue, 0) + ")";
    return {"Exposure", words,
            daily >= exposureLimitValue    ? Shade::limit
            : daily >= exposureActionValue ? Shade::now
                                           : Shade::text};
}

constexpr int lowestRow = 18, highestRow = 26, afterName = 14;

/// That the words need at that width, broken between words.
int linesOf(const juce::String& words, const juce::Font& font, int width) {
    if (text::pixels(font, words) <= width) return 1;
    juce::AttributedString all;
    all.append(words, font);
    juce::TextLayout layout;
    layout.createLayout(all, static_cast<float>(std::max(1, width)));
    return std::max(1, layout.getNumLines());
}

} // namespace

std::vector<Fact> telemetryFacts(const MixerModel& model, const MixerMoment& moment, float medianLoad) {
    const auto& output = model.output();
    const auto& r = moment.session.render;
    const auto& session = model.session();
    const auto refused = moment.session.refused + r.rejected;
    const double reduction = toDecibels(std::max(static_cast<double>(r.limiterGain), 1e-6));
    std::vector<Fact> facts{
        {"Played", hits(r.played) + ", " + juce::String{r.pending} + " waiting"},
        {"Late", hits(r.late), noneIsGood(r.late)},
        {"Dropped", hits(session.world().drops()) + " in a step", noneIsGood(session.world().drops())},
        {"Refused", count(moment.session.refused) + " without room, " + count(r.rejected) + " unplayable",
         noneIsGood(refused)},
        {"Elsewhere", hits(r.withoutPart) + " of a part without an actuator", noneIsGood(r.withoutPart)},
        marginFact(moment, output.sampleRateHz()),
        {"Stalls", number(1e-6 * static_cast<double>(session.world().slippedNs()), 0) + " ms of the world"},
        {"Modes", juce::String{r.liveModes} + " ringing, " + count(r.stolen) + " ended early",
         noneIsGood(r.stolen)},
        {"Limiter", number(reduction, 1) + " dB", reduction < -0.05 ? Shade::limit : Shade::text},
        guardFact(moment.device),
        exposureFact(moment.dailyExposure),
        clockFact(model, moment),
        {"Render call", "median " + percent(medianLoad) + ", worst " + percent(moment.device.worstLoad),
         moment.device.worstLoad > 1.0f ? Shade::now : Shade::text},
        {"Blocks", count(moment.device.blocks) + " of " + juce::String{output.blockFrames()} + " frames"},
        {"Xruns",
         moment.device.deviceXruns < 0 ? juce::String{"not counted by the device"}
                                       : juce::String{moment.device.deviceXruns},
         moment.device.deviceXruns > 0 ? Shade::now : Shade::text},
        {"Not told", hits(r.untold) + ", " + count(model.signals().framesLost()) + " frames",
         noneIsGood(r.untold)},
        {"Not finite", count(r.nonFinite) + " samples", noneIsGood(r.nonFinite)}};
    const auto sinks = model.session().sinks().states();
    if (sinks.empty()) facts.push_back({"Board", "none", Shade::muted});
    for (const SinkState& sink : sinks)
        for (const auto& [name, value, isWrong] : sink.facts)
            facts.push_back({utf8(name), utf8(value), isWrong ? Shade::now : Shade::text});
    return facts;
}

TelemetryTab::TelemetryTab(MixerModel& model)
    : model_{model} {
    setTitle("Telemetry");
    addAndMakeVisible(facts_);
}

float TelemetryTab::medianLoad() const {
    std::vector<float> sorted(loads_.begin(), loads_.end());
    if (sorted.empty()) return 0.0f;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    return *middle;
}

void TelemetryTab::refresh(const MixerMoment& moment) {
    if (moment.device.isRunning) loads_.push_back(moment.device.load);
    if (loads_.size() > maxLoads) loads_.pop_front();
    const double now = nowMs();
    if (now - shownAtMs_ < showFiguresMs) return;
    shownAtMs_ = now;
    facts_.set(telemetryFacts(model_, moment, medianLoad()));
}

FactList::FactList(const juce::String& title, int maxColumns)
    : maxColumns_{maxColumns} {
    setTitle(title);
}

// As many columns as hold every value in one line; in a single one, a long value has several lines.
FactList::Places FactList::placesIn(int width) const {
    const auto font = text::font(text::medium);
    Places p;
    int widest = 0;
    for (const auto& fact : facts_) {
        p.nameWidth = std::max(p.nameWidth, text::pixels(font, fact.name) + afterName);
        widest = std::max(widest, text::pixels(font, fact.value) + 1);
    }
    const auto room = [&](int columns) { return (width - (columns - 1) * gap) / columns - p.nameWidth; };
    for (p.columns = maxColumns_; p.columns > 1 && room(p.columns) < widest;) --p.columns;
    const int count = static_cast<int>(facts_.size());
    p.rows = (count + p.columns - 1) / p.columns;
    for (const auto& fact : facts_)
        p.linesOf.push_back(p.columns > 1 ? 1 : linesOf(fact.value, font, room(1)));
    p.lines = p.columns > 1 ? p.rows : std::accumulate(p.linesOf.begin(), p.linesOf.end(), 0);
    return p;
}

int FactList::heightFor(int width) const { return placesIn(width).lines * lowestRow; }

void FactList::set(std::vector<Fact> facts) {
    if (facts == facts_) return;
    facts_ = std::move(facts);
    juce::StringArray words;
    for (const auto& fact : facts_) words.add(fact.name + ": " + fact.value);
    setDescription(words.joinIntoString("; "));
    repaint();
}

void FactList::paint(juce::Graphics& g) {
    if (facts_.empty()) return;
    const auto p = placesIn(getWidth());
    const int line = juce::jlimit(lowestRow, highestRow, getHeight() / p.lines),
              width = (getWidth() - (p.columns - 1) * gap) / p.columns;
    const auto font = text::font(text::medium);
    g.setFont(font);
    int y = 0;
    for (int i = 0; i < static_cast<int>(facts_.size()); ++i) {
        const auto& fact = nth(facts_, i);
        const int lines = nth(p.linesOf, i);
        if (i % p.rows == 0) y = 0;
        juce::Rectangle<int> row{i / p.rows * (width + gap), y, width, lines * line};
        y = row.getBottom();
        g.setColour(shade(*this, Shade::muted));
        g.drawText(fact.name, row.removeFromLeft(p.nameWidth).withHeight(line),
                   juce::Justification::centredLeft, true);
        g.setColour(shade(*this, fact.shade));
        g.drawFittedText(fact.value, row, juce::Justification::centredLeft, lines, 1.0f);
    }
}

} // namespace physvib
