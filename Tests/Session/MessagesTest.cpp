// SPDX-License-Identifier: MIT
// What a message does: the strikes it becomes, the words of its refusals, and that what was felt is rendered
// again.
#include "Core/Samples.h"
#include "FakeHost.h"
#include "Io/Text/NameList.h"
#include "Live/Documents/InputLine.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Messages/MessageValues.h"
#include "Live/Session/SessionRender.h"
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <thread>

namespace physvib::messages_test {

using namespace test;

PlainMessage messageOf(std::string_view line) {
    const auto read = readInputLine(line, {}, hostChannels);
    EXPECT_EQ(read.error, "");
    const auto* message = std::get_if<PlainMessage>(&read.value);
    return message != nullptr ? *message : PlainMessage{};
}

SessionSetup quietSetup() {
    auto setup = emptyBoxSetup(0.05);
    setup.scene.materials.push_back(
        {.name = "bell", .densityKgPerSquareMetre = 850, .frequencyHz = 220, .decayPerSecond = 12});
    return setup;
}

std::vector<CollisionEvent> strikesOfLine(std::string_view line, const SessionSetup& setup = quietSetup()) {
    const PlainMessage message = messageOf(line);
    const auto found = std::ranges::find(messageTable, message.name, &MessageDescription::name);
    return std::get<MessageDescription::Strikes*>(found->action)({message, *found, setup.panner},
                                                                 setup.scene.materials, setup.shaping);
}

/// A prepared session, and what takes its messages.
struct Routed {
    explicit Routed(const SessionSetup& setup = quietSetup())
        : session{setup} {
        session.prepare(hostRate, 512);
    }
    Result<PlainMessage> take(std::string_view line, const ClipSource& clips = {}) {
        return router.handle(messageOf(line), nullptr, clips);
    }
    Session session;
    MessageRouter router{session};
};

TEST(Messages, APathThatLagsSaysSo) {
    Routed routed;
    EXPECT_EQ(routed.take(R"({"message": "path", "places": "AB"})").value.name, "") << "equal follows";
    EXPECT_EQ(routed.take(R"({"message": "path", "places": "AB", "law": "energy"})").value.name, "");
    const auto note = routed.take(R"({"message": "path", "places": "AB", "law": "linear"})").value;
    ASSERT_EQ(note.name, "path");
    EXPECT_NE(answerLine(note).find(
                  "law: linear lags: felt at 0.16 of the way between two actuators where 0.3 is meant"),
              std::string::npos)
        << answerLine(note);
}

TEST(Messages, APathOverARowIsSharedByNeighboursUnlessALawIsNamed) {
    constexpr std::string_view path = R"({"message": "path", "places": "AD"})",
                               equal = R"({"message": "path", "places": "AD", "law": "equal"})";
    EXPECT_EQ(strikesOfLine(path)[0].spread, Spread::equal) << "on four corners";
    auto setup = quietSetup();
    ActuatorLayout row{1.0, 1.0, 4, {{{0.0, 0.5}, {0.2, 0.5}, {0.6, 0.5}, {1.0, 0.5}}}};
    setup.panner = {row, PanningLaw::linear, 1.0, 1.0, 1.0};
    EXPECT_EQ(strikesOfLine(path, setup)[0].spread, spreadBy(PanningLaw::neighbours));
    EXPECT_EQ(strikesOfLine(equal, setup)[0].spread, Spread::equal);
    Routed routed{setup};
    EXPECT_EQ(routed.take(path).value.name, "");
    EXPECT_NE(answerLine(routed.take(equal).value).find("equal lags on this layout"), std::string::npos);
}

TEST(Messages, ActuatorsInSpaceAreFoundByTheirLetters) {
    for (const char* const name : {"glove5", "sleeve8", "vest16"}) {
        ActuatorLayout layout;
        ASSERT_TRUE(layoutPreset(name, layout));
        auto setup = quietSetup();
        setup.panner = {layout, PanningLaw::automatic, 1.0, 2.0 * layout.extentWidthMetres,
                        2.0 * layout.extentHeightMetres};
        std::string letters;
        for (int j = 0; j < layout.count; ++j) letters += static_cast<char>('A' + j);
        const auto expectAlone = [&](const CollisionEvent& event, int j) {
            PhantomPanner::Gains gains{};
            setup.panner.gainsAt(event, gains);
            for (int k = 0; k < layout.count; ++k)
                EXPECT_NEAR(gains[static_cast<std::size_t>(k)], k == j, 1e-9) << name << ' ' << j << ' ' << k;
        };
        const auto pulses = strikesOfLine(
            R"({"message": "pattern", "pulse_s": 0.1, "enchanters": ")" + letters + "\"}", setup);
        const auto path =
            strikesOfLine(R"({"message": "path", "law": "alone", "places": ")" + letters + "\"}", setup);
        ASSERT_EQ(std::ssize(pulses), layout.count);
        ASSERT_EQ(std::ssize(path), layout.count - 1);
        for (int j = 0; j < layout.count; ++j) expectAlone(pulses[static_cast<std::size_t>(j)], j);
        for (int j = 1; j < layout.count; ++j)
            expectAlone(movedAlong(path[static_cast<std::size_t>(j - 1)], 1.0), j);
    }
    for (const char* line : {R"({"message": "phantom", "part": "thumb"})",
                             R"({"message": "path", "places": "AB", "part": "thumb"})",
                             R"({"message": "strike", "frequency_hz": 180, "seconds": 1, "part": "thumb"})"})
        for (const CollisionEvent& each : strikesOfLine(line))
            EXPECT_EQ(each.source.part, partNamed("thumb")) << line;
    EXPECT_EQ(strikesOfLine(R"({"message": "phantom", "part": "part-7"})")[0].source.part, 7);
    const auto event = strikesOfLine(R"({"message": "phantom", "place": [1, 2, 3]})")[0];
    EXPECT_EQ(event.source.part, 0);
    EXPECT_EQ(std::tuple(event.x, event.y, event.z), std::tuple(1.0, 2.0, 3.0));
}

TEST(Messages, AStrikeIsOfAMaterialOrOfNumbers) {
    const auto ofMaterial =
        strikesOfLine(R"({"message": "strike", "material": "bell", "place": "A", "level": 0.25})");
    ASSERT_EQ(ofMaterial.size(), 1u);
    EXPECT_EQ(ofMaterial[0].frequencyHz, 220.0);
    EXPECT_EQ(ofMaterial[0].decayPerSecond, 12.0);
    EXPECT_EQ(ofMaterial[0].amplitude, 0.25);
    EXPECT_EQ(ofMaterial[0].x, 0.0);
    EXPECT_EQ(ofMaterial[0].y, quietSetup().scene.fieldHeightMetres);
    const auto ofNumbers = strikesOfLine(
        R"({"message": "strike", "frequency_hz": 180, "decay_per_s": 30, "place": [1, 0.5], "seconds": 0.2, "law": "energy"})");
    ASSERT_EQ(ofNumbers.size(), 1u);
    EXPECT_EQ(ofNumbers[0].frequencyHz, 180.0);
    EXPECT_EQ(ofNumbers[0].durationNs, 200'000'000);
    EXPECT_EQ(ofNumbers[0].x, 1.0);
    EXPECT_EQ(ofNumbers[0].spread, spreadBy(PanningLaw::energy));
}

TEST(Messages, APatternIsOnItsEnchantersAlone) {
    const auto strikes = strikesOfLine(R"({"message": "pattern", "pattern": "ADA-250"})");
    ASSERT_EQ(strikes.size(), 3u);
    const auto setup = quietSetup();
    constexpr int on[] = {0, 3, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(strikes[k].timeNs, static_cast<std::int64_t>(k) * 350'000'000);
        EXPECT_EQ(strikes[k].durationNs, 251'219'512) << "103 half periods of 205 Hz";
        PhantomPanner::Gains gains{};
        setup.panner.gainsAt(strikes[k].x, strikes[k].y, strikes[k].spread, gains);
        for (int j = 0; j < hostChannels; ++j)
            EXPECT_EQ(gains[static_cast<std::size_t>(j)], j == on[k] ? 1.0 : 0.0);
    }
    const auto own =
        strikesOfLine(R"({"message": "pattern", "enchanters": "ABCDDCBA", "pulse_s": 0.05, "gap_s": 0})");
    ASSERT_EQ(own.size(), 8u);
    EXPECT_EQ(own[7].timeNs, 350'000'000);
}

TEST(Messages, APathIsOneToneFromSegmentToSegment) {
    const auto segments =
        strikesOfLine(R"({"message": "path", "places": [[0, 0], [3, 0], [3, 0], [3, 1]], "seconds": 2})");
    ASSERT_EQ(segments.size(), 2u) << "where it does not go there is no leg";
    EXPECT_EQ(segments[0].durationNs, 1'500'000'000);
    EXPECT_EQ(segments[1].timeNs, segments[0].durationNs);
    EXPECT_EQ(segments[1].course.toneAgeNs, segments[0].durationNs);
    EXPECT_EQ(segments[1].durationNs, 500'000'000);
    EXPECT_EQ(segments[1].course.travelNs, segments[1].durationNs);
    EXPECT_EQ(segments[1].course.toY, 1.0);
    EXPECT_EQ(segments[0].spread, Spread::equal);
    const auto bySpeed =
        strikesOfLine(R"({"message": "path", "places": [[0, 0], [3, 0]], "speed_m_per_s": 1.5})");
    EXPECT_EQ(bySpeed.at(0).durationNs, 2'000'000'000);
    const auto byTimes = strikesOfLine(R"({"message": "path", "places": "ABD", "times_s": [0.5, 0.75, 2]})");
    ASSERT_EQ(byTimes.size(), 2u);
    EXPECT_EQ(byTimes[0].timeNs, 500'000'000);
    EXPECT_EQ(byTimes[1].timeNs, 750'000'000);
    EXPECT_EQ(byTimes[1].course.toneAgeNs, 250'000'000);
}

/// The largest step between two samples of a channel, in steps of the tone itself at that level.
double largestStep(const SessionSetup& setup, const std::string& line, double frequencyHz, double seconds);

TEST(Messages, WhatIsCutBeginsAndEndsWithoutAStep) {
    auto remapped = quietSetup();
    remapped.shaping.remap.band = {100.0, 200.0};
    const std::pair<std::string, double> lines[] = {
        {R"({"message": "pattern", "pattern": "ABA-250", "level": 1})", 205.0},
        {R"({"message": "pattern", "enchanters": "ABCDDCBA", "pulse_s": 0.05, "gap_s": 0, "frequency_hz": 173.3, "level": 1})",
         173.3},
        {R"({"message": "pattern", "enchanters": "AD", "pulse_s": 0.001, "frequency_hz": 40, "level": 1})",
         40.0},
        {R"({"message": "phantom", "place": "A", "seconds": 0.7, "frequency_hz": 207.3, "level": 1})", 207.3},
        {R"({"message": "strike", "frequency_hz": 90, "decay_per_s": 3, "seconds": 0.3, "place": "A", "level": 1})",
         90.0},
        {R"({"message": "strike", "material": "bell", "seconds": 0.011, "place": "A", "level": 1})", 220.0},
        {R"({"message": "path", "places": "ABDC", "seconds": 0.7, "frequency_hz": 207.3, "level": 1})",
         207.3},
        {R"({"message": "path", "places": "ABD", "times_s": [0, 0.5, 0.51], "frequency_hz": 207.3, "level": 1})",
         207.3},
        // two at a time
        {R"({"message": "path", "places": "AD", "seconds": 0.7, "strokes": 5, "frequency_hz": 61.7, "level": 0.5, "law": "alone"})",
         61.7},
    };
    for (const auto& [line, hz] : lines) {
        EXPECT_LT(largestStep(quietSetup(), line, hz, 1.3), 1.3) << line;
        EXPECT_LT(largestStep(remapped, line, remapped.shaping.remap(hz), 1.3), 1.3) << "remapped: " << line;
    }
}

TEST(Messages, APathThatIsCutGoesOnAtItsSpeed) {
    const auto longer = strikesOfLine(R"({"message": "path", "places": "AB", "seconds": 0.25})"),
               shorter = strikesOfLine(R"({"message": "path", "places": "AB", "seconds": 0.249})");
    EXPECT_EQ(longer[0].course.travelNs, 250'000'000);
    EXPECT_EQ(longer[0].durationNs, 251'219'512) << "it stays where it is for the rest";
    EXPECT_EQ(shorter[0].course.travelNs, 249'000'000);
    EXPECT_EQ(shorter[0].durationNs, 248'780'488);
    const auto segments = strikesOfLine(
        R"({"message": "path", "places": "ABD", "times_s": [0, 0.5, 0.5001], "frequency_hz": 61.7})");
    ASSERT_EQ(segments.size(), 2u);
    EXPECT_EQ(segments[0].durationNs, 500'000'000) << "legs join where they did";
    EXPECT_NEAR(static_cast<double>(segments[1].course.toneAgeNs + segments[1].durationNs) * 2e-9 * 61.7,
                62.0, 1e-6);
    EXPECT_EQ(strikesOfLine(
                  R"({"message": "path", "places": "ABD", "times_s": [0, 0.5, 0.5001], "frequency_hz": 61})")
                  .size(),
              1u)
        << "the last leg lies after the end";
}

TEST(Messages, StrokesHaveTactileBrushsTiming) {
    for (const int count : {2, 5, 9}) {
        const auto strokes = strikesOfLine(
            R"({"message": "path", "places": "AB", "seconds": 1, "strokes": )" + std::to_string(count) + "}");
        ASSERT_EQ(strokes.size(), static_cast<std::size_t>(count));
        constexpr double quarter = 0.25 / 205.0 + 2e-9; // to the nearest crossing
        const double length = strokeSeconds(count, 1.0);
        for (std::size_t k = 0; k < strokes.size(); ++k) {
            const double onset = static_cast<double>(k) * (0.32 * length + 0.0473);
            EXPECT_NEAR(static_cast<double>(strokes[k].timeNs) * 1e-9, onset, quarter);
            EXPECT_NEAR(static_cast<double>(strokes[k].timeNs + strokes[k].durationNs) * 1e-9, onset + length,
                        quarter);
            EXPECT_EQ(strokes[k].course.toneAgeNs, strokes[k].timeNs);
        }
        EXPECT_NEAR(static_cast<double>(strokes.back().timeNs + strokes.back().durationNs) * 1e-9, 1.0,
                    quarter);
        EXPECT_EQ(strokes.back().x, quietSetup().scene.fieldWidthMetres);
    }
}

TEST(Messages, RefusalsNameTheValueAndWhatWasExpected) {
    Routed routed;
    EXPECT_EQ(routed.take(R"({"message": "knock"})").error,
              "\"knock\": expected one of " + nameList(entryNames(messageTable)));
    const std::tuple<std::string, std::string, std::string> refusals[]{
        {"strike", R"("material": "cheese")",
         "material: expected a material of the scene that vibrates, found \"cheese\""},
        {"strike", "", "material: expected a material, or frequency_hz"},
        {"strike", R"("frequency_hz": 100)", "seconds: expected a length, or a decay: it would not end"},
        {"strike", R"("frequency_hz": 100, "material": "x")",
         "frequency_hz: expected either this or material"},
        {"phantom", R"("level": 3)", "level: expected 0 to 1, found 3"},
        {"phantom", R"("frequency_hz": 4.9)", "frequency_hz: expected 5 to 20000, found 4.9"},
        {"strike", R"("frequency_hz": 2, "seconds": 60)",
         "frequency_hz: expected at least 5 Hz, or a decay of at least 1 per second, found 2 Hz"},
        {"strike", R"("frequency_hz": 2, "decay_per_s": 0.001)",
         "frequency_hz: expected at least 5 Hz, or a decay of at least 1 per second, found 2 Hz"},
        {"phantom", R"("levle": 3)", "has no \"levle\""},
        {"phantom", R"("place": "Q")", "place: expected letters from A to D, found \"Q\""},
        {"phantom", R"("place": [1])",
         "place: expected x and y, or x, y and z in metres, or an actuator's letter"},
        {"phantom", R"("place": [1, 2, 3, 4])",
         "place: expected x and y, or x, y and z in metres, or an actuator's letter"},
        {"phantom", R"("law": "flat")", "law: expected one of " + nameList(spreadNames) + ", found \"flat\""},
        {"pattern", R"("pattern": "AB")",
         "pattern: expected one like ABA-250 (one to three actuators, then milliseconds), found \"AB\""},
        {"path", R"("places": "A")", "places: expected 2 to 64 places, found 1"},
        {"path", R"("places": "AA")", "places: expected places that are not all the same"},
        {"path", R"("places": "AB", "times_s": [1])", "times_s: expected 2 times, one per place, found 1"},
        {"path", R"("places": "AB", "times_s": [1, 1])", "times_s: expected rising numbers, found 1 after 1"},
        {"path", R"("places": "AB", "seconds": 0.1, "strokes": 9)",
         "strokes: expected so few that each lasts 0.01 s, found 9 in 0.1 s"},
        {"path", R"("places": "AB", "speed_m_per_s": 0.001)",
         "speed_m_per_s: expected a path of at most 3600 s, found 6400"},
        {"stop", R"("at": "soon")", "at: expected a session time, or now"},
        {"stop", R"("at": 1, "in": 1)", "in: expected either this or at"},
        {"status", R"("at": 1)", "has no \"at\""},
    };
    for (const auto& [name, values, why] : refusals) {
        const std::string line = R"({"message": ")" + name + (values.empty() ? "\"" : "\", ") + values + '}';
        EXPECT_EQ(routed.take(line).error, name + ": " + why) << line;
    }
}

/// "NAME.channels": so many channels of a tone that no other name has.
Result<LoadedClip> clipOf(const std::string& name) {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) return Failure{name + ": cannot be read"};
    LoadedClip clip;
    for (int j = 0; j < std::stoi(name.substr(dot + 1)); ++j) {
        ContactRecording& channel = clip.channels.emplace_back();
        channel.sampleRateHz = 24'000;
        for (int n = 0; n < 9'600; ++n)
            channel.samples.push_back(0.3f *
                                      std::sin(0.001f * static_cast<float>(n * (20 + j + name[0] % 16))));
        channel.file = {.path = name, .hash = "0123456789abcdef"};
    }
    return clip;
}

LoadedRecordings loadedAgain(const SessionLog& log) {
    LoadedRecordings loaded;
    for (const ClipFile& clip : log.clips)
        loaded.clips.push_back(
            clipOf(clip.file.path).value.channels.at(static_cast<std::size_t>(clip.channel)));
    return loaded;
}

struct Played {
    Interleaved signal;
    SessionLog log;
    std::vector<CollisionEvent> events;
};

/// Lines at session times, in seconds; blocks of random size.
Played play(Session& session, std::multimap<double, std::string> lines, double seconds,
            std::function<void(SessionLog&)> read = {}, RenderMode mode = RenderMode::realtime) {
    Played played;
    Random random{5};
    Block block;
    session.prepare(hostRate, 512);
    session.advance();
    MessageRouter router{session};
    const auto frames = static_cast<std::int64_t>(seconds * hostRate);
    for (std::int64_t done = 0; done < frames;) {
        for (; !lines.empty() && static_cast<double>(done) / hostRate >= lines.begin()->first;
             lines.erase(lines.begin()))
            EXPECT_EQ(router.handle(messageOf(lines.begin()->second), nullptr, clipOf).error, "")
                << lines.begin()->second;
        session.advance();
        const int size = static_cast<int>(std::min<std::int64_t>(frames - done, 1 + random.below(512)));
        session.render(block.at.data(), size, mode);
        append(played.signal, block.at.data(), size);
        done += size;
        for (const auto& event : drain(session)) played.events.push_back(event);
        if (read) read(played.log);
    }
    session.readLog(played.log);
    return played;
}

Interleaved renderedAgain(const SavedSession& session, std::int64_t delayFrames, double seconds) {
    Interleaved signal(static_cast<std::size_t>(delayFrames * hostChannels), 0.0f);
    renderSession(
        session, loadedAgain(session.log),
        {hostRate, seconds - static_cast<double>(delayFrames) / hostRate, [](double) { return true; }},
        [&](const float* const* block, int n) {
            append(signal, block, n);
            return true;
        });
    return signal;
}

double largestStep(const SessionSetup& setup, const std::string& line, double frequencyHz, double seconds) {
    Session session{setup};
    const Interleaved signal = play(session, {{0.1, line}}, seconds).signal;
    double most = 0.0;
    for (std::size_t i = hostChannels; i < signal.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(signal[i]) - signal[i - hostChannels]));
    EXPECT_GT(peakOf(signal), 0.5f) << line;
    return most / (2.0 * std::numbers::pi * frequencyHz / hostRate);
}

const std::multimap<double, std::string> everything{
    {0.1, R"({"message": "strike", "frequency_hz": 180, "decay_per_s": 30, "place": [1, 1]})"},
    {0.2, R"({"message": "path", "places": "ABDC", "seconds": 1.1, "frequency_hz": 207.3})"},
    {0.25,
     R"({"message": "path", "places": [[0, 0], [5, 2]], "seconds": 0.7, "strokes": 5, "frequency_hz": 250})"},
    {0.3, R"({"message": "pattern", "pattern": "ABA-100", "at": 1.5})"},
    {0.3, R"({"message": "stop", "at": 1.55})"},
    {0.4, R"({"message": "phantom", "place": "C", "seconds": 3, "in": 1.4})"},
    {0.5, R"({"message": "path", "places": "DA", "seconds": 2, "at": 2, "level": 0.3})"},
    {0.6, R"({"message": "clip", "file": "a.1", "place": "B"})"},
    {0.7, R"({"message": "clip", "file": "b.4", "level": 0.5, "in": 0.2})"},
    {2.05, R"({"message": "clip", "file": "a.1", "law": "energy"})"},
    {2.1, R"({"message": "stop"})"},
    {2.1, R"({"message": "strike", "frequency_hz": 99, "decay_per_s": 20})"},
    {2.3, R"({"message": "clip", "file": "c.1", "place": [1, 1]})"},
};

TEST(Messages, WhatWasFeltIsRenderedAgainToTheBit) {
    const auto setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    const auto felt = play(session, everything, 3.0);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_GT(felt.log.strikes.size(), 10u);
    const std::string text = sessionJson(saved(setup, felt.log, 3'000'000'000));
    const auto read = readSession(text, "session.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(sessionJson(read.value), text);
    const auto again = renderedAgain(read.value, session.timeline().outputLatencyFrames(), 3.0);
    ASSERT_EQ(again.size(), felt.signal.size());
    const auto differs = std::mismatch(again.begin(), again.end(), felt.signal.begin());
    EXPECT_TRUE(differs.first == again.end())
        << "at frame " << (differs.first - again.begin()) / hostChannels;
}

// A world's hit of rubber has half a sine against its mean; a strike has none, felt or rendered.
TEST(Messages, WithAFixedLevelOfEachHitAStrikeIsRenderedAsItWasFelt) {
    auto setup = quietSetup();
    ASSERT_TRUE(parseRenderingMethod("AF-FV-DRV", setup.shaping.method));
    setup.shaping.method.fixedAmplitude = 0.9;
    Session session{setup};
    const auto felt =
        play(session, {{0.1, R"({"message": "strike", "frequency_hz": 80, "decay_per_s": 34})"}}, 0.6);
    EXPECT_GT(peakOf(felt.signal), 0.1f);
    EXPECT_TRUE(renderedAgain(saved(setup, felt.log, 600'000'000), session.timeline().outputLatencyFrames(),
                              0.6) == felt.signal);
}

TEST(Messages, AClipIsFeltBesideWhatSounds) {
    Session without{quietSetup()}, with{quietSetup()}, alone{quietSetup()};
    const std::string first = R"({"message": "clip", "file": "a.1", "place": "A"})",
                      second = R"({"message": "clip", "file": "b.1", "place": "D", "level": 0.5})";
    const auto one = play(without, {{0.1, first}}, 1.0), other = play(alone, {{0.2, second}}, 1.0),
               both = play(with, {{0.1, first}, {0.2, second}}, 1.0);
    ASSERT_EQ(both.signal.size(), one.signal.size());
    double most = 0.0;
    for (std::size_t i = 0; i < both.signal.size(); ++i)
        most =
            std::max(most, std::abs(static_cast<double>(both.signal[i]) - one.signal[i] - other.signal[i]));
    EXPECT_LE(most, 1e-6) << "the first fades, or the second is not there";
    EXPECT_NEAR(peakOf(one.signal), 0.3f, 0.01f);
    EXPECT_EQ(both.log.clips.size(), 2u);
}

TEST(Messages, WhatWasTakenAwayOfAClipIsAnswered) {
    Routed routed;
    const auto answerOf = [&](const std::string& note) {
        return routed.take(R"({"message": "clip", "file": "a.1"})", [&](const std::string& name) {
            auto clip = clipOf(name);
            for (ContactRecording& channel : clip.value.channels) channel.note = note;
            return clip;
        });
    };
    EXPECT_EQ(answerOf("").value, PlainMessage{});
    EXPECT_EQ(answerOf("a.1: a mean of 1.00").value,
              (PlainMessage{"clip", {{"note", "a.1: a mean of 1.00"}}}));
}

TEST(Messages, AClipIsNoCollision) { // of a scene with a gain, a method and a level
    auto setup = quietSetup();
    setup.shaping.gain = 0.25;
    setup.shaping.remap.band = {100.0, 200.0};
    setup.shaping.method.fixedAmplitude = 0.9;
    Session session{setup};
    const auto felt = play(session, {{0.1, R"({"message": "clip", "file": "a.1", "place": "A"})"}}, 0.8);
    EXPECT_NEAR(peakOf(felt.signal), 0.3f, 0.01f);
    ASSERT_EQ(felt.log.strikes.size(), 1u);
    EXPECT_EQ(felt.log.strikes[0].amplitude, 1.0);
}

TEST(Messages, ClipsAreBounded) {
    Routed routed;
    const auto clip = [&](const std::string& name, const ClipSource& source) {
        return routed.take(R"({"message": "clip", "place": "A", "file": ")" + name + "\"}", source).error;
    };
    EXPECT_EQ(clip("a.1", {}), "clip: file: expected no clips here: no folder was given to read them from");
    EXPECT_EQ(clip("a", clipOf), "clip: file: a: cannot be read");
    EXPECT_EQ(routed.take(R"({"message": "clip"})", clipOf).error, "clip: file: expected a file's name");
    EXPECT_EQ(routed.take(R"({"message": "clip", "file": "a.3"})", clipOf).error,
              "clip: file: expected one channel, places, or as many channels as actuators, 4, found 3");
    for (int i = 0; i < 7; ++i) EXPECT_EQ(clip(std::to_string(i) + ".4", clipOf), "");
    EXPECT_EQ(clip("3.4", clipOf), "") << "it is kept already";
    EXPECT_EQ(clip("x.5", clipOf),
              "clip: file: expected no more than 32 channels of clips in a session, and 32000000 samples");
    EXPECT_EQ(clip("y.4", clipOf), "") << "nothing of what found no room was kept";
    SessionLog log;
    routed.session.readLog(log);
    EXPECT_EQ(log.clips.size(), 32u);
}

/// Whether another thread may ask, again and again, while this is done.
bool othersAskDuring(const std::function<void()>& work, const std::function<void()>& ask) {
    std::atomic<bool> isDone{false};
    std::atomic<int> asked{0};
    std::thread other{[&] {
        for (; !isDone; ++asked) ask();
    }};
    while (asked == 0) std::this_thread::yield();
    const int before = asked;
    work();
    const int during = asked - before;
    isDone = true;
    other.join();
    return during > 100;
}

TEST(Messages, NobodyWaitsForAClipThatIsReadAndBroughtToTheSessionsRate) {
    Routed routed;
    const ContactRecording minute{
        0.0, 44'100, std::vector<float>(300'000, 0.1f), {.path = "minute", .hash = "0123456789abcdef"}};
    EXPECT_TRUE(othersAskDuring(
        [&] {
            EXPECT_EQ(routed.session.addClip({&minute, 1}), 0);
        },
        [&] { routed.session.timeline().presentNs(); }));
    std::future<std::string> other;
    const ClipSource slow = [&](const std::string&) {
        other = std::async(std::launch::async,
                           [&] { return routed.take(R"({"message": "phantom", "in": 2})").error; });
        EXPECT_EQ(other.wait_for(std::chrono::seconds{60}), std::future_status::ready)
            << "another message waits for the file";
        return Result<LoadedClip>{Failure{"read"}};
    };
    EXPECT_EQ(routed.take(R"({"message": "clip", "file": "x"})", slow).error, "clip: file: read");
    EXPECT_EQ(other.get(), "");
}

TEST(Messages, ATimeThatIsOverIsRefusedBeforeAFileIsRead) {
    Session session{quietSetup()};
    play(session, {}, 0.5);
    MessageRouter router{session};
    EXPECT_EQ(router.handle(messageOf(R"({"message": "phantom", "at": 0.25})")).error,
              "phantom: at: expected a session time that is not over: it is 0.500 s, found 0.25 s");
    int reads = 0;
    const ClipSource counting = [&](const std::string& name) { return ++reads, clipOf(name); };
    EXPECT_NE(router.handle(messageOf(R"({"message": "clip", "file": "a.1", "at": 0.1})"), nullptr, counting)
                  .error.find("clip: at: "),
              std::string::npos);
    EXPECT_EQ(reads, 0);
}

TEST(Messages, ClipsComeWhileBlocksAreRendered) {
    Routed routed;
    Session& session = routed.session;
    std::atomic<bool> isDone{false};
    std::thread door{[&] {
        for (int i = 0; i < 32; ++i)
            EXPECT_TRUE(
                routed.take(R"({"message": "clip", "file": ")" + std::to_string(i) + R"(.1"})", clipOf));
        isDone = true;
    }};
    Block block;
    std::size_t played = 0;
    for (int after = 0; after < 200; after += isDone) {
        session.advance();
        session.render(block.at.data(), 512, RenderMode::realtime);
        played += drain(session).size();
    }
    door.join();
    EXPECT_EQ(played, 32u);
}

TEST(Messages, ASavedClipIsReadAsStrictlyAsTheRest) {
    const auto setup = quietSetup();
    Session session{setup};
    const auto felt = play(session, {{0.1, R"({"message": "clip", "file": "b.4"})"}}, 0.5);
    const std::string text = sessionJson(saved(setup, felt.log, 500'000'000));
    const auto read = readSession(text, "s.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(read.value.log.clips, felt.log.clips);
    const auto changed = [&](const std::string& from, const std::string& to) {
        return readSession(textWith(text, from, to), "s.json").error;
    };
    EXPECT_EQ(changed(R"("channel": 2)", R"("channel": 64)"),
              "s.json: clips[2].channel: expected 0 to 63, found 64");
    EXPECT_EQ(changed(R"("sound": 1,)", R"("sound": -1,)").substr(0, 26), "s.json: strikes[0].sound: ");
    EXPECT_EQ(changed(R"("clips": [)", R"("clips": [1, )").substr(0, 18), "s.json: clips[0]: ");
    for (const char* older : {"4", "5"}) {
        Session without{setup};
        const std::string now = sessionJson(
            saved(setup, play(without, {{0.1, R"({"message": "phantom"})"}}, 0.5).log, 500'000'000));
        const std::string version = "\"physvib_session\": ",
                          old =
                              textWith(now, version + std::to_string(sessionFormatVersion), version + older);
        EXPECT_EQ(readSession(old, "s.json").error, "") << older;
    }
}

TEST(Messages, AHostThatDoesNotPlayInRealTimeGetsTheSame) {
    Session live{shakeTheBoxSetup(0.05)}, bounced{shakeTheBoxSetup(0.05)};
    EXPECT_TRUE(play(live, everything, 3.0).signal ==
                play(bounced, everything, 3.0, {}, RenderMode::offline).signal);
}

TEST(Messages, TheJournalHoldsThem) {
    const auto setup = quietSetup();
    Session session{setup};
    JournalLines lines{saved(setup, {}, 0), {}};
    std::string text = lines.head();
    auto felt = play(session, everything, 3.0,
                     [&](SessionLog& log) { text += lines.nextLines(log, session.readLog(log)); });
    text += lines.nextLines(felt.log, 3'000'000'000);
    const auto read = readSession(text, "journal");
    ASSERT_EQ(read.error, "");
    const auto again = renderedAgain(read.value, session.timeline().outputLatencyFrames(), 3.0);
    EXPECT_TRUE(again == felt.signal);
}

TEST(Messages, AStopForgetsWhatHasNotBegun) {
    Session session{quietSetup()};
    const auto felt =
        play(session,
             {{0.1, R"({"message": "pattern", "enchanters": "ABCD", "pulse_s": 0.1, "gap_s": 0.1})"},
              {0.1, R"({"message": "phantom", "seconds": 0.1, "frequency_hz": 300, "at": 0.9})"},
              {0.35, R"({"message": "stop", "at": 0.65})"},
              {0.36, R"({"message": "phantom", "seconds": 0.1, "frequency_hz": 400, "at": 0.8})"}},
             1.2);
    std::vector<double> hz;
    for (const auto& event : felt.events) hz.push_back(event.frequencyHz);
    EXPECT_EQ(hz, (std::vector<double>{205, 205, 205, 400}))
        << "the fourth pulse and the phantom of 300 Hz were asked for before the stop";
    EXPECT_EQ(session.world().size().strikes, 0u);
}

TEST(Messages, OfOneMomentTheSecondActsOnTheFirst) {
    Session session{quietSetup()};
    const auto felt = play(session,
                           {{0.1, R"({"message": "phantom", "seconds": 1, "frequency_hz": 300})"},
                            {0.1, R"({"message": "stop"})"},
                            {0.1, R"({"message": "strike", "frequency_hz": 99, "decay_per_s": 2})"}},
                           1.0);
    ASSERT_EQ(felt.events.size(), 2u);
    const float late = peakOf(std::span{felt.signal}.subspan(felt.signal.size() / 2)); // of half a second
    EXPECT_GT(late, 0.01f) << "what came after the stop sounds";
    EXPECT_LT(late, 0.25f * 0.5f + 0.01f) << "what came before does not";
}

TEST(Messages, QueriesAnswer) {
    const auto setup = quietSetup();
    Session session{setup};
    play(session, {}, 0.5);
    MessageRouter router{session};
    EXPECT_EQ(router.handle(messageOf(R"({"message": "phantom", "in": 2})")).error, "");
    EXPECT_EQ(
        answerLine(router.handle({"status", {}}).value),
        R"({ "answer": "status", "session_s": 0.5, "waiting": 1, "bodies": 0, "lost": 0, "stalls_s": 0, "dropped": 0 })");
    const auto latency = router.handle({"latency", {}}).value;
    EXPECT_EQ(std::get<double>(latency.values.at(0).value),
              static_cast<double>(session.timeline().outputLatencyFrames()) / hostRate);
    const auto layout = router.handle({"layout", {}}).value;
    EXPECT_EQ(std::get<std::string>(layout.values.at(0).value), "linear");
    EXPECT_EQ(std::get<std::vector<double>>(layout.values.at(3).value),
              (std::vector<double>{0, setup.scene.fieldHeightMetres, setup.scene.fieldWidthMetres,
                                   setup.scene.fieldHeightMetres, 0, 0, setup.scene.fieldWidthMetres, 0}));
}

} // namespace physvib::messages_test
