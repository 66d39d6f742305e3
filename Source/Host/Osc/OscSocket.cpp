// SPDX-License-Identifier: GPL-3.0-or-later
// Names, ports and datagrams.
#include "Host/Osc/OscSocket.h"
#include "Files/Text/NumberText.h"
#include <cerrno>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t longestPacket = 65'536;

struct FreeAddresses {
    void operator()(addrinfo* all) const { freeaddrinfo(all); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Result<std::shared_ptr<addrinfo>> lookUp(const std::string& host, int port, int flags) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_DGRAM;
    wanted.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (const int fault = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found)) return Failure{inQuotes(host) + ": " + gai_strerror(fault)};
    return std::shared_ptr<addrinfo>(Addresses{found});
}

int portOf(const sockaddr_storage& address) {
    const auto port = address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port : reinterpret_cast<const sockaddr_in&>(address).sin_port;
    return ntohs(port);
}

int openedFor(const addrinfo& address) { return socket(address.ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); }

} // namespace

OscSocket::OscSocket(OscSocket&& other) noexcept { *this = std::move(other); }

OscSocket& OscSocket::operator=(OscSocket&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(port_, other.port_);
    bytes_.swap(other.bytes_);
    return *this;
}

OscSocket::~OscSocket() {
    if (isOpen()) close(handle_);
}

// Without SO_REUSEADDR: of two programs that have it, one would get nothing, and nobody would be told.
Result<OscSocket> OscSocket::listening(const std::string& address, int port) {
    for (int tried = port; tried < port + triedPorts && tried <= 65'535; ++tried) {
        const auto found = lookUp(address, tried, AI_PASSIVE | AI_NUMERICHOST);
        if (!found) return Failure{found.error};
        OscSocket own{openedFor(*found.value)};
        if (own.isOpen() && bind(own.handle_, found.value->ai_addr, found.value->ai_addrlen) == 0) {
            setsockopt(own.handle_, SOL_SOCKET, SO_RCVBUF, &wantedBufferBytes, sizeof wantedBufferBytes);
            const int on = 1;
            setsockopt(own.handle_, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
            sockaddr_storage bound{};
            socklen_t size = sizeof bound;
            getsockname(own.handle_, reinterpret_cast<sockaddr*>(&bound), &size);
            own.port_ = portOf(bound);
            own.bytes_.resize(longestPacket);
            return own;
        }
        if (errno != EADDRINUSE && errno != EACCES) return Failure{address + ": " + std::strerror(errno)};
    }
    return Failure{address + ": expected a free port from " + std::to_string(port) + " on, found none"};
}

Result<OscSocket> OscSocket::connected(const std::string& receiver) {
    const auto colon = receiver.rfind(':');
    const auto port = colon == std::string::npos ? std::nullopt : parseNumber<int>(std::string_view{receiver}.substr(colon + 1));
    if (!port || *port < 1 || *port > 65'535) return Failure{"expected HOST:PORT, found " + inQuotes(receiver)};
    std::string host = receiver.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    const auto found = lookUp(host, *port, 0);
    if (!found) return Failure{found.error};
    OscSocket own{openedFor(*found.value)};
    own.bytes_.resize(longestPacket);
    if (!own.isOpen() || connect(own.handle_, found.value->ai_addr, found.value->ai_addrlen) != 0) return Failure{receiver + ": " + std::strerror(errno)};
    return own;
}

int OscSocket::bufferBytes() const {
    int bytes = 0;
    socklen_t size = sizeof bytes;
    getsockopt(handle_, SOL_SOCKET, SO_RCVBUF, &bytes, &size);
    return bytes;
}

std::optional<std::span<const char>> OscSocket::receive() {
    alignas(cmsghdr) char told[64];
    iovec part{bytes_.data(), bytes_.size()};
    msghdr packet{};
    packet.msg_name = &sender_;
    packet.msg_namelen = sizeof sender_;
    packet.msg_iov = &part;
    packet.msg_iovlen = 1;
    packet.msg_control = told;
    packet.msg_controllen = sizeof told;
    const ssize_t size = recvmsg(handle_, &packet, 0);
    if (size < 0) return std::nullopt;
    senderSize_ = packet.msg_namelen;
    for (cmsghdr* one = CMSG_FIRSTHDR(&packet); one != nullptr; one = CMSG_NXTHDR(&packet, one))
        if (one->cmsg_level == SOL_SOCKET && one->cmsg_type == SO_RXQ_OVFL) std::memcpy(&lost_, CMSG_DATA(one), sizeof lost_);
    return std::span<const char>{bytes_.data(), static_cast<std::size_t>(size)};
}

std::string OscSocket::sender() const {
    char host[NI_MAXHOST], port[NI_MAXSERV];
    if (getnameinfo(reinterpret_cast<const sockaddr*>(&sender_), senderSize_, host, sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV) != 0) return "unknown";
    return std::string(host) + ":" + port;
}

std::uint32_t OscSocket::takeLost() noexcept { return lost_ - std::exchange(toldLost_, lost_); }

bool OscSocket::answer(std::span<const char> bytes) noexcept {
    return sendto(handle_, bytes.data(), bytes.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&sender_), senderSize_) == static_cast<ssize_t>(bytes.size());
}

bool OscSocket::send(std::span<const char> bytes) noexcept { return ::send(handle_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size()); }

} // namespace physvib
