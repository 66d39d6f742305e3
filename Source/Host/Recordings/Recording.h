// SPDX-License-Identifier: GPL-3.0-or-later
// A recording of a live session: what its channels play as WAV, and every event of it beside it, in the WAV's
// time.
#pragma once
#include "Core/RenderControl.h"
#include "Host/Recordings/PlayedRecorder.h"
#include "Scene/EventsCsv.h"
#include <filesystem>
#include <vector>

namespace physvib {

/// M only; recorder() is what the output fills.
class Recording {
public:
    /// `path` (.wav); the events stand beside it as .csv.
    Recording(const std::filesystem::path& path, int channels, int sampleRateHz);

    std::string error() const { return recorder_.error(); }
    PlayedRecorder& recorder() noexcept { return recorder_; }
    std::filesystem::path eventsPath() const {
        return std::filesystem::path{path_}.replace_extension(".csv");
    }

    void take(const PlayedEvent& played) { played_.push_back(played.event); }

    /// Both files in their places, after R has stopped; `playOutFrames` is L; `field` is what places are in;
    /// `names`: of the scene's materials. Empty, or one line with the reason.
    std::string finish(std::int64_t playOutFrames, FieldSize field, const Provenance& provenance,
                       const SoundNames& names);

private:
    std::filesystem::path path_;
    PlayedRecorder recorder_;
    std::vector<CollisionEvent> played_;
};

} // namespace physvib
