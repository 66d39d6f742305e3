// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's physics world: user input and undoable edits.
#pragma once
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include "Mixer/Desk/PaceWatch.h"
#include "Scene/Drawing/SceneDrawing.h"
#include <cstdint>
#include <functional>
#include <juce_data_structures/juce_data_structures.h>
#include <string>
#include <vector>

namespace physvib {

/// Message thread only.
class DeskWorld {
public:
    /// All references outlive it. `onInput` is called after each input to the world, with whether it changes
    /// the display.
    DeskWorld(Session& session, const Mix& mix, juce::UndoManager& undo,
              std::function<void(bool isShown)> onInput);

    /// The scene with the bodies spawned since its start, indexed as in events.
    const Scene& scene() const noexcept { return drawing_.cast(); }
    const SceneDrawing& drawing() const noexcept { return drawing_; } ///< bodies as drawn, at their start
    std::uint64_t edits() const noexcept { return edits_; }           ///< increments when scene() changes
    std::string act(const Action& action);                            ///< empty, or an error

    /// Undoable edit: adds, removes or changes a body, joins two bodies, or changes a sound. `goesOn` as for
    /// Desk::edit. Empty, or an error. A body without a name gets one.
    std::string edit(const juce::String& name, const Action& action, bool goesOn = false) {
        return edit(name, std::vector{action}, goesOn);
    }
    std::string edit(const juce::String& name, std::vector<Action> actions, bool goesOn = false);

    /// Pose of a body at the last simulated step; nullopt if it is not present.
    std::optional<BodyPose> poseNow(const std::string& body) const;

    /// Poses of all bodies at one moment.
    PoseNow posesNow() const;

    /// A warning, once each time the world becomes too slow for real time; else empty. `poses` are the last
    /// ones, of session time `posesNs`.
    juce::String tooMuch(std::int64_t sessionNs, std::int64_t posesNs, const std::vector<BodyPose>& poses);

    /// Restarts the mixer's scene. If it is the same scene, measured, tuned and drawn values stay. Empty, or
    /// an error.
    std::string begin(bool isSameScene);

private:
    class Edit;

    Session& session_;
    const Mix& mix_;
    juce::UndoManager& undo_;
    std::function<void(bool isShown)> onInput_;
    SceneDrawing drawing_;
    std::string refused_; // why the last edit was refused
    std::uint64_t edits_ = 0;
    PaceWatch pace_;
    bool isTooMuch_ = false;
};

} // namespace physvib
