// SPDX-License-Identifier: GPL-3.0-or-later
// Records user input in the world as the scene's script, and trims it.
#pragma once
#include "Scene/Drawing/HandScript.h"
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace physvib {

class Desk;

/// Message thread only.
class DeskScript {
public:
    /// `desk` outlives it.
    explicit DeskScript(Desk& desk)
        : desk_{desk} {}

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
    /// Selects another part of hands() as an edit, and restarts the world. `goesOn` as for Desk::edit.
    void setTrim(const ScriptTrim& trim, bool goesOn = false);

private:
    void apply(const ScriptTrim& trim, bool goesOn);

    Desk& desk_;
    bool isRecording_ = false;
    double seconds_ = 0.0;
    std::size_t inputs_ = 0, takesBefore_ = 0;
    std::uint64_t worldEdits_ = 0;
    std::shared_ptr<const Scene> recordedIn_;
    HandScript hands_;
    std::vector<std::pair<std::weak_ptr<const Scene>, ScriptTrim>> applied_; // so that undo restores them
};

} // namespace physvib
