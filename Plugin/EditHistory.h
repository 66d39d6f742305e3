// SPDX-License-Identifier: GPL-3.0-or-later
// Undo and redo of what a person changed, and a second state to compare with.
#pragma once
#include "Live/Documents/PluginState.h"
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

namespace physvib {

/// One thread at a time. States hold whole scenes, so only the newest steps are kept.
class EditHistory {
public:
    static constexpr std::size_t most = 30;
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds oneStep{500}; ///< edits that follow sooner are one: a drag

    /// What was there before an edit.
    void add(PluginState before, Clock::time_point now = Clock::now()) {
        redo_.clear();
        const bool isSameStep = !undo_.empty() && now - last_ < oneStep;
        last_ = now;
        if (isSameStep) return;
        undo_.push_back(std::move(before));
        if (undo_.size() > most) undo_.pop_front();
    }

    bool canUndo() const noexcept { return !undo_.empty(); }
    bool canRedo() const noexcept { return !redo_.empty(); }
    bool isAtB() const noexcept { return isAtB_; }

    /// The state one step back or forth from `now`; none: there is none.
    std::optional<PluginState> undo(PluginState now) { return move(undo_, redo_, std::move(now)); }
    std::optional<PluginState> redo(PluginState now) { return move(redo_, undo_, std::move(now)); }

    /// The other one of A and B; at first both are the same.
    PluginState exchange(PluginState now) {
        isAtB_ = !isAtB_;
        return std::exchange(other_, now).value_or(now);
    }

private:
    using States = std::deque<PluginState>;
    std::optional<PluginState> move(States& from, States& to, PluginState now) {
        if (from.empty()) return {};
        last_ = {};
        to.push_back(std::move(now));
        auto state = std::move(from.back());
        from.pop_back();
        return state;
    }
    States undo_, redo_;
    std::optional<PluginState> other_;
    bool isAtB_ = false;
    Clock::time_point last_{};
};

} // namespace physvib
