// SPDX-License-Identifier: MIT
// Everything that was done in a session: what it takes to render it again.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Documents/RecordingFile.h"
#include "Scene/SceneTake.h"
#include <algorithm>
#include <cstdint>
#include <vector>

namespace physvib {

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

/// One channel of a clip, which strikes of its file's frequency play.
struct ClipFile {
    RecordingFile file; ///< always with its hash
    int channel = 0;
    bool operator==(const ClipFile&) const = default;
};

struct SessionLog {
    std::vector<SceneTake> takes;             ///< one after the other; the last goes on
    std::vector<PannerChange> panners;        ///< in time order
    std::vector<ChannelChange> channels;      ///< in time order
    std::vector<RecordingsChange> recordings; ///< in time order; without one there are none
    std::vector<CollisionEvent> strikes; ///< apart from the world, in the order in which they were asked for
    std::vector<ClipFile> clips{}; ///< each once, before its first strike; named clipFrequencyHz(0), (1)...

    std::int64_t lastControlNs() const noexcept {
        return std::max(panners.empty() ? 0 : panners.back().timeNs,
                        channels.empty() ? 0 : channels.back().timeNs);
    }
};

/// The controls in time order, as a renderer takes them, without recordings; `keepLayouts` false leaves
/// layouts out, and channels from `channels` on. Any thread.
std::vector<RenderControl> controlsOf(const SessionLog& log, bool keepLayouts, int channels);

} // namespace physvib
