// SPDX-License-Identifier: MIT
// Two tones for Switch controllers: known bytes, silence, stops and what a fit chooses. coils.py judges
// energy and pitch over a minute.
#include "Live/Pads/ToneFeed.h"
#include <gtest/gtest.h>

namespace physvib::tone_feed_test {

constexpr std::int64_t ms = 1'000'000;
constexpr HidFeedKind kind{{}, "test"};

std::vector<int> sideOf(const PadReport& report, std::size_t side) {
    return {report.bytes.begin() + 2 + 4 * static_cast<std::ptrdiff_t>(side),
            report.bytes.begin() + 6 + 4 * static_cast<std::ptrdiff_t>(side)};
}
const std::vector<int> neutral{0x00, 0x01, 0x40, 0x40};

PhantomPanner panner(double fieldWidthMetres) {
    ActuatorLayout layout;
    layoutPreset("phone2", layout);
    return {layout, PanningLaw::linear, 1.0, fieldWidthMetres, 1.0};
}

TEST(SwitchTones, ThePublicDescriptionsExamplesAreWritten) {
    EXPECT_EQ(sideOf(switchTones({}, {}, 0), 0), neutral);
    const PadReport report = switchTones({}, {341.4, 0.1894, 794.8, 0.5013}, 0x3A);
    EXPECT_EQ(report.bytes[0], 0x10);
    EXPECT_EQ(report.bytes[1], 0xA);
    EXPECT_EQ(report.size, 10u);
    EXPECT_EQ(sideOf(report, 0), neutral);
    EXPECT_EQ(sideOf(report, 1), (std::vector<int>{0xA8, 0x89, 0xE3, 0x4D}));
    const PadReport beyond = switchTones({5.0, 2.0, 9000.0, 2.0}, {9000.0, NAN, 5.0, -1.0}, 0);
    EXPECT_EQ(sideOf(beyond, 0), (std::vector<int>{0xFC, 0xC9, 0x01, 0x72})) << "never above full scale";
    EXPECT_EQ(sideOf(beyond, 1), (std::vector<int>{0x04, 0x00, 0x7F, 0x40}));
}

// In thousandths of full scale, as Linux' driver of these controllers has the steps of a tone's level.
TEST(SwitchTones, LevelsAreTheNearestSteps) {
    const auto stepOf = [](double amplitude) {
        return sideOf(switchTones({320.0, 0.0, 320.0, amplitude}, {}, 0), 0)[1] / 2;
    };
    int step = 0;
    for (const int thousandths :
         {10, 12, 14, 17, 20, 24, 28, 33, 40, 47, 56, 67, 80, 95, 112, 117, 123, 128, 134, 140})
        EXPECT_EQ(stepOf(1e-3 * thousandths), ++step) << thousandths;
    EXPECT_EQ(stepOf(0.225), 31);
    EXPECT_EQ(stepOf(0.235), 33);
    EXPECT_EQ(stepOf(0.0084), 0);
    EXPECT_EQ(stepOf(0.0086), 1) << "the weakest that there is";
}

TEST(ToneFeed, AFitTakesTheToneThatCanPlayIt) {
    const auto fit = [](std::vector<ToneFeed::Partial> partials) {
        return ToneFeed::fitTones(std::move(partials));
    };
    EXPECT_EQ(fit({}), TonePair{});
    EXPECT_NEAR(fit({{60.0, 0.25}}).low, 0.5, 1e-9);
    EXPECT_EQ(fit({{60.0, 0.25}}).high, 0.0);
    EXPECT_NEAR(fit({{400.0, 0.25}}).highHz, 400.0, 1e-6);
    const TonePair close = fit({{60.0, 1e-5}, {76.0, 0.04}});
    EXPECT_NEAR(close.lowHz, 76.0, 0.1) << "the weak one does not force it upon the high tone";
    const TonePair four = fit({{400.0, 0.01}, {90.0, 0.04}, {100.0, 0.04}, {420.0, 0.01}});
    EXPECT_NEAR(four.lowHz, std::sqrt(9000.0), 0.01);
    EXPECT_NEAR(four.highHz, std::sqrt(168000.0), 0.01);
    EXPECT_NEAR(four.low, std::sqrt(0.08), 1e-9);
    const TonePair loud = fit({{90.0, 4.0}, {400.0, 4.0}});
    EXPECT_NEAR(loud.low * loud.low + loud.high * loud.high, 1.0, 1e-9);
}

TEST(ToneFeed, SilenceAndAStopAreTheNextReport) {
    ToneFeed feed{kind, panner(1.0)};
    feed.onCollision({50 * ms, 100.0, 0.1, 0.8, 1.0, 0.5});
    std::int64_t now = 0;
    int reports = 0;
    const auto last = [&](int milliseconds, float level) {
        std::optional<PadReport> newest;
        reports = 0;
        for (const std::int64_t end = now + milliseconds * ms; now < end; now += ms)
            if (const auto report = feed.next(1000 * ms + now, now, level)) newest = report, ++reports;
        return newest;
    };
    EXPECT_FALSE(last(20, 1.0f)) << "nothing rings within the next report";
    const auto rings = last(100, 1.0f);
    ASSERT_TRUE(rings);
    EXPECT_EQ(sideOf(*rings, 0), neutral) << "it is on the right";
    EXPECT_GE(sideOf(*rings, 1)[3], 0x6C);
    const auto silent = last(31, 0.0f);
    ASSERT_TRUE(silent);
    EXPECT_EQ(sideOf(*silent, 1), neutral);
    EXPECT_EQ(sideOf(*last(1000, 0.0f), 1), neutral);
    EXPECT_EQ(reports, silentReportCount - 1) << "radio may lose one";
    EXPECT_FALSE(last(100, 0.0f));
    EXPECT_NE(sideOf(*last(31, 1.0f), 1), neutral) << "what rings comes back";
    feed.onControl({.timeNs = now + 10 * ms}); // a stop
    EXPECT_EQ(sideOf(*last(200, 1.0f), 1), neutral);
    EXPECT_FALSE(last(100, 1.0f));
}

// 512 that have nearly rung out, and one more that is weaker than they were.
TEST(ToneFeed, OfTooManyTheWeakestByNowAreLeftOut) {
    ToneFeed full{kind, panner(1.0)}, alone{kind, panner(1.0)};
    for (int k = 0; k < 512; ++k) full.onCollision({0, 100.0, 45.0, 0.5, 1.0, 0.5});
    EXPECT_TRUE(full.next(0, 0, 1.0f));
    const auto report = [](ToneFeed& feed) {
        feed.onCollision({110 * ms, 400.0, 20.0, 0.4, 1.0, 0.5});
        const auto sent = feed.next(110 * ms, 110 * ms, 1.0f);
        return sent ? sideOf(*sent, 1) : std::vector<int>(4);
    };
    const auto crowd = report(full), one = report(alone);
    EXPECT_EQ((std::vector{crowd[0], crowd[1]}), (std::vector{one[0], one[1]})) << "the high tone is its own";
    EXPECT_GT(one[1] / 2, 40);
    EXPECT_NE(crowd[3], one[3]) << "they ring on";
}

/// A device that was away (a pause, or another one) begins again, in the layout that the session has by then.
TEST(ToneFeed, FieldsAreFollowedAtTheirTimeAndKeptWhenTheDeviceComesBack) {
    const PhantomPanner narrow = panner(1.0), wide = panner(9.0);
    ToneFeed feed{kind, narrow};
    std::int64_t now = 0;
    const auto isLeftToo = [&] { // a hit at the right edge of the narrow field
        feed.onCollision({now, 100.0, 50.0, 0.8, 1.0, 0.5});
        const auto first = feed.next(now, now, 1.0f);
        for (const std::int64_t end = now + 300 * ms; now < end; now += ms) feed.next(now, now, 1.0f);
        return sideOf(*first, 0) != neutral;
    };
    feed.onControl({.timeNs = 100 * ms, .kind = RenderControl::Kind::panner, .panner = &wide});
    EXPECT_FALSE(isLeftToo()) << "not before its time";
    EXPECT_TRUE(isLeftToo());
    feed.begin();
    EXPECT_TRUE(isLeftToo());
    feed.onControl({.timeNs = now, .kind = RenderControl::Kind::panner, .panner = &narrow});
    feed.begin();
    EXPECT_FALSE(isLeftToo()) << "changed meanwhile";
}

// The report that gives a DualSense's coils to sound, against what SDL, the Linux driver and public
// descriptions say of its bytes.

TEST(DualSense, TheReportForSoundEmulatesNoMotorsAndChangesNothingElse) {
    constexpr auto report = dualsense::coilsToSound();
    EXPECT_EQ(report.size(), 47u) << "output report 0x02 over USB has 48 bytes with its number";
    EXPECT_EQ(report[dualsense::flagsByte] & (dualsense::emulatesMotors | dualsense::keepsSoundFromCoils), 0);
    EXPECT_EQ(report[dualsense::leftMotorByte] + report[dualsense::rightMotorByte], 0);
    for (const std::size_t flags : {0u, 1u, 38u})
        EXPECT_EQ(report[flags], 0) << "no light, trigger, volume or improved rumble is touched";
}

TEST(DualSense, ItsSoundDeviceIsKnownByItsName) {
    EXPECT_TRUE(dualsense::isDevice(
        "DualSense Wireless Controller, USB Audio; Direct hardware device without any conversions"));
    EXPECT_TRUE(dualsense::isDevice("dualsense"));
    EXPECT_TRUE(dualsense::isDevice("DualSense Edge Wireless Controller Pro"));
    EXPECT_FALSE(dualsense::isDevice("Wireless Controller"))
        << "so does a DualShock 4 call itself, which has no coils";
    EXPECT_FALSE(dualsense::isDevice("JACK:system"));
}

} // namespace physvib::tone_feed_test
