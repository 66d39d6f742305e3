// SPDX-License-Identifier: MIT
// What needs no world is felt sooner where a session is direct; the world's collisions keep the play-out
// delay.
#include "FakeHost.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/SessionRender.h"
#include <gtest/gtest.h>

namespace physvib::direct_test {

using namespace test;

SessionSetup stillSetup(Direct direct) {
    auto setup = emptyBoxSetup(0.026);
    setup.direct = direct;
    return setup;
}

constexpr std::string_view knock =
    R"({"message": "strike", "frequency_hz": 205, "decay_per_s": 80, "place": "A"})";

struct Host {
    explicit Host(const SessionSetup& setup, int block)
        : session{setup}
        , block{block} {
        session.prepare(hostRate, block);
    }
    void play(int blocks, RenderMode mode = RenderMode::realtime) {
        for (int b = 0; b < blocks; ++b) {
            if (mode == RenderMode::realtime) session.advance();
            session.render(scratch.at.data(), block, mode);
            append(signal, scratch.at.data(), block);
        }
    }
    Result<PlainMessage> take(std::string_view line) {
        return router.handle(std::get<PlainMessage>(readInputLine(line, {}, hostChannels).value));
    }
    /// First frame from `from` on that is louder; a sine begins with 0, but for a nanosecond.
    std::int64_t onsetFrom(std::int64_t from, float threshold = 1e-5f) const {
        for (std::int64_t n = from; n < static_cast<std::int64_t>(signal.size()) / hostChannels; ++n)
            for (int j = 0; j < hostChannels; ++j)
                if (std::abs(signal[static_cast<std::size_t>(n * hostChannels + j)]) > threshold) return n;
        return -1;
    }
    Session session;
    MessageRouter router{session};
    int block;
    Block scratch;
    Interleaved signal;
};

int limiterFrames() { return HapticRenderer::latencyFramesAt(hostRate); }

TEST(Direct, AMessageIsFeltABlockAndTheLimiterLaterWhateverTheBlock) {
    for (const int block : {16, 64, 480, 2048}) {
        Host host{stillSetup(Direct::inputs), block};
        host.play(hostRate / block + 1);
        const std::int64_t at = host.session.timeline().framesRendered();
        ASSERT_TRUE(host.take(knock));
        host.play(4000 / block + 4);
        EXPECT_EQ(host.onsetFrom(0), at + block + limiterFrames() + 1) << block << ": a sine begins with 0";
        EXPECT_EQ(host.session.status().render.late, 0u);
        const auto answer = host.take(R"({"message": "latency"})").value;
        const double direct = static_cast<double>(block + limiterFrames()) / hostRate;
        EXPECT_NEAR(std::get<double>(answer.values.at(0).value),
                    static_cast<double>(host.session.timeline().outputLatencyFrames()) / hostRate, 1e-12);
        EXPECT_NEAR(std::get<double>(answer.values.at(1).value), direct, 1e-12);
        EXPECT_NEAR(std::get<double>(answer.values.at(2).value), direct, 1e-8);
    }
}

TEST(Direct, OneThatIsNotDirectIsFeltThePlayOutDelayLaterAndSaysSo) {
    Host host{stillSetup(Direct::no), 64};
    host.play(750);
    ASSERT_TRUE(host.take(knock));
    host.play(100);
    EXPECT_EQ(host.onsetFrom(0), 750 * 64 + host.session.timeline().outputLatencyFrames() + 1);
    const auto answer = host.take(R"({"message": "latency"})").value;
    EXPECT_EQ(std::get<double>(answer.values.at(2).value), std::get<double>(answer.values.at(0).value));
}

TEST(Direct, WhatIsAskedForLaterIsInTimeAsWell) {
    Host host{stillSetup(Direct::inputs), 64};
    host.play(750);
    ASSERT_TRUE(host.take(R"({"message": "strike", "frequency_hz": 205, "decay_per_s": 80, "in": 0.25})"));
    ASSERT_TRUE(host.take(R"({"message": "strike", "frequency_hz": 205, "decay_per_s": 80, "at": 2})"));
    host.play(1000);
    EXPECT_EQ(host.onsetFrom(0), 750 * 64 + 12000 + 64 + limiterFrames() + 1);
    EXPECT_EQ(host.session.status().render.late, 0u);
    EXPECT_EQ(host.session.world().size().strikes, 0u);
    host.play(200);
    const auto events = drain(host.session);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_NEAR(static_cast<double>(events[1].timeNs) * 1e-9,
                2.0 - static_cast<double>(host.session.timeline().inputLeadNs()) * 1e-9, 1e-9);
}

TEST(Direct, AStopActsOnWhatWasStruckBeforeAndNotOnWhatFollows) {
    Host host{stillSetup(Direct::inputs), 64};
    host.play(750);
    ASSERT_EQ(host.take(R"({"message": "phantom", "seconds": 3})").error, "");
    host.play(300);
    const std::int64_t at = host.session.timeline().framesRendered();
    ASSERT_EQ(host.take(R"({"message": "stop"})").error, "");
    host.play(200);
    const std::int64_t faded = at + 64 + limiterFrames() + hostRate / 100 + 64;
    EXPECT_EQ(host.onsetFrom(faded, 1e-3f), -1) << "within 10 ms";
    ASSERT_TRUE(host.take(knock));
    host.play(100);
    EXPECT_GT(host.onsetFrom(faded, 1e-3f), 0);
}

TEST(Direct, CollisionsKeepThePlayOutDelayAndWhatIsSavedIsWhatWasFelt) {
    const auto wallBefore = [](Direct direct) {
        auto setup = shakeTheBoxSetup(0.026);
        setup.direct = direct;
        return setup;
    };
    const auto played = [&](Direct direct, bool strikes) {
        Host host{wallBefore(direct), 256};
        for (int k = 0; k < 8; ++k) {
            host.play(50);
            if (!strikes) continue;
            EXPECT_TRUE(host.take(knock));
            EXPECT_TRUE(host.take(R"({"message": "path", "places": "AD", "seconds": 0.3, "in": 0.01})"));
            if (k == 4)
                EXPECT_TRUE(host.session.submit({RenderControl{0, RenderControl::Kind::gain, 1, 0.5f, {}}}));
            if (k == 5) EXPECT_EQ(host.take(R"({"message": "stop", "in": 0.2})").error, "");
        }
        host.play(200);
        EXPECT_EQ(host.session.status().render.late, 0u);
        SavedSession saved = test::saved(wallBefore(direct), {}, 0);
        saved.lengthNs = host.session.readLog(saved.log);
        const auto L = static_cast<std::size_t>(host.session.timeline().outputLatencyFrames());
        Interleaved again;
        EXPECT_TRUE(renderSession(saved, {}, {hostRate, 2.5, [](double) { return true; }},
                                  [&](const float* const* at, int n) {
                                      append(again, at, n);
                                      return true;
                                  }));
        Interleaved felt{host.signal.begin() + static_cast<std::ptrdiff_t>(L * hostChannels),
                         host.signal.end()};
        felt.resize(again.size());
        std::size_t equal = 0;
        for (std::size_t n = 0; n < felt.size(); ++n) equal += felt[n] == again[n] ? 1u : 0u;
        EXPECT_EQ(equal, felt.size());
        return felt;
    };
    EXPECT_EQ(played(Direct::inputs, false), played(Direct::no, false));
    EXPECT_NE(played(Direct::inputs, true), played(Direct::no, true));
}

TEST(Direct, WhatIsBornInTheRenderCallIsFeltTheLimiterLaterFromTheFirstFrameOn) {
    for (const auto mode : {RenderMode::realtime, RenderMode::offline})
        for (const int frame : {0, 17}) {
            auto setup = stillSetup(Direct::fromStart);
            setup.log = LogUse::none;
            Host host{setup, 64};
            const CollisionEvent strike{.frequencyHz = 205.0, .decayPerSecond = 80.0, .amplitude = 0.5};
            ASSERT_TRUE(host.session.callback().strike(strike, frame));
            host.play(20, mode);
            EXPECT_EQ(host.onsetFrom(0), frame + limiterFrames() + 1);
            EXPECT_EQ(host.session.timeline().inputLatencyFrames(), limiterFrames());
            EXPECT_EQ(host.session.status().render.late, 0u);
        }
}

TEST(Direct, ABornSessionsWorldKeepsThePlayOutDelay) {
    auto setup = shakeTheBoxSetup(0.026);
    setup.log = LogUse::none;
    Host host{setup, 256};
    host.play(400, RenderMode::offline);
    setup.direct = Direct::fromStart;
    Host direct{setup, 256};
    direct.play(400, RenderMode::offline);
    ASSERT_GT(host.onsetFrom(0), 0);
    EXPECT_NEAR(static_cast<double>(direct.onsetFrom(0)), static_cast<double>(host.onsetFrom(0)), 1.0);
}

TEST(Direct, ASilenceOfABornSessionLetsWhatIsStruckBehindItBeFelt) {
    auto setup = stillSetup(Direct::fromStart);
    setup.log = LogUse::none;
    Host host{setup, 64};
    const CollisionEvent strike{.frequencyHz = 205.0, .amplitude = 0.5, .durationNs = 1'000'000'000};
    ASSERT_TRUE(host.session.callback().strike(strike, 0));
    host.play(100);
    ASSERT_TRUE(host.session.callback().strike(strike, 5));
    ASSERT_TRUE(host.session.callback().silence(10));
    host.play(50);
    EXPECT_EQ(host.onsetFrom(6400 + 64 + hostRate / 100 + limiterFrames(), 1e-3f), -1);
    ASSERT_TRUE(host.session.callback().silence(10));
    ASSERT_TRUE(host.session.callback().strike(strike, 20));
    host.play(20);
    EXPECT_EQ(host.onsetFrom(6400 + 50 * 64), 6400 + 50 * 64 + 20 + limiterFrames() + 1);
}

} // namespace physvib::direct_test
