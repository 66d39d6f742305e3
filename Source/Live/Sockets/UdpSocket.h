// SPDX-License-Identifier: MIT
// UDP socket, bound to one address and a port of its own, or connected to one receiver.
#pragma once
#include "Io/Result.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace physvib {

/// Address of a packet's sender.
struct UdpSender {
    alignas(8) std::array<std::byte, 128> address{}; ///< a sockaddr_storage
    std::size_t size = 0;
    std::string text() const; ///< HOST:PORT
};

/// A non-blocking socket. One thread per direction.
class UdpSocket {
public:
    static constexpr int maxPortAttempts = 100;
    static constexpr int wantedBufferBytes = 4 << 20; ///< the system may give less (net.core.rmem_max)

    UdpSocket() = default;
    UdpSocket(UdpSocket&& other) noexcept;
    UdpSocket& operator=(UdpSocket&& other) noexcept;
    ~UdpSocket();

    /// Binds to that local address and port, or to the next port that is free; 0: any. The port is never
    /// shared. Returns the error in one line otherwise.
    static Result<UdpSocket> listenAt(const std::string& address, int port);

    /// Connects to `HOST:PORT` or `[ADDRESS]:PORT`, or returns the error in one line.
    static Result<UdpSocket> connectTo(const std::string& receiver);

    bool isOpen() const noexcept { return handle_ != none; }
    int port() const noexcept { return port_; }
    int bufferBytes() const; ///< as the system reports, with its own overhead

    /// Whether a packet arrives within that time; false if the socket is not open.
    bool wait(int milliseconds) const noexcept;
    /// The next packet, if there is one; valid until the next call.
    std::optional<std::span<const char>> receive();
    /// Sender of that packet.
    const UdpSender& sender() const noexcept { return sender_; }
    /// Packets dropped by the system for lack of buffer space, since the last call.
    std::uint32_t resetDroppedCount() noexcept;
    /// answer() sends to a sender, send() to the connected receiver; false: not sent.
    bool answer(std::span<const char> bytes, const UdpSender& receiver) noexcept;
    bool send(std::span<const char> bytes) noexcept;

private:
    using Handle = std::intptr_t; // as the system defines it
    static constexpr Handle none = -1;
    explicit UdpSocket(Handle handle) noexcept
        : handle_{handle} {}
    Handle handle_ = none;
    int port_ = 0;
    std::string packet_;
    UdpSender sender_;
    std::uint32_t dropped_ = 0, seen_ = 0;
};

} // namespace physvib
