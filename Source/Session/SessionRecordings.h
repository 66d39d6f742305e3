// SPDX-License-Identifier: MIT
// The recordings of a saved session, on their way to a renderer.
#pragma once
#include "Core/RenderControl.h"
#include "Files/SessionLog.h"
#include "Session/ContactSounds.h"
#include <vector>

namespace physvib {

/// What a session plays of recordings; a study exchanges the same few sets over and over.
struct LoadedRecordings {
    std::vector<std::vector<ContactRecording>> sets; ///< each once
    std::vector<std::size_t> setOfChange;            ///< per change in SessionLog::recordings
};

/// They at one rate, and the controls that exchange them; lives as long as whoever renders. M only.
class SessionRecordings {
public:
    SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz);

    /// `controls`, in time order, and these; both stay in order.
    std::vector<RenderControl> with(std::vector<RenderControl> controls) const;

private:
    std::vector<std::int64_t> times_;
    std::vector<std::size_t> setOfChange_;
    std::vector<ContactSounds> sounds_;
};

} // namespace physvib
