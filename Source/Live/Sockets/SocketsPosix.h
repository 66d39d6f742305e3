// SPDX-License-Identifier: MIT
// Datagram sockets on POSIX, behind the interface that SocketsWindows.h has too. For UdpSocket.cpp only.
#pragma once
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <span>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace physvib::sockets {

using Handle = int;
using Size = std::size_t;
constexpr int sendFlags = MSG_NOSIGNAL;

inline void begin() noexcept {}
inline Handle open(int family) noexcept {
    return socket(family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}
inline void close(Handle socket) noexcept { ::close(socket); }

/// Binds that port exclusively, or returns false. SO_REUSEADDR is not set: of two programs with that option,
/// one would get no packets, without any error.
inline bool bindExclusively(Handle socket, const sockaddr* address, socklen_t size) noexcept {
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
    return bind(socket, address, size) == 0;
}

/// Error text of the last call, and whether another program has the port.
inline std::string lastError() { return std::strerror(errno); }
inline bool isPortInUse() noexcept { return errno == EADDRINUSE || errno == EACCES; }

inline bool wait(Handle socket, int milliseconds) noexcept {
    pollfd in{socket, POLLIN, 0};
    return poll(&in, 1, milliseconds) > 0;
}

/// Size of the packet, or less than 0; its sender; how many were dropped so far, if the system tells it.
inline std::ptrdiff_t receive(Handle socket, std::span<char> bytes, sockaddr_storage& sender,
                              socklen_t& senderSize, std::uint32_t& lost) noexcept {
    alignas(cmsghdr) char control[64];
    iovec part{bytes.data(), bytes.size()};
    msghdr packet{};
    packet.msg_name = &sender;
    packet.msg_namelen = sizeof sender;
    packet.msg_iov = &part;
    packet.msg_iovlen = 1;
    packet.msg_control = control;
    packet.msg_controllen = sizeof control;
    const ssize_t size = recvmsg(socket, &packet, 0);
    if (size < 0) return size;
    senderSize = packet.msg_namelen;
    for (cmsghdr* header = CMSG_FIRSTHDR(&packet); header != nullptr; header = CMSG_NXTHDR(&packet, header))
        if (header->cmsg_level == SOL_SOCKET && header->cmsg_type == SO_RXQ_OVFL)
            std::memcpy(&lost, CMSG_DATA(header), sizeof lost);
    return size;
}

} // namespace physvib::sockets
