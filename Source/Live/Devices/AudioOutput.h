// SPDX-License-Identifier: MIT
// Plays a session on a multichannel audio device. A missing device means silence and a message, never another
// device, because the outputs drive actuators on a person's skin. Levels rise in a ramp, and one switch
// silences everything within a block.
//
// No manager of devices chooses for it: one that opens the default device (the loudspeakers) when the chosen
// device disappears would play there what is meant for skin.
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

class AudioOutput final : public OutputClock, private DeviceUser {
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
    std::string assign(const std::vector<int>& channelMap, int enchanters) {
        return remap(channelMap, enchanters, settings_.listening);
    }

    /// The device output of each actuator, from 0, as assigned last; -1: none. M.
    const std::vector<int>& channelMap() const noexcept { return settings_.channelMap; }

    /// Whether a device runs that has the actuator's output. Any thread.
    bool isPlaced(int enchanter) const noexcept { return running_ && map_.at(enchanter) >= 0; }

    /// Changes what plays on the listening outputs, without interruption as in assign(). Returns empty, or
    /// one line with the reason, in which case nothing changes. M.
    std::string hear(const ListeningSettings& listening) {
        return remap(settings_.channelMap, settings_.enchanters, listening);
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
    bool isLent() const noexcept { return played_.isLent(); }

    /// What was sent to an actuator (from 0) between `fromNs` and `untilNs`, in the time of the session that
    /// plays now, or of the `session` that playedSession() returned. Any thread, wait-free.
    Receipt left(std::int64_t fromNs, std::int64_t untilNs, int actuator) const noexcept {
        return left(fromNs, untilNs, actuator, playedSession());
    }
    Receipt left(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                 std::uint32_t session) const noexcept {
        return receipts_.left(fromNs, untilNs, actuator, session);
    }
    std::uint32_t playedSession() const noexcept { return played_.number(); } ///< 0: its own session
    /// Makes left() exact for this span in the future; otherwise it is extended to whole bins of 10 ms. M.
    void expect(std::int64_t fromNs, std::int64_t untilNs) noexcept { receipts_.expect(fromNs, untilNs); }
    Receipts::Total leftInAll(int actuator) const noexcept { return receipts_.all(actuator); } ///< any thread
    /// Whether a device is open and asks for blocks without a pause of more than three blocks and 100 ms.
    /// Pauses of a device that discards its samples do not count. Any thread.
    bool isPlaying() const noexcept { return running_ && !played_.now().pulse().isStill(steadyNs()); }

    /// Exposure of the session's channels as played: after ceilings, master level, silence and guard. M.
    const ExposureSums& exposure() noexcept { return exposure_.read(); }

    /// M.
    AudioOutputStatus status();
    int sampleRateHz() const noexcept { return played_.sampleRateHz(); }
    int blockFrames() const noexcept { return played_.blockFrames(); }
    int deviceLatencyFrames() const;
    int deviceOutputs() const; ///< number of outputs the device has; 0: no device

private:
    void block(const float* const* in, int inputs, float* const* out, int outputs,
               int frames) noexcept override;
    void aboutToStart(AudioDevice& device) override;
    void stopped() override { running_ = false; }

    std::string remap(const std::vector<int>& channelMap, int enchanters, const ListeningSettings& listening);
    std::string listeningFault() const; // empty, or why listening outputs cannot play
    DeviceRequest wish() const;         // the device to open, by settings and output map
    std::string openDevice(DeviceSession::Limit limit);
    void fadeOut(); // returns when the outputs are silent, or after a time limit
    bool hasGone(Clock::time_point now);
    std::string follow(); // restarts for another sample rate, longer blocks or a new sink
    void renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING;
    void renderPart(Session& session, float* const* out, int outputs, int first, int frames) noexcept;

    PlayedSession played_;
    AudioOutputSettings settings_;
    std::atomic<bool> running_{false}, ending_{false};
    std::atomic<int> largestBlock_{0}; // largest block that the device has asked for
    LoadMeter load_;

    // M
    DeviceWatch watch_;
    bool wasConnected_ = false; // since the device was opened
    Clock::time_point openedAt_;

    // R, set while the device is stopped
    InputTap* inputTap_ = nullptr;
    VibrationConverter* converter_ = nullptr;
    OutputMap map_;
    GainRamp master_;
    MonitorMix heard_{map_};
    ExposureMeter exposure_;
    Receipts receipts_;
    OnOffMotors motors_;
    DeviceGuard guard_;
    DeviceSession keeper_; // last: its thread calls the members above
};

} // namespace physvib
