// SPDX-License-Identifier: MIT
// What is done to a session while it plays is logged; the log, saved and read again, renders to what was
// felt, to the bit.
#include "FakeHost.h"
#include "Live/Documents/InputLine.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/Session.h"
#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace physvib::session_log_test {

using namespace test;
constexpr int rate = hostRate, channels = hostChannels;

Action anyInput(Random& random, int& stones) {
    const std::string body = random.below(2) == 0 ? "small rubber ball" : "large rubber ball";
    switch (random.below(7)) {
    case 0: return TiltAction{random.uniform(-3, 3)};
    case 1: return GravityAction{{random.uniform(-20, 20), random.uniform(-20, 20)}};
    case 2: {
        BodyDescription stone{"stone " + std::to_string(stones++),
                              BodyType::dynamicBody,
                              {{CircleShape{0.15}, {}, 0.0, 0, true}},
                              {random.uniform(2, 4), random.uniform(1, 3)}};
        return SpawnAction{stone, {}};
    }
    case 3: return SoundAction{random.below(2), random.uniform(50, 300), random.uniform(20, 90)};
    case 4: return TextureAction{random.below(2), random.uniform(0.002, 0.02), random.uniform(0, 3)};
    case 5:
        return GripAction{body, Vector{random.uniform(0, 4), random.uniform(0, 3)}, Vector{0.05, 0.05},
                          random.uniform(0, 0.3)};
    default: return CameraAction{"no such body", everyFixture, true}; // refused
    }
}

OwnedControl anyControl(Random& random) {
    OwnedControl control;
    control.kind = static_cast<RenderControl::Kind>(random.below(20) == 0 ? 3 : random.below(3));
    control.channel = random.below(channels);
    control.value = static_cast<float>(control.kind == RenderControl::Kind::mute ? random.below(2)
                                                                                 : random.uniform(0, 1));
    if (control.kind == RenderControl::Kind::panner) {
        ActuatorLayout layout{1, 1, 1 + random.below(channels), {}};
        for (int j = 0; j < layout.count; ++j)
            layout.places[static_cast<std::size_t>(j)] = {random.uniform(0, 1), random.uniform(0, 1)};
        control.ownedPanner = std::make_shared<const PhantomPanner>(
            layout, static_cast<PanningLaw>(random.below(4)), 1.5, 6.4, 3.6);
        control.panner = control.ownedPanner.get();
    }
    return control;
}

struct Felt {
    Interleaved signal;
    SessionLog log;
    int refused = 0;
};

// A host that edits, restarts, exchanges the scene, stalls, and has the log read now and then.
template <class Read>
Felt playEdited(Session& session, const SessionSetup& setup, std::int64_t frames, Read read) {
    Felt felt;
    Random random{11};
    Block block;
    session.prepare(rate, 512);
    session.advance(); // time begins
    int stones = 0;
    for (std::int64_t done = 0, sinceTick = 0; done < frames; ++sinceTick) {
        const int size = 1 + random.below(512);
        const bool stalls = random.below(4000) == 0;
        if (stalls)
            for (int i = 0; i < 60; ++i) {
                session.render(block.at.data(), 512, RenderMode::realtime);
                append(felt.signal, block.at.data(), 512);
                done += 512;
            }
        if (sinceTick > random.below(3)) {
            session.advance();
            sinceTick = 0;
        }
        if (random.below(60) == 0)
            felt.refused += session.submit({anyInput(random, stones)}).error.empty() ? 0 : 1;
        if (random.below(90) == 0) session.submit({anyControl(random)});
        if (random.below(2000) == 0) session.world().restart(random.below(size));
        if (random.below(2000) == 0)
            session.world().setState({std::make_shared<const Scene>(*findBuiltInScene("fruit-basket")), 4});
        if (random.below(1500) == 0)
            session.world().setState(
                {std::make_shared<const Scene>(setup.scene), static_cast<std::uint32_t>(random.below(3))});
        if (random.below(50) == 0) read(felt.log);
        session.render(block.at.data(), size, RenderMode::realtime);
        append(felt.signal, block.at.data(), size);
        done += size;
        while (drain(session).size() > 100) {
        }
    }
    read(felt.log);
    return felt;
}

Felt playEdited(Session& session, const SessionSetup& setup, std::int64_t frames) {
    return playEdited(session, setup, frames, [&](SessionLog& log) { session.readLog(log); });
}

Interleaved renderedAgain(const SavedSession& session, std::int64_t delayFrames, std::int64_t frames) {
    auto made = simulateRuns(session.log.runs, session.run, session.lengthNs);
    std::ranges::transform(made.events, made.events.begin(), session.shaping);
    const auto controls = logControls(session.log, true, channels);
    Interleaved signal(static_cast<std::size_t>(delayFrames * channels), 0.0f);
    renderOffline(made.events,
                  {{rate, channels, session.panner, session.limiterEnabled, session.ceilings, 0,
                    InstructionSet::best, session.equalised},
                   frames - delayFrames,
                   333,
                   controls},
                  [&](const float* const* block, int n) {
                      append(signal, block, n);
                      return true;
                  });
    return signal;
}

TEST(SessionLog, SavedAndReadAgainRendersToWhatWasFelt) {
    auto setup = shakeTheBoxSetup(0.05);
    setup.ceilings = {0.2f, 0.1f, 0.3f, 1.0f};
    setup.equalised[2] = {{205, 8}, {180, 230}};
    ASSERT_TRUE(parseRenderingMethod("AV-FV-DRF", setup.shaping.method));
    setup.shaping.remap.band = {150, 600};
    setup.shaping.perceived.isWeighted = true;
    Session session{setup};
    const Felt felt = playEdited(session, setup, 60 * rate);
    const auto frames = static_cast<std::int64_t>(felt.signal.size()) / channels;
    ASSERT_GT(felt.log.runs.size(), 3u);
    ASSERT_GT(felt.log.panners.size(), 10u);
    ASSERT_GT(felt.refused, 5);
    ASSERT_GT(session.world().stalledNs(), 0);
    std::size_t inputs = 0;
    for (const auto& take : felt.log.runs) inputs += take.inputs.size();
    ASSERT_GT(inputs, 50u);

    const std::string text = sessionJson(saved(setup, felt.log, frames * 1'000'000'000 / rate));
    const auto read = readSession(text, "session.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(sessionJson(read.value), text);
    EXPECT_EQ(session.status().render.late, 0u);
    const auto again = renderedAgain(read.value, session.timeline().outputLatencyFrames(), frames);
    ASSERT_EQ(again.size(), felt.signal.size());
    const auto differs = std::mismatch(again.begin(), again.end(), felt.signal.begin());
    EXPECT_TRUE(differs.first == again.end())
        << "at frame " << (differs.first - again.begin()) / channels << " of " << frames;
}

std::int64_t nsOf(const Felt& felt) {
    return static_cast<std::int64_t>(felt.signal.size()) / channels * 1'000'000'000 / rate;
}

TEST(SessionLog, AsLinesOfAJournalIsTheSameSession) {
    auto setup = shakeTheBoxSetup(0.05);
    setup.ceilings = {0.2f, 0.1f, 0.3f, 1.0f};
    setup.shaping.perceived.isWeighted = true;
    Session whole{setup}, told{setup};
    const Felt felt = playEdited(whole, setup, 40 * rate);
    ASSERT_GT(felt.log.runs.size(), 2u);
    ASSERT_GT(whole.world().stalledNs(), 0);
    JournalLines lines{saved(setup, {}, 0), {}};
    std::string text = lines.head();
    std::vector<std::size_t> ends;
    const Felt same = playEdited(told, setup, 40 * rate, [&](SessionLog& log) {
        text += lines.nextLines(log, told.readLog(log));
        ends.push_back(text.size());
        EXPECT_TRUE(log.runs.size() == 1 && log.runs[0].inputs.empty() && log.channels.empty())
            << "it is on disk";
    });
    SessionLog rest = same.log;
    text += lines.nextLines(rest, nsOf(same));
    ASSERT_TRUE(isJournal(text));
    const auto read = readSession(text, "monday.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(sessionJson(read.value),
              sessionJson(saved(setup, felt.log, std::ssize(felt.signal) / channels * 1'000'000'000 / rate)));

    Random random{3};
    for (int i = 0; i < 40; ++i) { // cut off anywhere: all that was told before
        const std::size_t cut =
            ends[0] + static_cast<std::size_t>(random.below(static_cast<int>(text.size() - ends[0])));
        const auto part = readSession(std::string_view{text}.substr(0, cut), "monday.json");
        ASSERT_EQ(part.error, "") << cut;
        const auto last = std::ranges::upper_bound(ends, cut) - 1;
        EXPECT_EQ(sessionJson(part.value),
                  sessionJson(readSession(std::string_view{text}.substr(0, *last), "monday.json").value))
            << cut;
    }
}

/// A session and its journal.
struct Journalled {
    explicit Journalled(const SessionSetup& setup)
        : session{setup}
        , lines{saved(setup, {}, 0), {}}
        , text{lines.head()} {
        session.prepare(rate, 480);
        session.advance();
    }
    void renderBlock() {
        session.render(block.at.data(), 480, RenderMode::realtime);
        session.advance();
    }
    Session session;
    JournalLines lines;
    std::string text;
    SessionLog log;
    Block block;
};

TEST(SessionLog, AJournalEndsWhereAFileIsFullAndTheSessionPlaysOn) {
    auto setup = shakeTheBoxSetup(0.05);
    setup.log = LogUse::stream;
    Journalled run{setup};
    auto& [session, lines, text, log, block] = run;
    for (int i = 0; i < 102; ++i) {
        run.renderBlock();
        for (int k = 0; k < 1000; ++k) ASSERT_EQ(session.submit({TiltAction{0.0001 * k}}).error, "");
        text += lines.nextLines(log, session.readLog(log));
    }
    EXPECT_EQ(lines.limitError(), "100000 inputs");
    EXPECT_NEAR(static_cast<double>(lines.completeNs()) * 1e-9, 1.0, 0.02);
    EXPECT_LT(session.world().size().inputs, 3000u);
    const auto read = readSession(text, "monday.json");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(read.value.log.runs[0].inputs.size(), 100'000u);
    EXPECT_EQ(read.value.lengthNs, lines.completeNs());
}

// What a file limits, and what a line replaces, is of one take.
TEST(SessionLog, InputsAndStallsInAJournalCountForTheirTakeAlone) {
    constexpr std::size_t portion = 1000;
    const auto setup = emptyBoxSetup(0.05);
    const auto scene = std::make_shared<const Scene>(setup.scene);
    JournalLines lines{saved(setup, {}, 0), {}};
    SessionLog log;
    const auto linesOf = [&](std::size_t inputs) {
        log.runs.back().inputs.assign(inputs, {0.5, TiltAction{1.0}});
        return lines.nextLines(log, 1'000'000'000);
    };
    for (const std::size_t inputs : {portion, sceneLimits::maxLiveInputs}) {
        log.runs.push_back({0, 0, 1, scene, {}, {{200'000'000, 10'000'000}}});
        EXPECT_NE(linesOf(0).find("\n{ \"stall\": "), std::string::npos) << "also if it is as the last was";
        for (std::size_t told = 0; told < inputs; told += portion) ASSERT_NE(linesOf(portion), "") << told;
        EXPECT_EQ(lines.limitError(), "");
    }
    EXPECT_EQ(linesOf(1), "");
    EXPECT_EQ(lines.limitError(), std::to_string(sceneLimits::maxLiveInputs) + " inputs");
}

// A file of more could not be read again, and replaces the journal at the end.
TEST(SessionLog, AJournalEndsWhereItsTakesHaveMoreBodiesThanAFileMay) {
    constexpr int bodies = 4000, takes = 250;
    auto setup = emptyBoxSetup(0.05);
    const BodyDescription ball{"ball", BodyType::dynamicBody, {{CircleShape{0.15}, {}}}, {2.0, 1.0}};
    setup.scene.scriptPeriodSeconds = 0.0;
    setup.scene.script = {{0.0, bodies, 1.0, SpawnAction{ball, {}}}};
    const auto scene = std::make_shared<const Scene>(setup.scene);
    JournalLines lines{saved(setup, {}, 0), {}};
    std::string text = lines.head();
    SessionLog log;
    for (int take = 0; take <= takes; ++take) {
        log.runs.push_back({take, 0, 1, scene, {}, {}});
        text += lines.nextLines(log, 1'000'000'000 + take);
        EXPECT_EQ(lines.limitError(), take < takes ? "" : "1000000 bodies") << take;
    }
    const auto kept = readSession(text, "monday.json");
    ASSERT_EQ(kept.error, "");
    EXPECT_EQ(kept.value.log.runs.size(), std::size_t{takes});
    EXPECT_EQ(kept.value.lengthNs, lines.completeNs());
    EXPECT_EQ(readSession(sessionJson(kept.value), "monday.json").error, "");
}

// Whoever reads the log meanwhile gets the pause again, as long as it has become.
TEST(SessionLog, APauseThatGrowsWhileItIsReadIsOnePause) {
    const auto setup = emptyBoxSetup(0.02);
    for (const bool isJournal : {false, true}) {
        Journalled run{setup};
        auto& [session, lines, text, log, block] = run;
        std::vector<WorldStall> pauses;
        for (const int blocks : {7, 1, 30}) // of 10 ms, as a step
            for (const int slowness : {1, 0}) {
                session.world().setSlowness(slowness);
                if (slowness == 0) pauses.push_back({session.world().sceneNs(), blocks * 10'000'000});
                for (int i = 0; i < blocks; ++i) {
                    run.renderBlock();
                    const std::int64_t endNs = session.readLog(log);
                    if (isJournal) text += lines.nextLines(log, endNs);
                }
            }
        if (isJournal) log = readSession(text, "monday.json").value.log;
        ASSERT_EQ(log.runs.size(), 1u);
        EXPECT_EQ(log.runs[0].stalls, pauses) << isJournal;
    }
}

TEST(SessionLog, AJournalIsReadAsStrictlyAsAFile) {
    const auto setup = shakeTheBoxSetup(0.05);
    JournalLines lines{saved(setup, {}, 0), {}};
    SessionLog log;
    log.runs.push_back({0,
                        0,
                        1,
                        std::make_shared<const Scene>(setup.scene),
                        {{0.5, TiltAction{1.0}}},
                        {{200'000'000, 10'000'000}}});
    const std::string text = lines.head() + lines.nextLines(log, 1'000'000'000);
    ASSERT_EQ(readSession(text, "s.json").error, "");
    const auto refuses = [&](const std::string& from, const std::string& to, const std::string& why) {
        EXPECT_EQ(readSession(textWith(text, from, to), "s.json").error, why);
    };
    refuses("\"journal\": 1", "\"journal\": 2",
            "s.json:1: journal: made for a newer PhysVib: expected a version up to 1, found 2");
    refuses("{ \"time_s\": 0.5, \"input\": \"tilt\"", "{ \"angle\": 1, \"time_s\": 0.5, \"input\": \"tilt\"",
            "s.json:3: input: unknown field \"angle\"");
    refuses("{ \"stall\"", "{ \"stop\"", "s.json:4: unknown field \"stop\"");
    refuses("{ \"take\": ", "{ \"take\": 1, \"x\": ", "s.json:2: unknown field \"x\"");
    EXPECT_EQ(readSession(lines.head(), "s.json").error, "s.json:1: expected at least 1 take, found none");
}

TEST(SessionLog, StatesFromAThirdThreadDisturbNothing) {
    const auto setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    session.prepare(rate, 8192);
    std::atomic<bool> stop{false};
    std::atomic<int> exchanges{0};
    std::thread third{[&] {
        while (!stop) { // what a host does when it saves
            SessionState copy = session.world().state();
            copy.scene = std::make_shared<const Scene>(*copy.scene);
            EXPECT_EQ(session.world().setState(copy), "");
            ++exchanges;
            SessionState bad{std::make_shared<const Scene>(), 1};
            EXPECT_NE(session.world().setState(bad), "");
        }
    }};
    Random random{5};
    Block block;
    std::vector<CollisionEvent> played;
    RenderMode mode = RenderMode::offline;
    for (int done = 0, left = 10; done < 30 * rate || exchanges < 100; --left) {
        if (left <= 0) {
            left = 1 + random.below(50);
            mode = mode == RenderMode::realtime ? RenderMode::offline : RenderMode::realtime;
        }
        const int size = 1 + random.below(mode == RenderMode::offline ? 8192 : 512);
        if (mode == RenderMode::realtime) session.advance();
        session.render(block.at.data(), size, mode);
        done += size;
        for (const auto& e : drain(session)) played.push_back(e);
    }
    stop = true;
    third.join();
    const auto made =
        simulateScene(setup.scene, {setup.seed, setup.stepsPerSecond}, played.back().timeNs + 1);
    EXPECT_TRUE(played == made.events);
}

TEST(SessionLog, TakesOfOneSceneAreAlikeAndShareIt) {
    const auto setup = shakeTheBoxSetup(0.02);
    Session session{setup};
    session.prepare(rate, 480);
    Block block;
    std::vector<CollisionEvent> played;
    for (int take = 0; take < 5; ++take) {
        if (take > 0) session.world().restart();
        for (int i = 0; i < 300; ++i) { // 3 s
            session.advance();
            session.render(block.at.data(), 480, RenderMode::realtime);
            for (const auto& e : drain(session)) played.push_back(e);
        }
    }
    SessionLog log;
    session.readLog(log);
    ASSERT_EQ(log.runs.size(), 5u);
    const std::string text = sessionJson(saved(setup, log, 15'000'000'000));
    EXPECT_EQ(text.find("\"bodies\""), text.rfind("\"bodies\""));
    std::vector<std::vector<CollisionEvent>> takes(5);
    for (CollisionEvent e : played) {
        const auto take = static_cast<std::size_t>(e.timeNs / 3'000'000'000);
        e.timeNs -= static_cast<std::int64_t>(take) * 3'000'000'000;
        takes[take].push_back(e);
    }
    EXPECT_GT(takes[0].size(), 20u);
    for (const auto& take : {takes[1], takes[2], takes[3]}) EXPECT_TRUE(take == takes[0]);
}

TEST(Session, ARefusedInputSaysWhyAndIsNotLogged) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, 64);
    EXPECT_EQ(session.submit({RemoveAction{"nobody"}}).error,
              "body: expected the name of a body, found \"nobody\"");
    EXPECT_FALSE(session.submit({TiltAction{0.1}, 1'000'000}))
        << "what waits for its time are strikes and stops";
    SessionLog log;
    session.readLog(log);
    EXPECT_TRUE(log.runs[0].inputs.empty());
}

} // namespace physvib::session_log_test
