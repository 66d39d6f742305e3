// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that is called as a DualSense's sound device is and has its four inputs; says "ready", and
// the peak of each when its standard input ends. Usage: physvib-jack-coils NAME INPUTS
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <jack/jack.h>

namespace {

struct Coils {
    std::array<jack_port_t*, 4> ports{};
    std::array<std::atomic<float>, 4> peaks{};

    int process(jack_nframes_t frames) {
        for (std::size_t k = 0; k < ports.size(); ++k) {
            if (ports[k] == nullptr) continue;
            const auto* in = static_cast<const float*>(jack_port_get_buffer(ports[k], frames));
            for (jack_nframes_t n = 0; n < frames; ++n)
                if (std::abs(in[n]) > peaks[k]) peaks[k] = std::abs(in[n]);
        }
        return 0;
    }
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    jack_client_t* client = jack_client_open(argv[1], JackNoStartServer, nullptr);
    if (client == nullptr) return 1;
    static Coils coils;
    const std::array names{"playback_FL", "playback_FR", "playback_RL", "playback_RR"};
    for (std::size_t k = 0; k < std::min<std::size_t>(4, static_cast<std::size_t>(std::atoi(argv[2]))); ++k)
        coils.ports[k] = jack_port_register(client, names[k], JACK_DEFAULT_AUDIO_TYPE,
                                            JackPortIsInput | JackPortIsPhysical, 0);
    jack_set_process_callback(
        client, [](jack_nframes_t frames, void* self) { return static_cast<Coils*>(self)->process(frames); },
        &coils);
    if (jack_activate(client) != 0) return 1;
    std::puts("ready");
    std::fflush(stdout);
    while (std::getchar() != EOF) {
    }
    for (auto& peak : coils.peaks) std::printf("%.4f ", static_cast<double>(peak.load()));
    std::puts("");
    jack_client_close(client);
}
