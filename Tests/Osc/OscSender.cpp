// SPDX-License-Identifier: GPL-3.0-or-later
// Sends by liblo what run.sh measures. Usage: physvib-osc-sender PORT COMMAND, which is one of
//   flood COUNT PER_SECOND AHEAD_S   strikes, each in a bundle that is tagged so far ahead
//   random COUNT PER_SECOND          packets of random bytes, some of which begin like OSC
//   tags COUNT                       strikes tagged at irregular times, each told in ns since 1970
//   phone SECONDS PER_SECOND         the accelerometer of an Android phone that is turned slowly, and lies
//   upright in the end silence COUNT PER_SECOND         strikes as of flood, and meanwhile silence on and
//   off: how long until each is answered ask NAME                         a query; its answer
#include "Host/Osc/OscReceiver.h"
#include "Live/Sockets/UdpSocket.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <lo/lo.h>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace physvib;
using Clock = std::chrono::steady_clock;

std::int64_t unixNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

/// Calls `send(k)` for each k, so many a second: those of each millisecond together.
template <class Send>
void paced(int count, double perSecond, Send send) {
    const auto start = Clock::now();
    for (int k = 0; k < count;) {
        const auto due = static_cast<int>(std::min<double>(
            count, perSecond * std::chrono::duration<double>(Clock::now() - start).count() + 1));
        for (; k < due; ++k) send(k);
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    std::printf("%d in %.1f s\n", count, std::chrono::duration<double>(Clock::now() - start).count());
}

void sendStrike(lo_address to, std::int64_t unixNs, double frequency, double decay, double level, double x,
                double y) {
    const OscTag tag = tagFromUnixNs(unixNs);
    const lo_bundle bundle =
        lo_bundle_new({static_cast<std::uint32_t>(tag >> 32), static_cast<std::uint32_t>(tag)});
    const lo_message strike = lo_message_new();
    lo_message_add(strike, "sfsfsfsff", "frequency_hz", frequency, "decay_per_s", decay, "level", level,
                   "place", x, y);
    lo_bundle_add_message(bundle, "/physvib/strike", strike);
    lo_send_bundle(to, bundle);
    lo_bundle_free_recursive(bundle);
}

void flood(lo_address to, int count, double perSecond, double aheadSeconds) {
    paced(count, perSecond, [&](int) {
        sendStrike(to, unixNow() + std::llround(aheadSeconds * 1e9), 205.0, 200.0, 1e-4, 1.0, 0.5);
    });
}

void sendRandom(UdpSocket& to, int count, double perSecond) {
    std::mt19937 random{11};
    std::string bytes;
    paced(count, perSecond, [&](int k) {
        bytes.resize(random() % 200);
        for (char& byte : bytes) byte = static_cast<char>(random());
        static constexpr const char* beginnings[] = {"#bundle", "/physvib/strike", ""};
        const std::string beginning = beginnings[k % 3];
        std::copy_n(beginning.begin(), std::min(beginning.size(), bytes.size()), bytes.begin());
        to.send({bytes.data(), bytes.size()});
    });
}

void sendTags(lo_address to, int count) {
    std::mt19937 random{7};
    const auto between = [&random](double least, double most) {
        return std::uniform_real_distribution{least, most}(random);
    };
    for (int k = 0; k < count; ++k) {
        const std::int64_t tag = unixNow() + 200'000'000 + std::llround(between(0.0, 5e7));
        sendStrike(to, tag, between(80.0, 400.0), between(20.0, 60.0), between(0.02, 0.3), between(0.0, 2.0),
                   between(0.0, 1.0));
        std::printf("%lld\n", static_cast<long long>(tag));
        std::this_thread::sleep_for(std::chrono::microseconds{std::llround(between(5e4, 1.5e5))});
    }
}

void sendPhone(lo_address to, double seconds, double perSecond) {
    const int count = static_cast<int>(seconds * perSecond);
    paced(count, perSecond, [&](int k) {
        const double angle =
            k + 1 == count ? 0.0 : 1.2 * std::sin(2 * std::numbers::pi * k / perSecond / 5.0);
        lo_send(to, "/accelerometer", "fff", 9.81 * std::sin(angle), 9.81 * std::cos(angle), 0.1);
    });
}

/// An answer comes when silence has acted. Fails if one took longer than `mostMs`.
int timeSilence(lo_address to, UdpSocket& socket, int count, double perSecond) {
    constexpr double mostMs = 20.0;
    std::jthread flooding{[=] { flood(to, count, perSecond, 0.1); }};
    const auto end = Clock::now() + std::chrono::duration<double>(count / perSecond);
    std::vector<double> ms;
    for (double isOn = 1.0; Clock::now() < end; isOn = 1.0 - isOn) {
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
        const auto start = Clock::now();
        socket.send(oscPacket("/physvib/silence", {"", {{"on", isOn}}}));
        if (!socket.wait(1000) || !socket.receive()) return std::puts("silence was not answered"), 1;
        ms.push_back(1e3 * std::chrono::duration<double>(Clock::now() - start).count());
    }
    std::ranges::sort(ms);
    std::printf("%zu silences: answered after %.2f ms, the slowest after %.2f ms\n", ms.size(),
                ms[ms.size() / 2], ms.back());
    return ms.back() <= mostMs ? 0 : 1;
}

int ask(UdpSocket& to, const std::string& name) {
    const auto query = oscPacket("/physvib/" + name, {});
    for (int tries = 0; tries < 20; ++tries) {
        to.send(query);
        if (!to.wait(1000)) continue;
        const auto packet = to.receive();
        if (!packet) continue;
        const auto answer = readOscPacket(*packet).value.at(0);
        for (const OscValue& value : answer.values)
            std::holds_alternative<double>(value) ? std::printf("%.9f ", std::get<double>(value))
                                                  : std::printf("%s ", std::get<std::string>(value).c_str());
        std::puts("");
        return 0;
    }
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const auto number = [&](int i) { return i < argc ? std::atof(argv[i]) : 0.0; };
    if (argc < 4) return 2;
    const std::string command = argv[2];
    const lo_address to = lo_address_new("127.0.0.1", argv[1]);
    auto socket = UdpSocket::connectTo(std::string("127.0.0.1:") + argv[1]);
    if (!socket) return 2;
    const int count = static_cast<int>(number(3));
    if (command == "flood")
        flood(to, count, number(4), number(5));
    else if (command == "random")
        sendRandom(socket.value, count, number(4));
    else if (command == "tags")
        sendTags(to, count);
    else if (command == "phone")
        sendPhone(to, number(3), number(4));
    else if (command == "silence")
        return timeSilence(to, socket.value, count, number(4));
    else if (command == "ask")
        return ask(socket.value, argv[3]);
    else
        return 2;
    lo_address_free(to);
    return 0;
}
