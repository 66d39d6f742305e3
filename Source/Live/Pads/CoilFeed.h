// SPDX-License-Identifier: MIT
// Feeds a controller that has a coil on either side with the session's samples: pans them onto the two coils,
// reduces their sample rate, applies master level and guard, and sends reports at an even pace.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/EventQueue.h"
#include "Core/PhantomPanner.h"
#include "Live/Devices/DeviceGuard.h"
#include "Live/Pads/HidOutput.h"
#include "Live/Pads/PadReports.h"
#include <atomic>
#include <deque>
#include <vector>

namespace physvib {

// Reduces the sample rate of two channels to that of a controller's coils, with a windowed sinc of six zeros
// on each side: flat to 0.35 of the lower rate, 40 dB down from 0.62 on. Later by 6.2 of its frames (2 ms at
// 3 kHz).

/// One thread.
class RateReducer {
public:
    /// From `inHz` to the lower `outHz`, from silence.
    RateReducer(int inHz, int outHz);

    void push(const CoilFrame& frame);
    /// Frames that can be pulled.
    std::size_t size() const noexcept { return ready_.size(); }
    /// The next frame; silence if there is none.
    CoilFrame pull();

private:
    CoilFrame filtered(std::size_t phase) const;

    int in_, out_;                            // both rates, in lowest terms
    std::vector<std::vector<float>> kernels_; // per phase, oldest frame first; each sums to 1
    std::vector<CoilFrame> ring_;             // the newest input frames
    std::size_t oldest_ = 0;                  // of the ring, overwritten next
    int due_ = 0;                             // until the next output frame, in 1/out_ of an input frame
    std::deque<CoilFrame> ready_;
};

class CoilFeed final : public HidFeed {
public:
    /// `panner`: the session's; its actuators are panned onto the two coils by their places from left to
    /// right, with equal power.
    CoilFeed(const HidFeedKind& kind, const CoilFormat& format, const PhantomPanner& panner);

    const HidFeedKind& kind() const noexcept override { return kind_; }
    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override;
    void posted(const RenderControl& control) noexcept override;
    void begin() override;
    std::span<const PadReport> on() const noexcept override { return format_.on; }
    std::span<const PadReport> off() const noexcept override { return format_.off; }
    std::optional<PadReport> next(std::int64_t nowNs, std::int64_t sessionNs, float level) override;
    PadReport rest() override;
    std::uint64_t lost() const noexcept override { return samples_.overflows() + skipped_; }
    double laterSeconds() const noexcept override;

private:
    /// Gains of each actuator in both coils.
    struct Sides {
        std::size_t count = 0;
        std::array<CoilFrame, limits::maxEnchanters> gains{};
    };
    static Sides sidesOf(const EnchanterLayout& layout) noexcept;
    void drain();
    PadReport compose(float level);
    void watchReserve();
    std::int64_t periodNs() const noexcept { return 1'000'000'000LL * format_.frames / format_.rateHz; }

    const HidFeedKind& kind_;
    const CoilFormat& format_;
    const std::size_t channels_; // of the session
    LatestValue<Sides> sides_;
    EventQueue<CoilFrame, 16384> samples_;
    std::atomic<int> rateHz_{0}; // of what is in the queue

    RateReducer reducer_;
    int reducedHz_; // input rate of the reducer
    GainRamp level_;
    DeviceGuard guard_; // remembers what a controller of this kind has had, as a sound device's does
    std::uint32_t number_ = 0;
    std::int64_t dueNs_ = 0; // steady time of the next report; 0: as soon as there are samples
    std::size_t leastLeft_ = 0, reports_ = 0; // fewest frames left over the last `reports_` reports
    bool isEarly_ = false;                    // more frames wait than needed: a little faster
    bool isStarved_ = false;                  // a report was due before its samples were there
    bool isAtRest_ = true;                    // the last report was all zeros
    std::atomic<std::uint64_t> skipped_{0};   // frames
};

} // namespace physvib
