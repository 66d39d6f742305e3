// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that listens to the outputs of `physvib`, whenever they are there, and prints when they begin
// to sound and when they fell silent: "sound MS" and "silent MS", in ms since 1970. It ends with the server.
// Usage: physvib-jack-silence CHANNELS
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <jack/jack.h>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr std::int64_t quietMs = 40; // so long, and it is silence and no pause of a wave
constexpr float nothing = 1e-6f;

std::int64_t nowMs() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

struct Listener {
    jack_client_t* client = nullptr;
    std::vector<jack_port_t*> ports;
    std::atomic<std::int64_t> soundedMs{0}; // when the newest block with a sound in it was over
    std::atomic<bool> hasEnded{false};

    int process(jack_nframes_t frames) {
        for (auto* port : ports) {
            const auto* in = static_cast<const float*>(jack_port_get_buffer(port, frames));
            for (jack_nframes_t n = 0; n < frames; ++n)
                if (std::abs(in[n]) > nothing) soundedMs = nowMs();
        }
        return 0;
    }
    void connect() {
        for (std::size_t j = 0; j < ports.size(); ++j)
            if (jack_port_connected(ports[j]) == 0)
                jack_connect(client, ("physvib:out_" + std::to_string(j + 1)).c_str(),
                             jack_port_name(ports[j]));
    }
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    Listener listener;
    jack_set_error_function([](const char*) {});
    listener.client = jack_client_open("silence", JackNoStartServer, nullptr);
    if (listener.client == nullptr) return 1;
    for (int j = 0; j < std::atoi(argv[1]); ++j)
        listener.ports.push_back(jack_port_register(listener.client, ("in_" + std::to_string(j + 1)).c_str(),
                                                    JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
    jack_set_process_callback(
        listener.client,
        [](jack_nframes_t frames, void* self) { return static_cast<Listener*>(self)->process(frames); },
        &listener);
    jack_on_shutdown(
        listener.client, [](void* self) { static_cast<Listener*>(self)->hasEnded = true; }, &listener);
    jack_activate(listener.client);
    bool sounds = false;
    for (std::int64_t look = 0; !listener.hasEnded; ++look) {
        if (look % 10 == 0) listener.connect();
        const std::int64_t soundedMs = listener.soundedMs;
        const bool soundsNow = nowMs() - soundedMs < quietMs;
        if (soundsNow != sounds) {
            std::printf("%s %lld\n", soundsNow ? "sound" : "silent", static_cast<long long>(soundedMs));
            std::fflush(stdout);
        }
        sounds = soundsNow;
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    return 0;
}
