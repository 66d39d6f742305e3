// SPDX-License-Identifier: GPL-3.0-or-later
// The world of the desk: what is done to it, and the way back of every edit.
#pragma once
#include "Scene/Sessions/Mix.h"
#include "Session/Session.h"
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
    DeskWorld(Session& session, const Mix& mix, juce::UndoManager& undo, std::function<void(bool isShown)> onInput);

    const Scene& scene() const noexcept { return scene_; } ///< with what was spawned since it began
    std::uint64_t edits() const noexcept { return edits_; } ///< grows when scene() changes
    std::string act(const Action& action); ///< empty, or what is wrong with it

    /// An edit that can be undone: adds a body, takes one away, makes it of another material, changes a
    /// sound. `goesOn` as of Desk::edit. Empty, or what is wrong with it.
    std::string edit(const juce::String& name, const Action& action, bool goesOn = false);

    /// The mix's scene begins anew. What was measured or tuned stays, if it is the same scene. Empty, or what is wrong with it.
    std::string begin(bool isSameScene);

private:
    class Edit;
    std::vector<Action> undoOf(const Action& action) const;
    Action renamed(const Action& action);
    bool show(const Action& action);

    Session& session_;
    const Mix& mix_;
    juce::UndoManager& undo_;
    std::function<void(bool isShown)> onInput_;
    Scene scene_;
    std::uint64_t edits_ = 0;
    int added_ = 0;
};

} // namespace physvib
