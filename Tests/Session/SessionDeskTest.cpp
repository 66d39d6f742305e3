// SPDX-License-Identifier: MIT
// What a mixer does to a session while it plays is saved, and rendered again to the bit.
#include "FakeHost.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/Session.h"
#include "Live/Session/SessionRender.h"
#include "Scene/SceneEdits.h"
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace physvib::session_desk_test {

using namespace test;
constexpr int rate = hostRate, room = 8; // more channels than enchanters, as the mixer has
using Kind = RenderControl::Kind;
using Script = std::multimap<double, std::function<void(Session&)>>; // by seconds

SessionSetup deskSetup(SessionSetup s = shakeTheBoxSetup(0.02)) {
    s.channels = room;
    return s;
}

RenderControl controlOf(Kind kind, int channel, float value) { return {0, kind, channel, value, {}}; }

using Signal = std::vector<std::vector<float>>; // [channel][frame]

Signal play(Session& session, double seconds, Script script, int block = 300) {
    session.prepare(rate, block);
    Signal signal(room);
    std::vector<std::vector<float>> part(room, std::vector<float>(static_cast<std::size_t>(block)));
    std::vector<float*> at;
    for (auto& channel : part) at.push_back(channel.data());
    for (std::int64_t done = 0; done < static_cast<std::int64_t>(seconds * rate); done += block) {
        session.advance();
        while (!script.empty() && script.begin()->first * rate <= static_cast<double>(done)) {
            script.begin()->second(session);
            script.erase(script.begin());
        }
        session.render(at.data(), block, RenderMode::realtime);
        for (std::size_t j = 0; j < room; ++j)
            signal[j].insert(signal[j].end(), part[j].begin(), part[j].end());
        drain(session);
    }
    return signal;
}

SavedSession savedOf(Session& session, const SessionSetup& setup, int channels) {
    SavedSession saved{setup.run(), setup.panner, channels, setup.limiterEnabled, setup.ceilings, 0, {}, {}};
    session.readLog(saved.log);
    saved.lengthNs = 10'000'000'000;
    auto again = readSession(sessionJson(saved), "session");
    EXPECT_TRUE(again) << again.error;
    return again ? again.value : saved;
}

/// How many samples of the saved session, rendered again, are not those that were played L earlier.
int differences(const Signal& live, const SavedSession& saved, std::int64_t outputLatencyFrames) {
    const auto frames = static_cast<std::int64_t>(live[0].size()) - outputLatencyFrames;
    const auto events = sessionEvents(saved, frames * 1'000'000'000 / rate).events;
    const auto controls = logControls(saved.log, true, saved.channels);
    int wrong = 0;
    std::int64_t done = outputLatencyFrames;
    renderOffline(
        events,
        {{rate, saved.channels, saved.panner, saved.limiterEnabled, saved.ceilings}, frames, 256, controls},
        [&](const float* const* block, int n) {
            for (int j = 0; j < saved.channels; ++j)
                for (int k = 0; k < n; ++k)
                    wrong +=
                        block[j][k] != live[static_cast<std::size_t>(j)][static_cast<std::size_t>(done + k)]
                            ? 1
                            : 0;
            done += n;
            return true;
        });
    return wrong;
}

double energyOf(const std::vector<float>& samples, double from, double to) {
    double sum = 0.0;
    for (auto n = static_cast<std::size_t>(from * rate); n < static_cast<std::size_t>(to * rate); ++n)
        sum += static_cast<double>(samples[n]) * static_cast<double>(samples[n]);
    return sum;
}

CollisionEvent pulse(double seconds) { return {static_cast<std::int64_t>(seconds * 1e9), 205.0, 30.0, 0.5}; }

TEST(SessionDesk, WhatWasDoneToItRendersAgainToTheBit) {
    const auto setup = deskSetup();
    Session session{setup};
    ActuatorLayout five = setup.panner.layout();
    five.places[static_cast<std::size_t>(five.count++)] = {0.5 * five.extentWidthMetres,
                                                           0.5 * five.extentHeightMetres};
    const PhantomPanner wider{five, PanningLaw::energy, 1.3, setup.scene.fieldWidthMetres,
                              setup.scene.fieldHeightMetres};
    const Script script{{0.5, [](Session& s) { s.submit({controlOf(Kind::gain, 0, -0.5f)}); }},
                        {0.7, [](Session& s) { s.submit({controlOf(Kind::delay, 1, 0.013f)}); }},
                        {0.9, [](Session& s) { s.submit({controlOf(Kind::ceiling, 2, 0.05f)}); }},
                        {1.0, [](Session& s) { s.world().setSlowness(0); }},
                        {1.2, [](Session& s) { s.world().stepOnce(); }},
                        {1.4,
                         [](Session& s) {
                             s.world().stepOnce();
                             s.world().stepOnce();
                         }},
                        {1.6, [](Session& s) { s.world().setSlowness(4); }},
                        {2.5, [](Session& s) { s.world().setSlowness(1); }},
                        {2.7,
                         [&](Session& s) {
                             s.submit({RenderControl{0, Kind::panner, 0, 0.0f, &wider}});
                         }},
                        {3.0,
                         [](Session& s) {
                             const std::array strikes{pulse(0.2), pulse(0.0)};
                             EXPECT_TRUE(s.submit({Strikes{strikes}}));
                         }},
                        {3.2, [](Session& s) { s.submit({controlOf(Kind::delay, 1, 0.0f)}); }},
                        {3.4,
                         [](Session& s) {
                             s.submit({controlOf(Kind::mute, 3, 1.0f)});
                             s.world().setSlowness(2);
                         }},
                        {4.0, [](Session& s) { s.world().restart(); }},
                        {4.5, [](Session& s) { s.world().setSlowness(1); }}};
    const auto live = play(session, 6.0, script);
    EXPECT_EQ(session.status().render.late, 0u);
    const auto saved = savedOf(session, setup, 5);
    ASSERT_EQ(saved.log.runs.size(), 2u);
    EXPECT_EQ(saved.log.strikes.size(), 2u);
    EXPECT_LT(saved.log.runs[0].stalls.size(), 12u) << "slow motion is one entry, however long it lasts";
    EXPECT_GT(energyOf(live[4], 2.8, 5.9), 0.0);
    EXPECT_EQ(differences(live, saved, session.timeline().outputLatencyFrames()), 0);
}

TEST(SessionDesk, AWorldThatStandsStillMakesNoHitsAndTellsThemAllLater) {
    const auto setup = deskSetup();
    Session one{setup}, other{setup};
    const auto live = play(one, 6.0, {});
    const auto paused = play(other, 9.0,
                             {{2.0, [](Session& s) { s.world().setSlowness(0); }},
                              {5.0, [](Session& s) { s.world().setSlowness(1); }}});
    EXPECT_EQ(energyOf(paused[2], 4.5, 5.0), 0.0);
    SessionLog log;
    other.readLog(log);
    EXPECT_EQ(log.runs[0].stalls.size(), 1u);
    EXPECT_NEAR(static_cast<double>(log.runs[0].stalls[0].lengthNs) * 1e-9, 3.0, 0.02);
    EXPECT_NEAR(energyOf(paused[2], 5.5, 9.0), energyOf(live[2], 2.5, 6.0),
                0.2 * energyOf(live[2], 2.5, 6.0));
}

TEST(SessionDesk, ATestPulseIsFeltLAfterItWasAskedFor) {
    Session session{deskSetup(emptyBoxSetup(0.02))};
    const auto live = play(session, 1.0,
                           {{0.3,
                             [](Session& s) {
                                 const std::array strikes{pulse(0.0)};
                                 s.submit({Strikes{strikes}});
                             }}},
                           480);
    const auto& c = live[2]; // (0, 0) is its corner
    const auto first = std::ranges::find_if(c, [](float x) { return std::abs(x) > 0.001f; }) - c.begin();
    // a block
    EXPECT_NEAR(static_cast<double>(first - session.timeline().outputLatencyFrames()) / rate, 0.3, 0.011);
    EXPECT_EQ(energyOf(live[1], 0.0, 1.0), 0.0);
    const std::array bad{pulse(0.0), CollisionEvent{}};
    EXPECT_FALSE(session.submit({Strikes{bad}})) << "one that cannot be played, and none is";
}

TEST(SessionDesk, AStrikeOfATimeOfItsOwnIsFeltLAfterItWheneverItWasTold) {
    const auto told = [](double seconds) {
        Session session{deskSetup(emptyBoxSetup(0.02))};
        auto live = play(session, 1.0,
                         {{seconds,
                           [](Session& s) {
                               const std::array strikes{pulse(0.3)};
                               EXPECT_TRUE(s.submit({Strikes{strikes}, 0}));
                           }}},
                         480);
        EXPECT_EQ(session.status().render.late, 0u);
        EXPECT_EQ(session.timeline().presentNs(), 1'000'000'000);
        return std::pair{std::move(live), session.timeline().outputLatencyFrames()};
    };
    const auto [early, delay] = told(0.05);
    EXPECT_EQ(early, told(0.295).first);
    const auto first =
        std::ranges::find_if(early[2], [](float x) { return std::abs(x) > 0.001f; }) - early[2].begin();
    EXPECT_NEAR(static_cast<double>(first - delay) / rate, 0.3, 0.001);
}

TEST(SessionDesk, ADeskIsSavedAndABrokenOneSaysWhere) {
    const auto setup = deskSetup();
    Session session{setup};
    play(session, 0.2, {});
    SavedSession saved{setup.run(), setup.panner, 4, true, setup.ceilings, 0, {}, {}};
    session.readLog(saved.log);
    Mix mix;
    mix.layout = describeLayout("phone4", setup.panner.layout());
    mix.layout.actuators[1].label = "thumb";
    mix.resizeStrips();
    mix.strips[2] = {-7.5, true, false, true, 12.5, -3.0, 6};
    mix.law = PanningLaw::energy;
    mix.levelDb = -20.0;
    mix.dragNewtonSecondsPerScreenMetre = 12'000.0;
    saved.mix = mix;
    const auto again = readSession(sessionJson(saved), "s.json");
    ASSERT_TRUE(again) << again.error;
    const Mix read = mixAtEnd(again.value);
    EXPECT_EQ(read.strips, mix.strips);
    EXPECT_EQ(read.layout.actuators, mix.layout.actuators);
    EXPECT_EQ(read.levelDb, -20.0);
    EXPECT_EQ(read.dragNewtonSecondsPerScreenMetre, 12'000.0);
    EXPECT_EQ(*read.scene, setup.scene);
    const std::string older = textWith(sessionJson(saved), "drag_ns_per_screen_m", "drag_ns_per_m"),
                      version = "\"physvib_session\": ";
    const auto old =
        readSession(textWith(older, version + std::to_string(sessionFormatVersion), version + "3"), "s.json");
    ASSERT_TRUE(old) << old.error;
    EXPECT_EQ(mixAtEnd(old.value).dragNewtonSecondsPerScreenMetre, 12'000.0)
        << "the knob stays; what was dragged is an input, in N s";
    saved.mix->strips[1].delayMs = 70.0;
    EXPECT_EQ(readSession(sessionJson(saved), "s.json").error,
              "s.json: desk.strips[1].delay_ms: expected 0 to 50, found 70");
    saved.mix.reset(); // as `physvib play` saves
    saved.log.channels = {{0, Kind::gain, 1, -0.5f}, {0, Kind::mute, 3, 1.0f}, {0, Kind::ceiling, 0, 0.25f}};
    saved.ceilings[2] = 0.1f;
    const Mix made = mixAtEnd(saved);
    EXPECT_TRUE(made.strips[1].isInverted);
    EXPECT_NEAR(made.strips[1].gainDb, -6.02, 0.01);
    EXPECT_TRUE(made.strips[3].isMuted);
    EXPECT_NEAR(made.strips[0].ceilingDb, -12.04, 0.01);
    EXPECT_NEAR(made.strips[2].ceilingDb, -20.0, 0.01) << "a bound that hands rely on";
}

/// A strip with a lane of its own, and a group with one.
Mix mixWithLanes(const SessionSetup& setup) {
    Mix mix;
    mix.layout = describeLayout("phone4", setup.panner.layout());
    mix.resizeStrips();
    mix.strips[0].lane = {{0.3, 0.0}, {1.1, -20.0}, {1.3, 6.0}};
    mix.strips[2].group = addGroup(mix, "Left hand");
    mix.strips[2].isInverted = true;
    mix.groups[0].gainDb = -3.0;
    mix.groups[0].lane = {{0.0, -60.0}, {0.9, -60.0}, {1.2, -3.0}};
    return mix;
}

/// Gains that a channel got in a take, but at its beginning: when, since it began, and which.
std::vector<std::pair<std::int64_t, float>> gainsIn(const SavedSession& saved, std::size_t take, int channel,
                                                    std::int64_t lengthNs) {
    std::vector<std::pair<std::int64_t, float>> gains;
    for (const ChannelChange& c : saved.log.channels) {
        const std::int64_t at = c.timeNs - saved.log.runs[take].startNs;
        if (c.kind == Kind::gain && c.channel == channel && at > 200'000'000 && at < lengthNs)
            gains.emplace_back(at, c.value);
    }
    return gains;
}

TEST(SessionDesk, ALaneIsFeltAtTheTimesOfItsSceneAndRenderedAgainToTheBit) {
    const auto setup = deskSetup();
    const auto mix = std::make_shared<const Mix>(mixWithLanes(setup));
    Session session{setup};
    const auto live = play(session, 5.0,
                           {{0.0, [&](Session& s) { s.submit({Lanes{mix}}); }},
                            {2.0, [](Session& s) { s.world().restart(); }},
                            {3.8, [](Session& s) { s.world().setSlowness(0); }},
                            {4.2, [](Session& s) { s.world().setSlowness(1); }},
                            {4.4, [](Session& s) { s.submit({Lanes{}}); }}});
    EXPECT_EQ(session.status().render.late, 0u);
    const auto saved = savedOf(session, setup, 5);
    EXPECT_EQ(differences(live, saved, session.timeline().outputLatencyFrames()), 0);
    for (const int channel : {0, 2}) {
        const auto first = gainsIn(saved, 0, channel, 1'700'000'000),
                   again = gainsIn(saved, 1, channel, 1'700'000'000);
        EXPECT_GT(first.size(), 20u);
        EXPECT_EQ(first, again) << "the scene's time, whatever the session's is";
    }
    EXPECT_TRUE(gainsIn(saved, 1, 1, 3'000'000'000).empty()) << "a strip without a lane is left alone";
    for (const auto& [ns, gain] : gainsIn(saved, 0, 0, 1'700'000'000))
        EXPECT_EQ(gain, channelGain({.gainDb = gainDbAt(*mix, 0, 1e-9 * static_cast<double>(ns))})) << ns;
    EXPECT_EQ(energyOf(live[2], 0.1, 0.9), 0.0) << "silence, until the group's lane rises";
    EXPECT_GT(energyOf(live[2], 1.3, 2.0), 0.0);
    EXPECT_LT(gainsIn(saved, 0, 2, 1'700'000'000).back().second, 0.0f) << "polarity stays";
}

TEST(SessionDesk, GroupsAndLanesAreSavedAndABrokenOneSaysWhere) {
    const auto setup = deskSetup();
    Session session{setup};
    play(session, 0.1, {});
    SavedSession saved{setup.run(), setup.panner, 4, true, setup.ceilings, 0, {}, {}};
    session.readLog(saved.log);
    saved.mix = mixWithLanes(setup);
    saved.mix->groups[0].isMuted = true;
    const std::string text = sessionJson(saved);
    const auto again = readSession(text, "s.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(again.value.mix->strips, saved.mix->strips);
    EXPECT_EQ(again.value.mix->groups, saved.mix->groups);
    const auto faultOf = [&](const std::string& from, const std::string& to) {
        return readSession(textWith(text, from, to), "s.json").error;
    };
    EXPECT_EQ(faultOf("\"group\": 1", "\"group\": 2"),
              "s.json: desk.strips[2].group: expected a group that is listed, of 1, found 2");
    EXPECT_NE(faultOf("\"Left hand\", \"gain_db\": -3", "\"Left hand\", \"gain_db\": 60")
                  .find("desk.groups[0].gain_db"),
              std::string::npos);
    saved.mix->strips[0].lane = {{2.0, 0.0}, {1.0, 0.0}};
    EXPECT_NE(
        readSession(sessionJson(saved), "s.json").error.find("desk.strips[0].lane[1][0]: expected 2 to"),
        std::string::npos);
}

TEST(SessionDesk, BodiesThatCameAndWentAreInTheSceneAsItWasLeft) {
    SceneRun take;
    take.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    BodyDescription ball;
    ball.name = "added 1";
    ball.fixtures.push_back({CircleShape{0.2}, {}, 0.0, 1, false, Voice::own});
    ball.positionMetres = {3.0, 3.0};
    take.inputs = {{0.5, SpawnAction{ball, {}}},
                   {0.6, MaterialAction{"added 1", everyFixture, 2}},
                   {0.7, RemoveAction{"large rubber ball"}},
                   {0.8, SoundAction{3, 90.0, 20.0}},
                   {0.9, TextureAction{3, 0.004, 2.0, GrainPattern::regular, 0.5}},
                   {0.9, GripAction{"added 1", Vector{1.0, 1.0}, {}}}};
    const Scene left = sceneAtEndOfRun(take);
    EXPECT_EQ(left.bodies.size(), take.scene->bodies.size());
    EXPECT_EQ(left.bodies.back().name, "added 1");
    EXPECT_EQ(left.bodies.back().fixtures[0].material, 2);
    EXPECT_EQ(left.materials[3].frequencyHz, 90.0);
    EXPECT_EQ(left.materials[3].grainMetres, 0.004);
    EXPECT_EQ(left.materials[3].grainPattern, GrainPattern::regular);
    EXPECT_TRUE(left.inputs.empty());
    EXPECT_NO_THROW(Session{[&] {
        auto s = deskSetup();
        s.scene = left;
        return s;
    }()});
}

} // namespace physvib::session_desk_test
