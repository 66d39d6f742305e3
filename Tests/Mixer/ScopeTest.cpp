// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra, events and telemetry: what is played is what they show.
#include "Host/FakeAudioDevice.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Strips/ScopeView.h"
#include "MixerTesting.h"
#include <cmath>
#include <numbers>

namespace physvib::scope_test {

using namespace test;

double peakHz(const SpectrumLevels& levels) {
    return FrequencyAxis::hzAtPoint(static_cast<int>(std::ranges::max_element(levels) - levels.begin()));
}

float highestOf(const SpectrumLevels& levels) { return *std::ranges::max_element(levels); }

TEST(SpectrumTrace, ASineIsAPeakOfItsLevelInItsChannelAlone) {
    for (const int rate : {8000, 44100, 48000, 192000})
        for (const double hz : {40.0, 205.0, 430.0, 900.0}) {
            SpectrumTrace trace;
            trace.setRate(rate);
            std::vector<float> sine(static_cast<std::size_t>(rate) / 2), silence(sine.size());
            for (std::size_t i = 0; i < sine.size(); ++i)
                sine[i] = static_cast<float>(
                    0.5 * std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(i) / rate));
            for (int done = 0, frames = static_cast<int>(sine.size()); done < frames; done += 130) {
                const float* channels[]{silence.data() + done, sine.data() + done};
                trace.add(channels, 2, std::min(130, frames - done));
            }
            EXPECT_NEAR(peakHz(channelSpectrum(trace, 1)), hz, 0.03 * hz) << rate;
            EXPECT_NEAR(highestOf(channelSpectrum(trace, 1)), -6.0, 0.5) << rate << " Hz, " << hz;
            EXPECT_LT(channelSpectrum(trace, 1)[static_cast<std::size_t>(hz < 300.0 ? 150 : 40)], -60.0f)
                << "far from it there is nothing";
            EXPECT_EQ(highestOf(channelSpectrum(trace, 0)), FrequencyAxis::floorDb);
        }
}

TEST(SpectrumTrace, AxisAndLevelsMeetAtItsEnds) {
    EXPECT_DOUBLE_EQ(FrequencyAxis::hzAtPoint(0), 20.0);
    EXPECT_NEAR(FrequencyAxis::hzAtPoint(FrequencyAxis::pointCount - 1), 1000.0, 1e-9);
    EXPECT_NEAR(FrequencyAxis::shareFromHz(FrequencyAxis::hzFromShare(0.3)), 0.3, 1e-12);
    const std::vector<double> short_(3, 1.0); // the axis goes beyond what there is
    EXPECT_EQ(toSpectrumLevels(short_, 10.0, 1.0).back(), FrequencyAxis::floorDb);
}

TEST(ScopeTrace, AWaveHasNoGapAndLosesNoPeakAtAnyWidth) {
    constexpr int rate = 48000;
    ScopeTrace trace;
    trace.setRate(rate);
    std::vector<float> wave(rate + rate / 10);
    for (std::size_t i = 0; i < wave.size(); ++i)
        wave[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * 70.0 * static_cast<double>(i) / rate));
    wave[wave.size() - 20000] = 1.0f;
    const float* channel = wave.data();
    trace.add(&channel, 1, static_cast<int>(wave.size()));
    for (const int width : {100, 333, 798, 2400}) {
        auto before = trace.pixelRange(0, 0, width);
        float highest = 0.0f;
        for (int x = 1; x < width; ++x) {
            const auto now = trace.pixelRange(0, x, width);
            EXPECT_LE(now.lowest, before.highest) << x << " of " << width;
            EXPECT_GE(now.highest, before.lowest) << x << " of " << width;
            highest = std::max(highest, now.highest);
            before = now;
        }
        EXPECT_EQ(highest, 1.0f) << width;
    }
    for (std::size_t i = 0; i < wave.size(); ++i) // half a wave is a column
        wave[i] =
            static_cast<float>(std::sin(2.0 * std::numbers::pi * 400.0 * static_cast<double>(i) / rate));
    trace.add(&channel, 1, static_cast<int>(wave.size()));
    for (int x = 2; x < 558; ++x)
        EXPECT_TRUE(trace.pixelRange(0, x, 560).highest > 0.9f && trace.pixelRange(0, x, 560).lowest < -0.9f)
            << x;
}

// A column of the old rate may already be longer than those of the new one: the mixer crashed there.
TEST(ScopeTrace, AnotherRateInTheMiddleOfAColumnBeginsItAnew) {
    for (const int before : {44100, 48000, 192000})
        for (const int after : {8000, 44100, 96000}) {
            ScopeTrace trace;
            trace.setRate(before);
            const int longest = before / ScopeTrace::columnCount; // frames of a column
            const std::vector<float> loud(static_cast<std::size_t>(longest - 1), 0.5f),
                soft(static_cast<std::size_t>(after / ScopeTrace::columnCount), 0.25f);
            const float *ofLoud = loud.data(), *ofSoft = soft.data();
            trace.add(&ofLoud, 1, longest - 1);
            EXPECT_EQ(trace.columnsBegun(), 0);
            trace.setRate(after);
            trace.add(&ofSoft, 1, after / ScopeTrace::columnCount);
            EXPECT_EQ(trace.columnsBegun(), 1) << before << " to " << after << " Hz";
            const auto newest = trace.columnAt(0, ScopeTrace::columnCount - 2); // the last that is whole
            EXPECT_EQ(newest.lowest, 0.25f);
            EXPECT_EQ(newest.highest, 0.25f);
        }
}

struct Scope : testing::Test {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
};

TEST_F(Scope, WhatIsStruckIsAPeakThatFallsCalmly) {
    model.setSlowness(0);
    auto& spectrum = the<SpectrumView>(view, "Spectra");
    const auto isQuiet = [&](int channel) {
        return highestOf(spectrum.levelsDb(channel)) == FrequencyAxis::floorDb;
    };
    ASSERT_TRUE(runUntil([&] {
        return view.refresh(), view.snapshot().session.render.pending == 0 && isQuiet(0) && isQuiet(2);
    })) << "what was struck before";
    model.eventPlayer().testPulse(2);
    double seenHz = 0.0;
    float highest = FrequencyAxis::floorDb;
    ASSERT_TRUE(runUntil([&] {
        view.refresh();
        const float level = highestOf(spectrum.levelsDb(2));
        if (level > highest) highest = level, seenHz = peakHz(spectrum.levelsDb(2));
        return highest > -50.0f && level < highest - 6.0f;
    }));
    EXPECT_NEAR(seenHz, 205.0, 10.0);
    EXPECT_TRUE(isQuiet(0)) << "a pulse is one enchanter's";
}

TEST_F(Scope, PlayedEventsAreListedTheNewestFirst) {
    view.scope().choose("Events");
    auto& list = the<juce::ListBox>(view, "List of played events");
    ASSERT_TRUE(runUntil([&] { return view.refresh(), model.recentContacts().newestFirst().size() >= 5; }));
    ASSERT_TRUE(runUntil([&] { return view.refresh(), list.getModel()->getNumRows() >= 5; }));
    EXPECT_TRUE(std::ranges::is_sorted(model.recentContacts().newestFirst(), std::greater{},
                                       [](const RecentContact& c) { return c.event.timeNs; }));
    EXPECT_TRUE(list.getModel()->getNameForRow(0).contains("wall at ")) << list.getModel()->getNameForRow(0);
    ASSERT_TRUE(runUntil(
        [&] { return view.refresh(), model.poll().session.render.played > RecentContacts::maxContacts + 20; },
        60.0));
    EXPECT_EQ(model.recentContacts().newestFirst().size(), RecentContacts::maxContacts);
}

juce::String valueOf(const std::vector<StatusRow>& facts, const juce::String& name) {
    const auto found = std::ranges::find(facts, name, &StatusRow::name);
    return found == facts.end() ? juce::String{"?"} : found->value;
}

TEST_F(Scope, TelemetrySaysWhatTheSessionCounts) {
    view.scope().choose("Telemetry");
    ASSERT_TRUE(runUntil([&] { return view.refresh(), view.snapshot().session.render.played > 5; }));
    auto& shown = the<StatusTable>(*view.scope().find<TelemetryTab>()->getChildComponent(0), "Telemetry");
    EXPECT_TRUE(runUntil([&] { return view.refresh(), valueOf(shown.rows(), "Clock").contains("48000 Hz"); }))
        << shown.getDescription();
    EXPECT_TRUE(shown.getDescription().contains("Late: ")) << shown.getDescription();

    MixerSnapshot moment = view.snapshot();
    moment.session.render.late = 3;
    moment.session.render.liveModes = 7;
    moment.session.refused = 2;
    moment.session.minMarginFrames = -48;
    moment.device.worstLoad = 1.25f;
    moment.device.deviceXruns = 4;
    const auto facts = telemetryRows(model, moment, 0.125f);
    EXPECT_EQ(valueOf(facts, "Late"), "3 hits");
    EXPECT_TRUE(valueOf(facts, "Modes").startsWith("7 ringing"));
    EXPECT_TRUE(valueOf(facts, "Refused").startsWith("2 without room"));
    EXPECT_EQ(valueOf(facts, "Margin"), number(-1.0, 1) + " ms at least");
    EXPECT_EQ(valueOf(facts, "Render call"), "median 12.5 %, worst 125.0 %");
    EXPECT_EQ(valueOf(facts, "Xruns"), "4");
    EXPECT_EQ(valueOf(facts, "Board"), "none");
    for (const auto* name : {"Late", "Refused", "Margin", "Render call", "Xruns"})
        EXPECT_EQ(std::ranges::find(facts, juce::String{name}, &StatusRow::name)->shade, Shade::highlight)
            << name;
}

TEST(Telemetry, ADeviceThatHasGoneIsNoClock) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    EXPECT_TRUE(valueOf(telemetryRows(model, model.poll(), 0.0f), "Clock").startsWith("Fake:hands"));
    hands.unplug(true);
    ASSERT_TRUE(runUntil([&] { return !model.poll().device.isRunning; }));
    EXPECT_TRUE(valueOf(telemetryRows(model, model.poll(), 0.0f), "Clock").startsWith("none runs"));
}

} // namespace physvib::scope_test
