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
// on each side: flat to 0.35 of the lower rate, 40 dB down from 0.62 on. It delays by 6.2 output frames (2 ms
// at 3 kHz).

/// Used by one thread.
class RateReducer {
public:
    /// From `inHz` to the lower `outHz`, from silence.
    RateReducer(int inHz, int outHz);

    void push(const CoilFrame& frame);
    /// Number of output frames that can be pulled.
    std::size_t size() const noexcept { return outputFrames_.size(); }
    /// The next frame; silence if there is none.
    CoilFrame pull();

private:
    CoilFrame filtered(std::size_t phase) const;

    int inRate_, outRate_;                    // both rates, divided by their common factor
    std::vector<std::vector<float>> kernels_; // per phase, oldest frame first; each sums to 1
    std::vector<CoilFrame> ring_;             // the newest input frames
    std::size_t oldest_ = 0;                  // index in the ring; overwritten next
    int untilDue_ = 0; // time to the next output frame, in 1/outRate_ of an input frame
    std::deque<CoilFrame> outputFrames_;
};

class CoilFeed final : public HidFeed {
public:
    /// `panner`: the session's; its actuators are panned onto the two coils by their places from left to
    /// right, with equal power.
    CoilFeed(const HidFeedKind& kind, const CoilFormat& format, const PhantomPanner& panner);

    const HidFeedKind& kind() const noexcept override { return kind_; }
    void onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override;
    void onControl(const RenderControl& control) noexcept override;
    void begin() override;
    std::span<const PadReport> startReports() const noexcept override { return format_.onReports; }
    std::span<const PadReport> endReports() const noexcept override { return format_.offReports; }
    std::optional<PadReport> next(std::int64_t nowNs, std::int64_t sessionNs, float level) override;
    PadReport silentReport() override;
    std::uint64_t lost() const noexcept override { return samples_.overflows() + skipped_; }
    double maxDelaySeconds() const noexcept override;

private:
    /// Gains of each actuator in both coils.
    struct CoilGains {
        std::size_t count = 0;
        std::array<CoilFrame, limits::maxActuators> gains{};
    };
    static CoilGains computeCoilGains(const ActuatorLayout& layout) noexcept;
    void drainQueue();
    PadReport compose(float level);
    void adjustPace();
    std::int64_t periodNs() const noexcept { return 1'000'000'000LL * format_.frames / format_.rateHz; }

    const HidFeedKind& kind_;
    const CoilFormat& format_;
    LatestValue<CoilGains> coilGains_;
    EventQueue<CoilFrame, 16384> samples_;
    std::atomic<int> rateHz_{0}; // sample rate of the queued frames

    RateReducer reducer_;
    int reducedHz_; // input rate of the reducer
    GainRamp levelRamp_;
    DeviceGuard guard_; // its state is stored per kind of controller
    std::uint32_t reportNumber_ = 0;
    std::int64_t dueNs_ = 0; // steady time of the next report; 0: as soon as there are samples
    std::size_t minFramesLeft_ = 0, reportCount_ = 0; // minimum of unread frames over these reports
    bool isPaceRaised_ = false;                       // too many frames wait: reports are sent 0.1% faster
    bool isStarved_ = false;                          // a report was due before its samples were there
    bool isSilent_ = true;                            // the last report was all zeros
    std::atomic<std::uint64_t> skipped_{0};           // frames
};

} // namespace physvib
