// SPDX-License-Identifier: MIT
// Finds the body or wheels that the user controls, and converts keys, mouse places and tilt angles to actions
// that set velocities and motor speeds.
#include "Scene/World/ScenePlayer.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr double reachSeconds = 0.1;    // time to reach the mouse if it is near
constexpr double maxTiltRadians = 0.5;  // tilt at which the moved body has full speed
constexpr double minSpeedChange = 0.05; // m/s; smaller changes give no action

bool isHapticSource(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
}

double halfWidthOf(const FixtureDescription& fixture) {
    double halfWidth = 0.0;
    if (const auto* polygon = std::get_if<PolygonShape>(&fixture.shape))
        for (const Vector& v : polygon->verticesMetres)
            halfWidth = std::max(halfWidth, std::abs(fixture.offsetMetres.x + v.x));
    if (const auto* box = std::get_if<BoxShape>(&fixture.shape))
        halfWidth = std::abs(fixture.offsetMetres.x) + 0.5 * box->widthMetres;
    if (const auto* circle = std::get_if<CircleShape>(&fixture.shape))
        halfWidth = std::abs(fixture.offsetMetres.x) + circle->radiusMetres;
    return halfWidth;
}

} // namespace

ScenePlayer::ScenePlayer(const Scene& scene)
    : fieldWidthMetres_{scene.fieldWidthMetres} {
    for (const BodyDescription& body : scene.bodies) {
        if (body.type != BodyType::kinematicBody || !isHapticSource(body)) continue;
        body_ = body.name;
        for (const auto& fixture : body.fixtures)
            halfWidthMetres_ = std::max(halfWidthMetres_, halfWidthOf(fixture));
        return;
    }
    for (const JointDescription& joint : scene.joints) {
        const auto* wheel = std::get_if<WheelJoint>(&joint.joint);
        const auto* car = findNamed(scene.bodies, joint.bodyA);
        if (wheel != nullptr && wheel->maxTorqueNewtonMetres > 0.0 && car != nullptr && isHapticSource(*car))
            wheels_.push_back(joint.name);
    }
}

std::vector<Action> ScenePlayer::moveAt(double metresPerSecond) {
    if (!moves() || (std::abs(metresPerSecond - speedMetresPerSecond_) < minSpeedChange &&
                     (metresPerSecond != 0.0 || speedMetresPerSecond_ == 0.0)))
        return {};
    speedMetresPerSecond_ = metresPerSecond;
    return {VelocityAction{body_, {speedMetresPerSecond_, 0.0}}};
}

std::vector<Action> ScenePlayer::steer(int direction) {
    if (moves())
        return moveAt(direction * speedMetresPerSecond_ < 0.0 ? 0.0 : direction * maxMetresPerSecond);
    if (!drives()) return {};
    speedStep_ = direction == 0 || direction * speedStep_ < 0
                     ? 0
                     : std::clamp(speedStep_ + direction, -maxSteps, maxSteps);
    std::vector<Action> actions;
    // clockwise rotation drives to the right
    for (const std::string& wheel : wheels_)
        actions.push_back(MotorAction{wheel, -speedStep_ * stepRadiansPerSecond, {}});
    return actions;
}

std::vector<Action> ScenePlayer::moveTowards(double toMetres, double fromMetres) {
    return moveAt(
        std::clamp((toMetres - fromMetres) / reachSeconds, -maxMetresPerSecond, maxMetresPerSecond));
}

std::vector<Action> ScenePlayer::tilt(double angleRadians) {
    return moveAt(std::clamp(angleRadians / maxTiltRadians, -1.0, 1.0) * -maxMetresPerSecond);
}

std::vector<Action> ScenePlayer::keepInside(double fromMetres) {
    const bool isLeaving =
        (speedMetresPerSecond_ < 0.0 && fromMetres <= halfWidthMetres_) ||
        (speedMetresPerSecond_ > 0.0 && fromMetres >= fieldWidthMetres_ - halfWidthMetres_);
    return isLeaving ? moveAt(0.0) : std::vector<Action>{};
}

bool ScenePlayer::controls(const Action& action) const noexcept {
    const auto* velocity = std::get_if<VelocityAction>(&action);
    const auto* motor = std::get_if<MotorAction>(&action);
    return (velocity != nullptr && velocity->body == body_) ||
           (motor != nullptr && std::ranges::find(wheels_, motor->joint) != wheels_.end());
}

} // namespace physvib
