// SPDX-License-Identifier: MIT
// Plays on the ports of another JACK client.
#include "Live/Devices/JackDevice.h"
#include <algorithm>

namespace physvib {

JackDevice::JackDevice(const JackLibrary& jack, std::string name, bool withInputs)
    : jack_{jack}
    , name_{std::move(name)}
    , client_{jack, "physvib"} {
    if (!client_.connected()) return;
    out_.remote = client_.portsOf(name_, JackPortIsInput);
    if (withInputs) in_.remote = client_.portsOf(name_, JackPortIsOutput);
    addPorts(in_, "in_", JackPortIsInput);
    addPorts(out_, "out_", JackPortIsOutput);
}

void JackDevice::addPorts(Direction& direction, const char* prefix, JackPortFlags flags) {
    for (std::size_t k = 0; k < direction.remote.size(); ++k)
        if (auto* port = jack_.port_register(client_.get(), (prefix + std::to_string(k + 1)).c_str(),
                                             JACK_DEFAULT_AUDIO_TYPE, static_cast<unsigned long>(flags), 0))
            direction.ports.push_back(port);
    direction.buffers.resize(direction.ports.size());
}

std::string JackDevice::open(const ChannelSet& inputs, const ChannelSet& outputs, int, int) {
    close();
    if (!isAlive()) return "expected a running JACK server, found none";
    xruns_ = 0;
    const auto onBlock = [](jack_nframes_t frames, void* self) {
        static_cast<JackDevice*>(self)->process(frames);
        return 0;
    };
    const auto onXrun = [](void* self) {
        ++static_cast<JackDevice*>(self)->xruns_;
        return 0;
    };
    jack_.set_process_callback(client_.get(), onBlock, this);
    jack_.set_xrun_callback(client_.get(), onXrun, this);
    jack_.on_shutdown(
        client_.get(), [](void* self) { static_cast<JackDevice*>(self)->isGone_ = true; }, this);
    if (jack_.activate(client_.get()) != 0) return "the JACK server refuses to call this program";
    isOpen_ = true;
    connect(in_, inputs, false);
    connect(out_, outputs, true);
    return {};
}

void JackDevice::connect(const Direction& direction, const ChannelSet& wanted, bool isOutput) {
    for (const int k : wanted) {
        const auto at = static_cast<std::size_t>(k);
        if (at >= direction.ports.size()) continue;
        const char *own = jack_.port_name(direction.ports[at]), *other = direction.remote[at].c_str();
        jack_.connect(client_.get(), isOutput ? own : other, isOutput ? other : own);
    }
}

void JackDevice::close() {
    stop();
    if (isOpen_ && isAlive()) jack_.deactivate(client_.get());
    isOpen_ = false;
    in_.active.clear();
    out_.active.clear();
}

std::vector<jack_port_t*> JackDevice::connectedPorts(const Direction& direction) const {
    std::vector<jack_port_t*> ports;
    if (!isAlive()) return ports;
    for (auto* port : direction.ports)
        if (jack_.port_connected(port) > 0) ports.push_back(port);
    return ports;
}

void JackDevice::process(jack_nframes_t frames) noexcept {
    slot_.call([&](DeviceUser* user) {
        if (user == nullptr) return silence(frames);
        const int inputs = locate(in_, frames), outputs = locate(out_, frames);
        if (inputs + outputs > 0)
            user->block(in_.buffers.data(), inputs, out_.buffers.data(), outputs, static_cast<int>(frames));
    });
}

int JackDevice::locate(Direction& direction, jack_nframes_t frames) noexcept {
    int used = 0;
    for (auto* port : direction.active)
        direction.buffers[static_cast<std::size_t>(used++)] =
            static_cast<float*>(jack_.port_get_buffer(port, frames));
    return used;
}

void JackDevice::silence(jack_nframes_t frames) noexcept {
    for (auto* port : out_.ports)
        std::fill_n(static_cast<float*>(jack_.port_get_buffer(port, frames)), frames, 0.0f);
}

bool JackDevice::isOpen() {
    if (!isOpen_ || !isAlive()) return false;
    if (connectedPorts(in_) == in_.active && connectedPorts(out_) == out_.active) return true;
    if (DeviceUser* const user = slot_.end()) {
        user->stopped();
        start(*user);
    }
    return true;
}

void JackDevice::start(DeviceUser& user) {
    if (!isOpen_ || !isAlive()) return;
    in_.active = connectedPorts(in_); // not read by the render thread before the user is there
    out_.active = connectedPorts(out_);
    slot_.begin(*this, user);
}

void JackDevice::stop() {
    if (DeviceUser* const user = slot_.end()) user->stopped();
}

int JackDevice::sampleRateHz() {
    return isAlive() ? static_cast<int>(jack_.get_sample_rate(client_.get())) : 0;
}

int JackDevice::blockFrames() {
    return isAlive() ? static_cast<int>(jack_.get_buffer_size(client_.get())) : 0;
}

ChannelSet JackDevice::activeOutputs() const {
    ChannelSet channels;
    for (std::size_t k = 0; k < out_.ports.size(); ++k)
        if (std::ranges::find(out_.active, out_.ports[k]) != out_.active.end())
            channels.insert(static_cast<int>(k));
    return channels;
}

// Read at the ports that ours are connected to: JACK tells ours only after its next change of the graph.
int JackDevice::outputLatencyFrames() {
    jack_nframes_t longest = 0;
    for (auto* port : connectedPorts(out_)) {
        const char** const others = jack_.port_get_connections(port);
        for (const char** name = others; name != nullptr && *name != nullptr; ++name) {
            jack_latency_range_t range{};
            if (auto* other = jack_.port_by_name(client_.get(), *name))
                jack_.port_get_latency_range(other, JackPlaybackLatency, &range);
            longest = std::max(longest, range.max);
        }
        if (others != nullptr) jack_.free(static_cast<void*>(others));
    }
    return static_cast<int>(longest);
}

} // namespace physvib
