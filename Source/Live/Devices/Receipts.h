// SPDX-License-Identifier: MIT
// Receipts: the levels that were written to the device's buffer for each actuator, after all stages, by the
// session time at which they are felt. Studies report from them what really played. R: the render thread.
#pragma once
#include "Core/Limits.h"
#include "Core/Modes/TileKernels.h"
#include "Core/Nonblocking.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace physvib {

/// What was sent to an actuator within a span of session time; 1 = full scale of the output.
struct Receipt {
    std::int64_t frames = 0;             ///< that went to the actuator's output; 0 if it has none
    double peak = 0.0, meanSquare = 0.0; ///< of these frames
    bool isRunning = false; ///< every frame of the span left, in one piece: the device ran all the time, and
                            ///< the actuator had an output
    bool hasEnded = false;  ///< false: the device has not asked for the end of the span yet
    bool isInMemory = true; ///< false: the span is too old, and parts of it are unknown
    std::int64_t endNs = 0; ///< end of the last frame that left: start of a span that continues this one
    std::uint32_t opening = 0; ///< number of the last device start in the span; 0: no frame was sent
};

/// A ring of 10 ms bins that covers the newest minute, for one writer and any number of readers. The
/// constructor allocates its memory (0.35 MB for four actuators, 3.3 MB for 64).
class Receipts {
public:
    static constexpr int binsPerSecond = 100;
    static constexpr std::int64_t maxBins = 6'144; ///< at least a minute of them

    explicit Receipts(int actuators);

    /// Call when the device starts, or returns after a pause: a new opening begins. Render thread
    /// (R), or message thread (M) while R does not run.
    void begin() noexcept PHYSVIB_NONBLOCKING { ++opening_; }

    /// Adds frames that are sent: `outputs[j]` are the samples of actuator j, null if it has no output.
    /// `startFrame` is the session frame that is felt with the first of them; `session`: see receiptFor(). R,
    /// wait-free.
    void addBlock(std::uint32_t session, std::int64_t startFrame, int sampleRateHz,
                  const float* const* outputs, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Bins end exactly at these two times, so that receiptFor() of that span, if it is in the future, is
    /// exact; the next call replaces them. Other spans are extended to whole bins. One thread, wait-free.
    void alignBinsTo(std::int64_t fromNs, std::int64_t untilNs) noexcept;

    /// What was sent to that actuator (from 0) between `fromNs` and `untilNs` of a session: 0, the
    /// output's own; else the number of a borrowed one. Any thread; never holds up R.
    Receipt receiptFor(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                       std::uint32_t session = 0) const noexcept;

    /// An actuator's playing time and peak since the construction. Any thread, wait-free.
    struct Total {
        double seconds = 0.0; ///< at the actuator's output
        double peak = 0.0;
    };
    Total total(int actuator) const noexcept;

private:
    /// Position of a bin: consecutive frames of one session, at one rate, in one opening of the device.
    struct BinRange {
        std::int64_t start = 0;
        int frames = 0, rateHz = 0;
        std::uint32_t session = 0, opening = 0;
        std::int64_t end() const noexcept { return start + frames; }
    };
    /// A BinRange that R writes while others read, by release and acquire: a reader that got any part of a
    /// newer bin sees afterwards that `binsWritten_` has advanced, and discards what it read.
    struct Bin {
        std::atomic<std::int64_t> start{0};
        std::atomic<int> frames{0}, rateHz{0};
        std::atomic<std::uint32_t> session{0}, opening{0};
    };
    struct Level {
        std::atomic<float> peak{0.0f}, squares{0.0f}; // peak: -1 without an output; squares: their sum
    };
    struct SharedTotal {
        std::atomic<double> seconds{0.0};
        std::atomic<float> peak{0.0f};
    };

    bool read(std::int64_t bin, BinRange& range) const noexcept;
    bool read(std::int64_t bin, int actuator, Measured& sum) const noexcept;
    Level& level(std::int64_t bin, int actuator) const noexcept {
        return levels_[static_cast<std::size_t>(bin % maxBins) * count_ + static_cast<std::size_t>(actuator)];
    }
    bool hasNewAlignment() const noexcept {
        return alignedFromNs_ != newFromNs_.load(std::memory_order_relaxed) ||
               alignedUntilNs_ != newUntilNs_.load(std::memory_order_relaxed);
    }
    void setBinEnd() noexcept;
    void publish() noexcept;

    const std::size_t count_; // number of actuators
    decltype(TileKernel::measure) measureLanes_;
    decltype(TileKernel::join) joinLanes_;
    const std::unique_ptr<Bin[]> bins_;
    const std::unique_ptr<Level[]> levels_;
    const std::unique_ptr<SharedTotal[]> totals_;
    std::atomic<std::int64_t> binsWritten_{0}; // bins so far; the next one is being written
    std::atomic<std::int64_t> newFromNs_{0}, newUntilNs_{0};

    // R
    std::uint32_t opening_ = 0;
    BinRange currentBin_;                                 // the bin that grows
    std::int64_t binEndFrame_ = 0;                        // frame at which it ends
    std::int64_t alignedFromNs_ = 0, alignedUntilNs_ = 0; // request that binEndFrame_ respects
    int alignedRateHz_ = 0;
    std::array<std::int64_t, 2> alignedFrames_{};
    std::array<MeasuredLanes, static_cast<std::size_t>(limits::maxActuators)> currentLevels_{};
    std::array<Measured, static_cast<std::size_t>(limits::maxActuators)> binLevels_{}; // at the bin's end
    std::uint64_t missingOutputBits_ = 0; // bit j: actuator j had no output in part of the bin
};

} // namespace physvib
