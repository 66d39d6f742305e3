// SPDX-License-Identifier: GPL-3.0-or-later
// One rig from its beginning to its end: what it plays, keeps and says.
#include "Live/Rig/Rig.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Documents/SessionFile.h"
#include "MessageLoop.h"
#include "Session/FakeHost.h"
#include "Support/FileTesting.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;

class RigTest : public FolderTest {
protected:
    RigSettings settings() const {
        RigSettings wanted{.setup = shakeTheBoxSetup(0.02)};
        wanted.output.device = std::string{noDeviceType} + ":" + noDeviceName;
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
    Rig rig{wanted, withNoDevice(systemAudioDrivers)};
    ASSERT_EQ(rig.open(), "");
    EXPECT_EQ(rig.inputs(), nullptr) << "nothing is heard";
    rig.start();
    int played = 0;
    const auto count = [&](const PlayedEvent&) { ++played; };
    EXPECT_TRUE(runUntil([&] { return rig.takePlayed(count), played > 3; }));
    rig.maintain();
    EXPECT_EQ(rig.trouble(), "");
    rig.stop(count);
    const int all = played;
    EXPECT_EQ(rig.finish(false), "");
    rig.takePlayed(count);
    EXPECT_EQ(played, all) << "nothing is played behind the end";
    rig.close();
    rig.close(); // twice is as once
    const auto saved = loadSession(wanted.savePath);
    ASSERT_TRUE(saved) << saved.error;
    EXPECT_EQ(saved.value.log.takes.size(), 1U);
    EXPECT_GT(std::filesystem::file_size(wanted.recordPath), 1000U);
    EXPECT_TRUE(std::filesystem::exists(folder / "felt.events.csv"));
}

TEST_F(RigTest, ThatDoesNotOpenKeepsNothing) {
    RigSettings wanted = settings();
    wanted.output.device = "None:of this name";
    wanted.savePath = (folder / "felt.json").string();
    {
        Rig rig{wanted, withNoDevice(systemAudioDrivers)};
        EXPECT_NE(rig.open(), "");
    }
    EXPECT_FALSE(std::filesystem::exists(wanted.savePath));
}

TEST_F(RigTest, WaitsForASinkOrNamesItLater) {
    RigSettings wanted = settings();
    wanted.sinks = {{"BOARD", "/nowhere/port"}};
    {
        Rig rig{wanted, withNoDevice(systemAudioDrivers)};
        EXPECT_NE(rig.open(), "") << "a sink that is awaited has to come";
    }
    wanted.awaitsSinks = false;
    Rig rig{wanted, withNoDevice(systemAudioDrivers)};
    ASSERT_EQ(rig.open(), "");
    rig.start();
    EXPECT_EQ(rig.trouble(), "") << "it may still come";
    EXPECT_EQ(rig.sinkStates().size(), 1U);
    EXPECT_TRUE(runUntil([&] {
        return rig.trouble().starts_with("The board at /nowhere/port does not answer; it is looked for");
    })) << rig.trouble();
    std::string trouble;
    rig.stop([](const PlayedEvent&) {});
    rig.finish(false);
    rig.summary(trouble);
    EXPECT_NE(trouble, "") << "success is not told where nothing was felt";
}

} // namespace
} // namespace physvib
