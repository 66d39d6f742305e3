// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that is an actuator with its accelerometer: what comes in at `in` is felt at `out`, a cycle
// later or more. Usage: physvib-jack-actuator RESONANCE_HZ Q GAIN DELAY_FRAMES; runs until it is killed.
#include "Support/SimulatedActuator.h"
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <jack/jack.h>
#include <memory>
#include <thread>
#include <vector>

namespace {

struct Actuator {
    jack_port_t *in = nullptr, *out = nullptr;
    std::unique_ptr<physvib::SimulatedActuator> resonator;
    double gain = 1.0;
    std::vector<float> line; // delay
    std::size_t at = 0;

    int process(jack_nframes_t frames) {
        const auto* drive = static_cast<const float*>(jack_port_get_buffer(in, frames));
        auto* felt = static_cast<float*>(jack_port_get_buffer(out, frames));
        for (jack_nframes_t n = 0; n < frames; ++n) {
            felt[n] = line[at];
            line[at] = static_cast<float>(gain * resonator->process(static_cast<double>(drive[n])));
            at = (at + 1) % line.size();
        }
        return 0;
    }
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    Actuator actuator;
    jack_client_t* const client = jack_client_open("actuator", JackNoStartServer, nullptr);
    if (client == nullptr) return 1;
    actuator.resonator = std::make_unique<physvib::SimulatedActuator>(
        physvib::Resonator{std::atof(argv[1]), std::atof(argv[2])}, jack_get_sample_rate(client));
    actuator.gain = std::atof(argv[3]);
    actuator.line.resize(static_cast<std::size_t>(std::atoi(argv[4])));
    actuator.in = jack_port_register(client, "in", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    actuator.out = jack_port_register(client, "out", JACK_DEFAULT_AUDIO_TYPE, JackPortIsOutput, 0);
    jack_set_process_callback(
        client,
        [](jack_nframes_t frames, void* self) { return static_cast<Actuator*>(self)->process(frames); },
        &actuator);
    jack_activate(client);
    std::puts("ready");
    std::fflush(stdout);
    for (;;) std::this_thread::sleep_for(std::chrono::seconds{1});
}
