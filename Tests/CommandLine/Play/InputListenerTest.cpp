// SPDX-License-Identifier: GPL-3.0-or-later
// Silence among the lines of standard input: it overtakes what waits, and is lifted by who asked.
#include "CommandLine/Play/InputListener.h"
#include "Session/FakeHost.h"
#include <atomic>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

namespace physvib::input_listener_test {

/// A minute at most; sanitizers are slow.
bool comesTrue(const std::function<bool()>& isTrue) {
    for (int k = 0; k < 6000; ++k) {
        if (isTrue()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return false;
}

/// A session that listens to a pipe in the place of standard input. A message `clip` holds up whoever does
/// what lines say, until `goOn`.
struct Listening {
    explicit Listening(bool keepsPlaying = true) {
        EXPECT_EQ(pipe(ends), 0);
        before = dup(STDIN_FILENO);
        dup2(ends[0], STDIN_FILENO);
        const auto clips = [this](const std::string&) {
            isHeldUp = true;
            while (!keepGoing) std::this_thread::sleep_for(std::chrono::milliseconds{1});
            return Result<LoadedClip>{Failure{"no clip"}};
        };
        listener.emplace(session, output, messages, clips, keepsPlaying);
    }
    ~Listening() {
        keepGoing = true;
        if (writer.joinable()) writer.join();
        listener.reset();
        dup2(before, STDIN_FILENO);
        close(ends[0]), close(before);
        endInput();
    }
    void endInput() {
        if (ends[1] >= 0) close(ends[1]);
        ends[1] = -1;
    }
    void write(std::string text) {
        if (writer.joinable()) writer.join();
        writer = std::thread{[this, text = std::move(text)] {
            for (std::size_t at = 0; at < text.size();) {
                const ssize_t count = ::write(ends[1], text.data() + at, text.size() - at);
                if (count <= 0) return;
                at += static_cast<std::size_t>(count);
            }
        }};
    }
    void holdUp() {
        write(heldUp);
        ASSERT_TRUE(comesTrue([this] { return isHeldUp.load(); }));
    }
    /// All that was written before is done: one more clip is asked for.
    void goOnToTheEnd() {
        isHeldUp = false;
        keepGoing = true;
        write(heldUp);
        ASSERT_TRUE(comesTrue([this] { return isHeldUp.load(); }));
    }
    static constexpr const char* heldUp = "{\"message\": \"clip\", \"file\": \"a.wav\", \"place\": \"A\"}\n";

    static SessionSetup setup() {
        auto setup = test::shakeTheBoxSetup(0.05);
        setup.ceilings[0] = 0.1f; // -20 dB
        return setup;
    }

    Session session{setup()};
    AudioOutput output{session, [] { return std::vector<std::unique_ptr<AudioDriver>>{}; }};
    MessageRouter messages{session};
    std::atomic<bool> isHeldUp{false}, keepGoing{false};
    int ends[2]{}, before = 0;
    std::thread writer;
    std::optional<InputListener> listener;
};

const std::string on = "{\"control\": \"silence\", \"on\": true}\n",
                  off = "{\"control\": \"silence\", \"on\": false}\n";

TEST(InputListeners, SilenceOvertakesTenThousandLinesThatWait) {
    Listening one;
    one.holdUp();
    std::string flood;
    for (int k = 0; k < 10'000; ++k) flood += "{\"control\": \"gain\", \"channel\": 1, \"value\": 0.5}\n";
    one.write(flood + on);
    EXPECT_TRUE(comesTrue([&] { return one.output.isSilent(); }));
    EXPECT_FALSE(one.keepGoing) << "nothing of what came before it is done";
}

TEST(InputListeners, SpelledWithEscapesItIsSilenceAsWell) {
    Listening one;
    one.holdUp();
    one.write("{\"control\": \"\\u0073ilence\", \"on\": true}\n");
    EXPECT_TRUE(comesTrue([&] { return one.output.isSilent(); }));
}

TEST(InputListeners, TheEndOfTheInputSilences) {
    Listening one{false}; // whoever sent may have died within a long tone
    EXPECT_FALSE(one.output.isSilent());
    one.endInput();
    EXPECT_TRUE(comesTrue([&] { return one.output.isSilent(); }));
}

TEST(InputListeners, AnOffComesInItsTurnAndLiftsNoLaterOn) {
    for (const auto& [lines, isSilent] :
         {std::pair{on + off, false}, {off + on, true}, {on + off + on, true}, {on + on + off, false}}) {
        Listening one;
        one.holdUp();
        one.write(lines);
        EXPECT_TRUE(comesTrue([&] { return one.output.isSilent(); })) << lines;
        one.goOnToTheEnd();
        EXPECT_EQ(one.output.isSilent(), isSilent) << lines;
    }
}

TEST(InputListeners, WhatOneInputAsksForAnotherDoesNotLift) {
    Listening one;
    const auto byOsc = [&](bool isOn) {
        return applyInput(SilenceControl{isOn}, one.session, one.output, MuteRequester::osc);
    };
    one.write(on);
    ASSERT_TRUE(comesTrue([&] { return one.output.isSilent(); }));
    EXPECT_EQ(byOsc(false), "silence: still asked for by standard input");
    EXPECT_TRUE(one.output.isSilent());
    one.write(off);
    EXPECT_TRUE(comesTrue([&] { return !one.output.isSilent(); }));
    EXPECT_EQ(byOsc(true), "");
    one.write(off);
    one.goOnToTheEnd();
    EXPECT_TRUE(one.output.isSilent()) << "OSC asked for it";
    one.output.setSilent(false);
    EXPECT_FALSE(one.output.isSilent()) << "a person at the machine lifts all";
    one.output.setSilent(true);
    EXPECT_NE(byOsc(false), "");
    EXPECT_TRUE(one.output.isSilent());
}

TEST(InputListeners, ADoorSetsNoCeilingAboveThatOfTheMachine) {
    Listening one;
    const auto ask = [&](int channel, float value) {
        OwnedControl control;
        control.kind = RenderControl::Kind::ceiling;
        control.channel = channel;
        control.value = value;
        return applyInput(control, one.session, one.output, MuteRequester::osc);
    };
    EXPECT_EQ(ask(0, 1.0f), "ceiling: expected at most 0.1, as --ceiling was set, found 1");
    EXPECT_EQ(ask(0, 0.1001f).substr(0, 32), "ceiling: expected at most 0.1, a");
    EXPECT_EQ(ask(0, 0.01f), "") << "lower";
    EXPECT_EQ(ask(0, 0.1f), "") << "and up to it again";
    EXPECT_NE(ask(0, 0.5f), "") << "no further, whatever was between";
    EXPECT_EQ(ask(1, 1.0f), "") << "where none was set";
    EXPECT_EQ(one.session.rendered().ceiling(0), 0.1f);
}

} // namespace physvib::input_listener_test
