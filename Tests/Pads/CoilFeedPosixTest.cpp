// SPDX-License-Identifier: MIT
// Samples for controllers with coils: silence, the guard, places and rates. coils.py judges the bytes.
#include "Live/Pads/CoilFeed.h"
#include "Support/FileTesting.h"
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib::coil_feed_posix_test {

constexpr std::int64_t ms = 1'000'000;

PhantomPanner panner(const char* preset) {
    ActuatorLayout layout;
    layoutPreset(preset, layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

/// A DualSense's feed, and blocks of 10 ms with one value per channel and frame.
struct Fed {
    explicit Fed(const char* preset = "phone2", const CoilFormat& format = dualSenseSamples())
        : feed{std::make_unique<CoilFeed>(kind, format, panner(preset))} {}
    // of its own: what a kind has had is remembered
    const HidFeedKind kind{{}, testing::UnitTest::GetInstance()->current_test_info()->name()};
    /// Steps of a millisecond; the reports.
    template <class Value>
    std::vector<PadReport> run(int milliseconds, float level, Value value, bool hasBlocks = true) {
        std::vector<PadReport> reports;
        for (int i = 0; i < milliseconds; ++i, ++now) {
            if (hasBlocks && now % 10 == 0) {
                const int frames = rateHz / 100;
                std::vector<std::vector<float>> samples(4,
                                                        std::vector<float>(static_cast<std::size_t>(frames)));
                for (std::size_t j = 0; j < 4; ++j)
                    for (float& sample : samples[j]) sample = value(j, frame + (&sample - samples[j].data()));
                const float* const at[] = {samples[0].data(), samples[1].data(), samples[2].data(),
                                           samples[3].data()};
                feed->onBlock({at, frames, frame, rateHz, 4});
                frame += frames;
            }
            if (const auto report = feed->next((1000 + now) * ms, 0, level)) reports.push_back(*report);
        }
        return reports;
    }
    std::unique_ptr<CoilFeed> feed;
    std::int64_t frame = 0, now = 0;
    int rateHz = 48000;
};

/// The largest of some frames of one side, of 127.
int peak(const PadReport& report, std::size_t side, std::size_t from = 0) {
    int most = 0;
    for (std::size_t n = from; n < 32; ++n)
        most = std::max(
            most, std::abs(static_cast<int>(static_cast<std::int8_t>(report.bytes[13 + 2 * n + side]))));
    return most;
}

float tone(std::size_t, std::int64_t frame) {
    return static_cast<float>(
        0.8 * std::sin(2.0 * std::numbers::pi * 100.0 * static_cast<double>(frame) / 48000.0));
}

TEST(CoilFeed, SilenceIsCompleteWithinOneReportAndComesBackInARamp) {
    Fed fed;
    EXPECT_GT(peak(fed.run(200, 1.0f, tone).back(), 0), 95);
    const auto silent = fed.run(100, 0.0f, tone);
    ASSERT_GE(silent.size(), 8u);
    EXPECT_EQ(peak(silent[0], 0, 16), 0) << "at the latest after half a report";
    for (std::size_t i = 1; i < silent.size(); ++i) EXPECT_EQ(peak(silent[i], 0), 0);
    const auto back = fed.run(100, 0.5f, tone);
    EXPECT_LE(std::abs(static_cast<int>(static_cast<std::int8_t>(back[0].bytes[13]))), 7);
    EXPECT_NEAR(peak(back.back(), 0), 127 * 0.4, 2);
}

TEST(CoilFeed, AReportThatIsShorterThanTheRampIsSilentInTimeAsWell) {
    Fed fed{"phone2", steamSamples()};
    fed.run(200, 1.0f, tone);
    const auto silent = fed.run(50, 0.0f, tone);
    for (std::size_t i = 0; i < silent.size(); ++i)
        for (std::size_t k = i == 0 ? 2 + 20 : 2; k < 32; ++k)
            EXPECT_EQ(silent[i].bytes[k], 0) << i << ' ' << k;
}

TEST(CoilFeed, ADeviceThatStopsLeavesOneReportOfSilenceAndThenNone) {
    Fed fed;
    fed.run(200, 1.0f, tone);
    auto after = fed.run(300, 1.0f, tone, false);
    ASSERT_FALSE(after.empty());
    EXPECT_EQ(peak(after.back(), 0) + peak(after.back(), 1), 0);
    EXPECT_LE(after.size(), 4u);
    EXPECT_EQ(fed.run(300, 1.0f, tone, false).size(), 0u);
    EXPECT_GT(peak(fed.run(100, 1.0f, tone).back(), 0), 95) << "and it goes on with the device";
}

TEST(CoilFeed, DirectCurrentIsTurnedDownAsAtEveryOutput) {
    Fed fed;
    const auto reports = fed.run(2000, 1.0f, [](std::size_t, std::int64_t) { return 1.0f; });
    double sum = 0.0;
    for (std::size_t i = reports.size() - 23; i < reports.size(); ++i) // 250 ms
        for (std::size_t n = 0; n < 32; ++n) sum += static_cast<std::int8_t>(reports[i].bytes[13 + 2 * n]);
    EXPECT_LE(std::abs(sum) / (23 * 32 * 127), limits::guardShare);
}

TEST(CoilFeed, OpeningAnewIsNoWayAroundTheGuard) {
    GuardMemory::now = [] { return GuardMemory::Clock::time_point{std::chrono::hours{1}}; };
    double sum = 0.0;
    int reports = 0;
    for (int opening = 0; opening < 40; ++opening) {
        Fed fed;
        for (const PadReport& report : fed.run(50, 1.0f, [](std::size_t, std::int64_t) { return 1.0f; })) {
            if (opening < 20) continue; // a second
            ++reports;
            for (std::size_t n = 0; n < 32; ++n) sum += static_cast<std::int8_t>(report.bytes[13 + 2 * n]);
        }
    }
    GuardMemory::now = GuardMemory::Clock::now;
    EXPECT_LE(std::abs(sum) / (reports * 32 * 127), limits::guardShare);
}

TEST(CoilFeed, ActuatorsArePannedByTheirPlaceFromLeftToRight) {
    const auto only = [](std::size_t which) {
        return [which](std::size_t j, std::int64_t frame) { return j == which ? tone(j, frame) : 0.0f; };
    };
    ActuatorLayout mirrored = panner("phone4").layout();
    for (ActuatorPlace& place : mirrored.places) place.xMetres = mirrored.extentWidthMetres - place.xMetres;
    const PhantomPanner changed{mirrored, PanningLaw::linear, 1.0, 1.0, 1.0};
    for (const std::size_t j : {0u, 1u, 2u, 3u}) { // A and C are on the left
        Fed fed{"phone4"};
        for (const std::size_t side : {j % 2, 1 - j % 2}) {
            const PadReport report = fed.run(200, 1.0f, only(j)).back();
            EXPECT_NEAR(peak(report, side), 127 * 0.8, 2);
            EXPECT_EQ(peak(report, 1 - side), 0);
            fed.feed->onControl({.kind = RenderControl::Kind::panner, .panner = &changed});
        }
    }
    Fed grown{"phone2"};
    grown.feed->onControl({.kind = RenderControl::Kind::panner, .panner = &changed});
    EXPECT_NEAR(peak(grown.run(200, 1.0f, only(3)).back(), 0), 127 * 0.8, 2) << "more actuators than before";
}

TEST(CoilFeed, WhatItsRateCannotCarryIsFilteredAtEveryRateOfADevice) {
    for (const int rate : {44100, 48000, 96000, 5000})
        for (const auto& [hz, least, most] :
             {std::tuple{100.0, 0.995, 1.005}, {1000.0, 0.97, 1.01}, {2100.0, 0.0, 0.01}}) {
            RateReducer reducer{rate, 3000};
            double peak = 0.0;
            for (int n = 0; n < rate; ++n) {
                const auto x = static_cast<float>(std::sin(2.0 * std::numbers::pi * hz * n / rate));
                reducer.push({x, x});
            }
            EXPECT_NEAR(static_cast<double>(reducer.size()), 3000.0, 1.0);
            for (std::size_t n = 0; reducer.size() > 0; ++n)
                if (const auto frame = reducer.pull(); n > 20)
                    peak = std::max(peak, std::abs(static_cast<double>(frame[1])));
            EXPECT_GE(peak, least) << rate << ' ' << hz;
            EXPECT_LE(peak, most) << rate << ' ' << hz;
        }
}

TEST(CoilFeed, AToneHasItsPitchAtEveryRateOfADevice) {
    for (const int rateHz : {44100, 48000, 96000}) {
        Fed fed;
        fed.rateHz = rateHz;
        int turns = 0, last = 0;
        const auto tone = [=](std::size_t, std::int64_t n) {
            return static_cast<float>(std::sin(400.0 * std::numbers::pi * static_cast<double>(n) / rateHz));
        };
        for (const PadReport& report : fed.run(1000, 1.0f, tone))
            for (std::size_t n = 0; n < 32; ++n)
                if (const int sign = report.bytes[13 + 2 * n] & 0x80; sign != std::exchange(last, sign))
                    ++turns;
        EXPECT_NEAR(turns, 400, 15) << rateHz;
    }
}

/// A device that asks for 10 ms at a time.
class Device final : public OutputClock {
public:
    Device() { setLevel(1.0f); }
    void block(std::int64_t sessionNs) { publish({sessionNs, steadyNs(), 0, 48000}); }
    static std::int64_t steadyNs() { return std::chrono::steady_clock::now().time_since_epoch().count(); }
};

/// A Steam controller's files, where the outputs made meanwhile look.
class HidOutputTest : public FolderTest {
protected:
    void SetUp() override {
        FolderTest::SetUp();
        std::filesystem::create_directories(folder / "class" / "hidraw0" / "device");
        std::filesystem::create_directories(folder / "dev");
        std::ofstream{folder / "class" / "hidraw0" / "device" / "uevent"}
            << "HID_ID=0003:000028DE:00001302\nHID_NAME=Steam\n";
        setenv("PHYSVIB_HIDRAW", folder.c_str(), 1);
        node = folder / "dev" / "hidraw0";
    }
    void TearDown() override {
        unsetenv("PHYSVIB_HIDRAW");
        FolderTest::TearDown();
    }
    static std::unique_ptr<CoilFeed> feed() {
        return std::make_unique<CoilFeed>(kind, steamSamples(), panner("phone2"));
    }
    /// Ten blocks of 10 ms of a tone.
    static void play(Device& device, HidOutput& output, std::int64_t first = 0) {
        std::vector<float> samples(480);
        for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = tone(0, static_cast<std::int64_t>(n));
        const float* const channels[] = {samples.data(), samples.data()};
        for (std::int64_t i = first; i < first + 10; ++i) {
            device.block(10 * ms * i);
            output.onBlock({channels, 480, 480 * i, 48000, 2});
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
        }
    }
    static constexpr std::array models{HidModel{0x28DE, 0x1302, PadBus::usb}};
    static constexpr HidFeedKind kind{models, "Steam Controller"};
    std::filesystem::path node;
};

TEST_F(HidOutputTest, FollowsADeviceAndLeavesSilenceBehind) {
    std::ofstream{node};
    {
        HidOutput output{"nothing like it", feed()};
        EXPECT_EQ(output.awaitReady([] { return false; }),
                  "no Steam Controller is called \"nothing like it\"");
    }
    HidOutput output{anyPad, feed()};
    EXPECT_EQ(output.awaitReady([] { return true; }), "");
    EXPECT_TRUE(output.state().isReady && output.state().playsClips);
    Device device;
    output.follow(&device);
    play(device, output);
    output.follow(nullptr);
    std::ifstream file{node, std::ios::binary};
    const std::string sent{std::istreambuf_iterator<char>{file}, {}};
    const std::size_t reports = output.counts().reports;
    EXPECT_GE(reports, 10u);
    EXPECT_EQ(sent.size(), 4 * 4 + 64 * (reports + silentReportCount) + 2 * 4) << "on, samples, silence, off";
    EXPECT_EQ(sent.substr(0, 16), (std::string{"\x86\1\2\0\x86\1\5\0\x86\2\2\1\x86\2\5\1", 16}));
    EXPECT_EQ(sent.substr(sent.size() - 8), (std::string{"\x86\1\2\0\x86\1\5\0", 8}));
    EXPECT_EQ(sent.substr(sent.size() - 8 - 62, 62), std::string(62, '\0'));
    EXPECT_NE(sent.substr(sent.size() - 8 - 64 * silentReportCount - 62, 30), std::string(30, '\0'));
}

TEST_F(HidOutputTest, AControllerThatTakesNothingHoldsUpNobody) {
    ASSERT_EQ(mkfifo(node.c_str(), 0600), 0);
    const int reader = open(node.c_str(), O_RDWR | O_NONBLOCK);
    ASSERT_GE(fcntl(reader, F_SETPIPE_SZ, 4096), 4096); // holds some 60 reports, and then a write waits
    HidOutput output{anyPad, feed()};
    ASSERT_EQ(output.awaitReady([] { return true; }), "");
    Device device;
    output.follow(&device);
    std::uint64_t now = 0;
    for (std::int64_t first = 0; first < 1000; first += 10) {
        play(device, output, first);
        if (std::exchange(now, output.counts().reports) == output.counts().reports) break;
    }
    ASSERT_GE(now, 50u);
    EXPECT_TRUE(output.state().isReady);
    EXPECT_FALSE(output.summary([] { return true; }).empty());
    output.follow(nullptr);
    std::array<char, 8192> rest;
    std::atomic<bool> isOver{false};
    std::thread reads{[&] {
        for (; !isOver; std::this_thread::sleep_for(std::chrono::milliseconds{1}))
            while (read(reader, rest.data(), rest.size()) > 0) {
            }
    }}; // or its thread would wait for ever
    for (int i = 0; i < 1000 && output.counts().reports == now; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    EXPECT_GT(output.counts().reports, now) << "it takes them again";
    isOver = true;
    reads.join();
    close(reader);
}

using HidDeviceTest = FolderTest;

TEST_F(HidDeviceTest, IsFoundByItsNumbersTakenOnceAndGoneWithItsNode) {
    const HidFolders folders{folder / "class", folder / "dev"};
    constexpr std::array models{HidModel{0x054C, 0x0CE6, PadBus::bluetooth}};
    EXPECT_TRUE(HidDevice::list(models, folders).empty());
    std::filesystem::create_directories(folders.nodes);
    const auto plug = [&](const std::string& node, const std::string& id) {
        std::filesystem::create_directories(folders.classes / node / "device");
        std::ofstream{folders.classes / node / "device" / "uevent"} << "HID_ID=" << id << "\nHID_NAME=Pad "
                                                                    << node << '\n';
        std::ofstream{folders.nodes / node};
    };
    plug("hidraw0", "0003:0000054C:00000CE6");
    plug("hidraw2", "0005:0000054C:00000CE6");
    plug("hidraw1", "0005:0000057E:00002009");
    const auto found = HidDevice::list(models, folders);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].name, "Pad hidraw2");
    auto device = HidDevice::open(models, "HIDRAW2", folders);
    ASSERT_TRUE(device) << device.error;
    EXPECT_EQ(HidDevice::open(models, anyPad, folders).error, "none is there") << "it is taken";
    const std::array<std::uint8_t, 3> report{1, 2, 3};
    EXPECT_TRUE(device.value->write(report));
    EXPECT_EQ(std::filesystem::file_size(folders.nodes / "hidraw2"), 3u) << "at once";
    std::filesystem::remove(folders.nodes / "hidraw2");
    EXPECT_FALSE(device.value->write(report));
    EXPECT_FALSE(std::filesystem::exists(folders.nodes / "hidraw2"));
}

} // namespace physvib::coil_feed_posix_test
