// SPDX-License-Identifier: GPL-3.0-or-later
// A thread of its own; the session it renders is a copy.
#include "Mixer/Window/RenderTask.h"

namespace physvib {

RenderTask::RenderTask(const SavedSession& session, double seconds, const juce::File& file, int sampleRateHz, Done done, juce::Component& over)
    : juce::ThreadWithProgressWindow{"Rendering " + file.getFileName(), true, true, 10'000, "Cancel", &over}
    , session_{session}
    , seconds_{seconds}
    , file_{file}
    , sampleRateHz_{sampleRateHz}
    , done_{std::move(done)} {
    launchThread();
}

void RenderTask::run() {
    const auto shown = [this](double share) {
        setProgress(share);
        return !threadShouldExit();
    };
    error_ = renderSessionWav(session_, {sampleRateHz_, seconds_, shown}, file_.getFullPathName().toStdString(), "physvib " PHYSVIB_VERSION);
}

void RenderTask::threadComplete(bool userPressedCancel) {
    if (userPressedCancel) return done_("Rendering cancelled; nothing was written", true);
    done_(error_.empty() ? "Rendered " + file_.getFullPathName() : utf8(error_), error_.empty());
}

} // namespace physvib
