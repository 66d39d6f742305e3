// SPDX-License-Identifier: GPL-3.0-or-later
// A recording of a live session: what its channels play as WAV, and every event of it beside it, in the WAV's
// time.
#pragma once
#include "Core/RenderControl.h"
#include "Host/Recordings/PlayedRecorder.h"
#include "Io/Disk/AtomicFile.h"
#include "Scene/EventsCsv.h"
#include <algorithm>
#include <filesystem>
#include <vector>

namespace physvib {

/// M only; recorder() is what the output fills.
class Recording {
public:
    /// `path` (.wav); the events stand beside it as .csv.
    Recording(const std::filesystem::path& path, int channels, int sampleRateHz)
        : path_{path}
        , recorder_{path, channels, sampleRateHz} {}

    std::string error() const { return recorder_.error(); }
    PlayedRecorder& recorder() noexcept { return recorder_; }
    std::filesystem::path eventsPath() const {
        return std::filesystem::path{path_}.replace_extension(".csv");
    }

    void take(const PlayedEvent& played) { played_.push_back(played.event); }

    /// Both files in their places, after R has stopped; `playOutFrames` is L; `field` is what places are in.
    /// Empty, or one line with the reason.
    std::string finish(std::int64_t playOutFrames, FieldSize field, const Provenance& provenance) {
        if (auto error = recorder_.finish(); !error.empty()) return error;
        const std::int64_t rate = recorder_.sampleRateHz(), late = playOutFrames - recorder_.firstFrame();
        const std::int64_t shiftNs = late / rate * 1'000'000'000 + late % rate * 1'000'000'000 / rate;
        const std::int64_t lengthNs = static_cast<std::int64_t>(
            1e9 * static_cast<double>(recorder_.frames()) / static_cast<double>(rate));
        for (auto& event : played_) event.timeNs += shiftNs;
        std::erase_if(played_,
                      [lengthNs](const CollisionEvent& e) { return e.timeNs < 0 || e.timeNs >= lengthNs; });
        std::ranges::stable_sort(played_, {}, &CollisionEvent::timeNs);
        return writeFile(eventsPath(), eventsCsv(played_, field, provenance));
    }

private:
    std::filesystem::path path_;
    PlayedRecorder recorder_;
    std::vector<CollisionEvent> played_;
};

} // namespace physvib
