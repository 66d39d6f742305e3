// SPDX-License-Identifier: MIT
// The part of a scene that a user controls by keys, mouse or tilt: a moved body (a basket) or driven wheels
// (a car).
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// Moves the first kinematic haptic source sideways; if there is none, drives the wheels of haptic sources.
/// One thread at a time.
class ScenePlayer {
public:
    static constexpr double maxMetresPerSecond = 4.0;   ///< top speed of the moved body
    static constexpr double stepRadiansPerSecond = 6.0; ///< of driven wheels; each key press is a step
    static constexpr int maxSteps = 3;

    explicit ScenePlayer(const Scene& scene);

    /// True if the scene has something to control: a body that moves, or wheels that drive.
    bool isPresent() const noexcept { return moves() || drives(); }
    bool moves() const noexcept { return !body_.empty(); }
    bool drives() const noexcept { return !wheels_.empty(); }
    const std::string& body() const noexcept { return body_; } ///< the moved body

    /// Actions for a key to the left (-1) or right (1), or a stop (0). A key against the motion stops.
    std::vector<Action> steer(int direction);
    /// Moves the body from its middle x = `fromMetres` to x = `toMetres`; call several times a second.
    std::vector<Action> moveTowards(double toMetres, double fromMetres);
    /// Moves the body downhill on a device that is tilted counter-clockwise, faster with the angle.
    std::vector<Action> tilt(double angleRadians);
    /// Stops the body, whose middle is at x = `fromMetres`, at the field's edges.
    std::vector<Action> keepInside(double fromMetres);

    /// True if the player controls what this action of the script changes. Any thread.
    bool controls(const Action& action) const noexcept;

private:
    std::vector<Action> moveAt(double metresPerSecond);
    std::string body_;
    std::vector<std::string> wheels_;
    double fieldWidthMetres_, halfWidthMetres_ = 0.0;
    double speedMetresPerSecond_ = 0.0; // of the moved body
    int speedStep_ = 0;
};

} // namespace physvib
