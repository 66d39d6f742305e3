// SPDX-License-Identifier: GPL-3.0-or-later
// Records what hands do in the world as the script of the scene, and trims it.
#pragma once
#include "Scene/Drawing/HandScript.h"
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace physvib {

class Desk;

/// M only.
class DeskScript {
public:
    /// `desk` outlives it.
    explicit DeskScript(Desk& desk)
        : desk_{desk} {}

    /// The world begins anew without what its script does of what hands do, and hands are recorded.
    void start();
    /// What hands did is the scene's script: an edit. The world begins anew with it.
    void stop();
    bool isRecording() const noexcept { return isRecording_; }
    double seconds() const noexcept { return seconds_; }    ///< recorded so far, of the world
    std::size_t inputs() const noexcept { return inputs_; } ///< recorded so far

    /// Often: ends a recording when the drawing is changed, the world begins anew, or the script is full.
    void look();

    /// The recording whose part is the scene's script now; nullptr: the scene has another script, or none.
    const HandScript* hands() const;
    ScriptTrim trim() const; ///< of hands()
    /// Another part of hands(): an edit. The world begins anew with it. `goesOn` as of Desk::edit.
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
    std::vector<std::pair<std::weak_ptr<const Scene>, ScriptTrim>> applied_; // undo brings them back
};

} // namespace physvib
