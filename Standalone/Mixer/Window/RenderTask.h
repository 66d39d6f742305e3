// SPDX-License-Identifier: GPL-3.0-or-later
// A file is made beside the session that plays, with a bar that shows how far it is and a button that ends
// it.
#pragma once
#include "Mixer/Window/Parts.h"
#include <functional>
#include <string>

namespace physvib {

/// Shows the progress, and tells `done` in a line how it ended. M.
class RenderTask final : public juce::ThreadWithProgressWindow {
public:
    /// On a thread of its own: gives shares of 0 to 1, and ends where that answers false. Empty, or one line
    /// with the reason; "cancelled".
    using Work = std::function<std::string(const std::function<bool(double)>& progress)>;
    using Done = std::function<void(const juce::String& words, bool isGood)>;

    /// `doneWords`: what is told of the file when it is there.
    RenderTask(const juce::File& file, const juce::String& doneWords, Work work, Done done,
               juce::Component& over);
    ~RenderTask() override { stopThread(-1); }

    void run() override;
    void threadComplete(bool userPressedCancel) override;

private:
    const juce::String doneWords_;
    const Work work_;
    const Done done_;
    std::string error_;
};

} // namespace physvib
