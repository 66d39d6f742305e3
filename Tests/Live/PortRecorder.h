// SPDX-License-Identifier: GPL-3.0-or-later
// Records ports of JACK, and compares what came there with what tests of devices play.
#pragma once
#include "DeviceNoise.h"
#include <cstring>
#include <jack/jack.h>
#include <string>
#include <vector>

namespace physvib::test {

/// Records ports of another client; what is read is whole blocks.
class PortRecorder {
public:
    explicit PortRecorder(const std::vector<std::string>& sources)
        : client_{jack_client_open("recorder", JackNoStartServer, nullptr)}
        , recorded{std::vector<std::vector<float>>(sources.size())} {
        for (auto& channel : recorded) channel.reserve(capacity);
        for (std::size_t j = 0; j < sources.size(); ++j)
            ports_.push_back(jack_port_register(client_, ("in_" + std::to_string(j + 1)).c_str(),
                                                JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
        const auto onBlock = [](jack_nframes_t frames, void* self) {
            return static_cast<PortRecorder*>(self)->process(frames);
        };
        jack_set_process_callback(client_, onBlock, this);
        jack_activate(client_);
        for (std::size_t j = 0; j < sources.size(); ++j)
            if (jack_connect(client_, sources[j].c_str(), jack_port_name(ports_[j])) != 0) ++refused;
    }
    ~PortRecorder() { close(); }
    void close() {
        if (client_ != nullptr) jack_client_close(client_);
        client_ = nullptr;
    }

    int refused = 0;
    std::atomic<std::size_t> frames{0};

private:
    static constexpr std::size_t capacity = 480'000;
    int process(jack_nframes_t count) {
        if (frames + count > capacity) return 0;
        for (std::size_t j = 0; j < ports_.size(); ++j) {
            const auto* in = static_cast<const float*>(jack_port_get_buffer(ports_[j], count));
            recorded[j].insert(recorded[j].end(), in, in + count);
        }
        frames += count;
        return 0;
    }
    jack_client_t* client_;
    std::vector<jack_port_t*> ports_;

public:
    std::vector<std::vector<float>> recorded;
};

/// Whether these are noise() of the channel, bit for bit, from the first sample that is not 0 on.
inline bool isNoise(const std::vector<float>& samples, int channel, std::size_t least) {
    std::size_t first = 0;
    while (first < samples.size() && std::bit_cast<std::uint32_t>(samples[first]) == 0) ++first;
    if (samples.size() - first < least) return false;
    for (std::size_t n = first; n < samples.size(); ++n) {
        const float expected = noise(static_cast<std::uint32_t>(n - first), channel);
        if (std::memcmp(&expected, &samples[n], sizeof expected) != 0) return false;
    }
    return true;
}

} // namespace physvib::test
