// SPDX-License-Identifier: GPL-3.0-or-later
// One session on a device and a board: each hit leaves both at the same moment.
#include "Live/Session/BoardOutput.h"
#include "Host/FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Rig/Rig.h"
#include "Session/WallsScene.h"
#include "VirtualBoard.h"
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>
#include <random>

namespace physvib::board_output_test {

constexpr std::int64_t ms = 1'000'000;

/// Plays on a fake interface in real time and notes when its hands begin to feel something. Its crystal is
/// 200 ppm fast; it calls up to 3 ms late.
class Hands {
public:
    explicit Hands(test::FakeInterface& thing)
        : thing_{thing}
        , thread_{[this] { run(); }} {}
    ~Hands() {
        stop_ = true;
        thread_.join();
    }
    /// After the end of all calls, or nearly so.
    std::vector<std::int64_t> onsets() const {
        const std::scoped_lock lock{mutex_};
        return onsets_;
    }

private:
    void run() {
        std::mt19937 random{5};
        const double nsPerFrame = 1e9 / (thing_.rate * (1.0 + 200e-6));
        const std::int64_t began = BoardLink::nowNs();
        for (std::int64_t done = 0; !stop_; done += thing_.block) {
            const auto due = began + static_cast<std::int64_t>(static_cast<double>(done) * nsPerFrame);
            if (const auto wait = due + random() % (3 * ms) - BoardLink::nowNs(); wait > 0)
                std::this_thread::sleep_for(std::chrono::nanoseconds(wait));
            const auto out = thing_.play(thing_.block);
            // the latency it tells
            for (int n = 0; !out.empty() && n < thing_.block; ++n)
                take(out, n, due + static_cast<std::int64_t>((n + thing_.block) * nsPerFrame));
        }
    }
    void take(const std::vector<std::vector<float>>& out, int n, std::int64_t at) {
        float most = 0;
        for (std::size_t j = 0; j < 4; ++j)
            most = std::max(most, std::abs(out[j][static_cast<std::size_t>(n)]));
        if (most > audible && quiet_ > thing_.rate / 50) {
            const std::scoped_lock lock{mutex_};
            onsets_.push_back(at);
        }
        quiet_ = most > audible ? 0 : quiet_ + 1;
    }

    static constexpr float audible = 0.5f / 127; // as the first step of the board's converters
    test::FakeInterface& thing_;
    mutable std::mutex mutex_;
    std::vector<std::int64_t> onsets_;
    double quiet_ = 0;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

/// A ball between walls, felt on a fake device and the virtual board.
class BoardOutputTest : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(output.awaitReady([] { return true; }), "");
        ASSERT_LT(output.status().outputLatencyMs, 1e3 * latency - 50);
        session.sinks().attach(output);
        interface.block = 512; // which it is felt late by: 10.7 ms
        ASSERT_EQ(device.open({"hands", {}, 0, 0, 0.5f}), "");
        together.emplace(session.sinks(), device);
        hands.emplace(interface);
        driver.emplace(session, setup.stepsPerSecond);
        rest();
    }
    void rest() const { std::this_thread::sleep_for(std::chrono::milliseconds(300)); }
    void push(int times) {
        for (int i = 0; i < times; ++i, ++pushes) {
            EXPECT_EQ(session.submit({test::pushOfBall(pushes)}).error, "");
            std::this_thread::sleep_for(std::chrono::milliseconds(170 + 13 * (i % 5)));
        }
        rest();
    }
    std::vector<std::int64_t> onBoard() const {
        std::vector<std::int64_t> onsets;
        for (const auto& moment : board.log())
            if (moment.what == "sound") onsets.push_back(moment.steadyNs);
        return onsets;
    }

    static constexpr double latency = 0.12; // more than it needs, as programs beside this one may hold it up
    test::VirtualBoard board;
    SessionSetup setup = test::setupOfWalls();
    BoardOutput output{board.port(), setup.panner, latency};
    Session session{setup};
    test::FakeInterface interface;
    AudioOutput device{session, test::fakeDrivers({&interface})};
    std::optional<ScopedFollow> together;
    std::optional<Hands> hands;
    std::optional<ThreadDriver> driver;
    int pushes = 0;
};

TEST_F(BoardOutputTest, ADeviceAndABoardAreFeltAtTheSameMoment) {
    push(30);
    const auto felt = hands->onsets(), played = onBoard();
    ASSERT_EQ(felt.size(), 30u);
    ASSERT_EQ(played.size(), felt.size());
    double worst = 0, sum = 0;
    for (std::size_t i = 0; i < felt.size(); ++i) {
        const double apart = static_cast<double>(played[i] - felt[i]) / ms;
        worst = std::max(worst, std::abs(apart));
        sum += apart;
    }
    const auto t = output.status().telemetry;
    std::cout << felt.size() << " hits, L "
              << 1e3 * static_cast<double>(session.timeline().outputLatencyFrames()) / interface.rate
              << " ms: the board " << sum / 30 << " ms after the device on average, at most " << worst
              << " ms apart\n";
    EXPECT_LT(worst, 2.0);
    EXPECT_EQ(t.late + t.dropped + t.lost, 0u);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_EQ(output.droppedInQueues(), 0u);
}

TEST_F(BoardOutputTest, SilenceAndMutesHoldForBoth) {
    const auto muteAll = [this](float value) {
        for (int j = 0; j < 4; ++j)
            EXPECT_TRUE(session.submit({RenderControl{
                .kind = RenderControl::Kind::mute, .channel = j, .value = value, .panner = {}}}));
        rest();
    };
    const auto expectHits = [this](std::size_t count) {
        EXPECT_EQ(hands->onsets().size(), count);
        EXPECT_EQ(onBoard().size(), count);
    };
    push(3);
    expectHits(3);
    device.setSilent(true);
    rest();
    push(3);
    expectHits(3);
    device.setSilent(false);
    muteAll(1);
    push(3);
    expectHits(3);
    muteAll(0);
    push(3);
    expectHits(6);
}

} // namespace physvib::board_output_test
