// SPDX-License-Identifier: MIT
// What a controller's reports are made of: samples of the session, or its events as tones.
#pragma once
#include "Live/Pads/HidDevice.h"
#include "Live/Pads/PadReports.h"
#include "Live/Session/Sink.h"
#include <optional>
#include <string_view>

namespace physvib {

/// Which controllers a feed is for, and how they are called.
struct HidFeedKind {
    std::span<const HidModel> models;
    std::string_view name; ///< "DualSense by Bluetooth"
};

inline constexpr int silentReports = 5; ///< as Linux' own driver sends to a Switch's controller

/// Makes reports. next() and the others without a remark: one thread, the controller's.
class HidFeed {
public:
    virtual ~HidFeed() = default;
    virtual const HidFeedKind& kind() const noexcept = 0;

    /// Render thread (R), wait-free.
    virtual void rendered(const RenderedBlock&) noexcept PHYSVIB_NONBLOCKING {}
    /// As for Sink: the thread that holds the world mutex, wait-free; the input mutex.
    virtual void made(const CollisionEvent&) noexcept {}
    virtual void posted(const RenderControl&) noexcept {}

    /// A session begins, or time has gone back: what was fed before is discarded.
    virtual void begin() = 0;
    /// Reports that a controller needs before the first and after the last one, switchSeconds apart.
    virtual std::span<const PadReport> on() const noexcept { return {}; }
    virtual std::span<const PadReport> off() const noexcept { return {}; }
    /// The report that is due at that steady time, if one is. `sessionNs`: what is felt now on the device;
    /// `level`: the master level, 0: silent within this report.
    virtual std::optional<PadReport> next(std::int64_t nowNs, std::int64_t sessionNs, float level) = 0;
    /// A report of silence; sent `silentReports` times, as radio may lose one and a motor holds what it had.
    virtual PadReport rest() = 0;
    virtual std::uint64_t lost() const noexcept { return 0; }   ///< frames or events; any thread
    virtual bool playsClips() const noexcept { return true; }   ///< as SinkState
    virtual double leadSeconds() const noexcept { return 0.0; } ///< as Sink::latencySeconds
    virtual double laterSeconds() const noexcept = 0;           ///< than the device, at most, up to the write
};

} // namespace physvib
