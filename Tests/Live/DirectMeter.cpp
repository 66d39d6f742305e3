// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how long after a message its strike comes out of a JACK server where the session is direct. Prints
// a line; fails unless each is heard one block and the limiter after the session frame at which it came, and
// what was played is what the log renders. Usage: physvib-direct-meter MESSAGES
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/SessionRender.h"
#include "MeterClient.h"
#include "Session/WallsScene.h"
#include <cstdio>
#include <random>
#include <thread>

using namespace physvib;

namespace {

struct Asked {
    std::int64_t before, after; // session frames around the message
};

std::vector<Asked> ask(Session& session, int times) {
    MessageRouter router{session};
    std::mt19937 random{1};
    std::vector<Asked> all;
    for (int i = 0; i < times; ++i) {
        std::this_thread::sleep_for(std::chrono::microseconds{50'000 + random() % 40'000});
        const std::int64_t before = session.timeline().framesRendered();
        const auto told = router.handle(
            {"strike", {{"frequency_hz", 205.0}, {"decay_per_s", 120.0}, {"place", std::string{"A"}}}});
        if (!told) std::puts(told.error.c_str());
        all.push_back({before, session.timeline().framesRendered()});
    }
    return all;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const int messages = std::atoi(argv[1]);
    SessionSetup setup = test::setupOfWalls();
    setup.direct = Direct::inputs;
    Session session{setup};
    AudioOutput output{session, systemAudioDrivers};
    if (const auto error = output.open({"JACK:system", {}, 0, 0, 1.0f}); !error.empty())
        return std::puts(error.c_str()), 1;
    std::vector<Asked> asked;
    const double seconds = 0.1 * messages + 1.0;
    test::MeterClient client{session, seconds};
    {
        const ThreadDriver driver{session, setup.stepsPerSecond};
        std::this_thread::sleep_for(std::chrono::milliseconds{200}); // the first L is over
        asked = ask(session, messages);
        std::this_thread::sleep_for(std::chrono::milliseconds{300});
        client.stop();
    }
    SavedSession saved;
    saved.run = setup.run();
    session.readLog(saved.log);
    const auto render =
        test::rendered(sessionEvents(saved, std::llround(seconds * 1e9)).events, setup, client.rate, seconds);
    const auto result = test::RecordingRuns{client.recording, render, client.block}.compare();
    const auto& struck = saved.log.strikes;
    if (!result.isAligned || static_cast<int>(struck.size()) != messages)
        return std::printf("%zu strikes of %d messages, or they are not what was recorded\n", struck.size(),
                           messages),
               1;
    const std::int64_t measured = client.firstFrame + result.offset,
                       direct = std::llround(session.timeline().directSeconds() * client.rate);
    int exact = 0;
    for (int i = 0; i < messages; ++i) {
        const auto heard =
            FrameClock{client.rate}.at(struck[static_cast<std::size_t>(i)].timeNs).frame + measured;
        const auto [before, after] = asked[static_cast<std::size_t>(i)];
        exact += heard >= before + direct && heard <= after + direct ? 1 : 0;
    }
    const auto ms = [&](std::int64_t frames) { return 1e3 * static_cast<double>(frames) / client.rate; };
    std::printf("%d messages, blocks of %d: L %.2f ms, direct %.2f ms; heard that long after they came: %d; "
                "%llu late\n",
                messages, client.block, ms(session.timeline().outputLatencyFrames()), ms(direct), exact,
                static_cast<unsigned long long>(session.status().render.late));
    return exact == messages ? 0 : 1;
}
