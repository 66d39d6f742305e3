// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's world: its speed (RealTimeMonitor), input and undoable edits (MixerWorld, MixerHistory), the
// recorded script (MixerScript), and the comparison of two mixes (MixerCompare).
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include "Scene/Drawing/RecordedInputs.h"
#include "Scene/Drawing/SceneDrawing.h"
#include <algorithm>
#include <cstdint>
#include <functional>
#include <juce_data_structures/juce_data_structures.h>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

class MixerModel;

/// Measures whether the simulation keeps up with real time. To be polled a few times a second; one thread.
class RealTimeMonitor {
public:
    static constexpr std::int64_t intervalNs = 500'000'000;
    static constexpr double minShare = 0.9; ///< of real time; below it the world is too slow
    static constexpr int minBodies = 300;   ///< a smaller world is taken to be delayed by other load

    /// Share of real time at which the world ran since the last result, twice a second; nullopt in between.
    /// Arguments: session time, and the time by which the world is behind it (skipped after stalls, or not
    /// simulated yet). If session time decreases, a new session has begun.
    std::optional<double> poll(std::int64_t sessionNs, std::int64_t behindNs) noexcept {
        if (sessionNs < sessionNs_) sessionNs_ = sessionNs, behindNs_ = behindNs;
        const std::int64_t passedNs = sessionNs - sessionNs_;
        if (passedNs < intervalNs) return std::nullopt;
        const double share = 1.0 - static_cast<double>(behindNs - behindNs_) / static_cast<double>(passedNs);
        sessionNs_ = sessionNs;
        behindNs_ = behindNs;
        return std::clamp(share, 0.0, 1.0);
    }

private:
    std::int64_t sessionNs_ = 0, behindNs_ = 0;
};

/// Between which a step of undo goes.
struct MixStates {
    Mix before, after;
};

/// The undo steps. They act on `model`, which need not be the one that made them: a model that is opened with
/// another output takes them over. Message thread.
struct MixerHistory {
    MixerModel* model = nullptr;
    /// Pairs of a scene and the same scene after later drawing.
    std::vector<std::pair<std::shared_ptr<const Scene>, std::shared_ptr<const Scene>>> drawnScenes;
    std::set<MixStates*> mixEdits; ///< of the steps below
    juce::UndoManager undo{1000, 30};

    /// Begins a step of that name, unless it has begun and the edit continues it.
    void beginStep(const juce::String& name, bool continuesEdit) {
        if (!continuesEdit || undo.getNumActionsInCurrentTransaction() == 0 ||
            undo.getCurrentTransactionName() != name)
            undo.beginNewTransaction(name);
    }

    bool isSame(const std::shared_ptr<const Scene>& a, const std::shared_ptr<const Scene>& b) const {
        return newestScene(a) == newestScene(b);
    }

private:
    const Scene* newestScene(std::shared_ptr<const Scene> scene) const {
        for (const auto& [before, after] : drawnScenes) // in the order in which they were drawn
            if (before == scene) scene = after;
        return scene.get();
    }
};

/// Sends user input and edits to the session's world. Message thread.
class MixerWorld {
public:
    /// All references outlive it. `onInput` is called after each input to the world, with whether it changes
    /// the display.
    MixerWorld(Session& session, const Mix& mix, MixerHistory& history,
               std::function<void(bool changesDisplay)> onInput,
               std::function<void(const std::string&)> onError);

    /// The scene with the bodies spawned since its start, indexed as in events.
    const Scene& scene() const noexcept { return drawing_.sceneWithAllBodies(); }
    const SceneDrawing& drawing() const noexcept { return drawing_; } ///< bodies as drawn, at their start
    std::uint64_t editCount() const noexcept { return editCount_; }   ///< increments when scene() changes
    std::string apply(const Action& action);                          ///< empty, or an error

    /// Undoable edit: adds, removes or changes a body, joins two bodies, or changes a sound. `continuesEdit`
    /// as for MixerModel::edit. Empty, or an error. A body without a name gets one.
    std::string edit(const juce::String& name, const Action& action, bool continuesEdit = false) {
        return edit(name, std::vector{action}, continuesEdit);
    }
    std::string edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit = false);

    /// Looks up poses at the last simulated step by the name of a body; nullopt: it is not present.
    CurrentPose posesNow() const;

    /// A warning, once each time the world becomes too slow for real time; else empty. `poses` are the newest
    /// ones, of session time `posesNs`.
    juce::String overloadWarning(std::int64_t sessionNs, std::int64_t posesNs,
                                 const std::vector<BodyPose>& poses);

    /// Restarts the mixer's scene. If it is the same scene, measured, tuned and drawn values stay. Empty, or
    /// an error.
    std::string restartScene(bool isSameScene);

private:
    class Edit;
    void reportInput(bool changesDisplay);

    Session& session_;
    const Mix& mix_;
    MixerHistory& history_;
    std::function<void(bool changesDisplay)> onInput_;
    std::function<void(const std::string&)> onError_;
    SceneDrawing drawing_;
    std::string editError_; // why the last edit failed; empty: it did not
    std::uint64_t editCount_ = 0;
    RealTimeMonitor pace_;
    bool isOverloaded_ = false;
};

/// Records user input in the world as the scene's script, and trims it. Message thread.
class MixerScript {
public:
    /// `model` outlives it.
    explicit MixerScript(MixerModel& model)
        : model_{model} {}

    /// Restarts the world without the scripted user input, and records the user's input.
    void start();
    /// Makes the recorded input the scene's script, as an edit, and restarts the world with it.
    void stop();
    bool isRecording() const noexcept { return isRecording_; }
    double seconds() const noexcept { return seconds_; }        ///< recorded world time so far
    std::size_t inputs() const noexcept { return inputCount_; } ///< recorded so far

    /// To be called often. Ends a recording when the drawing changes, the world restarts, or the script is
    /// full.
    void poll();

    /// The recording that the scene's current script is a part of; null if the scene has another script or
    /// none.
    const RecordedInputs* recording() const;
    ScriptTrim trim() const; ///< of recording()
    /// Selects another part of recording() as an edit, and restarts the world. `continuesEdit` as for
    /// MixerModel::edit.
    void setTrim(const ScriptTrim& trim, bool continuesEdit = false);

private:
    void apply(const ScriptTrim& trim, bool continuesEdit);

    MixerModel& model_;
    bool isRecording_ = false;
    double seconds_ = 0.0;
    std::size_t inputCount_ = 0, runIndex_ = 0;
    std::uint64_t worldEditCount_ = 0;
    std::shared_ptr<const Scene> recordedScene_;
    RecordedInputs recording_;
    std::vector<std::pair<std::weak_ptr<const Scene>, ScriptTrim>> sceneTrims_; // for undo
};

/// The energy of these events in a mix, in g^2: the sum of their squared levels at all actuators, after
/// strips and master. Any thread.
double contactEnergyG2(const Mix& mix, std::span<const CollisionEvent> events);

/// Compares two states of panning law, layout and mix, A and B, at matched levels. One of them plays; a key
/// switches to the other. Message thread.
class MixerCompare {
public:
    explicit MixerCompare(MixerModel& model)
        : model_{model} {}

    /// Plays the other state. The first call makes B, a copy of A, and plays it. The master lowers the louder
    /// state until both have the same energy at the contacts played last; it raises neither.
    void toggle();
    /// Keeps the state that plays, and discards the other.
    void end();
    /// Whether there are two states; false after the switch between them was undone.
    bool isComparing() const;
    char activeState() const noexcept { return isBActive_ ? 'B' : 'A'; }
    double loweredDb() const noexcept { return loweredDb_; } ///< by how much the state that plays is lowered

private:
    Mix userMix() const;

    MixerModel& model_;
    std::optional<Mix> otherMix_; // as set by the user
    bool isBActive_ = false;
    double loweredDb_ = 0.0, appliedLevelDb_ = 0.0; // master level set by toggle()
};

} // namespace physvib
