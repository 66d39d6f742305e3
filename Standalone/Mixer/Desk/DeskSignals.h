// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's output samples for display: peaks, scope and spectrum.
#pragma once
#include "Live/Devices/Taps.h"
#include "Mixer/Desk/DeskMoment.h"
#include "Mixer/Strips/ScopeTrace.h"
#include "Mixer/Strips/SpectrumTrace.h"
#include "Mixer/Strips/TakeTrace.h"
#include <array>
#include <vector>

namespace physvib {

/// Message thread only.
class DeskSignals {
public:
    SignalTap& tap() noexcept { return tap_; } ///< filled by the output
    const ScopeTrace& scope() const noexcept { return scope_; }
    const SpectrumTrace& spectrum() const noexcept { return spectrum_; }
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

    const TakeTrace& take() const noexcept { return takeTrace_; }

    void setRate(int sampleRateHz);

    /// Sets the scene-run time of the samples read next; the world runs `slowness` times slower (0: paused).
    void follow(std::size_t take, double feltSeconds, int slowness);

    /// Updates peaks and holds of `moment`, which must be the same object each time. Returns the loudest peak
    /// of the first `enchanters`. `isSilent`: the output is muted, so all signals are shown as zeros.
    float read(DeskMoment& moment, int enchanters, bool isSilent);

private:
    void measure(const float* const* block, int frames, DeskMoment& moment, int enchanters);
    void measureSilence(int frames, DeskMoment& moment, int enchanters);

    SignalTap tap_{limits::maxEnchanters, 1 << 14};
    ScopeTrace scope_;
    SpectrumTrace spectrum_;
    TakeTrace takeTrace_;
    double scenePerFrame_ = 0.0; // in seconds
    int sampleRateHz_ = 48000;
    std::array<double, limits::maxEnchanters> heldAtMs_{};
    double readAtMs_ = 0.0;
    std::vector<float> zeros_;
};

} // namespace physvib
