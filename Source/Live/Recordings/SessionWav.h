// SPDX-License-Identifier: MIT
// Renders a saved session to a WAV file.
#pragma once
#include "Io/Disk/FileClash.h"
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionRender.h"
#include <string>

namespace physvib {

/// Writes the whole file or none. Returns empty, one line with the reason, or "cancelled". Any thread but R.
inline std::string renderSessionWav(const SavedSession& session, const SessionExtent& extent,
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
