// SPDX-License-Identifier: MIT
// What a message does: the strikes it becomes, the words of its refusals, and that what was felt is rendered again.
#include "FakeHost.h"
#include "Files/SessionFile.h"
#include "Files/SessionJournalText.h"
#include "Files/Text/InputLine.h"
#include "Session/Messages/MessageRouter.h"
#include "Session/Messages/MessageStrikes.h"
#include "Session/SessionRender.h"
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace physvib {
namespace {

using namespace test;

PlainMessage messageOf(std::string_view line) {
    const auto read = readInputLine(line, "line", {}, hostChannels);
    EXPECT_EQ(read.error, "");
    const auto* message = std::get_if<PlainMessage>(&read.value);
    return message != nullptr ? *message : PlainMessage{};
}

/// A scene in which nothing moves: what is felt is what messages ask for.
SessionSetup quietSetup() {
    auto setup = shakeTheBoxSetup(0.05);
    setup.scene.bodies.clear();
    setup.scene.script.clear();
    setup.scene.joints.clear();
    setup.scene.materials.push_back({.name = "bell", .densityKgPerSquareMetre = 850, .frequencyHz = 220, .decayPerSecond = 12});
    return setup;
}

std::vector<CollisionEvent> strikesOfLine(std::string_view line) {
    const auto setup = quietSetup();
    const PlainMessage message = messageOf(line);
    const auto found = std::ranges::find(messageTable, message.name, &MessageDescription::name);
    return strikesOf(static_cast<MessageKind>(found - messageTable.begin()), {message, *found, setup.panner}, setup.scene.materials);
}

std::string refusalOf(std::string_view line) {
    Session session{quietSetup()};
    session.prepare(hostRate, 512);
    MessageRouter router{session};
    return router.take(messageOf(line)).error;
}

TEST(Messages, AStrikeIsOfAMaterialOrOfNumbers) {
    const auto ofMaterial = strikesOfLine(R"({"message": "strike", "material": "bell", "place": "A", "level": 0.25})");
    ASSERT_EQ(ofMaterial.size(), 1u);
    EXPECT_EQ(ofMaterial[0].frequencyHz, 220.0);
    EXPECT_EQ(ofMaterial[0].decayPerSecond, 12.0);
    EXPECT_EQ(ofMaterial[0].amplitude, 0.25);
    EXPECT_EQ(ofMaterial[0].x, 0.0);
    EXPECT_EQ(ofMaterial[0].y, quietSetup().scene.fieldHeightMetres);
    const auto ofNumbers = strikesOfLine(R"({"message": "strike", "frequency_hz": 180, "decay_per_s": 30, "place": [1, 0.5], "seconds": 0.2, "law": "energy"})");
    ASSERT_EQ(ofNumbers.size(), 1u);
    EXPECT_EQ(ofNumbers[0].frequencyHz, 180.0);
    EXPECT_EQ(ofNumbers[0].durationNs, 200'000'000);
    EXPECT_EQ(ofNumbers[0].x, 1.0);
    EXPECT_EQ(ofNumbers[0].course.spread, Spread::energy);
}

TEST(Messages, APatternIsOnItsEnchantersAlone) {
    const auto strikes = strikesOfLine(R"({"message": "pattern", "pattern": "ADA-250"})");
    ASSERT_EQ(strikes.size(), 3u);
    const auto setup = quietSetup();
    constexpr int on[] = {0, 3, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(strikes[k].timeNs, static_cast<std::int64_t>(k) * 350'000'000);
        EXPECT_EQ(strikes[k].durationNs, 250'000'000);
        PhantomPanner::Gains gains{};
        setup.panner.gainsAt(strikes[k].x, strikes[k].y, strikes[k].course.spread, gains);
        for (int j = 0; j < hostChannels; ++j) EXPECT_EQ(gains[static_cast<std::size_t>(j)], j == on[k] ? 1.0 : 0.0);
    }
    const auto own = strikesOfLine(R"({"message": "pattern", "enchanters": "ABCDDCBA", "pulse_s": 0.05, "gap_s": 0})");
    ASSERT_EQ(own.size(), 8u);
    EXPECT_EQ(own[7].timeNs, 350'000'000);
}

TEST(Messages, APathIsOneToneFromLegToLeg) {
    const auto legs = strikesOfLine(R"({"message": "path", "places": [[0, 0], [3, 0], [3, 0], [3, 1]], "seconds": 2})");
    ASSERT_EQ(legs.size(), 2u) << "where it does not go there is no leg";
    EXPECT_EQ(legs[0].durationNs, 1'500'000'000);
    EXPECT_EQ(legs[1].timeNs, legs[0].durationNs);
    EXPECT_EQ(legs[1].course.sinceNs, legs[0].durationNs);
    EXPECT_EQ(legs[1].durationNs, 500'000'000);
    EXPECT_EQ(legs[1].course.travelNs, legs[1].durationNs);
    EXPECT_EQ(legs[1].course.toY, 1.0);
    EXPECT_EQ(legs[0].course.spread, Spread::equal);
    const auto bySpeed = strikesOfLine(R"({"message": "path", "places": [[0, 0], [3, 0]], "speed_m_per_s": 1.5})");
    EXPECT_EQ(bySpeed.at(0).durationNs, 2'000'000'000);
    const auto byTimes = strikesOfLine(R"({"message": "path", "places": "ABD", "times_s": [0.5, 0.75, 2]})");
    ASSERT_EQ(byTimes.size(), 2u);
    EXPECT_EQ(byTimes[0].timeNs, 500'000'000);
    EXPECT_EQ(byTimes[1].timeNs, 750'000'000);
    EXPECT_EQ(byTimes[1].course.sinceNs, 250'000'000);
}

TEST(Messages, StrokesHaveTactileBrushsTiming) {
    for (const int count : {2, 5, 9}) {
        const auto strokes = strikesOfLine(R"({"message": "path", "places": "AB", "seconds": 1, "strokes": )" + std::to_string(count) + "}");
        ASSERT_EQ(strokes.size(), static_cast<std::size_t>(count));
        const double length = static_cast<double>(strokes[0].durationNs) * 1e-9;
        for (std::size_t k = 1; k < strokes.size(); ++k)
            EXPECT_NEAR(static_cast<double>(strokes[k].timeNs - strokes[k - 1].timeNs) * 1e-9, 0.32 * length + 0.0473, 2e-9);
        EXPECT_NEAR(static_cast<double>(strokes.back().timeNs + strokes.back().durationNs) * 1e-9, 1.0, 2e-9);
        EXPECT_EQ(strokes.back().x, quietSetup().scene.fieldWidthMetres);
    }
}

TEST(Messages, RefusalsNameTheValueAndWhatWasExpected) {
    const std::map<std::string, std::string> refusals{
        {R"({"message": "knock"})", "\"knock\": expected one of strike, pattern, phantom, path, stop, status, layout, latency"},
        {R"({"message": "strike", "material": "cheese"})", "strike: material: expected a material of the scene that vibrates, found \"cheese\""},
        {R"({"message": "strike"})", "strike: material: expected a material, or frequency_hz"},
        {R"({"message": "strike", "frequency_hz": 100})", "strike: seconds: expected a length, or a decay: it would not end"},
        {R"({"message": "strike", "frequency_hz": 100, "material": "x"})", "strike: frequency_hz: expected either this or material"},
        {R"({"message": "phantom", "level": 3})", "phantom: level: expected 0 to 1, found 3"},
        {R"({"message": "phantom", "levle": 3})", "phantom: has no \"levle\""},
        {R"({"message": "phantom", "place": "Q"})", "phantom: place: expected letters from A to D, found \"Q\""},
        {R"({"message": "phantom", "place": [1, 2, 3]})", "phantom: place: expected x and y in metres, or an enchanter's letter"},
        {R"({"message": "phantom", "law": "flat"})", "phantom: law: expected one of layout, linear, log, log-outer, energy, equal, alone, found \"flat\""},
        {R"({"message": "pattern", "pattern": "AB"})", "pattern: pattern: expected one like ABA-250 (one to three enchanters, then milliseconds), found \"AB\""},
        {R"({"message": "path", "places": "A"})", "path: places: expected 2 to 64 places, found 1"},
        {R"({"message": "path", "places": "AA"})", "path: places: expected places that are not all the same"},
        {R"({"message": "path", "places": "AB", "times_s": [1]})", "path: times_s: expected 2 times, one per place, found 1"},
        {R"({"message": "path", "places": "AB", "times_s": [1, 1]})", "path: times_s: expected rising numbers, found 1 after 1"},
        {R"({"message": "path", "places": "AB", "seconds": 0.1, "strokes": 9})", "path: strokes: expected so few that each lasts 0.01 s, found 9 in 0.1 s"},
        {R"({"message": "stop", "at": "soon"})", "stop: at: expected a session time, or now"},
        {R"({"message": "stop", "at": 1, "in": 1})", "stop: in: expected either this or at"},
        {R"({"message": "status", "at": 1})", "status: has no \"at\""},
    };
    for (const auto& [line, refusal] : refusals) EXPECT_EQ(refusalOf(line), refusal) << line;
}

struct Played {
    Interleaved signal;
    SessionLog log;
    std::vector<CollisionEvent> events;
};

/// Lines at session times, in seconds; blocks of random size.
Played play(Session& session, std::multimap<double, std::string> lines, double seconds, std::function<void(SessionLog&)> read = {}, RenderMode mode = RenderMode::realtime) {
    Played played;
    Random random{5};
    Block block;
    session.prepare(hostRate, 512);
    session.advance();
    MessageRouter router{session};
    const auto frames = static_cast<std::int64_t>(seconds * hostRate);
    for (std::int64_t done = 0; done < frames;) {
        for (; !lines.empty() && static_cast<double>(done) / hostRate >= lines.begin()->first; lines.erase(lines.begin()))
            EXPECT_EQ(router.take(messageOf(lines.begin()->second)).error, "") << lines.begin()->second;
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

SavedSession saved(const SessionSetup& setup, const SessionLog& log, double seconds) {
    return {setup.run(), setup.panner, setup.channels, setup.limiterEnabled, setup.ceilings, std::llround(seconds * 1e9), log, {}, setup.equalised, setup.shaping};
}

Interleaved renderedAgain(const SavedSession& session, std::int64_t delayFrames, double seconds) {
    Interleaved signal(static_cast<std::size_t>(delayFrames * hostChannels), 0.0f);
    renderSession(session, {}, {hostRate, seconds - static_cast<double>(delayFrames) / hostRate, [](double) { return true; }}, [&](const float* const* block, int n) {
        append(signal, block, n);
        return true;
    });
    return signal;
}

const std::multimap<double, std::string> everything{
    {0.1, R"({"message": "strike", "frequency_hz": 180, "decay_per_s": 30, "place": [1, 1]})"},
    {0.2, R"({"message": "path", "places": "ABDC", "seconds": 1.1, "frequency_hz": 207.3})"},
    {0.25, R"({"message": "path", "places": [[0, 0], [5, 2]], "seconds": 0.7, "strokes": 5, "frequency_hz": 250})"},
    {0.3, R"({"message": "pattern", "pattern": "ABA-100", "at": 1.5})"},
    {0.3, R"({"message": "stop", "at": 1.55})"},
    {0.4, R"({"message": "phantom", "place": "C", "seconds": 3, "in": 1.4})"},
    {0.5, R"({"message": "path", "places": "DA", "seconds": 2, "at": 2, "level": 0.3})"},
    {2.1, R"({"message": "stop"})"},
    {2.1, R"({"message": "strike", "frequency_hz": 99, "decay_per_s": 20})"},
};

TEST(Messages, WhatWasFeltIsRenderedAgainToTheBit) {
    const auto setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    const auto felt = play(session, everything, 3.0);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_GT(felt.log.strikes.size(), 10u);
    const std::string text = sessionJson(saved(setup, felt.log, 3.0));
    const auto read = readSession(text, "session.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(sessionJson(read.value), text);
    const auto again = renderedAgain(read.value, session.playOutFrames(), 3.0);
    ASSERT_EQ(again.size(), felt.signal.size());
    const auto differs = std::mismatch(again.begin(), again.end(), felt.signal.begin());
    EXPECT_TRUE(differs.first == again.end()) << "at frame " << (differs.first - again.begin()) / hostChannels;
}

TEST(Messages, AHostThatDoesNotPlayInRealTimeGetsTheSame) {
    Session live{shakeTheBoxSetup(0.05)}, bounced{shakeTheBoxSetup(0.05)};
    EXPECT_TRUE(play(live, everything, 3.0).signal == play(bounced, everything, 3.0, {}, RenderMode::offline).signal);
}

TEST(Messages, TheJournalHoldsThem) {
    const auto setup = quietSetup();
    Session session{setup};
    JournalLines lines{saved(setup, {}, 0.0), {}};
    std::string text = lines.head();
    auto felt = play(session, everything, 3.0, [&](SessionLog& log) { text += lines.take(log, session.readLog(log)); });
    text += lines.take(felt.log, 3'000'000'000);
    const auto read = readSession(text, "journal");
    ASSERT_EQ(read.error, "");
    const auto again = renderedAgain(read.value, session.playOutFrames(), 3.0);
    EXPECT_TRUE(again == felt.signal);
}

TEST(Messages, AStopForgetsWhatHasNotBegun) {
    Session session{quietSetup()};
    const auto felt = play(session,
                           {{0.1, R"({"message": "pattern", "enchanters": "ABCD", "pulse_s": 0.1, "gap_s": 0.1})"},
                            {0.1, R"({"message": "phantom", "seconds": 0.1, "frequency_hz": 300, "at": 0.9})"},
                            {0.35, R"({"message": "stop", "at": 0.65})"},
                            {0.36, R"({"message": "phantom", "seconds": 0.1, "frequency_hz": 400, "at": 0.8})"}},
                           1.2);
    std::vector<double> hz;
    for (const auto& event : felt.events) hz.push_back(event.frequencyHz);
    EXPECT_EQ(hz, (std::vector<double>{205, 205, 205, 400})) << "the fourth pulse and the phantom of 300 Hz were asked for before the stop";
    EXPECT_EQ(session.size().strikes, 0u);
}

TEST(Messages, OfOneMomentTheSecondActsOnTheFirst) {
    Session session{quietSetup()};
    const auto felt = play(session, {{0.1, R"({"message": "phantom", "seconds": 1, "frequency_hz": 300})"}, {0.1, R"({"message": "stop"})"}, {0.1, R"({"message": "strike", "frequency_hz": 99, "decay_per_s": 2})"}}, 1.0);
    ASSERT_EQ(felt.events.size(), 2u);
    double late = 0.0; // of the last half second
    for (std::size_t i = felt.signal.size() / 2; i < felt.signal.size(); ++i) late = std::max(late, static_cast<double>(std::abs(felt.signal[i])));
    EXPECT_GT(late, 0.01) << "what came after the stop sounds";
    EXPECT_LT(late, 0.25 * 0.5 + 0.01) << "what came before does not";
}

TEST(Messages, ATimeThatIsOverIsRefused) {
    Session session{quietSetup()};
    play(session, {}, 0.5);
    MessageRouter router{session};
    EXPECT_EQ(router.take(messageOf(R"({"message": "phantom", "at": 0.25})")).error, "phantom: at: expected a session time that is not over: it is 0.500 s, found 0.25 s");
}

TEST(Messages, QueriesAnswer) {
    const auto setup = quietSetup();
    Session session{setup};
    play(session, {}, 0.5);
    MessageRouter router{session};
    EXPECT_EQ(router.take(messageOf(R"({"message": "phantom", "in": 2})")).error, "");
    EXPECT_EQ(answerLine(router.take({"status", {}}).value), R"({ "answer": "status", "session_s": 0.5, "waiting": 1, "bodies": 0, "lost": 0, "stalls_s": 0 })");
    const auto latency = router.take({"latency", {}}).value;
    EXPECT_EQ(std::get<double>(latency.values.at(0).value), static_cast<double>(session.playOutFrames()) / hostRate);
    const auto layout = router.take({"layout", {}}).value;
    EXPECT_EQ(std::get<std::string>(layout.values.at(0).value), "linear");
    EXPECT_EQ(std::get<std::vector<double>>(layout.values.at(3).value), (std::vector<double>{0, setup.scene.fieldHeightMetres, setup.scene.fieldWidthMetres, setup.scene.fieldHeightMetres, 0, 0, setup.scene.fieldWidthMetres, 0}));
}

} // namespace
} // namespace physvib
