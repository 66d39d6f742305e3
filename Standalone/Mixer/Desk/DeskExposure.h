// SPDX-License-Identifier: GPL-3.0-or-later
// What hands have taken of what the output played, in g: sums of full scales become sums of g by the layout
// that is felt.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/FeltLevel.h"

namespace physvib {

/// Enchanters count as axes do in ISO 5349-1: as if all lay in one hand, their squares add up. M only.
class DeskExposure {
public:
    explicit DeskExposure(AudioOutput& output)
        : output_{output} {}

    /// From now on the channels are these enchanters.
    void use(const LayoutDescription& layout);

    /// Takes up what has left since the last time; often enough that it is of one layout.
    void update();

    void goOnFrom(double squareGSeconds) noexcept {
        squareGSeconds_ += squareGSeconds;
    }                                                                  ///< hands had taken that before
    double squareGSeconds() const noexcept { return squareGSeconds_; } ///< weighted, of today
    /// A(8), if nothing else was felt that day
    double daily() const noexcept { return dailyExposure(squareGSeconds_); }

    /// felt() begins anew.
    void restartLevels() { mark_ = output_.restartLevels(); }
    /// The strongest enchanter since then, over `seconds`; zeros while nothing has left.
    FeltLevel felt(double seconds) const;

private:
    AudioOutput& output_;
    std::array<double, limits::maxEnchanters> fullScaleG_{};
    ExposureSums sums_;
    std::uint32_t mark_ = 0;
    double squareGSeconds_ = 0.0;
};

} // namespace physvib
