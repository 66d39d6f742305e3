// SPDX-License-Identifier: GPL-3.0-or-later
// A saved session is rendered beside the one that plays, with a bar that shows how far it is and a button that ends it.
#pragma once
#include "Host/Recordings/SessionWav.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Shows the progress, and tells `done` in a line how it ended. M.
class RenderTask final : public juce::ThreadWithProgressWindow {
public:
    using Done = std::function<void(const juce::String& words, bool isGood)>;

    /// `seconds` of it: beyond what was played the last scene goes on by itself.
    RenderTask(const SavedSession& session, double seconds, const juce::File& file, int sampleRateHz, Done done, juce::Component& over);
    ~RenderTask() override { stopThread(-1); }

    void run() override;
    void threadComplete(bool userPressedCancel) override;

private:
    const SavedSession session_;
    const double seconds_;
    const juce::File file_;
    const int sampleRateHz_;
    const Done done_;
    std::string error_;
};

} // namespace physvib
