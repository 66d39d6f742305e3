// SPDX-License-Identifier: MIT
// Plays on ALSA devices: its library, a PCM stream, a device with its thread, and the driver that lists them.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <alsa/asoundlib.h>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

// Loads ALSA's library (LGPL) at run time, when devices are first looked for.

// clang-format would indent this list in steps.
// clang-format off
#define PHYSVIB_ALSA_FUNCTIONS(use)                                                                          \
    use(lib_error_set_handler) use(strerror) use(device_name_hint) use(device_name_get_hint)                 \
    use(device_name_free_hint) use(config_update_ref) use(config_unref) use(config_search)                   \
    use(config_search_definition) use(config_get_string) use(config_delete) use(pcm_open) use(pcm_close)     \
    use(pcm_hw_params_sizeof) use(pcm_hw_params_any) use(pcm_hw_params_get_channels_min)                     \
    use(pcm_hw_params_get_channels_max) use(pcm_hw_params_test_rate) use(pcm_hw_params_test_format)          \
    use(pcm_hw_params_set_access) use(pcm_hw_params_set_format) use(pcm_hw_params_set_rate_near)             \
    use(pcm_hw_params_set_channels) use(pcm_hw_params_set_periods_near)                                      \
    use(pcm_hw_params_set_period_size_near) use(pcm_hw_params) use(pcm_hw_params_get_buffer_size)            \
    use(pcm_hw_params_get_period_size) use(pcm_hw_params_get_periods) use(pcm_sw_params_sizeof)              \
    use(pcm_sw_params_current) use(pcm_sw_params_get_boundary) use(pcm_sw_params_set_silence_threshold)      \
    use(pcm_sw_params_set_silence_size) use(pcm_sw_params_set_start_threshold)                               \
    use(pcm_sw_params_set_stop_threshold) use(pcm_sw_params) use(pcm_prepare) use(pcm_start) use(pcm_wait)   \
    use(pcm_avail_update) use(pcm_writei) use(pcm_readi) use(pcm_recover)
// clang-format on

struct AlsaLibrary {
#define PHYSVIB_ALSA_MEMBER(name) decltype(&::snd_##name) name = nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_MEMBER)
#undef PHYSVIB_ALSA_MEMBER
};

/// Loads ALSA at the first call, for the life of the process, and keeps it from printing. Null: it is missing
/// or too old. Any thread.
const AlsaLibrary* alsaLibrary();

/// What a device offers in one direction; no channels if it cannot be queried.
struct AlsaRange {
    int minChannels = 0, maxChannels = 0;
    bool isMissing = false; ///< cannot be opened for another reason than rights or use by another program
    int rateHz = 0;         ///< a rate that it supports, 44.1 kHz if possible; 0: none
};

/// One direction of an ALSA device, with interleaved samples. M is the message thread.
class AlsaPcm {
public:
    AlsaPcm(const AlsaLibrary& alsa, std::string id, snd_pcm_stream_t direction)
        : alsa_{alsa}
        , id_{std::move(id)}
        , direction_{direction} {}
    ~AlsaPcm() { close(); }
    AlsaPcm(const AlsaPcm&) = delete;
    AlsaPcm& operator=(const AlsaPcm&) = delete;

    /// Opens the device, reads its range and closes it. M; may wait for the driver.
    AlsaRange queryRange() const;

    /// Opens near `rateHz` and `blockFrames`, which become what the device chose. Samples are floats, which
    /// ALSA converts if necessary. Returns empty or the error in one line. M; may wait for the driver.
    std::string open(int channels, int& rateHz, int& blockFrames);
    void close();
    bool isOpen() const noexcept { return pcm_ != nullptr; }
    bool hasId() const noexcept { return !id_.empty(); }
    int channels() const noexcept { return channels_; }
    int latencyFrames() const noexcept { return latencyFrames_; }

    /// Starts recording; playback starts with the first block. Device thread.
    void begin();

    enum class Transfer { some, none, failed };
    /// Moves interleaved `frames` after waiting at most 100 ms; returns how many in `done`. Device thread.
    Transfer transfer(float* samples, int frames, int& done) noexcept;
    int xruns() const noexcept { return xruns_; } ///< any thread

private:
    int openId(const std::string& id);
    int chooseHardware(int channels, unsigned int& rateHz, snd_pcm_uframes_t& periodFrames);
    int chooseSoftware(snd_pcm_uframes_t periodFrames);
    bool hasFloats() const;
    void countXrun() noexcept;

    const AlsaLibrary& alsa_;
    const std::string id_;
    const snd_pcm_stream_t direction_;
    snd_pcm_t* pcm_ = nullptr;
    int channels_ = 0, latencyFrames_ = 0;
    snd_pcm_uframes_t bufferFrames_ = 0;
    std::atomic<int> xruns_{0};
    bool isInXrun_ = false; // the last block came too late
};

/// A device by ALSA's names for output and input. It is opened by name, so one that was plugged in while
/// others play is found.
class AlsaDevice final : public AudioDevice {
public:
    /// `outputId`, `inputId`: ALSA's names ("hw:CARD=Audio,DEV=0"); empty: none.
    AlsaDevice(const AlsaLibrary& alsa, std::string name, const std::string& outputId,
               const std::string& inputId);
    ~AlsaDevice() override { close(); }

    bool exists() const noexcept { return !outputRange_.isMissing; } ///< when it was constructed

    std::string name() const override { return name_; }
    int outputs() override { return outputRange_.maxChannels; }
    int inputs() override { return inputRange_.maxChannels; }
    int defaultBlockFrames() override { return 512; }
    /// ALSA opens the first n channels of a device, so all up to the highest requested one are opened; those
    /// that were not requested are silent.
    std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                     int blockFrames) override;
    void close() override;
    bool isOpen() override { return thread_.joinable() && !hasFailed_; }
    void start(AudioDeviceCallback& callback) override;
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
        std::vector<float*> buffers;              // pointers to `channels`
        std::string open(const ChannelSet& wanted, const AlsaRange& range, int& rateHz, int& blockFrames);
        void prepare(int blockFrames);
        void copy(bool isOutput) noexcept; // channels to interleaved samples, or these to channels
    };

    void run() noexcept;
    bool transferAll(Direction& direction) noexcept;

    const std::string name_;
    Direction in_, out_;
    AlsaRange inputRange_, outputRange_;
    CallbackSlot slot_;
    std::thread thread_;
    std::atomic<bool> isEnding_{false}, hasFailed_{false};
    int rateHz_ = 0, blockFrames_ = 0;
};

// Lists ALSA's devices: those that `aplay -L` lists, by their descriptions.

/// "ALSA". A scan opens no device but "default" and "pulse", and these only if ALSA does not list them. A
/// description that several devices share gets a number: "Audio (1)", "Audio (2)". Devices that lead to JACK
/// are left out: ALSA would use their JACK client after JACK has freed it, when the server has gone.
class AlsaDriver final : public AudioDriver {
public:
    /// `isJackRunning` tells whether a JACK server runs. Devices that lead to PulseAudio are then not listed,
    /// but create() still accepts their names.
    AlsaDriver(const AlsaLibrary& alsa, bool (*isJackRunning)())
        : alsa_{alsa}
        , isJackRunning_{isJackRunning} {}
    std::string name() const override { return "ALSA"; }
    void scan() override;
    std::vector<std::string> deviceNames(bool inputs) override;
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override;

private:
    struct Entry {
        std::string id, name, pluginType; // see lastPluginType()
    };
    using List = std::vector<Entry>;

    void addListed(const void* hint);
    /// The type of the last plug-in in a device's chain: "hw", "jack", "pulse"; empty: not known. Opens no
    /// device. `maxDepth` ends the search in a chain that refers to itself.
    std::string lastPluginType(const std::string& id, int maxDepth = 16) const;
    std::string configString(snd_config_t* node) const;
    void addUnlisted(const std::string& id, const std::string& name);
    std::string hintValue(const void* hint, const char* kind) const;
    static std::string deviceId(const List& list, const std::string& name);

    const AlsaLibrary& alsa_;
    bool (*isJackRunning_)();
    List inputs_, outputs_;
};

} // namespace physvib
