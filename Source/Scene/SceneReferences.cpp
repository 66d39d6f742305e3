// SPDX-License-Identifier: MIT
// Checks that names of bodies and joints in a scene are unique and exist.
#include "Scene/SceneReferences.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneRanges.h"
#include "Scene/World/SceneCast.h"
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>

namespace physvib {

namespace {

using detail::itemPath;

std::string missing(const std::string& path, const char* what, const std::string& name) {
    return path + ": expected the name of a " + what + ", found \"" + name + "\"";
}

class References {
public:
    explicit References(const Scene& scene)
        : scene_(scene)
        , cast_(scriptedCast(scene)) {
        for (const JointDescription& joint : scene.joints) joints_.emplace(joint.name, &joint);
        for (const LiveInput& input : scene.inputs)
            if (const auto* join = std::get_if<JoinAction>(&input.action))
                joints_.emplace(join->joint.name, &join->joint);
    }

    std::string check() {
        std::string fault = nameBodies();
        if (fault.empty()) fault = countJoints();
        for (std::size_t i = 0; i < scene_.joints.size() && fault.empty(); ++i)
            fault = checkJoint(scene_.joints[i], itemPath("joints", i));
        for (std::size_t i = 0; i < scene_.script.size() && fault.empty(); ++i)
            fault = checkInput(scene_.script[i], itemPath("script", i));
        for (std::size_t i = 0; i < scene_.inputs.size() && fault.empty(); ++i)
            fault = checkLive(i, itemPath("inputs", i));
        return fault;
    }

private:
    // The name of a spawned and removed body may be used again.
    std::string nameBodies() {
        const auto twice = [](const std::string& name) {
            return "bodies: expected names of their own, found \"" + name + "\" twice";
        };
        for (const BodyDescription& body : cast_)
            if (!bodies_.emplace(body.name, &body).second) return twice(body.name);
        std::set<std::string_view> there, gone;
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* removal = std::get_if<RemoveAction>(&input.action);
                removal != nullptr && there.erase(removal->body) > 0)
                gone.insert(removal->body);
            const BodyDescription* put = bodyPutBy(input.action);
            if (put == nullptr) continue;
            const BodyDescription& body = *put;
            const bool isChange = std::holds_alternative<ChangeAction>(input.action);
            if (isChange && !bodies_.contains(body.name)) return missing("body.name", "body", body.name);
            const auto [known, isNew] = bodies_.emplace(body.name, &body);
            if (gone.erase(body.name) == 0 && !isNew && !isChange) return twice(body.name);
            if (body.fixtures.size() > known->second->fixtures.size()) known->second = &body;
            there.insert(body.name);
        }
        return {};
    }

    // Like bodies: the name of a removed joint may be used again.
    std::string countJoints() const {
        std::set<std::string_view> there;
        for (const JointDescription& joint : scene_.joints) there.insert(joint.name);
        for (const LiveInput& input : scene_.inputs) {
            if (const auto* unjoin = std::get_if<UnjoinAction>(&input.action)) there.erase(unjoin->joint);
            const auto* join = std::get_if<JoinAction>(&input.action);
            if (join != nullptr && !there.insert(join->joint.name).second)
                return "joints: expected names of their own, found \"" + join->joint.name + "\" twice";
            if (there.size() > sceneLimits::maxJoints)
                return "joints: expected at most " + std::to_string(sceneLimits::maxJoints);
        }
        return {};
    }

    std::string checkJoint(const JointDescription& joint, const std::string& path) const {
        if (!bodies_.contains(joint.bodyA)) return missing(path + ".body_a", "body", joint.bodyA);
        if (!bodies_.contains(joint.bodyB)) return missing(path + ".body_b", "body", joint.bodyB);
        if (joint.bodyA == joint.bodyB) return path + ".body_b: expected another body than body_a";
        const auto isNoAxis = [](const auto* slides) {
            return slides != nullptr && std::hypot(slides->axis.x, slides->axis.y) < 1.0e-3;
        };
        if (isNoAxis(std::get_if<WheelJoint>(&joint.joint)) ||
            isNoAxis(std::get_if<SliderJoint>(&joint.joint)))
            return path + ".axis: expected a direction, found none";
        return {};
    }

    std::string checkInput(const ScriptInput& input, const std::string& path) const {
        const double last = input.timeSeconds + (input.times - 1) * input.everySeconds;
        const double period = scene_.scriptPeriodSeconds;
        const double end = period > 0.0 ? period : sceneLimits::maxScriptSeconds;
        if (!(last <= end)) return detail::outside(path + ".time_s", 0.0, end, last);
        if (std::holds_alternative<ChangeAction>(input.action) ||
            std::holds_alternative<JoinAction>(input.action) ||
            std::holds_alternative<UnjoinAction>(input.action))
            return path + ".input: expected another: change, join and unjoin are live inputs only";
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkLive(std::size_t index, const std::string& path) const {
        const LiveInput& input = scene_.inputs[index];
        if (index > 0 && input.timeSeconds < scene_.inputs[index - 1].timeSeconds)
            return path + ".time_s: expected a time that is not before that of the input above";
        return std::visit([&](const auto& action) { return checkAction(action, path); }, input.action);
    }

    std::string checkAction(const MotorAction& action, const std::string& path) const {
        const auto joint = joints_.find(action.joint);
        const bool hasMotor =
            joint != joints_.end() && (std::holds_alternative<RevoluteJoint>(joint->second->joint) ||
                                       std::holds_alternative<WheelJoint>(joint->second->joint));
        return hasMotor ? std::string() : missing(path + ".joint", "revolute or wheel joint", action.joint);
    }
    std::string checkAction(const JoinAction& action, const std::string& path) const {
        return checkJoint(action.joint, path + ".joint");
    }
    std::string checkAction(const UnjoinAction& action, const std::string& path) const {
        return joints_.contains(action.joint) ? std::string()
                                              : missing(path + ".joint", "joint", action.joint);
    }
    template <class One>
    std::string checkAction(const One& action, const std::string& path) const {
        if constexpr (requires { bodies_.find(action.body); }) { // action.body is a name; other actions have
                                                                 // none
            const auto body = bodies_.find(action.body);
            if (body == bodies_.end()) return missing(path + ".body", "body", action.body);
            if constexpr (requires { action.fixture; }) {
                const auto count = static_cast<int>(body->second->fixtures.size());
                if (action.fixture >= count)
                    return detail::outside(path + ".fixture", 0, count - 1, action.fixture);
            }
        }
        return {};
    }

    const Scene& scene_;
    std::vector<BodyDescription> cast_;
    std::map<std::string_view, const BodyDescription*> bodies_;
    std::map<std::string_view, const JointDescription*> joints_;
};

} // namespace

std::string checkReferences(const Scene& scene) { return References(scene).check(); }

} // namespace physvib
