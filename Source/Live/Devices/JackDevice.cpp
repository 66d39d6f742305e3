// SPDX-License-Identifier: MIT
// Opens clients of JACK, plays on the ports of another client, and lists the clients with audio ports.
#include "Live/Devices/JackDevice.h"
#include "Live/Session/System.h"
#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <optional>
#include <utility>

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
    const auto guard = stream_->client.lock();
    if (!guard) return "expected a running JACK server, found none";
    stream_->xruns = 0;
    // a busy server that is 20 blocks late to call the client says no, but yes when asked again
    const auto isCalled = [this] { return jack_.activate(stream_->client.get()) == 0; };
    if (!isCalled() && !isCalled()) return "the JACK server refuses to call this program";
    isOpen_ = true;
    const std::size_t in = connect(stream_->in, inputs, false), out = connect(stream_->out, outputs, true);
    awaitConnections(in, out);
    return {};
}

std::size_t JackDevice::connect(const Direction& direction, const ChannelSet& channels, bool isOutput) {
    std::size_t connected = 0;
    for (const int k : channels) {
        const auto index = static_cast<std::size_t>(k);
        if (index >= direction.ports.size()) continue;
        const char *ours = jack_.port_name(direction.ports[index]), *theirs = direction.remote[index].c_str();
        if (jack_.connect(stream_->client.get(), isOutput ? ours : theirs, isOutput ? theirs : ours) == 0)
            ++connected;
    }
    return connected;
}

// Waits for connections: JACK makes them at once, but lists them only from the server's next block on.
void JackDevice::awaitConnections(std::size_t inputs, std::size_t outputs) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds{500};
    while ((connectedPorts(stream_->in).size() < inputs || connectedPorts(stream_->out).size() < outputs) &&
           isAlive() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

void JackDevice::close() {
    stop();
    if (const auto guard = stream_->client.lock(); isOpen_ && guard) jack_.deactivate(stream_->client.get());
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

bool JackDevice::haveConnectionsChanged() const {
    const auto guard = stream_->client.lockBriefly();
    return guard && (connectedPorts(stream_->in) != stream_->in.active ||
                     connectedPorts(stream_->out) != stream_->out.active);
}

bool JackDevice::isOpen() {
    if (!isOpen_ || !isAlive()) return false;
    if (!haveConnectionsChanged()) return true;
    if (AudioDeviceCallback* const callback = stream_->slot.end()) {
        callback->stopped();
        start(*callback);
    }
    return true;
}

void JackDevice::start(AudioDeviceCallback& callback) {
    if (!isOpen_ || !isAlive()) return;
    if (const auto guard = stream_->client.lockBriefly()) {
        stream_->in.active = connectedPorts(stream_->in); // the render thread reads it once a callback is set
        stream_->out.active = connectedPorts(stream_->out);
    }
    stream_->slot.begin(*this, callback);
}

void JackDevice::stop() {
    if (AudioDeviceCallback* const callback = stream_->slot.end()) callback->stopped();
}

int JackDevice::sampleRateHz() { return isAlive() ? stream_->rateHz : 0; }

int JackDevice::blockFrames() {
    if (const auto guard = stream_->client.lockBriefly())
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

// Reads the latency at the ports that ours are connected to: JACK updates ours only when its graph changes.
int JackDevice::deviceLatencyFrames() {
    jack_nframes_t maxFrames = 0;
    const auto guard = stream_->client.lockBriefly();
    if (!guard) return 0;
    for (auto* port : connectedPorts(stream_->out)) {
        const char** const others = jack_.port_get_connections(port);
        for (const char** name = others; name != nullptr && *name != nullptr; ++name) {
            jack_latency_range_t range{};
            if (auto* other = jack_.port_by_name(stream_->client.get(), *name))
                jack_.port_get_latency_range(other, JackPlaybackLatency, &range);
            maxFrames = std::max(maxFrames, range.max);
        }
        if (others != nullptr) jack_.free(static_cast<void*>(others));
    }
    return static_cast<int>(maxFrames);
}

namespace {

std::optional<JackLibrary> loadJack() {
    JackLibrary jack;
    void* library = nullptr;
    for (const char* name : {"libjack.so.0", "libjack64.dll", "libjack.0.dylib"})
        if (library == nullptr) library = openLibrary(name);
    bool hasAll = library != nullptr;
#define PHYSVIB_JACK_FIND(name)                                                                              \
    if (hasAll) jack.name = reinterpret_cast<decltype(jack.name)>(findFunction(library, "jack_" #name));     \
    hasAll = hasAll && jack.name != nullptr;
    PHYSVIB_JACK_FUNCTIONS(PHYSVIB_JACK_FIND)
#undef PHYSVIB_JACK_FIND
    if (!hasAll) return {};
    // Without a server, JACK prints five lines to stderr for each query; the caller reports it in one.
    jack.set_error_function([](const char*) {});
    jack.set_info_function([](const char*) {});
    return jack;
}

std::shared_timed_mutex jackMutex;
std::atomic<unsigned int> serversLost{0};

std::vector<std::shared_ptr<void>>& callbacksToFree() {
    static std::vector<std::shared_ptr<void>> callbacks;
    return callbacks;
}

// The server's number comes by value, because the client's object may have gone. The first of its clients
// counts the loss for all.
void onJackShutdown(void* server) {
    auto lost = static_cast<unsigned int>(reinterpret_cast<std::uintptr_t>(server));
    serversLost.compare_exchange_strong(lost, lost + 1);
}

// "physvib", or "physvib-01" and so on: another device of this program, or another run of it.
bool isOwn(const std::string& client) {
    return client == "physvib" ||
           (client.starts_with("physvib-") && client.find_first_not_of("0123456789", 8) == std::string::npos);
}

std::vector<std::string> clientNames(const std::vector<std::string>& ports) {
    std::vector<std::string> clients;
    for (const std::string& port : ports) {
        const std::string client = port.substr(0, port.find(':'));
        if (!isOwn(client) && std::ranges::find(clients, client) == clients.end()) clients.push_back(client);
    }
    return clients;
}

} // namespace

const JackLibrary* jackLibrary() {
    static const std::optional<JackLibrary> loaded = loadJack();
    return loaded ? &*loaded : nullptr;
}

// Opens and closes clients of JACK, one at a time in the process, as JACK's library does itself.

JackClient::JackClient(const JackLibrary& jack, const char* name)
    : jack_{jack} {
    std::vector<std::shared_ptr<void>> freed;
    const std::unique_lock lock{jackMutex, std::chrono::seconds{1}};
    if (!lock) return;
    jack_status_t status{};
    client_ = jack_.client_open(name, JackNoStartServer, &status);
    // The server may have gone this very moment: opening may then have freed clients whose loss JACK had no
    // time to report.
    if (client_ == nullptr && (status & JackServerFailed) != 0) ++serversLost;
    if (client_ == nullptr) return;
    serverNumber_ = serversLost;
    const std::uintptr_t server = serverNumber_;
    jack_.on_shutdown(client_, onJackShutdown, reinterpret_cast<void*>(server));
    freed.swap(callbacksToFree()); // opening freed their clients
}

JackClient::~JackClient() {
    if (const auto guard = lock()) jack_.client_close(client_);
}

bool JackClient::isAlive() const noexcept { return client_ != nullptr && serversLost == serverNumber_; }

JackClient::Lock JackClient::lock(bool isBrief) const {
    if (!isAlive()) return {};
    Lock guard = isBrief ? Lock{jackMutex, std::chrono::milliseconds{50}} : Lock{jackMutex};
    return guard && isAlive() ? std::move(guard) : Lock{};
}

void JackClient::keepUntilFreed(std::shared_ptr<void> callbacks) {
    const std::lock_guard lock{jackMutex};
    callbacksToFree().push_back(std::move(callbacks));
}

std::vector<std::string> JackClient::ports(JackPortFlags direction) const {
    std::vector<std::string> names;
    const char** const all = jack_.get_ports(client_, nullptr, JACK_DEFAULT_AUDIO_TYPE, direction);
    for (const char** name = all; name != nullptr && *name != nullptr; ++name) names.emplace_back(*name);
    if (all != nullptr) jack_.free(static_cast<void*>(all));
    return names;
}

std::vector<std::string> JackClient::clientPorts(const std::string& owner, JackPortFlags direction) const {
    std::vector<std::string> names = ports(direction);
    std::erase_if(names, [&](const std::string& name) { return !name.starts_with(owner + ":"); });
    return names;
}

void JackDriver::scan() {
    inputs_.clear();
    outputs_.clear();
    const JackClient client{jack_, "physvib-scan"};
    const auto guard = client.lock();
    if (!guard) return;
    inputs_ = clientNames(client.ports(JackPortIsOutput)); // what gives samples is an input here
    outputs_ = clientNames(client.ports(JackPortIsInput));
}

std::unique_ptr<AudioDevice> JackDriver::create(const std::string& name, bool withInputs) {
    if (std::ranges::find(outputs_, name) == outputs_.end()) return nullptr;
    return std::make_unique<JackDevice>(jack_, name, withInputs);
}

} // namespace physvib
