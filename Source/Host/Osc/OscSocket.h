// SPDX-License-Identifier: GPL-3.0-or-later
// A socket of UDP: bound to one address and to a port of its own, or connected to one receiver.
#pragma once
#include "Io/Result.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace physvib {

/// Where a packet came from.
struct OscSender {
    alignas(8) std::array<std::byte, 128> address{}; ///< a sockaddr_storage
    std::size_t size = 0;
    std::string text() const; ///< HOST:PORT
};

/// One thread per direction.
class OscSocket {
public:
    static constexpr int triedPorts = 100;
    static constexpr int wantedBufferBytes = 4 << 20; ///< the system gives less if it is told to
                                                      ///< (net.core.rmem_max)

    OscSocket() = default;
    OscSocket(OscSocket&& other) noexcept;
    OscSocket& operator=(OscSocket&& other) noexcept;
    ~OscSocket();

    /// At that address of this computer and that port, or else the next one that nobody has; 0: any. Never
    /// one that others share. Or one line.
    static Result<OscSocket> listening(const std::string& address, int port);

    /// To `HOST:PORT` or `[ADDRESS]:PORT`. Or one line.
    static Result<OscSocket> connected(const std::string& receiver);

    bool isOpen() const noexcept { return handle_ != none; }
    int port() const noexcept { return port_; }
    int bufferBytes() const; ///< as the system counts them, with its own

    /// Whether something comes in that time; nothing does where it is not open.
    bool wait(int milliseconds) const noexcept;
    /// What has come, if something has; valid until the next call.
    std::optional<std::span<const char>> receive();
    /// From where that was.
    const OscSender& sender() const noexcept { return sender_; }
    /// Packets that found no room, since the last call.
    std::uint32_t takeLost() noexcept;
    /// To who sent something, or to the receiver that it is connected to; false: it did not leave.
    bool answer(std::span<const char> bytes, const OscSender& to) noexcept;
    bool send(std::span<const char> bytes) noexcept;

private:
    using Handle = std::intptr_t; // the system's
    static constexpr Handle none = -1;
    explicit OscSocket(Handle handle) noexcept
        : handle_{handle} {}
    Handle handle_ = none;
    int port_ = 0;
    std::string bytes_;
    OscSender sender_;
    std::uint32_t lost_ = 0, toldLost_ = 0;
};

} // namespace physvib
