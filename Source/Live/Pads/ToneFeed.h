// SPDX-License-Identifier: MIT
// Feeds a controller that plays two tones on either side (HD rumble) with the session's events: each report
// has the two tones per side that fit best what sounds until the next report.
#pragma once
#include "Core/ControlQueue.h"
#include "Core/PhantomPanner.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Pads/HidOutput.h"
#include <vector>

namespace physvib {

class ToneFeed final : public HidFeed {
public:
    static constexpr std::int64_t reportNs = 30'000'000; ///< as SDL's driver paces them

    /// `panner`: the session's; events go to both sides by their places in its field.
    ToneFeed(const HidFeedKind& kind, const PhantomPanner& panner);

    const HidFeedKind& kind() const noexcept override { return kind_; }
    void onCollision(const CollisionEvent& event) noexcept override { events_.push(event); }
    void onControl(const RenderControl& control) noexcept override { controls_.push(control); }
    void begin() override;
    std::optional<PadReport> next(std::int64_t nowNs, std::int64_t sessionNs, float level) override;
    PadReport silentReport() override;
    std::uint64_t lost() const noexcept override { return events_.overflows() + controls_.overflows(); }
    bool playsClips() const noexcept override { return false; }
    double leadSeconds() const noexcept override { return 1e-9 * static_cast<double>(reportNs); }
    double maxDelaySeconds() const noexcept override { return 0.0; }

    /// A decaying sinusoid's share in a report: its frequency, and the mean square of its amplitude.
    struct Partial {
        double frequencyHz, energy;
    };
    /// The two tones that fit a low and a high part of the partials best, divided where both are nearest to
    /// playable tones; each has its part's energy and mean pitch. Total energy is at most 1. Any thread.
    static TonePair fitTones(std::vector<Partial> partials);

private:
    struct Voice {
        CollisionEvent event;
        std::array<double, 2> gains; // left, right
    };
    void processQueues();
    TonePair computeTones(std::size_t side, std::int64_t fromNs, double level) const;

    const HidFeedKind& kind_;
    PhantomPanner gripPanner_;
    EventQueue<CollisionEvent, 4096> events_; // in session time
    ControlQueue<256> controls_;
    std::vector<PannerChange> pendingPanners_; // panners and stops that wait for their time
    std::vector<std::int64_t> stopsNs_;
    std::vector<Voice> voices_;
    std::int64_t dueNs_ = INT64_MIN / 2;    // steady time of the next report
    int silentReports_ = silentReportCount; // reports of silence since the last tone
    std::uint32_t reportNumber_ = 0;
};

} // namespace physvib
