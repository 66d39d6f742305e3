// SPDX-License-Identifier: MIT
// Receipts: levels of what was written to the device's buffer for each actuator, after map, level, guard and
// clip, by the session time at which it is felt. Reports of what was played or felt are read from them.
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
    bool isOver = false;    ///< false: the device has not asked for the end of the span yet
    bool isKept = true;     ///< false: the span is too old, and parts of it are unknown
    std::int64_t endNs = 0; ///< end of the last frame that left: start of a span that continues this one
    std::uint32_t opening = 0; ///< number of the last opening in the span; 0: no frame of it left
};

/// A ring of 10 ms bins that covers the newest minute, for one writer and any number of readers. The
/// constructor allocates its memory (0.35 MB for four actuators, 3.3 MB for 64).
class Receipts {
public:
    static constexpr int binsPerSecond = 100;
    static constexpr std::int64_t mostBins = 6'144; ///< at least a minute of them

    explicit Receipts(int actuators);

    /// The device starts, or comes back after a pause: the next frames belong to a new opening. Render thread
    /// (R), or message thread (M) while R does not run.
    void begin() noexcept PHYSVIB_NONBLOCKING { ++opening_; }

    /// Adds frames that are sent: `outputs[j]` are the samples of actuator j, null if it has no output.
    /// `place` is the session frame that is felt with the first of them; `session`: see left(). R, wait-free.
    void take(std::uint32_t session, std::int64_t place, int sampleRateHz, const float* const* outputs,
              int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Bins end exactly at these two times, so that left() of that span, if it is in the future, is exact;
    /// the next call replaces them. Other spans are extended to whole bins. One thread, wait-free.
    void expect(std::int64_t fromNs, std::int64_t untilNs) noexcept;

    /// What left at that actuator, from 0, from `fromNs` on and before `untilNs` of a session: 0, the
    /// output's own; else the number of a borrowed one. Any thread; never holds up R.
    Receipt left(std::int64_t fromNs, std::int64_t untilNs, int actuator,
                 std::uint32_t session = 0) const noexcept;

    /// Totals since the construction. Any thread, wait-free.
    struct Total {
        double seconds = 0.0; ///< at the actuator's output
        double peak = 0.0;
    };
    Total all(int actuator) const noexcept;

private:
    /// Position of a bin: frames of a session at a sample rate, in one opening of the device.
    struct Place {
        std::int64_t start = 0;
        int frames = 0, rate = 0;
        std::uint32_t session = 0, opening = 0;
        std::int64_t end() const noexcept { return start + frames; }
    };
    /// The same in shared memory. Each value is written with release and read with acquire: a reader that got
    /// any part of a newer bin sees afterwards that `written_` has moved on.
    struct Bin {
        std::atomic<std::int64_t> start{0};
        std::atomic<int> frames{0}, rate{0};
        std::atomic<std::uint32_t> session{0}, opening{0};
    };
    struct Level {
        std::atomic<float> peak{0.0f}, squares{0.0f}; // peak: below 0, without an output
    };
    struct SharedTotal {
        std::atomic<double> seconds{0.0};
        std::atomic<float> peak{0.0f};
    };

    bool read(std::int64_t bin, Place& place) const noexcept;
    bool read(std::int64_t bin, int actuator, Measured& sum) const noexcept;
    Level& level(std::int64_t bin, int actuator) const noexcept {
        return levels_[static_cast<std::size_t>(bin % mostBins) * count_ +
                       static_cast<std::size_t>(actuator)];
    }
    bool isExpectedAnew() const noexcept {
        return edgeFromNs_ != fromNs_.load(std::memory_order_relaxed) ||
               edgeUntilNs_ != untilNs_.load(std::memory_order_relaxed);
    }
    void setEdge() noexcept;
    void publish() noexcept;

    const std::size_t count_; // actuators
    decltype(TileKernel::measure) measure_;
    decltype(TileKernel::join) join_;
    const std::unique_ptr<Bin[]> bins_;
    const std::unique_ptr<Level[]> levels_;
    const std::unique_ptr<SharedTotal[]> totals_;
    std::atomic<std::int64_t> written_{0}; // bins so far; the next one is being written
    std::atomic<std::int64_t> fromNs_{0}, untilNs_{0};

    // R
    std::uint32_t opening_ = 0;
    Place open_;                                    // the bin that grows
    std::int64_t edge_ = 0;                         // frame at which it ends
    std::int64_t edgeFromNs_ = 0, edgeUntilNs_ = 0; // expected times that edge_ respects
    int edgeRate_ = 0;
    std::array<std::int64_t, 2> expected_{};
    std::array<MeasuredLanes, static_cast<std::size_t>(limits::maxEnchanters)> growing_{};
    std::array<Measured, static_cast<std::size_t>(limits::maxEnchanters)> joined_{}; // of the bin that ends
    std::uint64_t absent_ = 0; // bit j: actuator j had no output in some of it
};

} // namespace physvib
