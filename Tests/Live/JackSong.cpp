// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that is a device with a song at its one input: it plays the song of a seed once it is
// connected, and listens to the last of its outputs, on which high beats are felt. JACK closes such a loop by
// handing what is played on a cycle later. Prints for each hit with a high beat: its second, and that at
// which the output was touched for the first time since it was silent, or -1. Usage: physvib-jack-song
// OUTPUTS SECONDS SEED
#include "Support/BeatSong.h"
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <jack/jack.h>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr double silentSeconds = 0.01;
constexpr float touched = 1e-3f;

struct Song {
    jack_port_t *out = nullptr, *last = nullptr;
    std::vector<float> samples, felt;
    std::atomic<std::size_t> at{0};
    std::atomic<bool> plays{false};

    int process(jack_nframes_t frames) {
        auto* to = static_cast<float*>(jack_port_get_buffer(out, frames));
        const auto* from = static_cast<const float*>(jack_port_get_buffer(last, frames));
        for (jack_nframes_t n = 0; n < frames; ++n) {
            const std::size_t i = at;
            const bool isPlaying = plays && i < samples.size();
            to[n] = isPlaying ? samples[i] : 0.0f;
            if (isPlaying) felt[i] = from[n], at = i + 1;
        }
        return 0;
    }
};

/// Where silence ends.
std::vector<double> onsets(const std::vector<float>& felt, int rateHz) {
    std::vector<double> times;
    double quiet = 0.0;
    for (std::size_t i = 0; i < felt.size(); ++i) {
        const bool isTouched = std::abs(felt[i]) > touched;
        if (isTouched && quiet > silentSeconds * rateHz) times.push_back(static_cast<double>(i) / rateHz);
        quiet = isTouched ? 0.0 : quiet + 1.0;
    }
    return times;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    Song song;
    jack_client_t* const client = jack_client_open("song", JackNoStartServer, nullptr);
    if (client == nullptr) return 1;
    const int rateHz = static_cast<int>(jack_get_sample_rate(client));
    const physvib::test::BeatSong made{std::atof(argv[2]), rateHz, std::strtoull(argv[3], nullptr, 10)};
    song.samples = made.samples;
    song.felt.resize(song.samples.size());
    song.out = jack_port_register(client, "out", JACK_DEFAULT_AUDIO_TYPE, JackPortIsOutput, 0);
    for (int k = 1; k <= std::atoi(argv[1]); ++k)
        song.last = jack_port_register(client, ("in_" + std::to_string(k)).c_str(), JACK_DEFAULT_AUDIO_TYPE,
                                       JackPortIsInput, 0);
    jack_set_process_callback(
        client, [](jack_nframes_t frames, void* self) { return static_cast<Song*>(self)->process(frames); },
        &song);
    jack_activate(client);
    std::puts("ready");
    std::fflush(stdout);
    while (jack_port_connected(song.out) == 0 || jack_port_connected(song.last) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
    std::this_thread::sleep_for(std::chrono::milliseconds{300}); // nobody shall miss its beginning
    song.plays = true;
    while (song.at < song.samples.size()) std::this_thread::sleep_for(std::chrono::milliseconds{20});
    const auto times = onsets(song.felt, rateHz);
    for (const auto& hit : made.hits) {
        if (hit.drum == physvib::test::Drum::kick) continue;
        const auto after = std::ranges::find_if(times, [&](double t) { return t > hit.seconds; });
        std::printf("%.5f %.5f\n", hit.seconds, after == times.end() ? -1.0 : *after);
    }
    jack_client_close(client);
}
