// SPDX-License-Identifier: MIT
// UDP socket on POSIX and Windows: name resolution, ports and datagrams.
#include "Live/Sockets/UdpSocket.h"
#include "Io/Text/NumberText.h"
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>
#include <utility>
#if defined(_WIN32)
#include "Live/Sockets/SocketsWindows.h"
#else
#include "Live/Sockets/SocketsPosix.h"
#endif

namespace physvib {
namespace {

constexpr std::size_t maxPacketBytes = 65'536;

Result<std::shared_ptr<addrinfo>> lookUp(const std::string& host, int port, int flags) {
    sockets::begin();
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found))
        return Failure{inQuotes(host) + ": " + gai_strerror(error)};
    return std::shared_ptr<addrinfo>(found, freeaddrinfo);
}

/// True for a multicast or broadcast address, whose packets go to many computers.
bool hasManyReceivers(const addrinfo& found) {
    if (found.ai_family == AF_INET6)
        return reinterpret_cast<const sockaddr_in6*>(found.ai_addr)->sin6_addr.s6_addr[0] == 0xff;
    return ntohl(reinterpret_cast<const sockaddr_in*>(found.ai_addr)->sin_addr.s_addr) >= 0xe0000000;
}

int readPort(const sockaddr_storage& address) {
    const auto port = address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                                    : reinterpret_cast<const sockaddr_in&>(address).sin_port;
    return ntohs(port);
}

sockets::Handle native(std::intptr_t handle) noexcept { return static_cast<sockets::Handle>(handle); }

std::intptr_t openHandle(const addrinfo& address) noexcept {
    return static_cast<std::intptr_t>(sockets::open(address.ai_family));
}

// Types of sizes and options differ between systems.
sockets::Size sizeOf(std::span<const char> bytes) noexcept {
    return static_cast<sockets::Size>(bytes.size());
}
socklen_t lengthOf(const addrinfo& address) noexcept { return static_cast<socklen_t>(address.ai_addrlen); }

} // namespace

UdpSocket::UdpSocket(UdpSocket&& other) noexcept { *this = std::move(other); }

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(port_, other.port_);
    packet_.swap(other.packet_);
    return *this;
}

UdpSocket::~UdpSocket() {
    if (isOpen()) sockets::close(native(handle_));
}

Result<UdpSocket> UdpSocket::listenAt(const std::string& address, int port) {
    for (int candidate = port; candidate < port + maxPortAttempts && candidate <= 65'535; ++candidate) {
        const auto found =
            lookUp(address == "localhost" ? "127.0.0.1" : address, candidate, AI_PASSIVE | AI_NUMERICHOST);
        if (!found) return Failure{found.error};
        if (hasManyReceivers(*found.value))
            return Failure{address + ": expected an address of this computer alone, or 0.0.0.0"};
        UdpSocket udp{openHandle(*found.value)};
        if (udp.isOpen() &&
            sockets::bindExclusively(native(udp.handle_), found.value->ai_addr, lengthOf(*found.value))) {
            setsockopt(native(udp.handle_), SOL_SOCKET, SO_RCVBUF,
                       reinterpret_cast<const char*>(&wantedBufferBytes), sizeof wantedBufferBytes);
            sockaddr_storage bound{};
            socklen_t size = sizeof bound;
            getsockname(native(udp.handle_), reinterpret_cast<sockaddr*>(&bound), &size);
            udp.port_ = readPort(bound);
            udp.packet_.resize(maxPacketBytes);
            return udp;
        }
        if (!sockets::isPortInUse()) return Failure{address + ": " + sockets::lastError()};
    }
    return Failure{address + ": expected a free port from " + std::to_string(port) + " on, found none"};
}

Result<UdpSocket> UdpSocket::connectTo(const std::string& receiver) {
    const auto colon = receiver.rfind(':');
    const auto port = colon == std::string::npos
                          ? std::nullopt
                          : parseNumber<int>(std::string_view{receiver}.substr(colon + 1));
    if (!port || *port < 1 || *port > 65'535)
        return Failure{"expected HOST:PORT, found " + inQuotes(receiver)};
    std::string host = receiver.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    const auto found = lookUp(host, *port, 0);
    if (!found) return Failure{found.error};
    UdpSocket udp{openHandle(*found.value)};
    udp.packet_.resize(maxPacketBytes);
    if (!udp.isOpen() || connect(native(udp.handle_), found.value->ai_addr, lengthOf(*found.value)) != 0)
        return Failure{receiver + ": " + sockets::lastError()};
    return udp;
}

int UdpSocket::bufferBytes() const {
    int bytes = 0;
    socklen_t size = sizeof bytes;
    getsockopt(native(handle_), SOL_SOCKET, SO_RCVBUF, reinterpret_cast<char*>(&bytes), &size);
    return bytes;
}

bool UdpSocket::wait(int milliseconds) const noexcept {
    if (isOpen()) return sockets::wait(native(handle_), milliseconds);
    std::this_thread::sleep_for(std::chrono::milliseconds{milliseconds});
    return false;
}

std::optional<std::span<const char>> UdpSocket::receive() {
    sockaddr_storage sender{};
    socklen_t senderSize = 0;
    const auto size = sockets::receive(native(handle_), packet_, sender, senderSize, dropped_);
    if (size < 0) return std::nullopt;
    static_assert(sizeof sender <= sizeof sender_.address);
    std::memcpy(sender_.address.data(), &sender, sizeof sender);
    sender_.size = static_cast<std::size_t>(senderSize);
    return std::span<const char>{packet_.data(), static_cast<std::size_t>(size)};
}

std::string UdpSender::text() const {
    char host[NI_MAXHOST], port[NI_MAXSERV];
    if (getnameinfo(reinterpret_cast<const sockaddr*>(address.data()), static_cast<socklen_t>(size), host,
                    sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV) != 0)
        return "unknown";
    return std::string(host) + ":" + port;
}

std::uint32_t UdpSocket::resetDroppedCount() noexcept { return dropped_ - std::exchange(seen_, dropped_); }

bool UdpSocket::answer(std::span<const char> bytes, const UdpSender& receiver) noexcept {
    const auto* address = reinterpret_cast<const sockaddr*>(receiver.address.data());
    return std::cmp_equal(sendto(native(handle_), bytes.data(), sizeOf(bytes), sockets::sendFlags, address,
                                 static_cast<socklen_t>(receiver.size)),
                          bytes.size());
}

bool UdpSocket::send(std::span<const char> bytes) noexcept {
    return std::cmp_equal(::send(native(handle_), bytes.data(), sizeOf(bytes), sockets::sendFlags),
                          bytes.size());
}

} // namespace physvib
