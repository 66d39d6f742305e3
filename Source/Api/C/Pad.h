// SPDX-License-Identifier: MIT
// The motors of one controller, for a program that has a rumble call of its own.
#pragma once
#include "Core/Pads/PadMotors.h"
#include <algorithm>

namespace physvib::api {

/// Neither allocates nor blocks. One thread at a time.
class Pad {
public:
    Pad(const PadLaw& law, double fieldWidthMetres, double fieldHeightMetres) noexcept
        : law_{law}
        , grips_{PadMotors::gripsOf({EnchanterLayout{fieldWidthMetres, fieldHeightMetres, 1, {}},
                                     PanningLaw::linear, 1.0, fieldWidthMetres, fieldHeightMetres})}
        , motors_{law} {}

    /// False if too many events are pending. An event that comes too late for its command begins at the next
    /// pull: the model has to know when its motor really starts.
    bool strike(const CollisionEvent& event) noexcept {
        if (event.timeNs >= pulledNs_ + leadNs()) return motors_.strike(event, grips_);
        if (lateCount_ == late_.size()) return false;
        late_[lateCount_++] = event;
        return true;
    }

    /// The command for the frame that ends at `untilNs`. Of several that became due since the last pull it is
    /// the strongest, per motor, so that no impact between two frames is lost. If none did, the last one
    /// holds.
    PadCommand pull(std::int64_t untilNs, double level) noexcept {
        pulledNs_ = untilNs;
        for (; lateCount_ > 0; motors_.strike(late_[lateCount_], grips_))
            late_[--lateCount_].timeNs = untilNs + leadNs();
        if (motors_.dueNs() > untilNs) return last_;
        PadCommand peak;
        for (int n = 0; n < maxCommands && motors_.dueNs() <= untilNs; ++n) {
            last_ = motors_.next(level);
            peak = {last_.timeNs, std::max(peak.low, last_.low), std::max(peak.high, last_.high)};
        }
        return peak;
    }

    /// Discards all events and lets the motors rest. Times may begin again at 0.
    void reset() noexcept { *this = Pad{law_, grips_.fieldWidthMetres(), grips_.fieldHeightMetres()}; }

    std::int64_t pulledNs() const noexcept { return pulledNs_; }
    const PadLaw& law() const noexcept { return law_; }
    PadMotors& motors() noexcept { return motors_; } ///< for a program with a timer per command, not frames

private:
    std::int64_t leadNs() const noexcept { return static_cast<std::int64_t>(1e9 * law_.leadSeconds); }

    static constexpr int maxCommands = 1000; // bounds a pull after a pause of minutes; the next goes on
    PadLaw law_;
    PhantomPanner grips_; // the left and the right end of the field
    PadMotors motors_;
    PadCommand last_;
    std::array<CollisionEvent, 256> late_; // until the next pull, in any order
    std::size_t lateCount_ = 0;
    std::int64_t pulledNs_ = INT64_MIN / 2;
};

} // namespace physvib::api
