// SPDX-License-Identifier: MIT
// The recordings and clips of a saved session, on their way to a renderer.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/RecordingSets.h"
#include <string>
#include <vector>

namespace physvib {

/// What a session plays of recordings; a study exchanges the same few sets over and over.
struct LoadedRecordings {
    std::vector<std::vector<ContactRecording>> sets; ///< each once
    std::vector<std::size_t> setOfChange;            ///< per change in SessionLog::recordings
    std::vector<ContactRecording> clips{};           ///< as SessionLog::clips
};

/// All their notes. Any thread.
std::vector<std::string> notesOf(const LoadedRecordings& loaded);

/// They at one rate, and the controls that exchange them; lives as long as whoever renders. M only.
class SessionRecordings {
public:
    SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz);

    /// `controls`, in time order, and these; both stay in order.
    std::vector<RenderControl> with(std::vector<RenderControl> controls) const;

    /// The clips beside these recordings: what is played from the start.
    RecordedContacts beside(const std::vector<ContactRecording>& recordings) {
        return sets_.at(sampleRateHz_, recordings);
    }

private:
    int sampleRateHz_;
    RecordingSets sets_;
    std::vector<RenderControl> changes_;
};

} // namespace physvib
