// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a live session on a device until its duration is over or the user interrupts: its settings, beats of
// the input, and sound files.
#pragma once
#include "Calls/LoadedRender.h"
#include "Host/Music/BeatDetector.h"
#include "Host/Osc/OscPort.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace physvib {

/// Detects beats in the input and submits an event for each, at the session time of the beat: it is played
/// one output latency later, or late if the latency is shorter than the detector's delay. Has its own thread.
class LiveBeats {
public:
    /// Time that the output latency must cover in addition to a block and the limiter, i.e. ClockLaw's
    /// longest gap and two steps together: the detector's delay, and the thread's maximum delay.
    static constexpr double detectionDelaySeconds = BeatDetector::maxDelaySeconds + 0.010;

    /// Both references outlive this object. Message thread.
    LiveBeats(Session& session, InputTap& inputs, const BeatVoices& voices, double sensitivity)
        : session_{session}
        , inputs_{inputs}
        , voices_{voices}
        , sensitivity_{sensitivity}
        , thread_{[this] { run(); }} {}
    ~LiveBeats() {
        stop_ = true;
        thread_.join();
    }

    std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); } ///< Any thread.

private:
    static constexpr std::chrono::milliseconds pollInterval{1};
    static constexpr std::int64_t nsPerSecond = 1'000'000'000;
    static std::int64_t framesToNs(std::int64_t frames, int rateHz) {
        return frames / rateHz * nsPerSecond + frames % rateHz * nsPerSecond / rateHz;
    }

    void run() {
        InputChunk chunk;
        while (!stop_) {
            while (inputs_.next(chunk)) process(chunk);
            std::this_thread::sleep_for(pollInterval);
        }
    }
    // Restarts the detector if session time jumps, because input was lost or the device returned.
    void process(const InputChunk& chunk) {
        const std::int64_t expectedNs = startNs_ + (detector_ ? framesToNs(processedFrames_, rateHz_) : 0);
        if (!detector_ || chunk.rateHz != rateHz_ ||
            std::abs(chunk.sessionNs - expectedNs) > nsPerSecond / chunk.rateHz)
            restart(chunk);
        processedFrames_ += chunk.count;
        detector_->process(chunk.usedSamples(), [this](const BandOnset& onset) { submitBeat(onset); });
    }
    void restart(const InputChunk& chunk) {
        if (!detector_ || chunk.rateHz != rateHz_)
            detector_ = std::make_unique<BeatDetector>(chunk.rateHz, sensitivity_);
        else
            detector_->reset();
        rateHz_ = chunk.rateHz;
        startNs_ = chunk.sessionNs;
        processedFrames_ = 0;
    }
    void submitBeat(const BandOnset& onset) {
        const PhantomPanner panner = session_.panner();
        std::vector<CollisionEvent> events;
        makeBeatEvents(onset, startNs_ + framesToNs(onset.frame, rateHz_), voices_, panner.layout(),
                       panner.fieldWidthMetres(), panner.fieldHeightMetres(),
                       [&](const CollisionEvent& e) { events.push_back(e); });
        if (session_.submit({Strikes{events}, 0})) ++count_;
    }

    Session& session_;
    InputTap& inputs_;
    const BeatVoices voices_;
    const double sensitivity_;
    std::unique_ptr<BeatDetector> detector_;
    int rateHz_ = 0;
    std::int64_t startNs_ = 0, processedFrames_ = 0; // session time of the first frame; frames since
    std::atomic<std::uint64_t> count_{0};
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

struct LivePlaySettings {
    RigSettings rig;
    double seconds = 10.0;
    bool readsInput = false;           ///< reads standard input, line by line (see readInputLine)
    std::optional<BeatVoices> beats{}; ///< plays beats of the input at rig.output.inputs
    double beatSensitivity = 0.0;
    OscSettings osc;
    std::string clips = ".";           ///< folder of clips that messages may name
    bool keepsPlaying = false;         ///< continue after the end of standard input
    std::optional<LoadedClip> sound{}; ///< a clip that is played once at the start
};

/// Empty, or one error line. Message thread.
std::string playLive(LivePlaySettings settings);

// Plays a sound file on the actuators, as a clip in a session without bodies, with its safety limits.

/// True if the name has an extension of a recording or a haptic file.
bool isSoundFile(std::string_view file);

/// Reads the sound file given as scene. Sets a scene without bodies in `job`; sets the file's duration and a
/// layout with one actuator per channel in `options`, unless given. Or one error line. Message thread.
Result<LoadedClip> loadSound(RenderJob& options, std::string_view device, LoadedRender& job);

/// Empty, or an error if the layout has fewer actuators than channels.
std::string soundError(const LoadedClip& sound, const LoadedRender& job);

/// Starts the sound and sets the duration of `settings` to its end. Empty, or one error line. Message thread.
std::string startSound(LivePlaySettings& settings, const Session& session, MessageRouter& messages);

} // namespace physvib
