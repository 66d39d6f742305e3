// SPDX-License-Identifier: MIT
// Plays on clients of the JACK server, such as "system": JACK's library, a client, a device and its driver.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <algorithm>
#include <atomic>
#include <jack/jack.h>
#include <memory>
#include <shared_mutex>
#include <string>
#include <vector>

namespace physvib {

// Loads JACK's client library (LGPL) at run time, when devices are first looked for.

#define PHYSVIB_JACK_FUNCTIONS(use)                                                                          \
    use(client_open) use(client_close) use(activate) use(deactivate) use(set_process_callback)               \
        use(set_xrun_callback) use(on_shutdown) use(set_error_function) use(set_info_function)               \
            use(get_sample_rate) use(get_buffer_size) use(get_ports) use(free) use(connect)                  \
                use(port_register) use(port_get_buffer) use(port_name) use(port_connected)                   \
                    use(port_get_connections) use(port_by_name) use(port_get_latency_range)

struct JackLibrary {
#define PHYSVIB_JACK_MEMBER(name) decltype(&::jack_##name) name = nullptr;
    PHYSVIB_JACK_FUNCTIONS(PHYSVIB_JACK_MEMBER)
#undef PHYSVIB_JACK_MEMBER
};

/// Loads JACK at the first call, for the life of the process, and keeps it from printing. Null: it is missing
/// or too old. Any thread.
const JackLibrary* jackLibrary();

// A client of the JACK server that may go away, and the names of other clients' ports.

/// For M, the message thread: opening and closing hang as long as the server does. Opening waits at most a
/// second for another client that is being opened.
///
/// After a server has gone, JACK's library frees all old clients of the process when the next one is opened.
/// So JACK is not called while a client is being opened, and a client that has lost its server is neither
/// used nor closed.
class JackClient {
public:
    /// Never starts a server. JACK appends a number to a name that another client has.
    JackClient(const JackLibrary& jack, const char* name);
    ~JackClient();
    JackClient(const JackClient&) = delete;
    JackClient& operator=(const JackClient&) = delete;

    /// Whether it has a server. Any thread.
    bool isAlive() const noexcept;

    /// Lock for calls of JACK with this client. Empty if the client has lost its server; lockBriefly() also
    /// if another client is still being opened after 50 ms.
    using Lock = std::shared_lock<std::shared_timed_mutex>;
    Lock lock(bool isBrief = false) const;
    Lock lockBriefly() const { return lock(true); }
    jack_client_t* get() const noexcept { return client_; }

    /// Full names ("system:playback_1") of the audio ports that take samples (JackPortIsInput) or give them
    /// (JackPortIsOutput), in the server's order. Call it with the lock.
    std::vector<std::string> ports(JackPortFlags direction) const;

    /// The ports() of one client.
    std::vector<std::string> clientPorts(const std::string& owner, JackPortFlags direction) const;

    /// Keeps the object that JACK may still call for a client without a server, until JACK frees the client.
    static void keepUntilFreed(std::shared_ptr<void> callbacks);

private:
    const JackLibrary& jack_;
    jack_client_t* client_ = nullptr;
    unsigned int serverNumber_ = 0; // number of servers that had been lost when it was opened
};

// The ports of a JACK device, and the blocks that JACK asks for.

/// What JACK's threads call. It outlives its device if the server has gone (JackClient::keepUntilFreed()).
class JackStream {
public:
    struct Direction {
        std::vector<std::string> remote;  ///< ports of the device
        std::vector<jack_port_t*> ports;  ///< own ports, to be connected to these
        std::vector<jack_port_t*> active; ///< connected own ports; changed while nobody plays
        std::vector<float*> buffers;      ///< of the active ports, for one block
    };

    JackStream(const JackLibrary& jack, const std::string& device, bool withInputs)
        : client{jack, "physvib"}
        , jack_{jack} {
        const auto guard = client.lock();
        if (!guard) return;
        rateHz = static_cast<int>(jack_.get_sample_rate(client.get()));
        blockFrames = static_cast<int>(jack_.get_buffer_size(client.get()));
        out.remote = client.clientPorts(device, JackPortIsInput);
        if (withInputs) in.remote = client.clientPorts(device, JackPortIsOutput);
        addPorts(in, "in_", JackPortIsInput);
        addPorts(out, "out_", JackPortIsOutput);
        jack_.set_process_callback(client.get(), onBlock, this);
        jack_.set_xrun_callback(client.get(), onXrun, this);
    }

    Direction in, out;
    CallbackSlot slot;
    std::atomic<int> xruns{0};
    int rateHz = 0;      ///< of the server, which keeps it
    int blockFrames = 0; ///< of the server, when it was last queried
    JackClient client;   ///< last member, so closed first: until then JACK may call

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
        slot.call([&](AudioDeviceCallback* callback) {
            if (callback == nullptr) return silence(frames);
            const int inputs = fetchBuffers(in, frames), outputs = fetchBuffers(out, frames);
            if (inputs + outputs > 0)
                callback->processBlock(in.buffers.data(), inputs, out.buffers.data(), outputs,
                                       static_cast<int>(frames));
        });
    }

    int fetchBuffers(Direction& direction, jack_nframes_t frames) noexcept {
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

/// Its ports are out_1, out_2 ... in_1, in_2 ... of the client "physvib", one for each port of the device.
/// The server sets rate and block. Outputs that nothing is connected to are not active.
class JackDevice final : public AudioDevice {
public:
    JackDevice(const JackLibrary& jack, std::string name, bool withInputs);
    ~JackDevice() override;

    std::string name() const override { return name_; }
    int outputs() override { return static_cast<int>(stream_->out.ports.size()); }
    int inputs() override { return static_cast<int>(stream_->in.ports.size()); }
    int defaultBlockFrames() override { return blockFrames(); }
    std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                     int blockFrames) override;
    void close() override;

    /// Also follows the server's connections: if others have connected or disconnected outputs, the callback
    /// is stopped and started anew with those that are connected now. JACK reports this on a thread of its
    /// own, where the callback must not be called, so this is polled.
    bool isOpen() override;

    void start(AudioDeviceCallback& callback) override;
    void stop() override;
    int sampleRateHz() override;
    int blockFrames() override;
    ChannelSet activeOutputs() const override;
    int deviceLatencyFrames() override;
    int xruns() const override { return stream_->xruns; }

private:
    using Direction = JackStream::Direction;

    bool isAlive() const noexcept { return stream_->client.isAlive(); }
    std::size_t connect(const Direction& direction, const ChannelSet& channels, bool isOutput);
    void awaitConnections(std::size_t inputs, std::size_t outputs) const;
    std::vector<jack_port_t*> connectedPorts(const Direction& direction) const; // with the lock
    bool haveConnectionsChanged() const;

    const JackLibrary& jack_;
    const std::string name_;
    std::shared_ptr<JackStream> stream_;
    bool isOpen_ = false;
};

// Lists the clients of the JACK server as devices.

/// "JACK". A scan sees the server that runs then, whichever ran before.
class JackDriver final : public AudioDriver {
public:
    explicit JackDriver(const JackLibrary& jack)
        : jack_{jack} {}
    std::string name() const override { return "JACK"; }
    void scan() override;
    std::vector<std::string> deviceNames(bool inputs) override { return inputs ? inputs_ : outputs_; }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override;

private:
    const JackLibrary& jack_;
    std::vector<std::string> inputs_, outputs_;
};

} // namespace physvib
