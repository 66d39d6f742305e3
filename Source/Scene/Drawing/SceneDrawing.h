// SPDX-License-Identifier: MIT
// The scene in an editor and the undo of its edits, independent of any window.
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

/// A body's present pose; nullopt: as drawn.
using PoseNow = std::function<std::optional<BodyPose>(const std::string& body)>;

/// The pose within the limits of a scene, with whole turns removed if necessary; nullopt: it is too far away.
std::optional<BodyPose> drawable(BodyPose pose);

/// One thread at a time.
class SceneDrawing {
public:
    /// A valid scene without inputs.
    explicit SceneDrawing(Scene scene);

    /// The scene in its start state; without inputs.
    const Scene& drawn() const noexcept { return drawn_; }

    /// The scene with all bodies that have ever existed, numbered as in sceneCast() and in a session.
    const Scene& cast() const noexcept { return cast_; }

    /// The error of these consecutive actions; empty: a session would accept them.
    std::string check(const std::vector<Action>& actions) const;

    /// Applies consecutive actions that a session has accepted.
    void take(std::span<const Action> actions);
    void take(const Action& action) { take({&action, 1}); }

    /// The actions that undo `action`. A removed body returns to its present place.
    std::vector<Action> undoOf(const Action& action, const PoseNow& now) const;

    const BodyDescription* find(std::string_view body) const noexcept; ///< in drawn(); nullptr: none
    /// "ball 1", "ball 2"...: the first name that was never used.
    std::string freeName(const std::string& stem) const { return freeNames(stem, 1).front(); }
    /// The first so many of them.
    std::vector<std::string> freeNames(const std::string& stem, std::size_t count) const;

private:
    Scene drawn_, cast_;
};

/// An edit of several actions that is done and undone as a whole.
class SceneEdit {
public:
    explicit SceneEdit(std::vector<Action> actions)
        : forth_{std::move(actions)} {}

    /// Calls `act` with all actions, some at a time, after recording their inverses.
    void run(bool isForth, const SceneDrawing& drawing, const PoseNow& now,
             const std::function<void(std::span<const Action>)>& act);

    const std::vector<Action>& forth() const noexcept { return forth_; }
    /// Merges `next` into this edit: undo reverses both.
    SceneEdit followedBy(const SceneEdit& next) const;

private:
    std::vector<Action> forth_, back_;
};

} // namespace physvib
