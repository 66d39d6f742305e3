// SPDX-License-Identifier: GPL-3.0-or-later
// One rig from its beginning to its end: what it plays, keeps and says.
#include "Live/Rig/Rig.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Documents/SessionFile.h"
#include "MessageLoop.h"
#include "Scene/World/Simulation.h"
#include "Session/FakeHost.h"
#include "Support/FileTesting.h"
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace physvib::rig_test {

using namespace test;

class RigTest : public FolderTest {
protected:
    RigSettings settings() const {
        RigSettings wanted{.setup = shakeTheBoxSetup(0.02)};
        wanted.output.device = std::string{nullDeviceType} + ":" + nullDeviceName;
        wanted.setup.log = LogUse::none;
        return wanted;
    }

private:
    juce::ScopedJuceInitialiser_GUI juce_; // the message loop
};

TEST_F(RigTest, PlaysAndKeepsASessionAndItsRecording) {
    RigSettings wanted = settings();
    wanted.recordPath = (folder / "felt.wav").string();
    wanted.savePath = (folder / "felt.json").string();
    Rig rig{wanted, withNullDevice(systemAudioDrivers)};
    ASSERT_EQ(rig.open(), "");
    EXPECT_EQ(rig.inputs(), nullptr) << "nothing is heard";
    rig.start();
    int played = 0;
    const auto count = [&](const PlayedEvent&) { ++played; };
    EXPECT_TRUE(runUntil([&] { return rig.drainPlayed(count), played > 3; }));
    rig.maintain();
    EXPECT_EQ(rig.errorText(), "");
    rig.stop(count);
    const int all = played;
    EXPECT_EQ(rig.finish(false), "");
    rig.drainPlayed(count);
    EXPECT_EQ(played, all) << "nothing is played behind the end";
    rig.close();
    rig.close(); // twice is as once
    const auto saved = loadSession(wanted.savePath);
    ASSERT_TRUE(saved) << saved.error;
    EXPECT_EQ(saved.value.log.runs.size(), 1U);
    EXPECT_GT(std::filesystem::file_size(wanted.recordPath), 1000U);
    EXPECT_TRUE(std::filesystem::exists(folder / "felt.events.csv"));
}

TEST_F(RigTest, ThatDoesNotOpenKeepsNothing) {
    RigSettings wanted = settings();
    wanted.output.device = "None:of this name";
    wanted.savePath = (folder / "felt.json").string();
    {
        Rig rig{wanted, withNullDevice(systemAudioDrivers)};
        EXPECT_NE(rig.open(), "");
    }
    EXPECT_FALSE(std::filesystem::exists(wanted.savePath));
}

TEST_F(RigTest, TellsAtTheEndWhichOfItsFilesAreNotThere) {
    for (const auto& [losesSession, losesRecording] :
         {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
        RigSettings wanted = settings();
        const std::string name = std::to_string(losesSession) + std::to_string(losesRecording);
        wanted.savePath = (folder / (name + ".json")).string();
        wanted.recordPath = (folder / (name + ".wav")).string();
        Rig rig{wanted, withNullDevice(systemAudioDrivers)};
        ASSERT_EQ(rig.open(), "");
        if (losesSession) std::filesystem::remove(wanted.savePath);
        if (losesRecording) std::filesystem::create_directory(wanted.recordPath); // where it would be put
        rig.stop([](const PlayedEvent&) {});
        const std::string error = rig.finish(false);
        EXPECT_EQ(error.find(wanted.savePath + ": ") != std::string::npos, losesSession) << error;
        EXPECT_EQ(error.find(wanted.recordPath + ": ") != std::string::npos, losesRecording) << error;
        EXPECT_EQ(error.empty(), !losesSession && !losesRecording) << error;
    }
}

TEST_F(RigTest, WaitsForASinkOrNamesItLater) {
    RigSettings wanted = settings();
    wanted.sinks = {{"BOARD", "/nowhere/port"}};
    {
        Rig rig{wanted, withNullDevice(systemAudioDrivers)};
        EXPECT_NE(rig.open(), "") << "a sink that is awaited has to come";
    }
    wanted.awaitsSinks = false;
    Rig rig{wanted, withNullDevice(systemAudioDrivers)};
    ASSERT_EQ(rig.open(), "");
    rig.start();
    EXPECT_EQ(rig.errorText(), "") << "it may still come";
    EXPECT_EQ(rig.sinkStates().size(), 1U);
    EXPECT_TRUE(runUntil([&] {
        return rig.errorText().starts_with("The board at /nowhere/port does not answer; it is looked for");
    })) << rig.errorText();
    std::string trouble;
    rig.stop([](const PlayedEvent&) {});
    rig.finish(false);
    rig.summary(trouble);
    EXPECT_NE(trouble, "") << "success is not told where nothing was felt";
}

// How what is played beside a device is named.

std::string words(const OutputNames& names) {
    std::string all = names.device;
    for (const SinkName& sink : names.sinks) all += " | " + sink.kind + " " + sink.address;
    return all;
}

TEST(SinkTable, ADeviceAndAnyNumberOfSinksAreNamedInOneLine) {
    const struct {
        const char *text, *read;
    } cases[]{
        {"", ""},
        {"JACK:system", "JACK:system"},
        {"BOARD:auto", "None:no device | BOARD auto"},
        {"JACK:system+BOARD:/dev/ttyACM0", "JACK:system | BOARD /dev/ttyACM0"},
        {"ALSA:a+b+BOARD:auto", "ALSA:a+b | BOARD auto"},
        {"JACK:system+BOARD:/dev/a+b+BOARD:auto", "JACK:system | BOARD /dev/a+b | BOARD auto"},
        {"BOARD:one+BOARD:two", "None:no device | BOARD one | BOARD two"},
        {"JACK:system+BOARD:", "JACK:system"},
        {"JACK:system+PLANK:auto", "JACK:system+PLANK:auto"},
    };
    for (const auto& one : cases) EXPECT_EQ(words(OutputNames{one.text}), one.read) << one.text;
}

TEST(SinkTable, MoreEnchantersThanASinkHasAreRefused) {
    const OutputNames names{"BOARD:auto"};
    EXPECT_EQ(channelCountError(names.sinks, 4), "");
    EXPECT_EQ(channelCountError(names.sinks, 5), "board: expected at most four actuators");
    EXPECT_EQ(channelCountError({}, 64), "");
}

TEST(SinkTable, MoreSinksThanFindRoomAreRefusedAndNoneIsOpened) {
    const std::vector<SinkName> nine(maxNamedSinks + 1, {"BOARD", "nowhere"});
    Sinks opened;
    EXPECT_EQ(openSinks(
                  nine, {}, [] { return false; }, opened),
              "expected at most 8 outputs beside the device, found 9");
    EXPECT_TRUE(opened.empty());
}

// Drivers take over from each other, and from blocks that step the world, at any moment.

using namespace test;

/// Steps the session for that time: as a message thread, a thread of its own, or not (the render call).
void drive(int kind, Session& session, std::chrono::milliseconds time) {
    std::optional<ThreadDriver> driver;
    if (kind == 1) driver.emplace(session, 100);
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;
         std::this_thread::sleep_for(std::chrono::milliseconds{kind == 0 ? 10 : 1}))
        if (kind == 0) session.advance();
}

TEST(SimulationDriver, AnyTakesOverFromAnyOther) {
    constexpr int frames = 480;
    const auto setup = shakeTheBoxSetup(0.1);
    Session session{setup};
    session.prepare(hostRate, frames);
    session.advance();
    std::atomic<bool> stop{false}, offline{false};
    std::vector<CollisionEvent> played;
    std::thread device{[&] { // blocks in real time
        Block block;
        for (auto next = std::chrono::steady_clock::now(); !stop; next += std::chrono::milliseconds{10}) {
            std::this_thread::sleep_until(next);
            session.render(block.at.data(), frames, offline ? RenderMode::offline : RenderMode::realtime);
            for (const auto& e : drain(session)) played.push_back(e);
        }
    }};
    Random random{1};
    for (int i = 0; i < 40; ++i) {
        const int kind = random.below(3);
        offline = kind == 2;
        drive(kind, session, std::chrono::milliseconds{20 + random.below(100)});
    }
    stop = true;
    device.join();
    SessionLog log;
    session.readLog(log);
    ASSERT_GT(played.size(), 40u);
    EXPECT_TRUE(played == simulateRuns(log.runs, setup.run(), played.back().timeNs + 1).events);
    EXPECT_EQ(session.status().render.late, 0u);
}

TEST(SimulationDriver, AWorldThatStandsStillIsLookedAtAsOftenAsItsStepsWouldBeDue) {
    constexpr int frames = 64;
    Session session{shakeTheBoxSetup(0.1)};
    session.prepare(hostRate, frames);
    Block block;
    const auto blocksUntilDue = [&] {
        session.render(block.at.data(), frames, RenderMode::realtime);
        session.advance();
        return (session.world().nextStepNs() - session.pulse().lastNs()) * hostRate / 1'000'000'000.0 /
               frames;
    };
    session.world().setSlowness(0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(blocksUntilDue(), 7.0, 0.01); // of 1.3 ms: no later than 10 ms
}

TEST(SimulationDriver, NoStepIsMadeOnceAllShallEnd) {
    Session session{shakeTheBoxSetup(0.1)};
    session.prepare(hostRate, 480);
    session.advance();
    const std::atomic<bool> ends{true};
    {
        const ThreadDriver driver{session, 100, &ends};
        Block block;
        for (int i = 0; i < 10; ++i) {
            session.render(block.at.data(), 480, RenderMode::realtime);
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
        }
    }
    EXPECT_GT(session.advance(), 0) << "what was due was left";
}

} // namespace physvib::rig_test
