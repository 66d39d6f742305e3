// SPDX-License-Identifier: GPL-3.0-or-later
// Beats of what a device hears, struck in a live session.
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

/// What is struck is struck at the session time at which it was heard, so it is felt L after it: an L that
/// has no room for the detector is late every time. On a thread of its own.
class LiveBeats {
public:
    /// What L has to cover beside a block and the limiter, so ClockLaw's longest gap and its two steps
    /// together: the detector's delay, and what the thread may be late by.
    static constexpr double knownAfterSeconds = BeatDetector::mostDelaySeconds + 0.010;

    /// Both outlive this object. M.
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
    std::int64_t beginNs_ = 0, heardFrames_ = 0; // session time of the detector's sample 0; how many it has
                                                 // had
    std::atomic<std::uint64_t> beats_{0};
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

} // namespace physvib
