// SPDX-License-Identifier: MIT
// Editor operations on joints: creates them, changes motors and springs, and adjusts joints to moved bodies.
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace physvib {
namespace {

using detail::distance;
using detail::Motion;
using detail::placeOf;

/// True if the places differ by no more than a seed's jitter.
bool isSamePlace(const BodyPlace& a, const BodyPlace& b) {
    constexpr double tolerance = 2.0e-3;
    return distance(a.metres, b.metres) < tolerance && std::abs(a.angleRadians - b.angleRadians) < tolerance;
}

Action atRest(BodyDescription body) {
    body.velocityMetresPerSecond = {};
    body.spinRadiansPerSecond = 0.0;
    return ChangeAction{std::move(body), false};
}

} // namespace

Result<std::vector<Action>> joinActions(const SceneDrawing& drawing, JointKind kind,
                                        const std::pair<std::string, BodyPlace>& a,
                                        const std::pair<std::string, BodyPlace>& b, const Vector& from,
                                        const Vector& to) {
    constexpr double motorRadiansPerSecond = 3.0, motorGravities = 3.0;
    std::vector<Action> actions;
    double maxMassTimesLength = 0.0;
    for (const auto& [name, place] : {a, b}) {
        const BodyDescription* body = drawing.find(name);
        if (body == nullptr) return Failure{"a joint: expected two bodies"};
        if (body->type == BodyType::dynamicBody)
            maxMassTimesLength = std::max(maxMassTimesLength, massKg(*body, drawing.drawn()) *
                                                                  lengthMetres(body->fixtures[0].shape));
        if (isSamePlace(place, placeOf(*body))) continue;
        BodyDescription placedBody = *body;
        placedBody.positionMetres = place.metres;
        placedBody.angleRadians = place.angleRadians;
        actions.push_back(atRest(std::move(placedBody)));
    }
    if (a.first == b.first) return Failure{"a joint: expected two bodies, found " + a.first + " twice"};
    if (maxMassTimesLength <= 0.0) return Failure{"a joint: expected a body that moves"};
    const double length = distance(from, to);
    if (kind != JointKind::pin && kind != JointKind::motor && length < sceneLimits::minSizeMetres)
        return Failure{"a rope, spring or slider: expected two places"};
    JointDescription joint{drawing.unusedName("joint"), a.first, b.first, {}};
    joint.collide = kind == JointKind::rope || kind == JointKind::spring;
    if (kind == JointKind::rope) {
        joint.joint = DistanceJoint{from, to, 0.0, 0.0, true};
    } else if (kind == JointKind::spring) {
        constexpr double hz = 2.0, dampingRatio = 0.1; // about five swings until it rests
        joint.joint = DistanceJoint{from, to, hz, dampingRatio, false};
    } else if (kind == JointKind::slider) {
        const Vector axis{(to.x - from.x) / length, (to.y - from.y) / length};
        joint.joint = SliderJoint{from, axis, Interval{0.0, length}};
    } else {
        RevoluteJoint pin;
        pin.anchorMetres = from;
        const Vector& g = drawing.drawn().gravityMetresPerSecond2;
        if (kind == JointKind::motor)
            pin.motorRadiansPerSecond = motorRadiansPerSecond,
            pin.maxTorqueNewtonMetres =
                std::min(sceneLimits::maxTorqueNewtonMetres,
                         motorGravities * std::max(1.0, portable::hypot(g.x, g.y)) * maxMassTimesLength);
        joint.joint = pin;
    }
    actions.push_back(JoinAction{std::move(joint)});
    return actions;
}

namespace {

/// Calls `use` with the joint if it is a hinge or wheel, which may have a motor; false for other joints.
bool withMotor(auto& joint, const auto& use) {
    return std::visit(
        [&](auto& kind) {
            constexpr bool turns = requires { kind.motorRadiansPerSecond; };
            if constexpr (turns) use(kind);
            return turns;
        },
        joint.joint);
}

/// The last joint of that kind that joins the body. Null: none.
const JointDescription* findLastJoint(const Scene& scene, const std::string& body, const auto& isKind) {
    const auto found =
        std::find_if(scene.joints.rbegin(), scene.joints.rend(), [&](const JointDescription& joint) {
            return (joint.bodyA == body || joint.bodyB == body) && isKind(joint);
        });
    return found == scene.joints.rend() ? nullptr : &*found;
}

} // namespace

const JointDescription* findMotor(const Scene& scene, const std::string& body) {
    return findLastJoint(scene, body, [](const auto& joint) { return withMotor(joint, [](const auto&) {}); });
}

MotorDrive driveOf(const JointDescription& motor) {
    MotorDrive drive;
    withMotor(motor, [&](const auto& kind) {
        drive = {kind.motorRadiansPerSecond, kind.maxTorqueNewtonMetres};
    });
    return drive;
}

Result<std::vector<Action>> motorActions(const SceneDrawing& drawing, const std::string& joint,
                                         const MotorDrive& drive, const CurrentPose& findPose) {
    const auto frameOf = [](const JointDescription& description) { // where it is, and how far it may go
        std::array<double, 3> frame{};
        withMotor(description, [&](const auto& kind) {
            frame = {kind.anchorMetres.x, kind.anchorMetres.y};
            if constexpr (requires { kind.restMetres; })
                frame[2] = kind.restMetres;
            else
                frame[2] = kind.limitsRadians.value_or(Interval{}).lower;
        });
        return frame;
    };
    Scene presentScene = sceneNow(drawing.drawn(), findPose);
    const auto* drawn = findNamed(drawing.drawn().joints, joint);
    auto* changed = findNamed(presentScene.joints, joint);
    if (!drawn || !withMotor(*changed, [&](auto& kind) {
            kind.motorRadiansPerSecond = drive.speedRadiansPerSecond;
            kind.maxTorqueNewtonMetres = drive.maxTorqueNewtonMetres;
        }))
        return Failure{"a motor: expected a pin or a wheel, found " + joint};
    std::vector<Action> actions{UnjoinAction{joint}};
    constexpr double tolerance = 1e-6;
    if (!std::ranges::equal(frameOf(*drawn), frameOf(*changed),
                            [](double a, double b) { return std::abs(a - b) <= tolerance; }))
        for (const BodyDescription& body : presentScene.bodies)
            if (body.type == BodyType::dynamicBody &&
                (body.name == changed->bodyA || body.name == changed->bodyB))
                actions.push_back(atRest(body));
    actions.push_back(JoinAction{std::move(*changed)});
    return actions;
}

double springHzOf(const JointDescription& spring) {
    const auto* kind = std::get_if<DistanceJoint>(&spring.joint);
    return kind == nullptr || kind->isSlack ? 0.0 : kind->springHz;
}

const JointDescription* findSpring(const Scene& scene, const std::string& body) {
    return findLastJoint(scene, body, [](const auto& joint) { return springHzOf(joint) > 0.0; });
}

Result<std::vector<Action>> springActions(const SceneDrawing& drawing, const std::string& joint,
                                          double springHz) {
    const auto* found = findNamed(drawing.drawn().joints, joint);
    if (found == nullptr || springHzOf(*found) <= 0.0)
        return Failure{"a spring: expected one, found " + joint};
    JointDescription changed = *found;
    std::get<DistanceJoint>(changed.joint).springHz = springHz;
    std::vector<Action> actions{UnjoinAction{joint}};
    for (const std::string& name : {changed.bodyA, changed.bodyB})
        if (const auto* body = drawing.find(name); body && body->type == BodyType::dynamicBody)
            actions.push_back(ChangeAction{*body, false});
    actions.push_back(JoinAction{std::move(changed)});
    return actions;
}

Scene sceneNow(const Scene& drawn, const CurrentPose& findPose) {
    Scene scene = drawn;
    const auto shift = [](std::optional<Interval>& limits, double by) {
        if (limits) limits = {limits->lower + by, limits->upper + by};
    };
    // a rigid joint rests as it is: what it differs by is where the seed put the bodies
    const auto yields = [](const auto& kind, double rest) { return kind.springHz > 0.0 || rest != 0.0; };
    std::map<std::string, Motion> motions;
    for (BodyDescription& body : scene.bodies) {
        const auto pose = findPose ? findPose(body.name) : std::nullopt;
        if (!pose) continue;
        const BodyPlace present{{pose->xMetres, pose->yMetres}, pose->angleRadians};
        motions.emplace(body.name, Motion{placeOf(body), present});
        body.positionMetres = present.metres;
        body.angleRadians = present.angleRadians;
    }
    for (JointDescription& joint : scene.joints) {
        const auto a = motions.find(joint.bodyA), b = motions.find(joint.bodyB);
        if (a == motions.end() || b == motions.end()) continue;
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.anchorAMetres; }) {
                    const double wasMetres = distance(kind.anchorAMetres, kind.anchorBMetres);
                    kind.anchorAMetres = a->second(kind.anchorAMetres);
                    kind.anchorBMetres = b->second(kind.anchorBMetres);
                    if (yields(kind, kind.restMetres) || kind.isSlack)
                        kind.restMetres += wasMetres - distance(kind.anchorAMetres, kind.anchorBMetres);
                } else {
                    const Vector onA = a->second(kind.anchorMetres), onB = b->second(kind.anchorMetres);
                    const double turnRadians = b->second.angleRadians() - a->second.angleRadians();
                    constexpr bool isWheel = requires { kind.suspensionHz; };
                    kind.anchorMetres = isWheel ? onB : onA; // else it would turn beside its middle
                    if constexpr (requires { kind.axis; }) {
                        kind.axis = a->second.rotate(kind.axis);
                        const double length = portable::hypot(kind.axis.x, kind.axis.y),
                                     slidMetres =
                                         ((onB.x - onA.x) * kind.axis.x + (onB.y - onA.y) * kind.axis.y) /
                                         length;
                        shift(kind.travelMetres, -slidMetres);
                        if constexpr (isWheel) kind.restMetres -= slidMetres;
                    }
                    if constexpr (requires { kind.restRadians; })
                        if (yields(kind, kind.restRadians)) // whole turns are none: poses lack them, too
                            kind.restRadians =
                                std::remainder(kind.restRadians - turnRadians, 2.0 * std::numbers::pi);
                    if constexpr (requires { kind.limitsRadians; }) shift(kind.limitsRadians, -turnRadians);
                }
            },
            joint.joint);
    }
    return scene;
}

} // namespace physvib
