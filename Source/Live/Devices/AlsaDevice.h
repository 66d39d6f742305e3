// SPDX-License-Identifier: MIT
// A device of ALSA: a thread that asks for blocks as fast as the device takes them.
#pragma once
#include "Live/Devices/AlsaPcm.h"
#include "Live/Devices/UserSlot.h"
#include <atomic>
#include <thread>

namespace physvib {

/// One name of ALSA's for output and input. It is opened by that name, so a device that was plugged in while
/// others play is found.
class AlsaDevice final : public AudioDevice {
public:
    /// `outputId`, `inputId`: ALSA's names ("hw:CARD=Audio,DEV=0"); empty: none.
    AlsaDevice(const AlsaLibrary& alsa, std::string name, const std::string& outputId,
               const std::string& inputId);
    ~AlsaDevice() override { close(); }

    bool isThere() const noexcept { return !outputRange_.isMissing; } ///< when it was made

    std::string name() const override { return name_; }
    int outputs() override { return outputRange_.maxChannels; }
    int inputs() override { return inputRange_.maxChannels; }
    int defaultBlockFrames() override { return 512; }
    /// Channels below the highest wanted one are opened, because ALSA opens only so many from the first on;
    /// those that are not wanted are silent.
    std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                     int blockFrames) override;
    void close() override;
    bool isOpen() override { return thread_.joinable() && !hasFailed_; }
    void start(DeviceUser& user) override;
    void stop() override;
    int sampleRateHz() override { return rateHz_; }
    int blockFrames() override { return blockFrames_; }
    ChannelSet activeOutputs() const override { return out_.active; }
    int deviceLatencyFrames() override { return out_.pcm.latencyFrames(); }
    int xruns() const override { return out_.pcm.xruns() + in_.pcm.xruns(); }

private:
    struct Direction {
        Direction(const AlsaLibrary& alsa, const std::string& id, snd_pcm_stream_t direction)
            : pcm{alsa, id, direction} {}
        AlsaPcm pcm;
        ChannelSet active;
        std::vector<float> interleaved;           // one block, all channels
        std::vector<std::vector<float>> channels; // the active ones, one after the other
        std::vector<float*> buffers;              // of these
        std::string open(const ChannelSet& wanted, const AlsaRange& range, int& rateHz, int& blockFrames);
        void prepare(int blockFrames);
        void split() noexcept; // interleaved samples into channels
        void join() noexcept;  // and back
    };

    void run() noexcept;
    bool moveAll(Direction& direction) noexcept;

    const std::string name_;
    Direction in_, out_;
    AlsaRange inputRange_, outputRange_;
    UserSlot slot_;
    std::thread thread_;
    std::atomic<bool> isEnding_{false}, hasFailed_{false};
    int rateHz_ = 0, blockFrames_ = 0;
};

} // namespace physvib
