// SPDX-License-Identifier: MIT
// Everything that was done in a session: what it takes to render it again.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Documents/RecordingFile.h"
#include "Scene/SceneFileLimits.h"
#include "Scene/SceneRun.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace physvib {

namespace kinds {
/// Seconds in files, nanoseconds here.
struct Time {
    std::int64_t operator()(const auto& json) const {
        return std::llround(json.numberUpTo(static_cast<double>(limits::maxSessionNs) / 1e9) * 1e9);
    }
    /// The double that is nearest to the decimal number.
    double write(std::int64_t ns) const { return static_cast<double>(ns) / 1e9; }
};
} // namespace kinds

/// A change of layout or law, at a session time.
struct PannerChange {
    std::int64_t timeNs = 0;
    PhantomPanner panner;
};

/// Any other control; apart, since a panner is a hundred times larger.
struct ChannelChange {
    std::int64_t timeNs = 0;
    RenderControl::Kind kind = RenderControl::Kind::stopAll;
    int channel = 0;
    float value = 0.0f;
};

/// Other recordings in place of modes; none: modes.
struct RecordingsChange {
    std::int64_t timeNs = 0;
    std::vector<RecordingFile> files;
    bool operator==(const RecordingsChange&) const = default;
};

void visitFields(auto& v, FieldsOf<RecordingsChange>) {
    v.field("time_s", &RecordingsChange::timeNs, kinds::Time{});
    v.field("files", &RecordingsChange::files, kinds::Objects<RecordingFile>{});
}

/// One channel of a clip. Its place in SessionLog::clips gives the number by which strikes play it.
struct ClipFile {
    RecordingFile file; ///< always with its hash
    int channel = 0;
    bool operator==(const ClipFile&) const = default;
};

void visitFields(auto& v, FieldsOf<ClipFile>) {
    constexpr auto file = &ClipFile::file;
    v.formerly("frequency_hz", in(file, &RecordingFile::frequencyHz), kinds::positive);
    v.field("file", in(file, &RecordingFile::path), kinds::text);
    v.field("channel", &ClipFile::channel, kinds::whole(0, limits::maxEnchanters - 1), Need::optional);
    v.field("hash", in(file, &RecordingFile::hash), kinds::text);
}

struct SessionLog {
    std::vector<SceneRun> takes;              ///< one after the other; the last goes on
    std::vector<PannerChange> panners;        ///< in time order
    std::vector<ChannelChange> channels;      ///< in time order
    std::vector<RecordingsChange> recordings; ///< in time order; without one there are none
    std::vector<CollisionEvent> strikes; ///< apart from the world, in the order in which they were asked for
    std::vector<ClipFile> clips{};       ///< each once, before its first strike

    std::int64_t lastControlNs() const noexcept {
        return std::max(panners.empty() ? 0 : panners.back().timeNs,
                        channels.empty() ? 0 : channels.back().timeNs);
    }
};

/// The controls in time order, as a renderer takes them, without recordings; `keepLayouts` false leaves
/// layouts out, and channels from `channels` on. Their panners are the log's. Any thread.
std::vector<RenderControl> controlsOf(const SessionLog& log, bool keepLayouts, int channels);

} // namespace physvib
