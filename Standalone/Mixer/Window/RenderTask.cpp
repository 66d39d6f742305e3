// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the work on its own thread with its own copy of the data.
#include "Mixer/Window/RenderTask.h"

namespace physvib {

RenderTask::RenderTask(const juce::File& file, const juce::String& doneWords, Work work, Done done,
                       juce::Component& over)
    : juce::ThreadWithProgressWindow{"Making " + file.getFileName(), true, true, 10'000, "Cancel", &over}
    , doneWords_{doneWords + " " + file.getFullPathName()}
    , work_{std::move(work)}
    , done_{std::move(done)} {
    launchThread();
}

void RenderTask::run() {
    error_ = work_([this](double share) {
        setProgress(share);
        return !threadShouldExit();
    });
}

void RenderTask::threadComplete(bool userPressedCancel) {
    if (userPressedCancel) return done_("Rendering cancelled; nothing was written", true);
    done_(error_.empty() ? doneWords_ : utf8(error_), error_.empty());
}

} // namespace physvib
