// SPDX-License-Identifier: MIT
// Messages: round trips, the compact form, versions, and a decoder in a storm of broken bytes.
#include "Wire/Messages.h"
#include "Wire/FrameDecoder.h"
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <vector>

namespace physvib::messages_test {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
Bytes framed(const Message& message) {
    Bytes frame(wire::maxFrame);
    frame.resize(wire::encode(message, frame));
    return frame;
}

template <class Message>
bool read(const Bytes& bytes, Message& message) {
    wire::FrameDecoder decoder;
    bool found = false;
    for (const auto b : bytes)
        if (const auto payload = decoder.feed(b); !payload.empty()) found = wire::decode(payload, message);
    return found;
}

wire::Strike someStrike(std::mt19937& random, std::uint8_t sequence) {
    wire::Strike s;
    s.sequence = sequence;
    s.event.frame = static_cast<std::uint32_t>(random());
    s.event.frequency16 = static_cast<std::uint16_t>(random());
    s.event.decay16 = static_cast<std::uint16_t>(random() % 3 == 0 ? 0 : random());
    s.event.durationMs = static_cast<std::uint16_t>(random());
    for (auto& a : s.event.amplitudes) a = static_cast<std::int16_t>(random() % 5 == 0 ? 0 : random());
    return s;
}

template <class Message>
std::vector<std::int64_t> fieldsOf(Message message) {
    std::vector<std::int64_t> all;
    message.visit([&](auto& field) { all.push_back(field); });
    return all;
}

/// The length of its frame.
template <class Message>
std::size_t expectItComesBackAsItWas() {
    std::mt19937 random{3};
    const auto any = [&](auto& field) {
        field = static_cast<std::remove_reference_t<decltype(field)>>(random() % 7 == 0 ? 0 : random());
    };
    Message sent, got;
    for (int i = 0; i < 10000 && !testing::Test::HasFailure(); ++i) {
        sent.visit(any);
        EXPECT_TRUE(read(framed(sent), got));
        EXPECT_EQ(fieldsOf(got), fieldsOf(sent));
    }
    return framed(sent).size();
}

TEST(Messages, EachComesBackAsItWas) {
    EXPECT_EQ(expectItComesBackAsItWas<wire::Strike>(), 24u) << "480 a second at 115,200 bit/s";
    EXPECT_EQ(expectItComesBackAsItWas<wire::Segment>(), 36u) << "320 a second at 115,200 bit/s";
    EXPECT_LE(expectItComesBackAsItWas<wire::Telemetry>(), wire::maxFrame);
    EXPECT_EQ(fieldsOf(wire::Telemetry{}).size(), 16u);
}

TEST(Messages, TelemetryOfAnImageWithoutAGuardIsRead) {
    wire::Telemetry sent, got;
    sent.silenced = 1;
    sent.guarded = 7;
    std::array<std::uint8_t, wire::maxPayload> payload{static_cast<std::uint8_t>(wire::Type::telemetry)};
    wire::Writer write{std::span(payload).subspan(1)};
    sent.visit(write);
    const std::size_t older = 1 + write.size() - wire::Telemetry::optionalBytes;
    ASSERT_TRUE(wire::decode(std::span(payload).first(older), got));
    EXPECT_EQ(got.silenced, 1);
    EXPECT_EQ(got.guarded, 0);
    EXPECT_FALSE(wire::decode(std::span(payload).first(older - 1), got));
}

TEST(Messages, TheCompactFormKeepsAllButHalfAStepOfAmplitude) {
    std::mt19937 random{2};
    for (int i = 0; i < 10000; ++i) {
        auto sent = someStrike(random, 7);
        sent.event.durationMs = 0;
        for (auto& a : sent.event.amplitudes)
            a = static_cast<std::int16_t>(static_cast<int>(random() % 8191) - 4096);
        ASSERT_EQ(wire::fitsCompact(sent.event),
                  *std::max_element(sent.event.amplitudes.begin(), sent.event.amplitudes.end()) < 4080);
        if (!wire::fitsCompact(sent.event)) continue;
        wire::CompactStrike got;
        const Bytes frame = framed(wire::toCompact(sent));
        ASSERT_TRUE(read(frame, got));
        ASSERT_EQ(frame.size(), 16u) << "720 a second";
        const std::uint32_t now =
            sent.event.frame + static_cast<std::uint32_t>(static_cast<int>(random() % 60000) - 30000);
        const auto back = wire::expand(got, now).event;
        EXPECT_EQ(back.frame, sent.event.frame);
        EXPECT_EQ(back.frequency16, sent.event.frequency16);
        EXPECT_EQ(back.decay16, sent.event.decay16);
        for (std::size_t j = 0; j < 4; ++j)
            ASSERT_LE(std::abs(back.amplitudes[j] - sent.event.amplitudes[j]), 16);
    }
    BoardEvent cut;
    cut.durationMs = 1;
    EXPECT_FALSE(wire::fitsCompact(cut));
}

TEST(Messages, AReaderSkipsFieldsOfLaterVersionsAndRefusesShortOnes) {
    Bytes payload{static_cast<std::uint8_t>(wire::Type::ping), 42, 99, 98};
    wire::Ping ping;
    EXPECT_TRUE(wire::decode(payload, ping));
    EXPECT_EQ(ping.id, 42);
    payload.resize(1);
    EXPECT_FALSE(wire::decode(payload, ping));
    EXPECT_EQ(ping.id, 42) << "nothing half-read";
    wire::StopAll stop;
    EXPECT_FALSE(wire::decode(payload, stop)) << "another type";
}

// Strikes over a line that flips, drops, doubles and inserts bytes. A frame that no fault has touched must
// arrive, or at most the one after a fault must not; a frame that was never sent must not, beyond the CRC's
// chance of 2^-16.
TEST(FrameDecoder, AMillionFramesThroughNoise) {
    std::mt19937 random{20};
    wire::FrameDecoder decoder;
    std::map<std::uint32_t, wire::Strike> onTheWay;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    constexpr int frames = 50'000;
#else
    constexpr int frames = 1'000'000;
#endif
    int touched = 0, arrived = 0, missing = 0, wrong = 0;
    bool wasClean = true;
    for (int i = 0; i < frames; ++i) {
        auto sent = someStrike(random, static_cast<std::uint8_t>(i));
        sent.event.frame = static_cast<std::uint32_t>(i);
        bool isClean = true, hasArrived = false;
        for (std::uint8_t byte : framed(sent)) {
            int copies = 1;
            if (random() % 200 == 0) {
                isClean = false;
                const auto kind = random() % 4;
                if (kind == 0) byte = static_cast<std::uint8_t>(byte ^ (1u << random() % 8));
                if (kind == 1) copies = 0;
                if (kind == 2) copies = 2;
                if (kind == 3) decoder.feed(static_cast<std::uint8_t>(random()));
            }
            for (; copies > 0; --copies) {
                wire::Strike got;
                if (!wire::decode(decoder.feed(byte), got)) continue;
                if (got.event == sent.event && got.sequence == sent.sequence)
                    hasArrived = true;
                else
                    ++wrong;
            }
        }
        touched += isClean ? 0 : 1;
        arrived += hasArrived ? 1 : 0;
        if (isClean && wasClean && !hasArrived) ++missing;
        wasClean = isClean; // a fault in the final zero also takes the frame after it
    }
    EXPECT_EQ(missing, 0) << "in step again within a frame";
    EXPECT_LE(wrong, 4 + touched / 65536) << "the CRC's chance";
    EXPECT_GT(touched, frames / 10);
    EXPECT_GT(arrived, frames - touched - touched / 10);
    RecordProperty("touched", touched);
    RecordProperty("wrong", wrong);
    std::cout << "frames " << frames << ", touched by noise " << touched << ", arrived " << arrived
              << ", wrong " << wrong << ", bad " << decoder.badFrames() << '\n';
}

TEST(FrameDecoder, ALineWithoutAZeroIsOneBadFrame) {
    wire::FrameDecoder decoder;
    for (int i = 0; i < 100000; ++i)
        EXPECT_TRUE(decoder.feed(static_cast<std::uint8_t>(1 + i % 255)).empty());
    decoder.feed(0);
    EXPECT_EQ(decoder.badFrames(), 1u);
    wire::Ping ping;
    for (const auto b : framed(wire::Ping{9})) wire::decode(decoder.feed(b), ping);
    EXPECT_EQ(ping.id, 9);
}

} // namespace physvib::messages_test
