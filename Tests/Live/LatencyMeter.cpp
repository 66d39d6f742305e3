// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how long after its contact a collision comes out of a JACK server: a session on it, and in the
// same process a client that records what it plays and notes which frame of the session each cycle is. Prints
// a row of a table. Usage: physvib-latency-meter message|thread|mixer STEPS_PER_SECOND SECONDS
#include "Host/MessageLoop.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Rig/Rig.h"
#include "MeterClient.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

using namespace physvib;

namespace {

SessionSetup setupFor(const std::string& driver, int stepsPerSecond) {
    SessionSetup s;
    s.scene = *findBuiltInScene("shake-the-box");
    s.stepsPerSecond = stepsPerSecond;
    s.longestGapSeconds = driver == "thread" ? threadGapSeconds(stepsPerSecond) : messageTimerGapSeconds;
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    s.panner = {layout, PanningLaw::linear, 1, s.scene.fieldWidthMetres, s.scene.fieldHeightMetres};
    return s;
}

/// Prints the row; 0 if what was recorded is what the log gives, L later.
int tell(const std::string& name, Session& session, const SessionSetup& setup, test::MeterClient& client,
         const SessionLog& log, double seconds) {
    const auto made = simulateRuns(log.runs, setup.run(), std::llround(seconds * 1e9));
    const auto render = test::rendered(made.events, setup, client.rate, seconds);
    const auto result = test::RecordingRuns{client.recording, render, client.block}.compare();
    if (!result.isAligned) return std::puts("the recording is not the render"), 1;
    const auto ms = [&](std::int64_t frames) { return 1e3 * static_cast<double>(frames) / client.rate; };
    const std::int64_t measured = client.firstFrame + result.offset,
                       law = session.timeline().outputLatencyFrames();
    std::printf(
        "| `%s`, %d steps/s | %d | %lld (%.1f ms) | %lld (%.1f ms) | %d (%.1f ms) | %.1f ms | %llu of %llu | "
        "%lld of %lld |\n",
        name.c_str(), setup.stepsPerSecond, client.block, static_cast<long long>(law), ms(law),
        static_cast<long long>(measured), ms(measured), client.playbackLatencyFrames(),
        ms(client.playbackLatencyFrames()), ms(measured + client.playbackLatencyFrames()),
        static_cast<unsigned long long>(session.status().render.late),
        static_cast<unsigned long long>(session.status().render.played), static_cast<long long>(result.equal),
        static_cast<long long>(result.blocks));
    return measured == law ? 0 : 1;
}

/// The mixer as it starts, with its message loop, at full level.
int measureMixer(double seconds) {
    const juce::ScopedJuceInitialiser_GUI juce;
    Mix mix = MixerModel::defaultMix();
    mix.levelDb = 0.0;
    for (Strip& strip : mix.strips) strip.gainDb = 0.0;
    MixerModel mixer{systemAudioDrivers, {.name = "JACK:system"}, mix};
    if (mixer.messageText().isNotEmpty()) return std::puts(mixer.messageText().toRawUTF8()), 1;
    test::MeterClient client{mixer.session(), seconds};
    test::runFor(seconds + 0.2);
    client.stop();
    return tell("mixer", mixer.session(), mixer.rig().settings().setup, client, mixer.savedSession().log,
                seconds);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    if (std::string{argv[1]} == "mixer") return measureMixer(std::atof(argv[3]));
    const std::string driverName = argv[1];
    const double seconds = std::atof(argv[3]);
    const SessionSetup setup = setupFor(driverName, std::atoi(argv[2]));
    Session session{setup};
    AudioOutput output{session, systemAudioDrivers};
    if (const auto error = output.open({"JACK:system", {}, 0, 0, 1.0f}); !error.empty())
        return std::puts(error.c_str()), 1;
    std::optional<ThreadDriver> driver;
    if (driverName == "thread") driver.emplace(session, setup.stepsPerSecond);
    test::MeterClient client{session, seconds};
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::milliseconds(std::llround(seconds * 1e3) + 200);
    repeatEvery(std::chrono::milliseconds{10}, [&] { // as `physvib play` without a thread for its world
        if (!driver) session.advance();
        return std::chrono::steady_clock::now() < end;
    });
    client.stop();
    SessionLog log; // stalls, if there were any
    session.readLog(log);
    return tell(driverName, session, setup, client, log, seconds);
}
