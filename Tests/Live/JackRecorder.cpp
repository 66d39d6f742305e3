// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that records the outputs of `physvib`, from the moment they appear, as raw interleaved
// floats, and counts the server's xruns meanwhile (a line on stdout). Usage: physvib-jack-recorder FILE
// CHANNELS SECONDS [SOURCE_PORTS (physvib:out_)]
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <jack/jack.h>
#include <string>
#include <thread>
#include <vector>

namespace {

struct Recorder {
    jack_client_t* client = nullptr;
    std::vector<jack_port_t*> ports;
    std::string sources = "physvib:out_";
    std::vector<float> samples; // preallocated: the process callback only copies
    std::atomic<std::size_t> used{0};
    std::atomic<bool> connected{false};
    std::atomic<int> xruns{0};

    int process(jack_nframes_t frames) {
        if (!connected) return 0;
        std::size_t at = used;
        if (at + frames * ports.size() > samples.size()) return 0;
        std::vector<const float*>::size_type channel = 0;
        for (auto* port : ports) {
            const auto* in = static_cast<const float*>(jack_port_get_buffer(port, frames));
            for (jack_nframes_t n = 0; n < frames; ++n) samples[at + n * ports.size() + channel] = in[n];
            ++channel;
        }
        used = at + frames * ports.size();
        return 0;
    }
    int countXrun() {
        if (connected) ++xruns;
        return 0;
    }
    bool connect() {
        for (std::size_t j = 0; j < ports.size(); ++j) {
            const std::string source = sources + std::to_string(j + 1);
            const int code = jack_connect(client, source.c_str(), jack_port_name(ports[j]));
            if (code != 0 && code != EEXIST) return false;
        }
        return true;
    }
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 4 && argc != 5) return 2;
    const int channels = std::atoi(argv[2]);
    const double seconds = std::atof(argv[3]);
    Recorder recorder;
    if (argc == 5) recorder.sources = argv[4];
    recorder.client = jack_client_open("recorder", JackNoStartServer, nullptr);
    if (recorder.client == nullptr) return 1;
    const auto rate = jack_get_sample_rate(recorder.client);
    for (int j = 0; j < channels; ++j)
        recorder.ports.push_back(jack_port_register(recorder.client, ("in_" + std::to_string(j + 1)).c_str(),
                                                    JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
    recorder.samples.resize(static_cast<std::size_t>(seconds * rate) * static_cast<std::size_t>(channels));
    jack_set_process_callback(
        recorder.client,
        [](jack_nframes_t frames, void* self) { return static_cast<Recorder*>(self)->process(frames); },
        &recorder);
    jack_set_xrun_callback(
        recorder.client, [](void* self) { return static_cast<Recorder*>(self)->countXrun(); }, &recorder);
    jack_activate(recorder.client);
    std::puts("ready");
    std::fflush(stdout);
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds{2}); };
    for (int i = 0; i < 10'000 && !recorder.connect(); ++i) pause();
    recorder.connected = true;
    while (recorder.used + 8192 * recorder.ports.size() < recorder.samples.size()) pause();
    jack_deactivate(recorder.client);
    std::printf("xruns %d\n", recorder.xruns.load());
    std::FILE* file = std::fopen(argv[1], "wb");
    if (file == nullptr) return 1;
    const bool written =
        std::fwrite(recorder.samples.data(), sizeof(float), recorder.used, file) == recorder.used;
    jack_client_close(recorder.client);
    return std::fclose(file) == 0 && written ? 0 : 1;
}
