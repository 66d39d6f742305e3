// SPDX-License-Identifier: MIT
// Log of a session: scene runs, inputs, controls, recordings and events, enough to render it again.
#pragma once
#include "Core/NameNumbers.h"
#include "Core/RenderControl.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Json/FieldTable.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// Reference to a recorded contact, as sessions and commands store it: path of the samples, and a hash to
// detect changes.

struct RecordingFile {
    double frequencyHz = 0.0;    ///< of the material's mode
    std::string path{};          ///< a WAV file, or "synthetic-SEED"
    double decayPerSecond = 0.0; ///< of the material; 0: unknown
    bool isMatched = false;      ///< scaled to the energy of the material's mode; otherwise to a peak of 1
    std::string hash{};     ///< contentHash of the file when read; empty: not checked, or a synthetic contact
    std::string material{}; ///< material whose events play it; empty: all events of that frequency
    bool operator==(const RecordingFile&) const = default;

    SoundNumber sound() const noexcept { return material.empty() ? 0 : soundOfMaterial(material); }
};

void visitFields(auto& v, FieldsOf<RecordingFile>) {
    using R = RecordingFile;
    v.field("frequency_hz", &R::frequencyHz, kinds::positive);
    v.field("file", &R::path, kinds::text);
    v.field("hash", &R::hash, kinds::text, Need::optional);
    v.field("decay_per_s", &R::decayPerSecond, kinds::positive, Need::optional);
    v.field("matched", &R::isMatched, kinds::boolean, Need::optional);
    v.field("material", &R::material, kinds::text, Need::optional.from(9));
}

/// The seed in "synthetic-7", a synthetic contact; none: `path` is a file. Any thread.
inline std::optional<std::uint32_t> syntheticSeed(std::string_view path) noexcept {
    constexpr std::string_view prefix = "synthetic-";
    std::uint32_t seed = 0;
    if (!path.starts_with(prefix)) return {};
    const auto [end, error] = std::from_chars(path.data() + prefix.size(), path.data() + path.size(), seed);
    return error == std::errc{} && end == path.data() + path.size() ? std::optional{seed} : std::nullopt;
}

namespace kinds {
/// Seconds in files, nanoseconds here.
struct Time {
    std::int64_t operator()(const auto& json) const {
        return std::llround(json.numberUpTo(static_cast<double>(limits::maxSessionNs) / 1e9) * 1e9);
    }
    /// The double that is nearest to the decimal number. A tone longer than any session ends with it.
    double write(std::int64_t ns) const {
        return static_cast<double>(std::min(ns, limits::maxSessionNs)) / 1e9;
    }
};
} // namespace kinds

/// A change of layout or law, at a session time.
struct PannerChange {
    std::int64_t timeNs = 0;
    PhantomPanner panner;
};

/// A change of any other control. It is a type of its own because a panner is a hundred times larger.
struct ChannelChange {
    std::int64_t timeNs = 0;
    RenderControl::Kind kind = RenderControl::Kind::stopAll;
    int channel = 0;
    float value = 0.0f;
};

/// Recordings that events play instead of modes from that time on; an empty list: modes.
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
    v.legacyField("frequency_hz", nest(file, &RecordingFile::frequencyHz), kinds::positive);
    v.field("file", nest(file, &RecordingFile::path), kinds::text);
    v.field("channel", &ClipFile::channel, kinds::wholeNumber(0, limits::maxActuators - 1), Need::optional);
    v.field("hash", nest(file, &RecordingFile::hash), kinds::text);
}

struct SessionLog {
    std::vector<SceneRun> runs;               ///< consecutive; the last has no end yet
    std::vector<PannerChange> panners;        ///< in time order
    std::vector<ChannelChange> channels;      ///< in time order
    std::vector<RecordingsChange> recordings; ///< in time order; empty: only modes are played
    std::vector<CollisionEvent> strikes;      ///< events that no world produced, in the order of requests
    std::vector<ClipFile> clips{};            ///< each once, before its first strike

    std::int64_t lastControlNs() const noexcept {
        return std::max(panners.empty() ? 0 : panners.back().timeNs,
                        channels.empty() ? 0 : channels.back().timeNs);
    }
};

/// The controls in time order, as a renderer needs them, without recordings: layouts only if `keepLayouts`,
/// and channels below `channels`. They point to panners of the log. Any thread.
std::vector<RenderControl> logControls(const SessionLog& log, bool keepLayouts, int channels);

} // namespace physvib
