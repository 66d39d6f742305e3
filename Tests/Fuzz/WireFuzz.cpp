// SPDX-License-Identifier: MIT
// Fuzz target of the link: any bytes through the decoder; what passes is written and read again.
#include "Fuzzing.h"
#include "Wire/FrameDecoder.h"

namespace {

template <class Message>
void demandRoundTrip(std::span<const std::uint8_t> payload) {
    using namespace physvib;
    Message message;
    if (!wire::decode(payload, message)) return;
    std::array<std::uint8_t, wire::maxFrame> frame{}, again{};
    const auto size = wire::encode(message, frame);
    wire::FrameDecoder decoder;
    Message read;
    bool arrived = false;
    for (std::size_t i = 0; i < size; ++i) {
        fuzz::demand(i + 1 == size || frame[i] != 0, "a zero inside a frame");
        arrived = wire::decode(decoder.feed(frame[i]), read);
    }
    fuzz::demand(arrived && decoder.goodFrames() == 1 && decoder.badFrames() == 0,
                 "cannot read what was written");
    fuzz::demand(wire::encode(read, again) == size && frame == again, "written differently");
}

template <class... Messages>
void demandRoundTrips(std::span<const std::uint8_t> payload) {
    (demandRoundTrip<Messages>(payload), ...);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib::wire;
    FrameDecoder decoder;
    for (std::size_t i = 0; i < size; ++i)
        demandRoundTrips<Hello, HelloReply, Strike, CompactStrike, Segment, Gains, Ping, Pong,
                         TelemetryRequest, Telemetry, StopAll, SelfTest, SelfTestReply>(
            decoder.feed(data[i]));
    return 0;
}
