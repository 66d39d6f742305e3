// SPDX-License-Identifier: GPL-3.0-or-later
// The world of the mixer: input and undoable edits, the recording of a script, two mixes compared in it.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include "Scene/Drawing/HandScript.h"
#include "Scene/Drawing/SceneDrawing.h"
#include <algorithm>
#include <cstdint>
#include <functional>
#include <juce_data_structures/juce_data_structures.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

class MixerModel;

/// Whether the simulation keeps up with real time. To be polled a few times a second; one thread at a time.
class PaceWatch {
public:
    static constexpr std::int64_t everyNs = 500'000'000;
    static constexpr double leastShare = 0.9; ///< below this share the world is too slow,
    static constexpr int minBodies = 300; ///< and has so many bodies; a smaller one is delayed by other load

    /// Share of real time at which the world ran since the last result, twice a second; nullopt in between.
    /// Arguments: session time, and the time by which the world is behind it (skipped after stalls, or not
    /// simulated yet). If session time decreases, a new session has begun.
    std::optional<double> look(std::int64_t sessionNs, std::int64_t behindNs) noexcept {
        if (sessionNs < sessionNs_) sessionNs_ = sessionNs, behindNs_ = behindNs;
        const std::int64_t passed = sessionNs - sessionNs_;
        if (passed < everyNs) return std::nullopt;
        const double share = 1.0 - static_cast<double>(behindNs - behindNs_) / static_cast<double>(passed);
        sessionNs_ = sessionNs;
        behindNs_ = behindNs;
        return std::clamp(share, 0.0, 1.0);
    }

private:
    std::int64_t sessionNs_ = 0, behindNs_ = 0;
};

/// The undo steps. They act on `model`, which may be another than the one that made them: a model with
/// another output takes them over. Message thread.
struct MixerHistory {
    MixerModel* model = nullptr;
    /// A scene, and the same scene as drawn later.
    std::vector<std::pair<std::shared_ptr<const Scene>, std::shared_ptr<const Scene>>> drawn;
    juce::UndoManager undo{1000, 30};

    bool isSame(const std::shared_ptr<const Scene>& a, const std::shared_ptr<const Scene>& b) const {
        return latest(a) == latest(b);
    }

private:
    const Scene* latest(std::shared_ptr<const Scene> scene) const {
        for (const auto& [before, after] : drawn) // in the order in which they were drawn
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
               std::function<void(bool isShown)> onInput, std::function<void(const std::string&)> onFault);

    /// The scene with the bodies spawned since its start, indexed as in events.
    const Scene& scene() const noexcept { return drawing_.cast(); }
    const SceneDrawing& drawing() const noexcept { return drawing_; } ///< bodies as drawn, at their start
    std::uint64_t edits() const noexcept { return edits_; }           ///< increments when scene() changes
    std::string act(const Action& action);                            ///< empty, or an error

    /// Undoable edit: adds, removes or changes a body, joins two bodies, or changes a sound. `continuesEdit`
    /// as for MixerModel::edit. Empty, or an error. A body without a name gets one.
    std::string edit(const juce::String& name, const Action& action, bool continuesEdit = false) {
        return edit(name, std::vector{action}, continuesEdit);
    }
    std::string edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit = false);

    /// Poses of all bodies at the last simulated step; nullopt of one that is not present.
    PoseNow posesNow() const;

    /// A warning, once each time the world becomes too slow for real time; else empty. `poses` are the last
    /// ones, of session time `posesNs`.
    juce::String tooMuch(std::int64_t sessionNs, std::int64_t posesNs, const std::vector<BodyPose>& poses);

    /// Restarts the mixer's scene. If it is the same scene, measured, tuned and drawn values stay. Empty, or
    /// an error.
    std::string begin(bool isSameScene);

private:
    class Edit;
    void acted(bool isShown);

    Session& session_;
    const Mix& mix_;
    MixerHistory& history_;
    std::function<void(bool isShown)> onInput_;
    std::function<void(const std::string&)> onFault_;
    SceneDrawing drawing_;
    std::string refused_; // why the last edit was refused
    std::uint64_t edits_ = 0;
    PaceWatch pace_;
    bool isTooMuch_ = false;
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
    double seconds() const noexcept { return seconds_; }    ///< recorded world time so far
    std::size_t inputs() const noexcept { return inputs_; } ///< recorded so far

    /// To be called often. Ends a recording when the drawing changes, the world restarts, or the script is
    /// full.
    void look();

    /// The recording that the scene's current script is a part of; null if the scene has another script or
    /// none.
    const HandScript* hands() const;
    ScriptTrim trim() const; ///< of hands()
    /// Selects another part of hands() as an edit, and restarts the world. `continuesEdit` as for
    /// MixerModel::edit.
    void setTrim(const ScriptTrim& trim, bool continuesEdit = false);

private:
    void apply(const ScriptTrim& trim, bool continuesEdit);

    MixerModel& model_;
    bool isRecording_ = false;
    double seconds_ = 0.0;
    std::size_t inputs_ = 0, runsBefore_ = 0;
    std::uint64_t worldEdits_ = 0;
    std::shared_ptr<const Scene> recordedIn_;
    HandScript hands_;
    std::vector<std::pair<std::weak_ptr<const Scene>, ScriptTrim>> applied_; // so that undo restores them
};

/// The level, in g^2, that a mixer state gives these events: the sum over its actuators, behind strips and
/// master. Any thread.
double energyOf(const Mix& mix, std::span<const CollisionEvent> events);

/// Two states of panning law, layout and mix, A and B, of which one plays; one key changes between them, at
/// matched levels. Message thread.
class MixerCompare {
public:
    explicit MixerCompare(MixerModel& model)
        : model_{model} {}

    /// Plays the other state. The first call makes B, a copy of A, and plays it. The louder of both is turned
    /// down to the other by the master, at the contacts played last; nothing is turned up.
    void toggle();
    /// Keeps what plays, and forgets the other.
    void end();
    /// False again after a change between them was undone.
    bool isOn() const;
    char shown() const noexcept { return isB_ ? 'B' : 'A'; }
    double loweredDb() const noexcept { return loweredDb_; } ///< of what plays, so that the levels match

private:
    Mix own() const;

    MixerModel& model_;
    std::optional<Mix> other_; // as set by the user
    bool isB_ = false;
    double loweredDb_ = 0.0, setDb_ = 0.0; // master level that was set with it
};

} // namespace physvib
