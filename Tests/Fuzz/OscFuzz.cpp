// SPDX-License-Identifier: MIT
// Fuzz target of OSC packets: read, and let in by the door.
#include "Fuzzing.h"
#include "Host/Osc/OscReceiver.h"
#include "SessionFuzzing.h"

using namespace physvib;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::unique_ptr<Session> session = fuzz::makeSession();
    session->prepare(8000, 256);
    MessageRouter messages{*session};
    OscReceiver door{
        *session,
        messages,
        {[](const LineInput& input, const OscOrigin&) {
             return session
                 ->submit({std::get_if<Action>(&input) ? std::get<Action>(input) : Action{TiltAction{}}})
                 .error;
         },
         {},
         fuzz::anyClip}};
    OscClock clock;
    std::vector<std::vector<char>> answers;
    const std::span<const char> bytes{reinterpret_cast<const char*>(data), size};
    const auto read = readOscPacket(bytes);
    door.receive(bytes, clock, answers);
    const OscCounts& counts = door.counts();
    fuzz::demand(counts.messages == read.value.size() && counts.malformed == (read ? 0u : 1u),
                 "counted otherwise than read", counts.lastError);
    fuzz::demand(counts.refused != counts.messages || session->world().size().strikes == 0,
                 "refused, and half done", counts.lastError);
    fuzz::demandLine(counts.lastError);
    for (const auto& answer : answers)
        fuzz::demand(static_cast<bool>(readOscPacket(answer)), "an answer that cannot be read");
    return 0;
}
