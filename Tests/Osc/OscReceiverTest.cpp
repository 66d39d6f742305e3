// SPDX-License-Identifier: GPL-3.0-or-later
// What packets do to a session, without a network.
#include "Host/Osc/OscReceiver.h"
#include "Session/FakeHost.h"
#include <gtest/gtest.h>

namespace physvib::osc_receiver_test {

using namespace test;
using namespace std::string_literals;

SessionSetup quietSetup(Direct direct) {
    auto setup = shakeTheBoxSetup(0.05);
    setup.direct = direct;
    setup.scene.bodies.clear();
    setup.scene.script.clear();
    setup.scene.joints.clear();
    return setup;
}

struct Open {
    Session session;
    MessageRouter messages{session};
    std::vector<LineInput> acted;
    std::string closed;
    OscReceiver door;
    OscClock clock;
    std::vector<std::vector<char>> answers;
    Block block;
    Interleaved signal;

    explicit Open(Direct direct = Direct::no, const ClipSource& clips = {})
        : session{quietSetup(direct)}
        , door{session,
               messages,
               {[this](const LineInput& input, const OscOrigin&) {
                    return acted.push_back(input), std::string{};
                },
                [this] { return closed; }, clips}} {
        session.prepare(hostRate, 512);
    }
    /// Half a second at 48 kHz, told to the clock as if the session had begun at 1 s of the steady clock,
    /// which is the system's.
    void play(int blocks = 47) {
        for (int k = 0; k < blocks; ++k) {
            clock.update(
                {session.timeline().presentNs() - 1, 1'000'000'000 + session.timeline().presentNs(), 1}, 0);
            session.advance();
            session.render(block.at.data(), 512, RenderMode::realtime);
            append(signal, block.at.data(), 512);
        }
    }
    void take(const std::vector<char>& bytes) { door.receive(bytes, clock, answers); }
    void strike(double level, OscTag tag) {
        take(oscBundle("/physvib/strike",
                       {"strike", {{"frequency_hz", 200.0}, {"decay_per_s", 20.0}, {"level", level}}}, tag));
    }
    std::vector<CollisionEvent> struck() {
        SessionLog log;
        session.advance();
        session.readLog(log);
        return log.strikes;
    }
};

TEST(OscReceivers, ATagIsTheSessionTimeToTheNanosecond) {
    Open open;
    open.play();
    const std::int64_t wanted = open.session.timeline().presentNs() + 123'456'789;
    open.strike(0.5, tagFromUnixNs(1'000'000'000 + wanted));
    open.play();
    const auto struck = open.struck();
    ASSERT_EQ(struck.size(), 1U);
    EXPECT_EQ(struck[0].timeNs, wanted);
    EXPECT_EQ(open.door.counts().late, 0U);
    EXPECT_EQ(open.door.counts().refused, 0U);
}

// As the page says: the play-out delay after its tag, or a block and the limiter where the session is direct.
TEST(OscReceivers, ATagIsFeltToTheFrameInADirectSessionAsWell) {
    for (const Direct direct : {Direct::no, Direct::inputs}) {
        Open open{direct};
        open.play();
        const std::int64_t now = open.session.timeline().framesRendered();
        // 5,000 frames and a half from now
        open.strike(0.5, tagFromUnixNs(1'000'000'000 + (now * 2 + 10'001) * 500'000'000 / hostRate));
        open.play();
        const auto delay = direct == Direct::no ? open.session.timeline().outputLatencyFrames()
                                                : 512 + HapticRenderer::latencyFramesAt(hostRate);
        const auto first = std::find_if(open.signal.begin(), open.signal.end(),
                                        [](float sample) { return std::abs(sample) > 1e-5f; });
        EXPECT_EQ((first - open.signal.begin()) / hostChannels, now + 5001 + delay);
        EXPECT_EQ(open.door.counts().late + open.door.counts().refused, 0U);
    }
}

TEST(OscReceivers, LateOnesAreCountedAndFeltAtOnce) {
    Open open;
    open.play();
    const std::int64_t now = open.session.timeline().presentNs();
    open.strike(0.5, tagFromUnixNs(1'000'000'000 + now - 1'000'000));
    open.strike(0.5, oscNow);
    const auto struck = open.struck();
    ASSERT_EQ(struck.size(), 2U);
    EXPECT_EQ(struck[0].timeNs, now);
    EXPECT_EQ(struck[1].timeNs, now);
    EXPECT_EQ(open.door.counts().late, 1U) << "\"immediately\" is never late";
}

TEST(OscReceivers, ATagAndATimeOfItsOwnAreTwo) {
    Open open;
    open.play();
    open.take(oscBundle("/physvib/strike",
                        {"strike", {{"frequency_hz", 200.0}, {"seconds", 0.1}, {"in", 2.0}}},
                        tagFromUnixNs(3'000'000'000)));
    open.strike(0.5, tagFromUnixNs(1'000'000'000 + std::int64_t{100'000} * 1'000'000'000));
    EXPECT_EQ(open.door.counts().refused, 2U);
    EXPECT_EQ(open.door.counts().lastError, "strike: time tag: expected at most 86400 s from now");
    EXPECT_EQ(open.session.world().size().strikes, 0U);
    EXPECT_TRUE(open.struck().empty());
}

// Whatever the table has, the door has.
TEST(OscReceivers, EveryMessageOfTheTableHasAnAddress) {
    for (const auto& message : messageTable) {
        Open open;
        open.take(oscPacket("/physvib/" + std::string(message.name), {}));
        EXPECT_EQ(open.door.counts().lastError.find("expected the name"), std::string::npos) << message.name;
        EXPECT_EQ(open.answers.size(), message.isQuery() ? 1U : 0U) << message.name;
    }
}

TEST(OscReceivers, QueriesAreAnswered) {
    Open open;
    open.play();
    open.take(oscPacket("/physvib/layout", {}));
    open.take(oscPacket("/physvib/status", {}));
    ASSERT_EQ(open.answers.size(), 2U);
    const auto layout = readOscPacket(open.answers[0]).value.at(0),
               status = readOscPacket(open.answers[1]).value.at(0);
    EXPECT_EQ(layout.address, "/physvib/answer/layout");
    EXPECT_EQ(std::get<std::string>(layout.values.at(1)), "linear");
    const auto plain = parseOscValues("status", status.values);
    EXPECT_EQ(plain.value.values.front().name, "session_s");
    EXPECT_NEAR(std::get<double>(plain.value.values.front().value),
                1e-9 * static_cast<double>(open.session.timeline().presentNs()), 1e-6);
    EXPECT_EQ(plain.value.values.at(6), (NamedValue{"osc_packets", 2.0}));
    open.take(open.answers[0]); // to itself
    EXPECT_EQ(open.answers.size(), 2U) << "an answer is never answered";
}

TEST(OscReceivers, InputsAndControlsAreThoseOfLines) {
    Open open;
    open.take(oscPacket("/physvib/tilt", {"", {{"angle_rad", 0.5}}}));
    open.take(oscPacket("/physvib/gravity", {"", {{"gravity_m_per_s2", std::vector{1.0, -9.0}}}}));
    open.take(oscPacket("/physvib/gain", {"", {{"channel", 2.0}, {"value", 0.5}}}));
    open.take(oscPacket("/physvib/mute", {"", {{"channel", 1.0}, {"on", 1.0}}}));
    open.take(oscPacket("/physvib/silence", {"", {{"on", 0.0}}}));
    open.take(oscPacket("/phone/gravity", {"", {}}));
    EXPECT_EQ(open.door.counts().lastError, "/phone/gravity: expected 3 numbers");
    ASSERT_EQ(open.acted.size(), 5U);
    EXPECT_EQ(std::get<Action>(open.acted[0]), Action{TiltAction{0.5}});
    EXPECT_EQ(std::get<Action>(open.acted[1]), (Action{GravityAction{{1.0, -9.0}}}));
    EXPECT_EQ(std::get<OwnedControl>(open.acted[2]).kind, RenderControl::Kind::gain);
    EXPECT_EQ(std::get<OwnedControl>(open.acted[2]).channel, 1);
    EXPECT_EQ(std::get<OwnedControl>(open.acted[2]).value, 0.5f);
    EXPECT_EQ(std::get<OwnedControl>(open.acted[3]).value, 1.0f);
    EXPECT_FALSE(std::get<SilenceControl>(open.acted[4]).isOn);
}

/// A packet with one message, its types and the bytes of its values as they are.
std::vector<char> rawMessage(const std::string& address, const std::string& types,
                             const std::string& values) {
    const auto padded = [](std::string text) { return text.append(4 - text.size() % 4, '\0'); };
    const std::string all = padded(address) + padded("," + types) + values;
    return {all.begin(), all.end()};
}

// Each says where, and what was expected.
TEST(OscReceivers, EveryWrongMessageIsRefusedWithItsAddressAndReason) {
    Open open{Direct::no};
    const auto plain = [](const std::string& address, std::vector<NamedValue> values) {
        return oscPacket(address, {"", std::move(values)});
    };
    const std::string strike = "/physvib/strike";
    const struct {
        std::vector<char> packet;
        std::string address, reason;
    } wrong[] = {
        {plain("/physvib/jump", {}), "/physvib/jump",
         "expected the name of a message, an input or a control"},
        {plain("/jump", {}), "/jump",
         "expected an address that begins with /physvib/, or one of a sensor program"},
        {plain(strike, {{"loudness", 1.0}}), strike, "loudness"},
        {plain("/physvib/tilt", {{"angle", 1.0}}), "/physvib/tilt", "tilt:"},
        {plain(strike, {{"frequency_hz", 200.0}, {"seconds", 1.0}, {"level", 2.0}}), strike,
         "strike: level: expected 0 to 1, found 2"},
        {plain(strike, {{"frequency_hz", 200.0}}), strike, "strike: seconds: expected a length"},
        {plain(strike, {{"level", "loud"s}}), strike, "strike: level: expected"},
        {rawMessage(strike, "f", "\x3f\0\0\0"s), strike, "strike: expected a name before 0.5"},
        {rawMessage(strike, "s", "level\0\0\0"s), strike, "strike: level: expected a value"},
        {rawMessage(strike, "sb", "level\0\0\0\0\0\0\4abcd"s), strike,
         "expected numbers and words, found one of type \"b\""},
        {rawMessage(strike, "sf", "level\0\0\0\x7f\xc0\0\0"s), strike, "expected numbers that are finite"},
        {plain("/physvib/gain", {{"channel", 9.0}, {"value", 1.0}}), "/physvib/gain",
         "gain: channel: expected a channel from 1 to 4, found 9"},
        {plain("/phone/gravity", {}), "/phone/gravity", "expected 3 numbers"},
        {plain("/physvib/clip", {{"file", "knock.wav"s}}), "/physvib/clip", "no folder was given"},
        {{'n', 'o', 'n', 'e'}, "", "expected an OSC message"},
    };
    for (const auto& one : wrong) {
        open.take(one.packet);
        ASSERT_EQ(open.door.refusals().size(), 1U) << one.reason;
        EXPECT_EQ(open.door.refusals()[0].address, one.address);
        EXPECT_NE(open.door.refusals()[0].reason.find(one.reason), std::string::npos)
            << open.door.refusals()[0].reason;
        EXPECT_NE(open.door.counts().lastError.find(one.reason), std::string::npos)
            << open.door.counts().lastError;
    }
    EXPECT_EQ(open.door.counts().malformed, 3U) << "of another type, not finite, and no OSC";
    EXPECT_EQ(open.door.counts().refused, std::size(wrong) - 3);
    open.closed = "a study is running";
    open.strike(0.5, oscNow);
    ASSERT_EQ(open.door.refusals().size(), 1U);
    EXPECT_EQ(open.door.refusals()[0].reason, "a study is running");
    EXPECT_EQ(open.door.counts().lastError, "a study is running");
    EXPECT_TRUE(open.answers.empty());
    EXPECT_TRUE(open.struck().empty());
    EXPECT_TRUE(open.acted.empty());
}

// Two programs that refuse each other's refusals would never end.
TEST(OscReceivers, WhatIsAReplyIsCountedAndNotRefused) {
    Open open;
    open.take(oscStringPacket(std::string(oscErrorAddress),
                              {"/physvib/strike", "strike: level: expected 0 to 1, found 2"}));
    open.take(oscPacket("/physvib/answer/status", {"", {{"session_s", 1.0}}}));
    open.take(oscPacket(std::string(oscHitAddress), {"", {{"session_s", 1.0}}}));
    open.take(rawMessage(std::string(oscErrorAddress), "b", ""));
    EXPECT_EQ(open.door.counts().failures(), 4U);
    EXPECT_TRUE(open.door.refusals().empty());
}

TEST(OscReceivers, ClipsAreReadWhereTheDoorHasAFolder) {
    Open closed;
    closed.take(oscPacket("/physvib/clip", {"", {{"file", "knock.wav"s}, {"place", "A"s}}}));
    EXPECT_EQ(closed.door.counts().lastError,
              "clip: file: expected no clips here: no folder was given to read them from");
    EXPECT_TRUE(closed.struck().empty());
    Open open{
        Direct::no, [](const std::string& name) {
            LoadedClip clip;
            clip.channels.push_back(
                {0.0, hostRate, std::vector<float>(4800, 0.1f), {.path = name, .hash = "0123456789abcdef"}});
            return Result<LoadedClip>{clip};
        }};
    open.take(oscPacket("/physvib/clip", {"", {{"file", "knock.wav"s}, {"place", "A"s}}}));
    EXPECT_EQ(open.door.counts().lastError, "");
    ASSERT_EQ(open.struck().size(), 1U);
}

TEST(OscReceivers, SilenceIsTakenAndAnsweredAlwaysAndInOrder) {
    const auto silence = [](double isOn) { return oscPacket("/physvib/silence", {"", {{"on", isOn}}}); };
    Open open;
    open.closed = "a study is running";
    open.door.receive(silence(1.0), open.clock, open.answers, 6);
    open.door.receive(silence(0.0), open.clock, open.answers, 7);
    ASSERT_EQ(open.acted.size(), 2U);
    EXPECT_TRUE(std::get<SilenceControl>(open.acted[0]).isOn);
    EXPECT_EQ(std::get<SilenceControl>(open.acted[0]).number, 7U) << "the next after those before it";
    EXPECT_EQ(std::get<SilenceControl>(open.acted[1]).number, 7U) << "the last that it lifts";
    ASSERT_EQ(open.answers.size(), 2U);
    const auto first = readOscPacket(open.answers[0]).value.at(0);
    EXPECT_EQ(first.address, "/physvib/answer/silence");
    EXPECT_EQ(first.values, (std::vector<OscValue>{"on"s, 1.0}));
    EXPECT_EQ(readOscPacket(open.answers[1]).value.at(0).values, (std::vector<OscValue>{"on"s, 0.0}));
    EXPECT_EQ(open.door.counts().refused, 0U);
}

TEST(OscReceivers, WhatIsNoOffInItsRightFormSilencesAndIsRefused) {
    for (const auto& packet :
         {oscPacket("/physvib/silence", {}), oscStringPacket("/physvib/silence", {"on", "1"}),
          oscPacket("/physvib/silence", {"", {{"on", 0.0}, {"id", 7.0}}}),
          oscPacket("/physvib/silence/", {"", {{"on", 0.0}}}),
          oscStringPacket("/physvib/silence", {"message", "stop"}), // a line of another kind
          oscStringPacket("/physvib/silence", {"input", "tilt"}),
          oscStringPacket("/physvib/silence", {"control", "gain"}),
          oscStringPacket("/physvib/silence", {"", ""}),
          // only the address itself lifts
          oscPacket("/physvib/sil*", {"", {{"on", 0.0}}}), oscPacket("/physvib/s?lenc[d-f]", {}),
          oscPacket("/*/{stop,silence}", {}),
          std::vector<char>{'/', 'p', 'h', 'y', 's', 'v', 'i', 'b', '/', 's', 'i', '*'},
          std::vector<char>{'/', 's', 'i', 'l', 'e', 'n', 'c', 'e'}}) {
        Open open;
        open.door.receive(packet, open.clock, open.answers, 6);
        ASSERT_EQ(open.acted.size(), 1U);
        EXPECT_TRUE(std::get<SilenceControl>(open.acted[0]).isOn);
        EXPECT_EQ(std::get<SilenceControl>(open.acted[0]).number, 7U) << "counted as silencesIn() counts";
        EXPECT_EQ(countSilenceRequests(packet), 1U);
        ASSERT_EQ(open.answers.size(), 1U);
        EXPECT_EQ(readOscPacket(open.answers[0]).value.at(0).values, (std::vector<OscValue>{"on"s, 1.0}));
        ASSERT_EQ(open.door.refusals().size(), 1U);
        EXPECT_TRUE(open.door.refusals()[0].reason.ends_with("; silenced all the same"))
            << open.door.refusals()[0].reason;
    }
}

TEST(OscReceivers, SilencesOfAPacketAreCountedAsTheyAreRead) {
    const PlainMessage on{"", {{"on", 1.0}}}, off{"", {{"on", 0.0}}};
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/silence", on)), 1U);
    EXPECT_EQ(countSilenceRequests(oscBundle("/physvib/silence", on, 12345)), 1U);
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/silence", off)), 0U);
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/silence", {"", {{"of", 1.0}}})), 1U)
        << "no off in its right form";
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/Silence/1", off)), 1U);
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/answer/silence", on)), 0U)
        << "what such a program as this says";
    EXPECT_EQ(countSilenceRequests(oscPacket("/elsewhere/silence", on)), 0U);
    EXPECT_EQ(countSilenceRequests(
                  oscPacket("/physvib/gain", {"", {{"channel", 1.0}, {"value", "/physvib/silence"s}}})),
              0U);
    EXPECT_EQ(countSilenceRequests(std::string{"/physvib/silence"}), 1U) << "broken, but readable so far";
    EXPECT_EQ(countSilenceRequests(std::string{"/physvib/strike"}), 0U);
    EXPECT_EQ(countSilenceRequests(std::string{"/physvib/str*"}), 0U);
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/st{op,rike}", {})), 0U);
    EXPECT_EQ(countSilenceRequests(oscPacket("/physvib/answer/*", on)), 0U);
    auto both = oscBundle("/physvib/silence", on, oscNow);
    const auto second = oscBundle("/physvib/silence", off, oscNow);
    both.insert(both.end(), second.begin() + 16, second.end());
    EXPECT_EQ(countSilenceRequests(both), 1U);
}

} // namespace physvib::osc_receiver_test
