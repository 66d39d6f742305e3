// SPDX-License-Identifier: MIT
// The scene in an editor and its edits with their undo, independent of any window.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/SceneWorld.h"
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Returns the present pose of the body of that name; nullopt: as drawn.
using CurrentPose = std::function<std::optional<BodyPose>(const std::string& body)>;

/// The pose with whole turns removed if its angle exceeds a scene's limit; nullopt: its place is outside the
/// limits.
std::optional<BodyPose> poseWithinLimits(BodyPose pose);

/// A scene that an editor changes: its start state, and all bodies it ever had. One thread at a time.
class SceneDrawing {
public:
    /// `scene` must be valid and without inputs.
    explicit SceneDrawing(Scene scene);

    /// The scene in its start state; without inputs.
    const Scene& drawn() const noexcept { return drawn_; }

    /// The scene with all bodies that have ever existed, numbered as in allBodies() and in a session.
    const Scene& sceneWithAllBodies() const noexcept { return sceneWithAllBodies_; }

    /// Checks consecutive actions: empty if a session would accept them, else the error.
    std::string check(const std::vector<Action>& actions) const;

    /// Applies consecutive actions that a session has accepted.
    void apply(std::span<const Action> actions);
    void apply(const Action& action) { apply({&action, 1}); }

    /// The actions that undo `action`. A removed body returns to its present place.
    std::vector<Action> undoActions(const Action& action, const CurrentPose& findPose) const;

    const BodyDescription* find(std::string_view body) const noexcept; ///< in drawn(); nullptr: none
    /// "ball 1", "ball 2"...: the first name that was never used.
    std::string unusedName(const std::string& stem) const { return unusedNames(stem, 1).front(); }
    /// The first `count` names with this stem that were never used.
    std::vector<std::string> unusedNames(const std::string& stem, std::size_t count) const;

private:
    Scene drawn_, sceneWithAllBodies_;
};

/// An edit of several actions that is done and undone as a whole.
class SceneEdit {
public:
    explicit SceneEdit(std::vector<Action> actions)
        : actions_{std::move(actions)} {}

    /// Does (isForward) or undoes the edit: calls `execute` with groups of independent actions in order,
    /// after computing their inverses from `drawing`, which `execute` must update.
    void perform(bool isForward, const SceneDrawing& drawing, const CurrentPose& findPose,
                 const std::function<void(std::span<const Action>)>& execute);

    const std::vector<Action>& actions() const noexcept { return actions_; }
    /// The edit that does what `next` does, and whose undo reverses both.
    SceneEdit mergedWith(const SceneEdit& next) const;

private:
    std::vector<Action> actions_, inverses_;
};

} // namespace physvib
