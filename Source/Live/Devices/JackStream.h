// SPDX-License-Identifier: MIT
// The ports of a JACK device, and the blocks that JACK asks for.
#pragma once
#include "Live/Devices/JackClient.h"
#include "Live/Devices/UserSlot.h"
#include <algorithm>
#include <atomic>

namespace physvib {

/// What JACK's threads call. It outlives its device if the server has gone (JackClient::keepUntilFreed()).
class JackStream {
public:
    struct Direction {
        std::vector<std::string> remote;  ///< ports of the device
        std::vector<jack_port_t*> ports;  ///< ours, to be connected to these
        std::vector<jack_port_t*> active; ///< of ours, those that are connected; changed while nobody plays
        std::vector<float*> buffers;      ///< of these, for one block
    };

    JackStream(const JackLibrary& jack, const std::string& device, bool withInputs)
        : client{jack, "physvib"}
        , jack_{jack} {
        const auto held = client.hold();
        if (!held) return;
        rateHz = static_cast<int>(jack_.get_sample_rate(client.get()));
        blockFrames = static_cast<int>(jack_.get_buffer_size(client.get()));
        out.remote = client.portsOf(device, JackPortIsInput);
        if (withInputs) in.remote = client.portsOf(device, JackPortIsOutput);
        addPorts(in, "in_", JackPortIsInput);
        addPorts(out, "out_", JackPortIsOutput);
        jack_.set_process_callback(client.get(), onBlock, this);
        jack_.set_xrun_callback(client.get(), onXrun, this);
    }

    Direction in, out;
    UserSlot slot;
    std::atomic<int> xruns{0};
    int rateHz = 0;      ///< of the server, which keeps it
    int blockFrames = 0; ///< of the server, when it was last asked
    JackClient client;   ///< closed first: until then JACK may call

private:
    static int onBlock(jack_nframes_t frames, void* self) {
        static_cast<JackStream*>(self)->process(frames);
        return 0;
    }
    static int onXrun(void* self) {
        ++static_cast<JackStream*>(self)->xruns;
        return 0;
    }

    void addPorts(Direction& direction, const char* prefix, JackPortFlags flags) {
        for (std::size_t k = 0; k < direction.remote.size(); ++k)
            if (auto* port =
                    jack_.port_register(client.get(), (prefix + std::to_string(k + 1)).c_str(),
                                        JACK_DEFAULT_AUDIO_TYPE, static_cast<unsigned long>(flags), 0))
                direction.ports.push_back(port);
        direction.buffers.resize(direction.ports.size());
    }

    // R
    void process(jack_nframes_t frames) noexcept {
        slot.call([&](DeviceUser* user) {
            if (user == nullptr) return silence(frames);
            const int inputs = locate(in, frames), outputs = locate(out, frames);
            if (inputs + outputs > 0)
                user->block(in.buffers.data(), inputs, out.buffers.data(), outputs, static_cast<int>(frames));
        });
    }

    int locate(Direction& direction, jack_nframes_t frames) noexcept {
        int used = 0;
        for (auto* port : direction.active)
            direction.buffers[static_cast<std::size_t>(used++)] =
                static_cast<float*>(jack_.port_get_buffer(port, frames));
        return used;
    }

    void silence(jack_nframes_t frames) noexcept {
        for (auto* port : out.ports)
            std::fill_n(static_cast<float*>(jack_.port_get_buffer(port, frames)), frames, 0.0f);
    }

    const JackLibrary& jack_;
};

} // namespace physvib
