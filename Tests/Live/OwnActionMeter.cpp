// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how long after one's own push the hit comes out of a JACK server. A ball between two walls, 4 mm
// of way: each push is a hit within the step. Prints a line; fails unless every hit is heard exactly L after
// its contact. Usage: physvib-own-action-meter PUSHES
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Rig/Rig.h"
#include "MeterClient.h"
#include "Session/WallsScene.h"
#include <cstdio>
#include <random>
#include <thread>

using namespace physvib;

namespace {

std::vector<std::int64_t> push(Session& session, const test::MeterClient& client, int times) {
    std::mt19937 random{1};
    std::vector<std::int64_t> frames;
    for (int i = 0; i < times; ++i) {
        std::this_thread::sleep_for(std::chrono::microseconds{80'000 + random() % 40'000});
        frames.push_back(client.sessionFrame);
        if (const auto fault = session.submit({test::pushOfBall(i)}).error; !fault.empty())
            std::puts(fault.c_str());
    }
    return frames;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const int pushes = std::atoi(argv[1]);
    const SessionSetup setup = test::setupOfWalls();
    Session session{setup};
    AudioOutput output{session, systemAudioDrivers};
    if (const auto error = output.open({"JACK:system", {}, 0, 0, 1.0f}); !error.empty())
        return std::puts(error.c_str()), 1;
    std::vector<std::int64_t> pushed;
    const double seconds = 0.13 * pushes + 1.0;
    test::MeterClient client{session, seconds};
    {
        const ThreadDriver driver{session, setup.stepsPerSecond};
        pushed = push(session, client, pushes);
        std::this_thread::sleep_for(std::chrono::milliseconds{300});
        client.stop();
    }
    SessionLog log;
    session.readLog(log);
    const auto made = simulateRuns(log.runs, setup.run(), std::llround(seconds * 1e9));
    const auto render = test::rendered(made.events, setup, client.rate, seconds);
    const auto result = test::RecordingRuns{client.recording, render, client.block}.compare();
    const bool isWhole = result.isAligned && static_cast<int>(made.events.size()) == pushes;
    if (!isWhole)
        return std::printf("%zu hits after %d pushes, or they are not what was recorded\n",
                           made.events.size(), pushes),
               1;
    const std::int64_t law = session.timeline().outputLatencyFrames(),
                       measured = client.firstFrame + result.offset;
    std::int64_t sum = 0, most = 0;
    for (int i = 0; i < pushes; ++i) {
        const auto heard =
            FrameClock{client.rate}.at(made.events[static_cast<std::size_t>(i)].timeNs).frame + measured;
        const auto after = heard - pushed[static_cast<std::size_t>(i)];
        sum += after;
        most = std::max(most, after);
    }
    const auto ms = [&](auto frames) { return 1e3 * static_cast<double>(frames) / client.rate; };
    std::printf("%d pushes, blocks of %d: L %.2f ms, heard %.2f ms after their contacts; after the pushes "
                "%.2f ms on average, %.2f ms at most; %llu late\n",
                pushes, client.block, ms(law), ms(measured), ms(sum) / pushes, ms(most),
                static_cast<unsigned long long>(session.status().render.late));
    return measured == law ? 0 : 1;
}
