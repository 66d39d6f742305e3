// SPDX-License-Identifier: MIT
// Readers and writers of .hjif, .haptic and .ahap files, the choice of one by the file's ending, and the
// report of what an imported file contains that is not played.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include "Io/Text/NumberText.h"
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

enum class ClipFormat { hjif, haptic, ahap, envelope };

struct ClipFormatInfo {
    std::string_view ending, owner;
    bool isMono;            ///< one channel only
    bool isReadable = true; ///< false: only written
};

/// The one table of haptic files, indexed by ClipFormat: help, dialogs and errors list what it has.
inline constexpr std::array<ClipFormatInfo, 4> clipFormats{{{".hjif", "MPEG", false},
                                                            {".haptic", "Meta", true},
                                                            {".ahap", "Apple", true},
                                                            {".envelope", "Android", true, false}}};

template <std::size_t Count>
inline constexpr auto firstEndings = [] {
    std::array<std::string_view, Count> endings;
    for (std::size_t i = 0; i < Count; ++i) endings[i] = clipFormats[i].ending;
    return endings;
}();
/// Of files that can be written, and of those that can be read as well, which come first.
inline constexpr auto& writableEndings = firstEndings<clipFormats.size()>;
inline constexpr auto& clipEndings = firstEndings<3>;
static_assert(clipFormats[clipEndings.size() - 1].isReadable && !clipFormats[clipEndings.size()].isReadable);

/// By the file's ending, case-insensitive. Any thread.
std::optional<ClipFormat> findClipFormat(std::string_view path) noexcept;

/// True if the format has one channel only. Any thread.
constexpr bool isMono(ClipFormat format) noexcept {
    return clipFormats[static_cast<std::size_t>(format)].isMono;
}

/// The clip of a file's bytes, or a one-line error. `scale`: frequency range of phone formats. Any thread.
Result<Clip> readClip(std::string_view bytes, std::string_view name, ClipFormat format,
                      const FrequencyScale& scale = {});

/// The same for a file. Any thread but the render thread (R).
Result<Clip> loadClip(const std::filesystem::path& path, ClipFormat format, const FrequencyScale& scale = {});

/// A file with `clip` (without a clipError), or its first channel if the format has only one. Any thread.
std::string clipBytes(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

/// What the format cannot store of `clip`, one line each, for the user. Any thread.
std::vector<std::string> clipLosses(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

// Reader and writer of .hjif, MPEG-I haptics as JSON (ISO/IEC 23090-31).
//
// Stores: channels with labels, places and actuators, bands of waves with phases, frequencies up to 10 kHz,
// any length. Does not store: places finer than 127 points across the field; panning laws and events as such.
// Reads from other writers: vibrotactile perceptions with vectorial, transient and curve bands; not wavelets
// or composite effects.

/// The clip that `text` describes; or, for the first error, one line `name: perceptions[0].channels[1]...`.
/// Optional fields may be missing, unknown ones are ignored. Any thread.
Result<Clip> readHjif(std::string_view text, std::string_view name);

/// `clip` (without a clipError) as JSON, 48,000 ticks per second; the date is constant. Any thread.
std::string hjifText(const Clip& clip);

/// What .hjif cannot store of `clip`, of these frequencies, one line each. Any thread.
std::vector<std::string> hjifLosses(const Clip& clip, const std::set<double>& frequenciesHz);

// Reader and writer of Meta's .haptic, which FMOD and Wwise also read: envelopes and emphasis points.
//
// Stores: one channel, amplitudes and frequencies from 0 to 1, transients as emphasis, any length. Does not
// store: several channels, places, several frequencies at once, phases, levels beyond full scale, Hz.

/// One channel: the envelope as a wave, emphasis as transients; 0.5 of the scale without frequencies and
/// before their first. A one-line error if it breaks one of Meta's rules: values from 0 to 1, times in order,
/// at least two points of amplitude, emphasis at least as strong as the envelope. Any thread.
Result<Clip> readMetaHaptic(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// Transients weaker than the envelope beside them: the format requires them to be raised to it. Any thread.
std::size_t raisedTransientCount(const ClipChannel& channel);

/// `channel` as such a file. Any thread.
std::string metaHapticText(const ClipChannel& channel, std::string_view title,
                           const FrequencyScale& scale = {});

// Reader and writer of Apple's .ahap: continuous and transient events, and curves that control all of them.
//
// Stores: one channel, intensities and sharpnesses from 0 to 1, transients; consecutive continuous events of
// at most 30 s. Does not store: several channels, places, several frequencies at once, phases, levels beyond
// full scale, Hz. Ignored with a note when reading: sound, attack, decay, release, and unknown fields.

/// One channel. Amplitude is the intensity squared, sharpness a share of the scale. Values out of range are
/// clamped and missing ones have defaults, as in Apple's definition (Docs/events.md). Any thread.
Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// `channel` as such a file. No curve changes a transient (AhapWriter.cpp) or has over 16 points. Any thread.
std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale = {});

/// Counts the contents of an imported file that are not played. One thread at a time.
class OmissionCounter {
public:
    /// Counts one more of that kind; its name may come from the file.
    void add(std::string_view what) {
        std::string name = printable(what);
        ++counts_[counts_.size() < maxKinds || counts_.contains(name) ? std::move(name) : "others"];
    }
    /// "left out: AttackTime (3), Sustained (1)"; empty: none.
    std::string line() const {
        std::string text;
        for (const auto& [name, count] : counts_)
            text += (text.empty() ? "left out: " : ", ") + name + " (" + std::to_string(count) + ")";
        return text;
    }

private:
    static constexpr std::size_t maxKinds = 12; // to keep the report short
    std::map<std::string, int> counts_;
};

} // namespace physvib
