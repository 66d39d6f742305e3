// SPDX-License-Identifier: GPL-3.0-or-later
// Detects beats in a device's audio input and plays them in a live session.
#pragma once
#include "Host/Devices/InputTap.h"
#include "Host/Music/BeatDetector.h"
#include "Host/Music/BeatStrikes.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

namespace physvib {

/// A beat has the session time at which it was heard, so it is felt one output latency later. If the output
/// latency is shorter than the detector's delay, every beat is late. Runs on its own thread.
class LiveBeats {
public:
    /// Time that the output latency must cover in addition to a block and the limiter, i.e. ClockLaw's
    /// longest gap and two steps together: the detector's delay, and the thread's maximum delay.
    static constexpr double knownAfterSeconds = BeatDetector::mostDelaySeconds + 0.010;

    /// Both references outlive this object. Message thread.
    LiveBeats(Session& session, InputTap& inputs, const BeatVoices& voices, double sensitivity);
    ~LiveBeats();

    std::uint64_t beats() const noexcept { return beats_.load(std::memory_order_relaxed); } ///< Any thread.

private:
    void run();
    void take(const HeardPiece& piece);
    void begin(const HeardPiece& piece);
    void strike(const BandOnset& onset);

    Session& session_;
    InputTap& inputs_;
    const BeatVoices voices_;
    const double sensitivity_;
    std::unique_ptr<BeatDetector> detector_;
    int rateHz_ = 0;
    std::int64_t beginNs_ = 0, heardFrames_ = 0; // session time of the detector's first sample; number of
                                                 // samples so far
    std::atomic<std::uint64_t> beats_{0};
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

} // namespace physvib
