// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the recordings of a saved session and writes its rendered samples.
#include "Host/Recordings/SessionWav.h"
#include "Host/Recordings/LoadRecordings.h"
#include "Io/Disk/FileClash.h"
#include "Io/Wav/WavSink.h"

namespace physvib {

std::string renderSessionWav(const SavedSession& session, const SessionExtent& extent,
                             const std::string& path, const std::string& comment) {
    const auto loaded = loadRecordings(session.log);
    if (!loaded) return loaded.error;
    if (auto clash = fileClash({&path, 1}, recordingPaths(session.log)); !clash.empty()) return clash;
    WavSink wav{path, session.channels, extent.sampleRateHz, comment};
    if (!wav.error().empty()) return wav.error();
    const bool isWhole = renderSession(session, loaded.value, extent,
                                       [&](const float* const* block, int n) { return wav.write(block, n); });
    if (!wav.error().empty()) return wav.error();
    return isWhole ? wav.finish() : "cancelled";
}

} // namespace physvib
