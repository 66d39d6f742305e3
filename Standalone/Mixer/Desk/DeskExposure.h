// SPDX-License-Identifier: GPL-3.0-or-later
// Vibration exposure of the mixer's output in g, from sums in full scales and the current layout.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/FeltLevel.h"

namespace physvib {

/// Actuators are treated like the axes in ISO 5349-1, as if all were in one hand: their squares add up.
/// Message thread only.
class DeskExposure {
public:
    explicit DeskExposure(AudioOutput& output)
        : output_{output} {}

    /// Sets the layout of the channels from now on.
    void use(const LayoutDescription& layout);

    /// Adds the output since the last call. Call it often, and before the layout changes.
    void update();

    void goOnFrom(double squareGSeconds) noexcept {
        squareGSeconds_ += squareGSeconds;
    }                                                                  ///< adds earlier exposure
    double squareGSeconds() const noexcept { return squareGSeconds_; } ///< weighted, of today
    /// A(8), if there was no other exposure that day
    double daily() const noexcept { return dailyExposure(squareGSeconds_); }

    /// Starts a new measurement of felt(), of these frames of the session that is played.
    void restartLevels(const SampleSpan& span) { mark_ = output_.restartLevels(span); }
    /// Level of the strongest actuator in the span, over `seconds`; zeros if nothing was played.
    FeltLevel felt(double seconds) const;

private:
    AudioOutput& output_;
    std::array<double, limits::maxEnchanters> fullScaleG_{};
    ExposureSums sums_;
    std::uint32_t mark_ = 0;
    double squareGSeconds_ = 0.0;
};

} // namespace physvib
