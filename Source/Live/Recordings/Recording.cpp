// SPDX-License-Identifier: MIT
// Writes the events of a recording, shifted from session time to the time of the WAV file.
#include "Live/Recordings/Recording.h"
#include "Io/Disk/AtomicFile.h"
#include <algorithm>

namespace physvib {

Recording::Recording(const std::filesystem::path& path, int channels, int sampleRateHz)
    : path_{path}
    , recorder_{path, channels, sampleRateHz} {}

std::string Recording::finish(std::int64_t outputLatencyFrames, FieldSize field, const Provenance& provenance,
                              const SoundNames& names) {
    if (auto error = recorder_.finish(); !error.empty()) return error;
    const std::int64_t rate = recorder_.sampleRateHz(), late = outputLatencyFrames - recorder_.firstFrame();
    const std::int64_t shiftNs = late / rate * 1'000'000'000 + late % rate * 1'000'000'000 / rate;
    const std::int64_t lengthNs =
        static_cast<std::int64_t>(1e9 * static_cast<double>(recorder_.frames()) / static_cast<double>(rate));
    for (auto& event : played_) event.timeNs += shiftNs;
    std::erase_if(played_,
                  [lengthNs](const CollisionEvent& e) { return e.timeNs < 0 || e.timeNs >= lengthNs; });
    std::ranges::stable_sort(played_, {}, &CollisionEvent::timeNs);
    return writeFile(eventsPath(), eventsCsv(played_, field, provenance, names));
}

} // namespace physvib
