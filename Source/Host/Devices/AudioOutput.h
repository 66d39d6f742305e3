// SPDX-License-Identifier: GPL-3.0-or-later
// A session on a multichannel audio device, with hands in mind: a device that is not there means silence and
// a message, never another device; levels come up in a ramp; one switch silences everything within a block.
//
// It uses JUCE's devices themselves and not its AudioDeviceManager, which opens the default device (the
// speakers) when the chosen one disappears.
#pragma once
#include "Core/Actuators/ExposureMeter.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/Nonblocking.h"
#include "Host/Devices/AudioOutputSettings.h"
#include "Host/Devices/DeviceGuard.h"
#include "Host/Devices/DeviceKeeper.h"
#include "Host/Devices/DeviceWatch.h"
#include "Host/Devices/HeardSignals.h"
#include "Host/Devices/LoadMeter.h"
#include "Host/Devices/OnOffMotors.h"
#include "Host/Devices/PlayedSession.h"
#include "Live/Session/FeltOutput.h"
#include <atomic>
#include <string>
#include <vector>

namespace physvib {

class AudioOutput final : public FeltOutput, private juce::AudioIODeviceCallback {
public:
    using Clock = DeviceWatch::Clock;

    /// `session` outlives the output; `types` is where devices are looked for. `isEnded` as FeltOutput's. M.
    explicit AudioOutput(Session& session, AudioDeviceTypes types = systemAudioDeviceTypes,
                         const std::atomic<bool>* isEnded = nullptr);
    ~AudioOutput() override;

    /// Opens that device and no other; empty, or one line with the reason. The session is prepared by the
    /// first device and resumed by later ones. M.
    std::string open(const AudioOutputSettings& settings);

    /// Another map of outputs and number of enchanters, while it plays if the device's outputs are open;
    /// empty, or one line with the reason, and all is as before. M.
    std::string assign(const std::vector<int>& channelMap, int enchanters);

    /// What is listened to, while it plays as assign(); empty, or one line with the reason, and all is as
    /// before. M.
    std::string hear(const ListeningSettings& listening);

    /// Plays `other` from the next block on, from its beginning, instead of the output's own session, which
    /// stands still meanwhile; null: the own one goes on. `other` has no more channels and outputs, no
    /// contact sound, and is prepared here. R has left the one that was played when this returns; what rings
    /// in it is cut. False, and nothing changes, while no device has run. M.
    bool lend(Session* other);

    /// Silent within two blocks; then R has left session, recorder and taps, though the device may go on. M.
    void stop();

    /// The same, and closes the device, or leaves it to a driver that hangs; what is left of the session
    /// stays. M.
    void close();

    /// Tries to get back a device that has gone, follows one that has changed its block or rate; empty while
    /// all is well, else what is missing or was changed. M, about once a second.
    std::string maintain(Clock::time_point now = Clock::now());

    /// The device that is wanted, as type:name once it was found; empty: none. M.
    const std::string& device() const noexcept { return settings_.device; }

    /// What plays is a session that was lent. Any thread.
    bool isLent() const noexcept { return played_.isLent(); }

    /// What has left for the enchanters, behind the master level, the ceilings and the switch; of the
    /// session's channels. M.
    const ExposureSums& exposure() noexcept { return exposure_.read(); }
    std::uint32_t restartLevels() noexcept { return exposure_.restart(); } ///< peaks and plain sums. M

    /// M.
    AudioOutputStatus status();
    int sampleRateHz() const noexcept { return played_.sampleRateHz(); }
    int blockFrames() const noexcept { return played_.blockFrames(); }
    int deviceLatencyFrames() const;
    int deviceOutputs() const; ///< that it offers; 0: there is none

private:
    void audioDeviceIOCallbackWithContext(const float* const* in, int inputs, float* const* out, int outputs,
                                          int frames, const juce::AudioIODeviceCallbackContext&) override;
    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { running_ = false; }
    void audioDeviceError(const juce::String&) override { running_ = false; }

    std::string remap(const std::vector<int>& channelMap, int enchanters, const ListeningSettings& listening);
    std::string listeningFault() const;
    DeviceWish wish() const;
    std::string openDevice(DeviceKeeper::Limit limit);
    void fadeOut();
    bool hasGone(Clock::time_point now);
    std::string follow();
    void renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING;
    void renderPart(Session& session, float* const* out, int outputs, int first, int frames) noexcept;

    PlayedSession played_;
    AudioOutputSettings settings_;
    std::atomic<bool> running_{false}, ending_{false};
    std::atomic<int> largestBlock_{0}; // that the device has asked for
    LoadMeter load_;

    // M
    DeviceWatch watch_;
    bool wasConnected_ = false; // since it was opened

    // R, set while the device is stopped
    InputTap* inputTap_ = nullptr;
    OutputMap map_;
    GainRamp master_;
    HeardSignals heard_{map_};
    ExposureMeter exposure_;
    OnOffMotors motors_;
    DeviceGuard guard_;
    DeviceKeeper keeper_; // last: its thread calls the others
};

} // namespace physvib
