// SPDX-License-Identifier: GPL-3.0-or-later
// Ports on the loopback: nobody shares one, and what is sent is counted.
#include "Host/Osc/OscPort.h"
#include "Session/FakeHost.h"
#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>

namespace physvib::osc_port_test {

using namespace test;

/// A device whose blocks are asked for by the test.
struct FakeOutput final : OutputClock {
    FakeOutput() { publish({1'000'000'000, 1'000'000'000, 50'000'000}); }
};

struct Played {
    Session session{shakeTheBoxSetup(0.05)};
    MessageRouter messages{session};
    FakeOutput output;
    Played() { session.prepare(hostRate, 512); }
    std::unique_ptr<OscPort> open(const OscSettings& settings) {
        return std::make_unique<OscPort>(
            settings, session, messages, output,
            OscHooks{[](const LineInput&, const OscOrigin&) { return std::string{}; }, {}});
    }
};

OscSettings anyPort() {
    OscSettings settings;
    settings.port = 0;
    return settings;
}

/// A minute at most; sanitizers are slow.
bool comes(const std::function<bool()>& isTrue) {
    for (int k = 0; k < 6000; ++k) {
        if (isTrue()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return false;
}

UdpSocket senderTo(const OscPort& port) {
    return std::move(
        UdpSocket::connectTo(std::string(oscLoopbackAddress) + ":" + std::to_string(port.port())).value);
}

/// The next packet that comes.
OscMessage nextOf(UdpSocket& socket) {
    EXPECT_TRUE(socket.wait(60'000));
    const auto packet = socket.receive();
    return packet ? readOscPacket(*packet).value.at(0) : OscMessage{};
}

TEST(OscPorts, EightAtOnceHaveAPortEach) {
    Played played;
    const auto first = played.open(anyPort());
    ASSERT_EQ(first->error(), "");
    OscSettings same;
    same.port = first->port();
    std::vector<std::unique_ptr<OscPort>> all;
    std::vector<int> ports{first->port()};
    for (int k = 0; k < 7; ++k) {
        all.push_back(played.open(same));
        ASSERT_EQ(all.back()->error(), "");
        EXPECT_GT(all.back()->port(), ports.back()) << "the next that is free";
        ports.push_back(all.back()->port());
    }
    const auto strike = oscPacket("/physvib/latency", {});
    for (const auto& port : all) {
        auto sender = senderTo(*port);
        EXPECT_TRUE(sender.send(strike));
        EXPECT_TRUE(comes([&] { return port->status().counts.messages == 1; }));
    }
    EXPECT_EQ(first->status().counts.packets, 0U);
}

TEST(OscPorts, WhatCannotBeIsToldInALine) {
    Played played;
    OscSettings nowhere = anyPort();
    nowhere.address = "203.0.113.7"; // nobody's
    EXPECT_EQ(played.open(nowhere)->error(), "203.0.113.7: Cannot assign requested address");
    nowhere.address = "here";
    EXPECT_EQ(played.open(nowhere)->error().substr(0, 7), "\"here\":");
    OscSettings toNobody;
    toNobody.receiver = "localhost";
    EXPECT_EQ(played.open(toNobody)->error(), "expected HOST:PORT, found \"localhost\"");
}

TEST(OscPorts, WhatIsSentIsCounted) {
    Played played;
    const auto port = played.open(anyPort());
    auto sender = senderTo(*port);
    const auto good = oscPacket("/physvib/strike", {"", {{"frequency_hz", 200.0}, {"decay_per_s", 20.0}}});
    const std::vector<char> bad{'n', 'o'};
    constexpr std::uint64_t each = 100; // the buffer holds more
    for (std::uint64_t k = 0; k < each; ++k) {
        EXPECT_TRUE(sender.send(good));
        EXPECT_TRUE(sender.send(bad));
    }
    EXPECT_TRUE(comes([&] { return port->status().counts.packets == 2 * each; }));
    const OscCounts counts = port->status().counts;
    EXPECT_EQ(counts.messages, each);
    EXPECT_EQ(counts.malformed, each);
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_TRUE(counts.lastError.starts_with("127.0.0.1:")) << counts.lastError;
    EXPECT_EQ(played.session.world().size().strikes, 0U) << "they were for now";
}

/// Whoever does what messages say is held up at the first of them until `keepGoing`.
struct HeldUp : Played {
    std::unique_ptr<OscPort> openHeldUp() {
        OscHooks hooks;
        hooks.apply = [this](const LineInput& input, const OscOrigin&) {
            isHeldUp = true;
            while (!keepGoing) std::this_thread::sleep_for(std::chrono::milliseconds{1});
            const auto* silence = std::get_if<SilenceControl>(&input);
            return silence != nullptr ? applySilence(output.silence(), *silence, MuteRequester::osc)
                                      : std::string{};
        };
        auto port = std::make_unique<OscPort>(anyPort(), session, messages, output, std::move(hooks));
        sender.emplace(senderTo(*port));
        EXPECT_TRUE(sender->send(oscPacket("/physvib/tilt", {"", {{"angle_rad", 0.5}}})));
        EXPECT_TRUE(comes([this] { return isHeldUp.load(); }));
        return port;
    }
    void silence(bool isOn) {
        EXPECT_TRUE(sender->send(oscPacket("/physvib/silence", {"", {{"on", isOn ? 1.0 : 0.0}}})));
    }

    std::optional<UdpSocket> sender;
    std::atomic<bool> isHeldUp{false}, keepGoing{false};
};

TEST(OscPorts, SilenceOvertakesTenThousandMessagesThatWait) {
    HeldUp played;
    const auto port = played.openHeldUp();
    const auto gain = oscPacket("/physvib/gain", {"", {{"channel", 1.0}, {"value", 0.5}}});
    for (int k = 0; k < 10'000; ++k) {
        played.sender->send(gain);
        if (k % 100 == 99)
            std::this_thread::sleep_for(std::chrono::milliseconds{1}); // the system's buffer is small
    }
    played.silence(true);
    EXPECT_TRUE(comes([&] { return played.output.isSilent(); }));
    EXPECT_EQ(port->status().counts.messages, 0U) << "nothing of what came before it is done";
    played.keepGoing = true;
    EXPECT_TRUE(comes([&] { return port->status().counts.packets + port->status().counts.lost == 10'002; }));
    EXPECT_EQ(nextOf(*played.sender).address, "/physvib/answer/silence") << "who asked is answered";
}

TEST(OscPorts, AnOffComesInItsTurnAndLiftsNoLaterOn) {
    for (const auto& [asked, isSilent] : {std::pair{std::vector{true, false}, false},
                                          {std::vector{false, true}, true},
                                          {std::vector{true, false, true}, true}}) {
        HeldUp played;
        const auto port = played.openHeldUp();
        for (const bool isOn : asked) played.silence(isOn);
        EXPECT_TRUE(comes([&] { return played.output.isSilent(); }));
        played.keepGoing = true;
        const std::uint64_t messages = asked.size() + 1;
        EXPECT_TRUE(comes([&] { return port->status().counts.messages == messages; }));
        EXPECT_EQ(played.output.isSilent(), isSilent);
    }
}

TEST(OscPorts, WhoSaysSomethingWrongIsToldSo) {
    Played played;
    const auto port = played.open(anyPort());
    auto says = senderTo(*port);
    ASSERT_TRUE(says.send(
        oscPacket("/physvib/strike", {"", {{"frequency_hz", 200.0}, {"seconds", 1.0}, {"level", 2.0}}})));
    const auto error = nextOf(says);
    EXPECT_EQ(error.address, oscErrorAddress);
    ASSERT_EQ(error.values.size(), 2U);
    EXPECT_EQ(std::get<std::string>(error.values[0]), "/physvib/strike");
    EXPECT_EQ(std::get<std::string>(error.values[1]), "strike: level: expected 0 to 1, found 2");
}

// As where a window's thread finds out.
TEST(OscPorts, WhatCouldNotBeDoneAfterAllIsToldToItsSender) {
    Played played;
    OscHooks hooks;
    std::promise<OscOrigin> taken;
    hooks.apply = [&taken](const LineInput&, const OscOrigin& origin) {
        return taken.set_value(origin), std::string{};
    };
    OscPort port{anyPort(), played.session, played.messages, played.output, std::move(hooks)};
    auto says = senderTo(port);
    ASSERT_TRUE(says.send(oscPacket("/physvib/tilt", {"", {{"angle_rad", 0.5}}})));
    port.refuse(taken.get_future().get(), "tilt: expected\nanother day");
    const auto error = nextOf(says);
    EXPECT_EQ(error.address, oscErrorAddress);
    EXPECT_EQ(std::get<std::string>(error.values.at(0)), "/physvib/tilt");
    EXPECT_EQ(std::get<std::string>(error.values.at(1)), "tilt: expected\\x0aanother day");
}

// Of 300 queries in less than a second few are answered, and what is not is counted.
TEST(OscPorts, NobodyGetsMuchMoreThanHeSends) {
    Played played;
    const auto port = played.open(anyPort());
    auto asks = senderTo(*port);
    const auto status = oscPacket("/physvib/status", {});
    constexpr std::uint64_t each = 300;
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint64_t k = 0; k < each; ++k) ASSERT_TRUE(asks.send(status));
    ASSERT_TRUE(comes([&] { return port->status().counts.packets == each; }));
    const auto seconds =
        1 +
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin).count();
    std::size_t bytes = 0, answers = 0;
    for (; asks.wait(100); ++answers) bytes += asks.receive()->size();
    EXPECT_GT(answers, 0U);
    EXPECT_LE(bytes, each * status.size() + static_cast<std::size_t>(seconds) * OscReplyLimiter::freeBytes);
    EXPECT_EQ(port->status().counts.heldBack, each - answers);
}

TEST(OscPorts, HitsLeaveWithTheTimeAtWhichTheyAreFelt) {
    Played played;
    auto in = std::move(UdpSocket::listenAt(oscLoopbackAddress, 0).value);
    OscSettings out;
    out.receiver = std::string(oscLoopbackAddress) + ":" + std::to_string(in.port());
    const auto port = played.open(out);
    ASSERT_EQ(port->error(), "");
    EXPECT_EQ(port->port(), 0) << "nothing is taken";
    EXPECT_EQ(nextOf(in).address, "/physvib/answer/status") << "the clock is known";
    CollisionEvent hit;
    hit.timeNs = 2'500'000'000;
    hit.frequencyHz = 250.0;
    hit.amplitude = 0.5;
    hit.x = 1.5;
    // a late one is felt at the frame at which it began, also after three days
    for (const auto& [isLate, seconds] : {std::pair{false, 3}, {true, 3}, {true, 259'200}}) {
        port->onPlayed({hit, std::int64_t{seconds} * hostRate, isLate}, hostRate);
        const OscMessage told = nextOf(in);
        EXPECT_EQ(told.address, oscHitAddress);
        const std::int64_t feltNs = isLate ? 1'000'000'000 * std::int64_t{seconds} : hit.timeNs;
        EXPECT_LT(std::abs(unixNsFromTag(told.tag) - unixMinusSteadyNs() - feltNs), 1'000'000)
            << "session time is the steady clock's there";
        const auto plain = parseOscValues("hit", told.values);
        EXPECT_EQ(plain.value.values.at(0), (NamedValue{"session_s", isLate ? double(seconds) : 2.5}));
        EXPECT_EQ(plain.value.values.at(1), (NamedValue{"frequency_hz", 250.0}));
        EXPECT_EQ(plain.value.values.at(4), (NamedValue{"x_m", 1.5}));
    }
}

// What is sent back to a sender, by a clock of the test's own.

constexpr std::int64_t ms = 1'000'000;

// Whatever comes, in every second, and for every address.
TEST(OscRepliesLimits, NoSecondHasMoreThanCamePlusTwoKilobytes) {
    struct Passed {
        std::int64_t atNs;
        std::size_t came, sent;
    };
    OscReplyLimiter replies;
    std::mt19937 random{5};
    std::map<std::string, std::deque<Passed>> last;
    std::size_t most = 0;
    std::int64_t now = 0;
    for (int k = 0; k < 200'000; ++k) {
        now += static_cast<std::int64_t>(random() % (k % 10'000 < 5'000 ? ms : 20 * ms));
        const std::string address = "198.51.100." + std::to_string(random() % 3);
        Passed passed{now, 8 + random() % 120, 0};
        replies.packetReceived(address + ":" + std::to_string(random() % 60'000), passed.came, now);
        for (auto answers = random() % 4; answers > 0; --answers)
            if (const std::size_t bytes = 20 + random() % 600; replies.tryReply(bytes)) passed.sent += bytes;
        auto& second = last[address];
        second.push_back(passed);
        while (second.front().atNs <= now - 1000 * ms) second.pop_front();
        std::size_t came = 0, sent = 0;
        for (const Passed& one : second) came += one.came, sent += one.sent;
        most = std::max(most, sent - std::min(sent, came));
        ASSERT_LE(sent, came + OscReplyLimiter::freeBytes) << k;
    }
    EXPECT_GT(most, OscReplyLimiter::freeBytes * 3 / 4) << "it is this limit that holds";
}

TEST(OscRepliesLimits, ARefusalOfACauseIsSentTenTimesASecond) {
    OscReplyLimiter replies;
    int told = 0, others = 0;
    for (std::int64_t now = 0; now < 1000 * ms; now += ms) {
        replies.packetReceived("192.0.2.1:5", 100, now);
        told += replies.tryRefusal("strike: level: expected 0 to 1, found " + std::to_string(now)) ? 1 : 0;
        replies.packetReceived("192.0.2.2:5", 100, now);
        others += replies.tryRefusal("strike: level: expected 0 to 1, found 2") ? 1 : 0;
    }
    EXPECT_EQ(told, 10);
    EXPECT_EQ(others, 10) << "each address by itself";
    replies.packetReceived("192.0.2.1:5", 100, 1000 * ms);
    EXPECT_TRUE(replies.tryRefusal("strike: level: expected 0 to 1, found 3"));
    EXPECT_TRUE(replies.tryRefusal("gain: channel: expected a channel from 1 to 4, found 9"))
        << "another cause";
    EXPECT_FALSE(replies.tryRefusal("gain: channel: expected a channel from 1 to 4, found 5"));
}

TEST(OscRepliesLimits, ProgramsOfThisComputerAreToldApartOthersByTheirComputer) {
    OscReplyLimiter replies;
    const auto spend = [&replies](const char* sender, std::int64_t now) {
        std::size_t sent = 0;
        replies.packetReceived(sender, 0, now);
        while (replies.tryReply(100)) sent += 100;
        return sent;
    };
    EXPECT_EQ(spend("127.0.0.1:4000", 0), OscReplyLimiter::freeBytes);
    EXPECT_EQ(spend("127.0.0.1:4001", 0), OscReplyLimiter::freeBytes);
    EXPECT_EQ(spend("192.0.2.1:4000", 0), OscReplyLimiter::freeBytes);
    EXPECT_EQ(spend("192.0.2.1:4001", 0), 0U) << "a port is easily made up";
    EXPECT_EQ(spend("192.0.2.1:4001", 999 * ms), 0U);
    EXPECT_EQ(spend("192.0.2.1:4001", 1000 * ms), OscReplyLimiter::freeBytes);
}

TEST(OscRepliesLimits, AddressesThatAreMadeUpGetLittleTogether) {
    OscReplyLimiter replies;
    std::size_t sent = 0;
    for (int k = 0; k < 10'000; ++k) {
        replies.packetReceived("10.0." + std::to_string(k / 250) + '.' + std::to_string(k % 250) + ":1", 24,
                               0);
        for (int answers = 0; answers < 100; ++answers)
            if (replies.tryReply(100)) sent += 100;
    }
    EXPECT_LE(sent, OscReplyLimiter::maxSenders * (OscReplyLimiter::freeBytes + 24));
    replies.packetReceived("192.0.2.1:5", 24, 1000 * ms);
    EXPECT_TRUE(replies.tryReply(100)) << "a second later there is room again";
}

} // namespace physvib::osc_port_test
