// SPDX-License-Identifier: MIT
// Plays on the ports of another JACK client.
#include "Live/Devices/JackDevice.h"
#include <algorithm>

namespace physvib {

JackDevice::JackDevice(const JackLibrary& jack, std::string name, bool withInputs)
    : jack_{jack}
    , name_{std::move(name)}
    , stream_{std::make_shared<JackStream>(jack, name_, withInputs)} {}

JackDevice::~JackDevice() {
    close();
    if (!isAlive()) JackClient::keepUntilFreed(std::move(stream_));
}

std::string JackDevice::open(const ChannelSet& inputs, const ChannelSet& outputs, int, int) {
    close();
    const auto held = stream_->client.hold();
    if (!held) return "expected a running JACK server, found none";
    stream_->xruns = 0;
    if (jack_.activate(stream_->client.get()) != 0) return "the JACK server refuses to call this program";
    isOpen_ = true;
    const std::size_t in = connect(stream_->in, inputs, false), out = connect(stream_->out, outputs, true);
    awaitConnections(in, out);
    return {};
}

std::size_t JackDevice::connect(const Direction& direction, const ChannelSet& wanted, bool isOutput) {
    std::size_t connected = 0;
    for (const int k : wanted) {
        const auto at = static_cast<std::size_t>(k);
        if (at >= direction.ports.size()) continue;
        const char *own = jack_.port_name(direction.ports[at]), *other = direction.remote[at].c_str();
        if (jack_.connect(stream_->client.get(), isOutput ? own : other, isOutput ? other : own) == 0)
            ++connected;
    }
    return connected;
}

// JACK makes connections at once, but lists them only from the server's next block on.
void JackDevice::awaitConnections(std::size_t inputs, std::size_t outputs) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds{500};
    while ((connectedPorts(stream_->in).size() < inputs || connectedPorts(stream_->out).size() < outputs) &&
           isAlive() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

void JackDevice::close() {
    stop();
    if (const auto held = stream_->client.hold(); isOpen_ && held) jack_.deactivate(stream_->client.get());
    isOpen_ = false;
    stream_->in.active.clear();
    stream_->out.active.clear();
}

std::vector<jack_port_t*> JackDevice::connectedPorts(const Direction& direction) const {
    std::vector<jack_port_t*> ports;
    for (auto* port : direction.ports)
        if (jack_.port_connected(port) > 0) ports.push_back(port);
    return ports;
}

bool JackDevice::hasOtherConnections() const {
    const auto held = stream_->client.holdSoon();
    return held && (connectedPorts(stream_->in) != stream_->in.active ||
                    connectedPorts(stream_->out) != stream_->out.active);
}

bool JackDevice::isOpen() {
    if (!isOpen_ || !isAlive()) return false;
    if (!hasOtherConnections()) return true;
    if (DeviceUser* const user = stream_->slot.end()) {
        user->stopped();
        start(*user);
    }
    return true;
}

void JackDevice::start(DeviceUser& user) {
    if (!isOpen_ || !isAlive()) return;
    if (const auto held = stream_->client.holdSoon()) {
        stream_->in.active = connectedPorts(stream_->in); // not read by the render thread before the user is
                                                          // there
        stream_->out.active = connectedPorts(stream_->out);
    }
    stream_->slot.begin(*this, user);
}

void JackDevice::stop() {
    if (DeviceUser* const user = stream_->slot.end()) user->stopped();
}

int JackDevice::sampleRateHz() { return isAlive() ? stream_->rateHz : 0; }

int JackDevice::blockFrames() {
    if (const auto held = stream_->client.holdSoon())
        stream_->blockFrames = static_cast<int>(jack_.get_buffer_size(stream_->client.get()));
    return isAlive() ? stream_->blockFrames : 0;
}

ChannelSet JackDevice::activeOutputs() const {
    ChannelSet channels;
    for (std::size_t k = 0; k < stream_->out.ports.size(); ++k)
        if (std::ranges::find(stream_->out.active, stream_->out.ports[k]) != stream_->out.active.end())
            channels.insert(static_cast<int>(k));
    return channels;
}

// Read at the ports that ours are connected to: JACK tells ours only after its next change of the graph.
int JackDevice::deviceLatencyFrames() {
    jack_nframes_t longest = 0;
    const auto held = stream_->client.holdSoon();
    if (!held) return 0;
    for (auto* port : connectedPorts(stream_->out)) {
        const char** const others = jack_.port_get_connections(port);
        for (const char** name = others; name != nullptr && *name != nullptr; ++name) {
            jack_latency_range_t range{};
            if (auto* other = jack_.port_by_name(stream_->client.get(), *name))
                jack_.port_get_latency_range(other, JackPlaybackLatency, &range);
            longest = std::max(longest, range.max);
        }
        if (others != nullptr) jack_.free(static_cast<void*>(others));
    }
    return static_cast<int>(longest);
}

} // namespace physvib
