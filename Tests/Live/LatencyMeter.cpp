// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how long after its contact a collision comes out of a JACK server: a session on it, and in the same process
// a client that records what it plays and notes which frame of the session each cycle is. Prints a row of a table.
// Usage: physvib-latency-meter message|thread SECONDS
#include "Files/SceneCatalogue.h"
#include "Host/AudioOutput.h"
#include "Host/OfflineRender.h"
#include "Host/SimulationDriver.h"
#include "Physics/SceneRun.h"
#include "RecordingRuns.h"
#include <atomic>
#include <cmath>
#include <cstdio>
#include <jack/jack.h>
#include <string>

using namespace physvib;

namespace {

constexpr int channels = 4;

SessionSetup setupFor(const std::string& driver) {
    SessionSetup s;
    s.scene = *findBuiltInScene("shake-the-box");
    s.stepsPerSecond = driver == "thread" ? 1000 : 100;
    s.longestGapSeconds = driver == "thread" ? driverThreadGapSeconds : messageTimerGapSeconds;
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    s.panner = {layout, PanningLaw::linear, 1, s.scene.fieldWidthMetres, s.scene.fieldHeightMetres};
    return s;
}

class Client {
public:
    Client(Session& session, double seconds)
        : session_{session}
        , client_{jack_client_open("meter", JackNoStartServer, nullptr)} {
        recording.channels = channels;
        if (client_ == nullptr) return;
        rate = static_cast<int>(jack_get_sample_rate(client_));
        block = static_cast<int>(jack_get_buffer_size(client_));
        recording.samples.reserve(static_cast<std::size_t>(seconds * rate) * channels);
        for (int j = 0; j < channels; ++j)
            ports_.push_back(jack_port_register(client_, ("in_" + std::to_string(j + 1)).c_str(), JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
        jack_set_process_callback(client_, [](jack_nframes_t frames, void* self) { return static_cast<Client*>(self)->process(frames); }, this);
        jack_activate(client_);
        for (int j = 0; j < channels; ++j)
            jack_connect(client_, ("physvib:out_" + std::to_string(j + 1)).c_str(), jack_port_name(ports_[static_cast<std::size_t>(j)]));
        isConnected_ = true;
    }
    ~Client() {
        if (client_ != nullptr) jack_client_close(client_);
    }
    void stop() { jack_deactivate(client_); }
    int playbackLatencyFrames() const {
        jack_latency_range_t range{};
        jack_port_get_latency_range(jack_port_by_name(client_, "system:playback_1"), JackPlaybackLatency, &range);
        return static_cast<int>(range.max);
    }

    test::Recording recording;
    std::int64_t firstFrame = -1; ///< of the session, in the recording's first block
    int rate = 0, block = 0;

private:
    // The cycle's order is the graph's: the session has just rendered these frames.
    int process(jack_nframes_t count) {
        const int frames = static_cast<int>(count);
        const auto at = recording.samples.size();
        if (!isConnected_ || at + static_cast<std::size_t>(frames * channels) > recording.samples.capacity()) return 0;
        const auto now = FrameClock{rate}.at(session_.status().sessionNs).frame;
        if (firstFrame < 0) firstFrame = now - frames;
        recording.samples.resize(at + static_cast<std::size_t>(frames * channels));
        for (int j = 0; j < channels; ++j) {
            const auto* in = static_cast<const float*>(jack_port_get_buffer(ports_[static_cast<std::size_t>(j)], count));
            for (int n = 0; n < frames; ++n) recording.samples[at + static_cast<std::size_t>(n * channels + j)] = in[n];
        }
        return 0;
    }

    Session& session_;
    jack_client_t* client_;
    std::vector<jack_port_t*> ports_;
    std::atomic<bool> isConnected_{false};
};

test::Recording rendered(const SessionSetup& s, int rate, double seconds) {
    const auto made = runScene(s.scene, {s.seed, s.stepsPerSecond}, std::llround(seconds * 1e9));
    test::Recording signal{{}, channels};
    renderOffline(made.events, {{rate, channels, s.panner, s.limiterEnabled}, std::llround(seconds * rate), 256}, [&](const float* const* out, int frames) {
        for (int n = 0; n < frames; ++n)
            for (int j = 0; j < channels; ++j) signal.samples.push_back(out[j][n]);
        return true;
    });
    return signal;
}

std::unique_ptr<SimulationDriver> start(const std::string& driver, Session& session, int stepsPerSecond) {
    if (driver == "thread") return std::make_unique<ThreadDriver>(session, stepsPerSecond);
    return std::make_unique<MessageTimerDriver>(session);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::string driverName = argv[1];
    const double seconds = std::atof(argv[2]);
    const juce::ScopedJuceInitialiser_GUI juce;
    const SessionSetup setup = setupFor(driverName);
    Session session{setup};
    AudioOutput output{session};
    if (const auto error = output.open({"JACK:system", {}, 0, 0, 1.0f}); !error.empty()) return std::puts(error.c_str()), 1;
    const auto driver = start(driverName, session, setup.stepsPerSecond);
    Client client{session, seconds};
    juce::Timer::callAfterDelay(static_cast<int>(seconds * 1000) + 200, [] { juce::MessageManager::getInstance()->stopDispatchLoop(); });
    juce::MessageManager::getInstance()->runDispatchLoop();
    client.stop();
    const auto render = rendered(setup, client.rate, seconds);
    const auto result = test::RecordingRuns{client.recording, render, client.block}.compare();
    if (!result.isAligned) return std::puts("the recording is not the render"), 1;
    const auto ms = [&](std::int64_t frames) { return 1e3 * static_cast<double>(frames) / client.rate; };
    const std::int64_t measured = client.firstFrame + result.offset, law = session.playOutFrames();
    std::printf("| `%s` | %d | %lld (%.1f ms) | %lld (%.1f ms) | %d (%.1f ms) | %.1f ms | %llu of %llu |\n", driverName.c_str(), client.block, static_cast<long long>(law),
                ms(law), static_cast<long long>(measured), ms(measured), client.playbackLatencyFrames(), ms(client.playbackLatencyFrames()),
                ms(measured + client.playbackLatencyFrames()), static_cast<unsigned long long>(session.status().render.late),
                static_cast<unsigned long long>(session.status().render.played));
    return measured == law ? 0 : 1;
}
