// SPDX-License-Identifier: MIT
// Each client of the JACK server, such as "system", as an audio device: our ports are connected to its ports.
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

/// M: opening and closing wait for the server, and hang as long as it does; another client that hangs in
/// opening is waited for a second.
///
/// When a server has gone, JACK's library frees all clients of the process as soon as any of them is opened
/// anew. So nobody calls JACK while a client is being opened, and a client that has lost its server is
/// neither closed nor used any more.
class JackClient {
public:
    /// Never starts a server. JACK appends a number to a name that another client has.
    JackClient(const JackLibrary& jack, const char* name);
    ~JackClient();
    JackClient(const JackClient&) = delete;
    JackClient& operator=(const JackClient&) = delete;

    /// Whether it has a server. Any thread.
    bool isAlive() const noexcept;

    /// JACK may be called for this client while the lock is held. Empty: it has lost its server, or, of
    /// holdSoon(), another client has been in opening for 50 ms.
    using Held = std::shared_lock<std::shared_timed_mutex>;
    Held hold(bool isSoon = false) const;
    Held holdSoon() const { return hold(true); }
    jack_client_t* get() const noexcept { return client_; }

    /// Full names ("system:playback_1") of the audio ports that take samples (JackPortIsInput) or give them
    /// (JackPortIsOutput), in the server's order. Held only.
    std::vector<std::string> ports(JackPortFlags direction) const;

    /// The ports() of one client.
    std::vector<std::string> portsOf(const std::string& owner, JackPortFlags direction) const;

    /// Keeps what JACK may still call for a client without its server, until JACK has freed it.
    static void keepUntilFreed(std::shared_ptr<void> callbacks);

private:
    const JackLibrary& jack_;
    jack_client_t* client_ = nullptr;
    unsigned int server_ = 0; // which of the servers that the process has seen, from 0
};

// The ports of a JACK device, and the blocks that JACK asks for.

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
    int blockFrames = 0; ///< of the server, when it was last queried
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

    /// Also follows the server's connections: if others have connected or disconnected outputs, the user is
    /// stopped and started anew with those that are connected now. JACK reports this on a thread of its own,
    /// where the user must not be called, so this is polled.
    bool isOpen() override;

    void start(DeviceUser& user) override;
    void stop() override;
    int sampleRateHz() override;
    int blockFrames() override;
    ChannelSet activeOutputs() const override;
    int deviceLatencyFrames() override;
    int xruns() const override { return stream_->xruns; }

private:
    using Direction = JackStream::Direction;

    bool isAlive() const noexcept { return stream_->client.isAlive(); }
    std::size_t connect(const Direction& direction, const ChannelSet& wanted, bool isOutput);
    void awaitConnections(std::size_t inputs, std::size_t outputs) const;
    std::vector<jack_port_t*> connectedPorts(const Direction& direction) const; // held
    bool hasOtherConnections() const;

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
