// SPDX-License-Identifier: GPL-3.0-or-later
// The line above the world: errors and news, one at a time, each with a button for what can be done about it.
#pragma once
#include <deque>
#include <functional>
#include <juce_core/juce_core.h>
#include <utility>

namespace physvib {

/// A button beside a message; without a name there is none.
struct DeskAct {
    juce::String name;
    std::function<void()> run;
};

struct DeskMessage {
    juce::String words;  ///< one line; empty: none
    bool isNews = false; ///< a success; else an error
    DeskAct act{};
    juce::String label{}; ///< what it is about: there is one message of a label; empty: nothing that lasts
};

/// Message thread only.
class DeskMessages {
public:
    /// `onChange` is called when another message is shown.
    explicit DeskMessages(std::function<void()> onChange)
        : onChange_{std::move(onChange)} {}

    const DeskMessage& shown() const noexcept { return shown_; }

    /// Replaces the message. Without words the next one that waits is shown. An error waits if it has a label
    /// or a button, since it still stands.
    void show(DeskMessage message);

    /// Shows the message after those that are there, or in the place of the one of its label.
    void add(DeskMessage message);

    /// Removes the message of this label, since it is no longer true.
    void withdraw(const juce::String& label);

private:
    void put(DeskMessage message);

    std::function<void()> onChange_;
    DeskMessage shown_;
    std::deque<DeskMessage> waiting_;
};

} // namespace physvib
