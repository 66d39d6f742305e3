// SPDX-License-Identifier: GPL-3.0-or-later
// Datagrams within this computer, on every system.
#include "Live/Sockets/UdpSocket.h"
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace physvib::udp_socket_test {

constexpr int soon = 10'000, atOnce = 20;
const std::string here = "127.0.0.1";

std::string textOf(const std::optional<std::span<const char>>& packet) {
    return packet ? std::string{packet->begin(), packet->end()} : std::string{"nothing"};
}

TEST(UdpSockets, APacketArrivesWholeAndItsAnswerComesBack) {
    auto in = UdpSocket::listenAt(here, 0);
    ASSERT_TRUE(in) << in.error;
    EXPECT_GT(in.value.port(), 0);
    EXPECT_GT(in.value.bufferBytes(), 0);
    auto out = UdpSocket::connectTo(here + ":" + std::to_string(in.value.port()));
    ASSERT_TRUE(out) << out.error;
    EXPECT_FALSE(in.value.wait(atOnce));
    EXPECT_EQ(textOf(in.value.receive()), "nothing") << "and nobody waits for it";
    const std::string longest(8'000, 'x');
    ASSERT_TRUE(out.value.send(longest));
    ASSERT_TRUE(in.value.wait(soon));
    EXPECT_EQ(textOf(in.value.receive()), longest);
    EXPECT_TRUE(in.value.sender().text().starts_with(here + ":")) << in.value.sender().text();
    EXPECT_EQ(in.value.resetDroppedCount(), 0U);
    ASSERT_TRUE(in.value.answer(std::string{"yes"}, in.value.sender()));
    ASSERT_TRUE(out.value.wait(soon));
    EXPECT_EQ(textOf(out.value.receive()), "yes");
}

TEST(UdpSockets, APortHasOneOwner) {
    const auto last = UdpSocket::listenAt(here, 65'535); // or another program has it
    EXPECT_EQ(UdpSocket::listenAt(here, 65'535).error,
              here + ": expected a free port from 65535 on, found none");
    auto first = UdpSocket::listenAt(here, 0);
    ASSERT_TRUE(first) << first.error;
    auto second = UdpSocket::listenAt(here, first.value.port());
    ASSERT_TRUE(second) << second.error;
    EXPECT_NE(second.value.port(), first.value.port());
    auto moved = std::move(first.value);
    EXPECT_FALSE(first.value.isOpen());
    EXPECT_TRUE(moved.isOpen());
}

TEST(UdpSockets, WhatCannotBeIsToldInALine) {
    EXPECT_FALSE(UdpSocket::listenAt("not an address", 9000));
    for (const char* many : {"255.255.255.255", "224.0.0.1", "239.1.2.3", "ff02::1"})
        EXPECT_FALSE(UdpSocket::listenAt(many, 0)) << many;
    EXPECT_TRUE(UdpSocket::listenAt("localhost", 0));
    EXPECT_EQ(UdpSocket::connectTo("nowhere").error, "expected HOST:PORT, found \"nowhere\"");
    EXPECT_FALSE(UdpSocket::connectTo(here + ":70000"));
    EXPECT_FALSE(UdpSocket{}.wait(1)) << "where none is open, nothing comes";
}

} // namespace physvib::udp_socket_test
