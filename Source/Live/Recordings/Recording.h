// SPDX-License-Identifier: MIT
// Records a live session: the channels as a WAV file, and the events as CSV in the WAV's time.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Recordings/PlayedRecorder.h"
#include "Scene/EventsCsv.h"
#include <filesystem>
#include <vector>

namespace physvib {

/// M only; the audio output feeds recorder().
class Recording {
public:
    /// `path` ends in .wav; the events go to the same name with .csv.
    Recording(const std::filesystem::path& path, int channels, int sampleRateHz);

    std::string error() const { return recorder_.error(); }
    PlayedRecorder& recorder() noexcept { return recorder_; }
    std::filesystem::path eventsPath() const {
        return std::filesystem::path{path_}.replace_extension(".csv");
    }

    void take(const PlayedEvent& played) { played_.push_back(played.event); }

    /// Completes both files, after R has stopped. `outputLatencyFrames` is the output latency; `field` is the
    /// field that places refer to; `names` are those of the scene's materials. Returns empty, or one line
    /// with the reason.
    std::string finish(std::int64_t outputLatencyFrames, FieldSize field, const Provenance& provenance,
                       const SoundNames& names);

private:
    std::filesystem::path path_;
    PlayedRecorder recorder_;
    std::vector<CollisionEvent> played_;
};

} // namespace physvib
