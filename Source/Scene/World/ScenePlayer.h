// SPDX-License-Identifier: MIT
// What somebody plays in a scene that has no hands for every body: a basket that is moved, a car that is
// driven.
#pragma once
#include "Scene/Scene.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// A kinematic body that is felt is moved sideways; else motors of wheels of a body that is felt are driven.
/// One thread at a time.
class ScenePlayer {
public:
    static constexpr double mostMetresPerSecond = 4.0;  ///< of what is moved
    static constexpr double stepRadiansPerSecond = 6.0; ///< of what is driven; each key goes a step faster
    static constexpr int mostSteps = 3;

    explicit ScenePlayer(const Scene& scene);

    bool isThere() const noexcept { return moves() || drives(); }
    bool moves() const noexcept { return !body_.empty(); }
    bool drives() const noexcept { return !wheels_.empty(); }
    const std::string& body() const noexcept { return body_; } ///< that is moved

    /// A key to the left (-1) or right (1), or one that stops (0). Against the way it goes it stops, too.
    std::vector<Action> steer(int way);
    /// What is moved, with its middle at `fromMetres`, goes towards that place; a few times a second.
    std::vector<Action> moveTowards(double toMetres, double fromMetres);
    /// Held at that angle (counter-clockwise): what is moved slides down, faster by the angle.
    std::vector<Action> tilt(double angleRadians);
    /// What is moved, with its middle at `fromMetres`, does not leave the field.
    std::vector<Action> keepInside(double fromMetres);

    /// Whether the scene's script does what the player does. Any thread.
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
