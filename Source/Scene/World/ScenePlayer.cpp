// SPDX-License-Identifier: MIT
// Converts keys, mouse places and tilt angles to velocities and motor speeds.
#include "Scene/World/ScenePlayer.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr double reachSeconds = 0.1;    // time to reach a mouse that is near
constexpr double steepestRadians = 0.5; // tilt at which the moved body has full speed
constexpr double leastChange = 0.05;    // m/s: a smaller change gives no input

bool isFelt(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
}

double reachOf(const FixtureDescription& fixture) {
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

} // namespace

ScenePlayer::ScenePlayer(const Scene& scene)
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
        const auto* car = findNamed(scene.bodies, joint.bodyA);
        if (wheel != nullptr && wheel->maxTorqueNewtonMetres > 0.0 && car != nullptr && isFelt(*car))
            wheels_.push_back(joint.name);
    }
}

std::vector<Action> ScenePlayer::go(double metresPerSecond) {
    if (!moves() ||
        (std::abs(metresPerSecond - goes_) < leastChange && (metresPerSecond != 0.0 || goes_ == 0.0)))
        return {};
    goes_ = metresPerSecond;
    return {VelocityAction{body_, {goes_, 0.0}}};
}

std::vector<Action> ScenePlayer::steer(int way) {
    if (moves()) return go(way * goes_ < 0.0 ? 0.0 : way * mostMetresPerSecond);
    if (!drives()) return {};
    step_ = way == 0 || way * step_ < 0 ? 0 : std::clamp(step_ + way, -mostSteps, mostSteps);
    std::vector<Action> all;
    // clockwise is to the right
    for (const std::string& wheel : wheels_)
        all.push_back(MotorAction{wheel, -step_ * stepRadiansPerSecond, {}});
    return all;
}

std::vector<Action> ScenePlayer::moveTowards(double toMetres, double fromMetres) {
    return go(std::clamp((toMetres - fromMetres) / reachSeconds, -mostMetresPerSecond, mostMetresPerSecond));
}

std::vector<Action> ScenePlayer::tilt(double angleRadians) {
    return go(std::clamp(angleRadians / steepestRadians, -1.0, 1.0) * -mostMetresPerSecond);
}

std::vector<Action> ScenePlayer::keepInside(double fromMetres) {
    const bool leaves = (goes_ < 0.0 && fromMetres <= halfWidthMetres_) ||
                        (goes_ > 0.0 && fromMetres >= fieldWidthMetres_ - halfWidthMetres_);
    return leaves ? go(0.0) : std::vector<Action>{};
}

bool ScenePlayer::isPlayedBy(const Action& action) const noexcept {
    const auto* velocity = std::get_if<VelocityAction>(&action);
    const auto* motor = std::get_if<MotorAction>(&action);
    return (velocity != nullptr && velocity->body == body_) ||
           (motor != nullptr && std::ranges::find(wheels_, motor->joint) != wheels_.end());
}

} // namespace physvib
