// SPDX-License-Identifier: MIT
// The recordings and clips of a saved session, prepared for a renderer.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/RecordingSets.h"
#include <string>
#include <vector>

namespace physvib {

/// The recordings that a session plays. A study switches between the same few sets many times.
struct LoadedRecordings {
    std::vector<std::vector<ContactRecording>> sets; ///< without duplicates
    std::vector<std::size_t> setOfChange;  ///< index into `sets` per change in SessionLog::recordings
    std::vector<ContactRecording> clips{}; ///< in the order of SessionLog::clips
};

/// All their notes. Any thread.
std::vector<std::string> notesOf(const LoadedRecordings& loaded);

/// The recordings at one sample rate, and the controls that change between them. Must outlive the render.
/// Message thread (M) only.
class SessionRecordings {
public:
    SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz);

    /// Merges `controls`, in time order, with the changes of recordings.
    std::vector<RenderControl> with(std::vector<RenderControl> controls) const;

    /// These recordings plus the session's clips: what is in use from the start.
    RecordedContacts beside(const std::vector<ContactRecording>& recordings) {
        return sets_.at(sampleRateHz_, recordings);
    }

private:
    int sampleRateHz_;
    RecordingSets sets_;
    std::vector<RenderControl> changes_;
};

} // namespace physvib
