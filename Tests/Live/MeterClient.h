// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client in the session's own process: records what it plays and notes which frame of the session each
// cycle is.
#pragma once
#include "Live/Session/OfflineRender.h"
#include "Live/Session/Session.h"
#include "RecordingRuns.h"
#include <atomic>
#include <cmath>
#include <jack/jack.h>
#include <string>
#include <vector>

namespace physvib::test {

class MeterClient {
public:
    static constexpr int channels = 4;

    explicit MeterClient(Session& session, double seconds)
        : session_{session}
        , client_{jack_client_open("meter", JackNoStartServer, nullptr)} {
        recording.channels = channels;
        if (client_ == nullptr) return;
        rate = static_cast<int>(jack_get_sample_rate(client_));
        block = static_cast<int>(jack_get_buffer_size(client_));
        recording.samples.reserve(static_cast<std::size_t>(seconds * rate) * channels);
        for (int j = 0; j < channels; ++j)
            ports_.push_back(jack_port_register(client_, ("in_" + std::to_string(j + 1)).c_str(),
                                                JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
        jack_set_process_callback(
            client_,
            [](jack_nframes_t frames, void* self) {
                return static_cast<MeterClient*>(self)->process(frames);
            },
            this);
        jack_activate(client_);
        for (int j = 0; j < channels; ++j) { // what plays on each output, whatever its driver calls it
            const auto* output =
                jack_port_by_name(client_, ("system:playback_" + std::to_string(j + 1)).c_str());
            const char** players = jack_port_get_all_connections(client_, output);
            if (players != nullptr)
                jack_connect(client_, players[0], jack_port_name(ports_[static_cast<std::size_t>(j)]));
            jack_free(players);
        }
        isConnected_ = true;
    }
    ~MeterClient() {
        if (client_ != nullptr) jack_client_close(client_);
    }
    void stop() { jack_deactivate(client_); }
    int playbackLatencyFrames() const {
        jack_latency_range_t range{};
        jack_port_get_latency_range(jack_port_by_name(client_, "system:playback_1"), JackPlaybackLatency,
                                    &range);
        return static_cast<int>(range.max);
    }

    Recording recording;
    std::int64_t firstFrame = -1; ///< of the session, in the recording's first block
    int rate = 0, block = 0;
    std::atomic<std::int64_t> sessionFrame{0}; ///< the first that has not been rendered

private:
    // The cycle's order is the graph's: the session has just rendered these frames.
    int process(jack_nframes_t count) {
        const int frames = static_cast<int>(count);
        const auto at = recording.samples.size();
        if (!isConnected_ || at + static_cast<std::size_t>(frames * channels) > recording.samples.capacity())
            return 0;
        const auto now = FrameClock{rate}.at(session_.status().sessionNs).frame;
        if (now == 0) return 0; // time has not begun
        if (firstFrame < 0) firstFrame = now - frames;
        sessionFrame = now;
        recording.samples.resize(at + static_cast<std::size_t>(frames * channels));
        for (int j = 0; j < channels; ++j) {
            const auto* in =
                static_cast<const float*>(jack_port_get_buffer(ports_[static_cast<std::size_t>(j)], count));
            for (int n = 0; n < frames; ++n)
                recording.samples[at + static_cast<std::size_t>(n * channels + j)] = in[n];
        }
        return 0;
    }

    Session& session_;
    jack_client_t* client_;
    std::vector<jack_port_t*> ports_;
    std::atomic<bool> isConnected_{false};
};

/// What the events give, rendered.
inline Recording rendered(const std::vector<CollisionEvent>& events, const SessionSetup& s, int rate,
                          double seconds) {
    Recording signal{{}, MeterClient::channels};
    const OfflineSettings settings{
        {rate, MeterClient::channels, s.panner, s.limiterEnabled}, std::llround(seconds * rate), 256};
    renderOffline(events, settings, [&](const float* const* out, int frames) {
        for (int n = 0; n < frames; ++n)
            for (int j = 0; j < MeterClient::channels; ++j) signal.samples.push_back(out[j][n]);
        return true;
    });
    return signal;
}

} // namespace physvib::test
