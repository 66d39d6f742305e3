// SPDX-License-Identifier: MIT
// Datagram sockets on Windows, behind the interface that SocketsPosix.h has too. For UdpSocket.cpp only.
#pragma once
#include "Io/Disk/SystemWindows.h"
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <system_error>
#include <winsock2.h>
#include <ws2tcpip.h>

namespace physvib::sockets {

using Handle = SOCKET;
using Size = int;
constexpr int sendFlags = 0;

inline void begin() noexcept {
    static const int startResult = [] {
        WSADATA data;
        return WSAStartup(MAKEWORD(2, 2), &data);
    }();
    static_cast<void>(startResult);
}

inline void close(Handle socket) noexcept { closesocket(socket); }

inline Handle open(int family) noexcept {
    const Handle opened = socket(family, SOCK_DGRAM, 0);
    u_long on = 1;
    if (opened == INVALID_SOCKET || ioctlsocket(opened, FIONBIO, &on) == 0) return opened;
    close(opened);
    return INVALID_SOCKET;
}

/// Binds that port exclusively, or returns false. By default, Windows lets another program bind it too.
inline bool bindExclusively(Handle socket, const sockaddr* address, socklen_t size) noexcept {
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_EXCLUSIVEADDRUSE, reinterpret_cast<const char*>(&on), sizeof on);
    return bind(socket, address, size) == 0;
}

/// Error text of the last call, and whether another program has the port.
inline std::string lastError() { return std::system_category().message(WSAGetLastError()); }
inline bool isPortInUse() noexcept {
    return WSAGetLastError() == WSAEADDRINUSE || WSAGetLastError() == WSAEACCES;
}

inline bool wait(Handle socket, int milliseconds) noexcept {
    WSAPOLLFD in{socket, POLLRDNORM, 0};
    return WSAPoll(&in, 1, milliseconds) > 0;
}

/// Size of the packet, or less than 0; and its sender. Windows does not report dropped packets.
inline std::ptrdiff_t receive(Handle socket, std::span<char> bytes, sockaddr_storage& sender,
                              socklen_t& senderSize, std::uint32_t&) noexcept {
    senderSize = sizeof sender;
    return recvfrom(socket, bytes.data(), static_cast<int>(bytes.size()), 0,
                    reinterpret_cast<sockaddr*>(&sender), &senderSize);
}

} // namespace physvib::sockets
