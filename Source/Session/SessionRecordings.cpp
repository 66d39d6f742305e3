// SPDX-License-Identifier: MIT
// Sets of recordings at the times of their changes.
#include "Session/SessionRecordings.h"
#include <algorithm>

namespace physvib {

SessionRecordings::SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz)
    : setOfChange_{loaded.setOfChange} {
    for (const RecordingsChange& change : log.recordings) times_.push_back(change.timeNs);
    for (const auto& set : loaded.sets) sounds_.emplace_back(set, sampleRateHz);
}

std::vector<RenderControl> SessionRecordings::with(std::vector<RenderControl> controls) const {
    for (std::size_t i = 0; i < setOfChange_.size(); ++i) {
        RenderControl& control = controls.emplace_back();
        control.timeNs = times_[i];
        control.kind = RenderControl::Kind::recordings;
        control.recordings = sounds_[setOfChange_[i]].contacts();
    }
    std::ranges::stable_sort(controls, {}, &RenderControl::timeNs);
    return controls;
}

} // namespace physvib
