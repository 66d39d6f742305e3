// SPDX-License-Identifier: GPL-3.0-or-later
// From files to controls.
#include "Host/SessionRecordings.h"
#include <algorithm>

namespace physvib {

Result<std::vector<std::vector<ContactRecording>>> loadRecordings(const SessionLog& log) {
    std::vector<std::vector<ContactRecording>> all;
    std::vector<ContactRecording> known; // a study exchanges the same few, over and over
    for (const RecordingsChange& change : log.recordings) {
        auto& set = all.emplace_back();
        for (const RecordingFile& file : change.files) {
            auto found = std::ranges::find(known, file, &ContactRecording::file);
            if (found == known.end()) {
                auto contact = loadContact(file);
                if (!contact) return Failure{contact.error};
                found = known.insert(known.end(), std::move(contact.value));
            }
            set.push_back(*found);
        }
    }
    return all;
}

std::vector<std::string> recordingPaths(const SessionLog& log) {
    std::vector<std::string> paths;
    for (const RecordingsChange& change : log.recordings)
        for (const RecordingFile& file : change.files) paths.push_back(file.path);
    return paths;
}

SessionRecordings::SessionRecordings(const SessionLog& log, const std::vector<std::vector<ContactRecording>>& loaded, int sampleRateHz) {
    for (const RecordingsChange& change : log.recordings) times_.push_back(change.timeNs);
    for (const auto& set : loaded) sounds_.emplace_back(set, sampleRateHz);
}

std::vector<RenderControl> SessionRecordings::with(std::vector<RenderControl> controls) const {
    for (std::size_t i = 0; i < sounds_.size(); ++i) {
        RenderControl& control = controls.emplace_back();
        control.timeNs = times_[i];
        control.kind = RenderControl::Kind::recordings;
        control.recordings = sounds_[i].contacts();
    }
    std::ranges::stable_sort(controls, {}, &RenderControl::timeNs);
    return controls;
}

} // namespace physvib
