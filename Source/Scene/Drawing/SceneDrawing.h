// SPDX-License-Identifier: MIT
// A scene while it is edited: what stands there, and what undoes each edit. No window is needed for it.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/SceneWorld.h"
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Where a body is now; none: as drawn.
using PoseNow = std::function<std::optional<BodyPose>(const std::string& body)>;

/// One thread at a time.
class SceneDrawing {
public:
    /// A valid scene without inputs.
    explicit SceneDrawing(Scene scene);

    /// What stands there, as it starts; without inputs.
    const Scene& drawn() const noexcept { return drawn_; }

    /// The scene with all bodies that there have been, under the numbers of sceneCast(); as a session numbers
    /// them.
    const Scene& cast() const noexcept { return cast_; }

    /// What is wrong with these actions, one after the other; empty: a session would take them.
    std::string check(const std::vector<Action>& actions) const;

    /// Shows what a session has taken. False: it does not show.
    bool take(const Action& action);

    /// What undoes it, if it acts next. A body that was removed comes back where it is now.
    std::vector<Action> undoOf(const Action& action, const PoseNow& now) const;

    const BodyDescription* find(std::string_view body) const noexcept; ///< of drawn(); nullptr: none
    /// "ball 1", "ball 2"...: the first that nobody has or had.
    std::string freeName(const std::string& stem) const;

private:
    Scene drawn_, cast_;
};

/// One edit of several actions that is done and undone as a whole.
class SceneEdit {
public:
    explicit SceneEdit(std::vector<Action> actions)
        : forth_{std::move(actions)} {}

    /// Calls `act` with each action, after what undoes it was noted; empty, or what is wrong with the first
    /// that was refused: those before it are undone by the next turn.
    std::string run(bool isForth, const SceneDrawing& drawing, const PoseNow& now,
                    const std::function<std::string(const Action&)>& act);

    const std::vector<Action>& forth() const noexcept { return forth_; }
    /// `next` went on with this edit: undone, both are.
    SceneEdit followedBy(const SceneEdit& next) const;

private:
    std::vector<Action> forth_, back_;
};

} // namespace physvib
