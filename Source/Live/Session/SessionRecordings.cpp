// SPDX-License-Identifier: MIT
// Prepares a saved session's recordings: resampled sets, and timed controls that change between them.
#include "Live/Session/SessionRecordings.h"
#include <algorithm>

namespace physvib {

std::vector<std::string> notesOf(const LoadedRecordings& loaded) {
    std::vector<std::string> notes = notesOf(loaded.clips);
    for (const auto& set : loaded.sets)
        for (std::string& note : notesOf(set))
            if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    return notes;
}

SessionRecordings::SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz)
    : sampleRateHz_{sampleRateHz} {
    for (const ContactRecording& clip : loaded.clips) sets_.add(clip);
    for (std::size_t i = 0; i < log.recordings.size() && i < loaded.setOfChange.size(); ++i) {
        RenderControl& control = changes_.emplace_back();
        control.timeNs = log.recordings[i].timeNs;
        control.kind = RenderControl::Kind::recordings;
        control.recordings = sets_.at(sampleRateHz, loaded.sets[loaded.setOfChange[i]]);
    }
}

std::vector<RenderControl> SessionRecordings::with(std::vector<RenderControl> controls) const {
    controls.insert(controls.end(), changes_.begin(), changes_.end());
    std::ranges::stable_sort(controls, {}, &RenderControl::timeNs);
    return controls;
}

} // namespace physvib
