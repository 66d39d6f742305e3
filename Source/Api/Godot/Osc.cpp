// SPDX-License-Identifier: MIT
#include "Api/Godot/Osc.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace physvib::godot {

namespace {
class Packet {
public:
    void add(std::string_view text) {
        for (const char each : text) add(each);
        for (std::size_t i = text.size() % 4; i < 4; ++i) add('\0'); // texts end with 1 to 4 zeros
    }
    void add(double number) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
        for (const int shift : {24, 16, 8, 0}) add(static_cast<char>(bits >> shift & 0xFFU));
    }
    const Value& bytes() const { return data; }

private:
    void add(char byte) { data.call("append", static_cast<unsigned char>(byte)); }
    Value data = Value::empty(GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY);
};
} // namespace

std::string Osc::open(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    const Value port = Value(colon < address.size() ? address.substr(colon + 1).c_str() : "").call("to_int");
    if (port.whole() < 1 || port.whole() > 65'535)
        return "outputs: osc: expected an address such as osc:127.0.0.1:9000, found osc:" + address;
    peer = singleton("ClassDB").call("instantiate", "PacketPeerUDP");
    peer.call("set_broadcast_enabled", true);
    const Value error = peer.call("set_dest_address", address.substr(0, colon).c_str(), port);
    return error.whole() == 0 ? "" : "outputs: osc: there is no host " + address.substr(0, colon);
}

void Osc::play(const physvib_event& event) const {
    Packet packet;
    packet.add("/physvib/strike");
    packet.add(",sfsfsffsf");
    packet.add("frequency_hz"), packet.add(event.frequency_hz);
    packet.add("decay_per_s"), packet.add(event.decay_per_s);
    packet.add("place"), packet.add(event.x_m), packet.add(event.y_m);
    packet.add("level"), packet.add(std::min(1.0, event.amplitude));
    peer.call("put_packet", packet.bytes());
}

} // namespace physvib::godot
