// SPDX-License-Identifier: MIT
// Another client of the JACK server, such as "system", as a device: this program's ports are connected to
// its.
#pragma once
#include "Live/Devices/JackStream.h"

namespace physvib {

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
    /// where the user must not be called, so whoever looks after the device asks.
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

} // namespace physvib
