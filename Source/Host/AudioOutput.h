// SPDX-License-Identifier: GPL-3.0-or-later
// A session on a multichannel audio device, with hands in mind: a device that is not there means silence and a
// message, never another device; levels come up in a ramp; one switch silences everything within a block.
//
// It uses JUCE's devices themselves and not its AudioDeviceManager, which opens the default device (the speakers)
// when the chosen one disappears.
#pragma once
#include "Core/GainRamp.h"
#include "Core/Limits.h"
#include "Host/PlayedRecorder.h"
#include "Host/Session.h"
#include <array>
#include <atomic>
#include <juce_audio_devices/juce_audio_devices.h>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

/// One output device of one driver.
struct AudioDeviceName {
    std::string type; ///< "ALSA", "JACK", "CoreAudio"...
    std::string name;
    int channels = 0; ///< outputs it offers; 0 if it could not be asked
};

/// All output devices. M; asks the system, which takes a while.
std::vector<AudioDeviceName> listAudioDevices();

/// What is wanted of a device.
struct AudioOutputSettings {
    std::string device;          ///< name, or type:name where two drivers have the same name
    std::vector<int> channelMap; ///< enchanter j plays on device output channelMap[j], from 0; empty: j on j
    int sampleRateHz = 0;        ///< 0: as the device stands
    int blockFrames = 0;         ///< 0: as the device stands
    float level = 1.0f;          ///< master gain, reached in a ramp
};

/// A moment of the output, for people.
struct AudioOutputStatus {
    std::uint64_t blocks = 0;
    float load = 0.0f;       ///< of the last block: time taken / time it lasts
    float worstLoad = 0.0f;
    int deviceXruns = 0;     ///< as the device counts them; -1: it does not
    bool isRunning = false;
};

class AudioOutput final : private juce::AudioIODeviceCallback {
public:
    /// `session` outlives the output. M.
    explicit AudioOutput(Session& session);
    ~AudioOutput() override;

    /// Opens that device and no other; empty, or one line with the reason. The session is prepared by the first
    /// device and resumed by later ones. M.
    std::string open(const AudioOutputSettings& settings);

    /// Stops and closes; what is left of the session stays. M.
    void close();

    /// Tries to get back a device that has gone; empty while all is well, else what is missing. M, now and then.
    std::string maintain();

    /// Silent within a block, back within limits::channelRampSeconds. Any thread, wait-free.
    void setSilent(bool silent) noexcept { silent_.store(silent, std::memory_order_relaxed); }
    void setLevel(float level) noexcept { level_.store(level, std::memory_order_relaxed); }

    /// From now on `recorder` takes all that is played, until the output is closed, or comes back at another rate: a
    /// file has one rate, so it ends there. M, once.
    void record(PlayedRecorder* recorder) noexcept { recorder_.store(recorder, std::memory_order_release); }
    bool isRecording() const noexcept { return recorder_.load(std::memory_order_relaxed) != nullptr; }

    /// M.
    AudioOutputStatus status();
    int sampleRateHz() const noexcept { return rate_; }
    int blockFrames() const noexcept { return block_; }
    int deviceLatencyFrames() const;

private:
    void audioDeviceIOCallbackWithContext(const float* const*, int, float* const* out, int outputs, int frames,
                                          const juce::AudioIODeviceCallbackContext&) override;
    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override;
    void audioDeviceError(const juce::String& message) override;

    std::string openDevice();
    void mapOutputs(const juce::BigInteger& active);
    void renderPart(float* const* out, int outputs, int first, int frames) noexcept;

    struct Load {
        std::uint64_t blocks = 0;
        float last = 0.0f, worst = 0.0f;
    };

    Session& session_;
    AudioOutputSettings settings_;
    std::unique_ptr<juce::AudioIODeviceType> type_;
    std::unique_ptr<juce::AudioIODevice> device_;
    std::atomic<bool> running_{false}, silent_{false};
    std::atomic<float> level_{1.0f};
    std::atomic<PlayedRecorder*> recorder_{nullptr};
    LatestValue<Load> load_;

    // R, set while the device is stopped
    int rate_ = 0, block_ = 0;
    std::array<int, limits::maxEnchanters> outputOf_{}; // callback channel of an enchanter; -1: none
    std::vector<std::vector<float>> scratch_;
    std::vector<float*> scratchAt_;
    GainRamp master_;
    Load measured_;
};

} // namespace physvib
