// SPDX-License-Identifier: GPL-3.0-or-later
// Undo and redo of what a person changed, and a second state to compare with.
#pragma once
#include "Live/Documents/PluginState.h"
#include "Parameters.h"
#include <bitset>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

namespace physvib {

/// Which parameters a step is about. Others keep the value that they have when it is undone: automation, a
/// controller or the host may have moved them since.
using TouchedParameters = std::bitset<parameterCount>;

/// One thread at a time. A and B have steps of their own. States hold whole scenes, so only the newest steps
/// are kept.
class EditHistory {
public:
    static constexpr std::size_t most = 30;
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds oneStep{500}; ///< edits that follow sooner are one: a drag

    struct Step {
        PluginState state;
        TouchedParameters touched{};
    };
    enum class Edit {
        part, ///< of what may come many times in a row
        whole ///< a step of its own
    };

    /// What was there before an edit.
    void add(PluginState before, TouchedParameters touched, Edit edit = Edit::part,
             Clock::time_point now = Clock::now()) {
        here_.redo.clear();
        touched_ |= touched;
        const bool isSameStep = edit == Edit::part && !here_.undo.empty() && now - last_ < oneStep;
        last_ = edit == Edit::part ? now : Clock::time_point{};
        if (isSameStep) {
            here_.undo.back().touched |= touched;
            return;
        }
        here_.undo.push_back({std::move(before), touched});
        if (here_.undo.size() > most) here_.undo.erase(here_.undo.begin());
    }

    bool canUndo() const noexcept { return !here_.undo.empty(); }
    bool canRedo() const noexcept { return !here_.redo.empty(); }
    bool isAtB() const noexcept { return isAtB_; }

    /// The state one step back or forth from `now`; none: there is none.
    std::optional<Step> undo(PluginState now) { return move(here_.undo, here_.redo, std::move(now)); }
    std::optional<Step> redo(PluginState now) { return move(here_.redo, here_.undo, std::move(now)); }

    /// The other one of A and B; at first both are the same. They differ in the parameters that any step was
    /// about.
    Step exchange(PluginState now) {
        isAtB_ = !isAtB_;
        last_ = {};
        std::swap(here_, there_);
        return {std::exchange(other_, now).value_or(now), touched_};
    }

private:
    using Steps = std::vector<Step>;
    std::optional<Step> move(Steps& from, Steps& to, PluginState now) {
        if (from.empty()) return {};
        last_ = {};
        Step step = std::move(from.back());
        from.pop_back();
        to.push_back({std::move(now), step.touched});
        return step;
    }
    struct Side {
        Steps undo, redo;
    } here_, there_;
    TouchedParameters touched_{};
    std::optional<PluginState> other_;
    bool isAtB_ = false;
    Clock::time_point last_{};
};

} // namespace physvib
