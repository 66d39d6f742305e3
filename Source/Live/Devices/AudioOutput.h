// SPDX-License-Identifier: MIT
// Plays a session on a multichannel audio device. A missing device means silence and a message, never another
// device, because the outputs drive actuators on a person's skin. Levels rise in a ramp, and one switch
// silences everything within a block.
//
// It opens devices itself, because JUCE's device manager would fall back to the default device, the
// loudspeakers. Threads: M, the message thread; R, the render thread.
#pragma once
#include "Core/Actuators/Exposure.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/Nonblocking.h"
#include "Live/Devices/DeviceGuard.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Devices/DeviceSession.h"
#include "Live/Devices/OutputMap.h"
#include "Live/Devices/OutputStages.h"
#include "Live/Devices/Receipts.h"
#include "Live/Session/OutputClock.h"
#include <atomic>
#include <string>
#include <vector>

namespace physvib {

class AudioOutput final : public OutputClock, private AudioDeviceCallback {
public:
    using Clock = DeviceWatch::Clock;

    /// `session` outlives the output; `drivers` are searched; `isEnded` as for OutputClock. M.
    AudioOutput(Session& session, AudioDrivers drivers, const std::atomic<bool>* isEnded = nullptr);
    ~AudioOutput() override;

    /// Opens that device and no other. Returns empty, or one line with the reason. The first device prepares
    /// the session; later ones resume it. M.
    std::string open(const AudioOutputSettings& settings);

    /// Changes the assignment of outputs and the number of actuators, without interruption if the device's
    /// outputs are open. Returns empty, or one line with the reason, in which case nothing changes. M.
    std::string assign(const std::vector<int>& channelMap, int actuatorCount) {
        return setMap(channelMap, actuatorCount, settings_.listening);
    }

    /// The device output of each actuator, from 0, as assigned last; -1: none. M.
    const std::vector<int>& channelMap() const noexcept { return settings_.channelMap; }

    /// Whether a device runs that has the actuator's output. Any thread.
    bool hasOutput(int actuator) const noexcept { return isRunning_ && map_.channelOf(actuator) >= 0; }

    /// Changes what plays on the listening outputs, without interruption as in assign(). Returns empty, or
    /// one line with the reason, in which case nothing changes. M.
    std::string setListening(const ListeningSettings& listening) {
        return setMap(settings_.channelMap, settings_.actuatorCount, listening);
    }

    /// Plays `other` from its beginning, from the next block on, while the output's own session pauses; null
    /// returns to the own session. `other` has no more channels and outputs than the own session and no
    /// contact sound; this call prepares it. When the call returns, the render thread no longer uses the
    /// session that was playing, and its modes are cut off. Returns false and changes nothing while no device
    /// has run. M.
    bool playInstead(Session* other);

    /// Silent within two blocks. Afterwards the render thread no longer uses session, recorder and taps,
    /// though the device may go on. M.
    void stop();

    /// Does what stop() does and closes the device, or abandons it to a driver that hangs. The session keeps
    /// its state. M.
    void close();

    /// Reopens a device that has gone, and adapts to a changed block size or sample rate. Returns empty if
    /// all is well, else one line that says what is missing or changed. M, about once a second.
    std::string maintain(Clock::time_point now = Clock::now());

    /// The requested device, as type:name once it was found; empty if none was requested. M.
    const std::string& device() const noexcept { return settings_.device; }

    /// Whether a session borrowed through playInstead() is playing. Any thread.
    bool isPlayingBorrowed() const noexcept { return played_.isPlayingBorrowed(); }

    /// What was sent to an actuator (from 0) between `fromNs` and `untilNs`, in the time of the session that
    /// plays now, or of the `session` that playedSession() returned. Any thread, wait-free.
    Receipt receiptFor(std::int64_t fromNs, std::int64_t untilNs, int actuator) const noexcept {
        return receiptFor(fromNs, untilNs, actuator, playedSession());
    }
    Receipt receiptFor(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                       std::uint32_t session) const noexcept {
        return receipts_.receiptFor(fromNs, untilNs, actuator, session);
    }
    std::uint32_t playedSession() const noexcept { return played_.borrowNumber(); } ///< 0: its own session
    /// Makes receiptFor() exact for this span in the future; otherwise it is extended to whole bins of 10 ms.
    /// M.
    void alignBinsTo(std::int64_t fromNs, std::int64_t untilNs) noexcept {
        receipts_.alignBinsTo(fromNs, untilNs);
    }
    /// Playing time and peak of an actuator. Any thread.
    Receipts::Total outputTotal(int actuator) const noexcept { return receipts_.total(actuator); }
    /// Whether a device is open and asks for blocks without a pause of more than three blocks and 100 ms.
    /// Pauses of a device that discards its samples do not count. Any thread.
    bool isPlaying() const noexcept {
        return isRunning_ && !played_.currentSession().pulse().isPaused(steadyNs());
    }

    /// Exposure of the session's channels as played: after ceilings, master level, silence and guard. M.
    const ExposureSums& exposure() noexcept { return exposure_.read(); }

    /// State of device, load and guard at this moment, for display. M.
    AudioOutputStatus status();
    int sampleRateHz() const noexcept { return played_.sampleRateHz(); }
    int blockFrames() const noexcept { return played_.blockFrames(); }
    int deviceLatencyFrames() const;
    int deviceOutputs() const; ///< number of outputs of the device; 0: no device

private:
    void processBlock(const float* const* in, int inputs, float* const* out, int outputs,
                      int frames) noexcept override;
    void aboutToStart(AudioDevice& device) override;
    void stopped() override { isRunning_ = false; }

    std::string setMap(const std::vector<int>& channelMap, int actuatorCount,
                       const ListeningSettings& listening);
    std::string listeningError() const;  // empty, or why listening outputs cannot play
    DeviceRequest deviceRequest() const; // the device to open, by settings and output map
    std::string openDevice(DeviceSession::TimeLimit limit);
    void fadeOut(); // returns when the outputs are silent, or after a time limit
    bool isGone(Clock::time_point now);
    std::string adaptToDevice(); // restarts for another sample rate, longer blocks or a new sink
    void renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING;
    void renderPart(Session& session, float* const* out, int outputs, int first, int frames) noexcept;

    PlayedSession played_;
    AudioOutputSettings settings_;
    std::atomic<bool> isRunning_{false}, isEnding_{false};
    std::atomic<int> maxFrames_{0}; // largest block that the device has asked for
    LoadMeter loadMeter_;

    // M
    DeviceWatch watch_;
    bool wasConnected_ = false; // since the device was opened
    Clock::time_point openedAt_;

    // R, set while the device is stopped
    InputTap* inputTap_ = nullptr;
    VibrationConverter* converter_ = nullptr;
    OutputMap map_;
    GainRamp masterRamp_;
    MonitorMix monitorMix_{map_};
    ExposureMeter exposure_;
    Receipts receipts_;
    OnOffMotors onOffMotors_;
    DeviceGuard deviceGuard_;
    DeviceSession deviceSession_; // last: its thread calls the members above
};

} // namespace physvib
