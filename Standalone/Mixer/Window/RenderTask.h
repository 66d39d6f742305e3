// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a file in the background while the session plays, with a progress bar and a cancel button.
#pragma once
#include "Mixer/Window/Parts.h"
#include <functional>
#include <string>

namespace physvib {

/// Shows the progress and reports the result to `done` in one line. Message thread.
class RenderTask final : public juce::ThreadWithProgressWindow {
public:
    /// Runs on its own thread, reports progress from 0 to 1, and stops when that returns false. Empty, or one
    /// error line; "cancelled".
    using Work = std::function<std::string(const std::function<bool(double)>& progress)>;
    using Done = std::function<void(const juce::String& words, bool isGood)>;

    /// `doneWords`: text for the completed file.
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
