// SPDX-License-Identifier: GPL-3.0-or-later
// The world of the desk: what is done to it, and the way back of every edit.
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

/// M only.
class DeskWorld {
public:
    /// All outlive it. `onInput` is called when something was done to the world, and told whether it shows.
    DeskWorld(Session& session, const Mix& mix, juce::UndoManager& undo,
              std::function<void(bool isShown)> onInput);

    /// with what was spawned since it began, under the numbers of events
    const Scene& scene() const noexcept { return drawing_.cast(); }
    const SceneDrawing& drawing() const noexcept { return drawing_; } ///< what stands there, at its start
    std::uint64_t edits() const noexcept { return edits_; }           ///< grows when scene() changes
    std::string act(const Action& action);                            ///< empty, or what is wrong with it

    /// An edit that can be undone: adds a body, takes one away, changes it, joins two, changes a
    /// sound. `goesOn` as of Desk::edit. Empty, or what is wrong with it. A body without a name is given one.
    std::string edit(const juce::String& name, const Action& action, bool goesOn = false) {
        return edit(name, std::vector{action}, goesOn);
    }
    std::string edit(const juce::String& name, std::vector<Action> actions, bool goesOn = false);

    /// Where a body is, as far as the world has been stepped; none: not there, or not yet.
    std::optional<BodyPose> poseNow(const std::string& body) const;

    /// The same of all bodies, at one moment.
    PoseNow posesNow() const;

    /// One line when the world has become too much for real time, once for each time that it does; else
    /// empty. `poses` are the last ones, of session time `posesNs`.
    juce::String tooMuch(std::int64_t sessionNs, std::int64_t posesNs, const std::vector<BodyPose>& poses);

    /// The mix's scene begins anew. What was measured, tuned or drawn stays, if it is the same scene. Empty,
    /// or what is wrong with it.
    std::string begin(bool isSameScene);

private:
    class Edit;

    Session& session_;
    const Mix& mix_;
    juce::UndoManager& undo_;
    std::function<void(bool isShown)> onInput_;
    SceneDrawing drawing_;
    std::uint64_t edits_ = 0;
    PaceWatch pace_;
    bool isTooMuch_ = false;
};

} // namespace physvib
