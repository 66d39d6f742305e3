// SPDX-License-Identifier: MIT
// The part of a scene that a user controls by keys, mouse or tilt: a moved body (a basket) or driven wheels
// (a car).
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// A kinematic haptic source is moved sideways; of others the wheel motors are driven. One thread at a time.
class ScenePlayer {
public:
    static constexpr double mostMetresPerSecond = 4.0;  ///< of the moved body
    static constexpr double stepRadiansPerSecond = 6.0; ///< of driven wheels; each key press is a step
    static constexpr int mostSteps = 3;

    explicit ScenePlayer(const Scene& scene);

    bool isThere() const noexcept { return moves() || drives(); }
    bool moves() const noexcept { return !body_.empty(); }
    bool drives() const noexcept { return !wheels_.empty(); }
    const std::string& body() const noexcept { return body_; } ///< the moved body

    /// The actions of a key to the left (-1) or right (1), or of a stop (0). A key against the motion stops.
    std::vector<Action> steer(int way);
    /// Moves the body, whose middle is at x = `fromMetres`, to x = `toMetres`; call a few times a second.
    std::vector<Action> moveTowards(double toMetres, double fromMetres);
    /// Device held at that angle (counter-clockwise): the body slides down, faster with the angle.
    std::vector<Action> tilt(double angleRadians);
    /// Keeps the body, whose middle is at `fromMetres`, inside the field.
    std::vector<Action> keepInside(double fromMetres);

    /// True if the player controls what this action of the script changes. Any thread.
    bool isPlayedBy(const Action& action) const noexcept;

private:
    std::vector<Action> go(double metresPerSecond);
    std::string body_;
    std::vector<std::string> wheels_;
    double fieldWidthMetres_, halfWidthMetres_ = 0.0;
    double goes_ = 0.0; // m/s
    int step_ = 0;
};

} // namespace physvib
