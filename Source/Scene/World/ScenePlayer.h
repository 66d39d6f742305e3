// SPDX-License-Identifier: MIT
// The part of a scene that a user controls by keys, mouse or tilt: a moved body (a basket) or driven wheels
// (a car).
#pragma once
#include "Scene/Scene.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// A kinematic haptic source is moved sideways; otherwise the wheel motors of a haptic source are driven. One
/// thread at a time.
class ScenePlayer {
public:
    static constexpr double mostMetresPerSecond = 4.0;  ///< of the moved body
    static constexpr double stepRadiansPerSecond = 6.0; ///< of driven wheels; each key press is a step
    static constexpr int mostSteps = 3;

    explicit ScenePlayer(const Scene& scene)
        : fieldWidthMetres_{scene.fieldWidthMetres} {
        for (const BodyDescription& body : scene.bodies) {
            if (body.type != BodyType::kinematicBody || !isFelt(body)) continue;
            body_ = body.name;
            for (const auto& fixture : body.fixtures)
                halfWidthMetres_ = std::max(halfWidthMetres_, reachOf(fixture));
            return;
        }
        for (const JointDescription& joint : scene.joints) {
            const auto* wheel = std::get_if<WheelJoint>(&joint.joint);
            const auto car = std::ranges::find(scene.bodies, joint.bodyA, &BodyDescription::name);
            if (wheel != nullptr && wheel->maxTorqueNewtonMetres > 0.0 && car != scene.bodies.end() &&
                isFelt(*car))
                wheels_.push_back(joint.name);
        }
    }

    bool isThere() const noexcept { return moves() || drives(); }
    bool moves() const noexcept { return !body_.empty(); }
    bool drives() const noexcept { return !wheels_.empty(); }
    const std::string& body() const noexcept { return body_; } ///< the moved body

    /// A key to the left (-1) or right (1), or stop (0). A key against the present direction stops, too.
    std::vector<Action> steer(int way) {
        if (moves()) return go(way * goes_ < 0.0 ? 0.0 : way * mostMetresPerSecond);
        if (!drives()) return {};
        step_ = way == 0 || way * step_ < 0 ? 0 : std::clamp(step_ + way, -mostSteps, mostSteps);
        std::vector<Action> all;
        // clockwise is to the right
        for (const std::string& wheel : wheels_)
            all.push_back(MotorAction{wheel, -step_ * stepRadiansPerSecond, {}});
        return all;
    }
    /// Moves the body, whose middle is at `fromMetres`, towards that place; call a few times a second.
    std::vector<Action> moveTowards(double toMetres, double fromMetres) {
        return go(
            std::clamp((toMetres - fromMetres) / reachSeconds, -mostMetresPerSecond, mostMetresPerSecond));
    }
    /// Device held at that angle (counter-clockwise): the body slides down, at a speed that grows with the
    /// angle.
    std::vector<Action> tilt(double angleRadians) {
        return go(std::clamp(angleRadians / steepestRadians, -1.0, 1.0) * -mostMetresPerSecond);
    }
    /// Keeps the body, whose middle is at `fromMetres`, inside the field.
    std::vector<Action> keepInside(double fromMetres) {
        const bool leaves = (goes_ < 0.0 && fromMetres <= halfWidthMetres_) ||
                            (goes_ > 0.0 && fromMetres >= fieldWidthMetres_ - halfWidthMetres_);
        return leaves ? go(0.0) : std::vector<Action>{};
    }

    /// True if the player controls what this action of the script changes. Any thread.
    bool isPlayedBy(const Action& action) const noexcept {
        const auto* velocity = std::get_if<VelocityAction>(&action);
        const auto* motor = std::get_if<MotorAction>(&action);
        return (velocity != nullptr && velocity->body == body_) ||
               (motor != nullptr && std::ranges::find(wheels_, motor->joint) != wheels_.end());
    }

private:
    static constexpr double reachSeconds = 0.1;    // time to reach the mouse, if that is near
    static constexpr double steepestRadians = 0.5; // tilt at which the moved body has full speed
    static constexpr double leastChange = 0.05;    // m/s: a smaller change gives no input
    static bool isFelt(const BodyDescription& body) {
        return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
    }
    static double reachOf(const FixtureDescription& fixture) {
        double most = 0.0;
        if (const auto* polygon = std::get_if<PolygonShape>(&fixture.shape))
            for (const Vector& v : polygon->verticesMetres)
                most = std::max(most, std::abs(fixture.offsetMetres.x + v.x));
        if (const auto* box = std::get_if<BoxShape>(&fixture.shape))
            most = std::abs(fixture.offsetMetres.x) + 0.5 * box->widthMetres;
        if (const auto* circle = std::get_if<CircleShape>(&fixture.shape))
            most = std::abs(fixture.offsetMetres.x) + circle->radiusMetres;
        return most;
    }

    std::vector<Action> go(double metresPerSecond) {
        if (!moves() ||
            (std::abs(metresPerSecond - goes_) < leastChange && (metresPerSecond != 0.0 || goes_ == 0.0)))
            return {};
        goes_ = metresPerSecond;
        return {VelocityAction{body_, {goes_, 0.0}}};
    }
    std::string body_;
    std::vector<std::string> wheels_;
    double fieldWidthMetres_, halfWidthMetres_ = 0.0;
    double goes_ = 0.0; // m/s
    int step_ = 0;
};

} // namespace physvib
