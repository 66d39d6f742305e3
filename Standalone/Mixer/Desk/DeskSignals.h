// SPDX-License-Identifier: GPL-3.0-or-later
// The samples that the desk plays, as they are seen: peaks, scope and spectrum.
#pragma once
#include "Host/Devices/SignalTap.h"
#include "Mixer/Desk/DeskMoment.h"
#include "Mixer/Strips/ScopeTrace.h"
#include "Mixer/Strips/SpectrumTrace.h"
#include "Mixer/Strips/TakeTrace.h"
#include <array>

namespace physvib {

/// M only.
class DeskSignals {
public:
    SignalTap& tap() noexcept { return tap_; } ///< what the output fills
    const ScopeTrace& scope() const noexcept { return scope_; }
    const SpectrumTrace& spectrum() const noexcept { return spectrum_; }
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

    const TakeTrace& take() const noexcept { return takeTrace_; }

    void setRate(int sampleRateHz);

    /// What is read next was felt at that time of a take, whose world goes `slowness` times slower (0: stands
    /// still).
    void follow(std::size_t take, double feltSeconds, int slowness);

    /// Brings peaks and holds of `moment`, which is the same each time, up to now; the loudest peak of the
    /// first `enchanters`.
    float read(DeskMoment& moment, int enchanters);

private:
    void measure(const float* const* block, int frames, DeskMoment& moment, int enchanters);

    SignalTap tap_{limits::maxEnchanters, 1 << 14};
    ScopeTrace scope_;
    SpectrumTrace spectrum_;
    TakeTrace takeTrace_;
    double scenePerFrame_ = 0.0; // seconds
    int sampleRateHz_ = 48000;
    std::array<double, limits::maxEnchanters> heldAtMs_{};
    double readAtMs_ = 0.0;
};

} // namespace physvib
