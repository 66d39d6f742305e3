// SPDX-License-Identifier: MIT
// Reads and writes haptic files of others; the format follows from the file's ending.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

enum class ClipFormat { hjif, haptic, ahap, envelope };

struct ClipFormatRow {
    std::string_view ending, owner;
    bool isMono;        ///< one channel only
    bool isRead = true; ///< false: only written
};

/// The one table of haptic files, indexed by ClipFormat: help, dialogs and errors list what it has.
inline constexpr std::array<ClipFormatRow, 4> clipFormats{{{".hjif", "MPEG", false},
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
inline constexpr auto& writtenEndings = firstEndings<clipFormats.size()>;
inline constexpr auto& clipEndings = firstEndings<3>;
static_assert(clipFormats[clipEndings.size() - 1].isRead && !clipFormats[clipEndings.size()].isRead);

/// By the file's ending, case-insensitive. Any thread.
std::optional<ClipFormat> clipFormatOf(std::string_view path) noexcept;

/// True if the format has one channel only. Any thread.
constexpr bool isMono(ClipFormat format) noexcept {
    return clipFormats[static_cast<std::size_t>(format)].isMono;
}

/// The clip of a file's bytes, or a one-line error. `scale`: frequency range of phone formats. Any thread.
Result<Clip> readClip(std::string_view bytes, std::string_view name, ClipFormat format,
                      const FrequencyScale& scale = {});

/// The same for a file. Any thread but the render thread (R).
Result<Clip> loadClip(const std::filesystem::path& path, ClipFormat format, const FrequencyScale& scale = {});

/// The bytes of a file with `clip` (without a clipFault), or its first channel if the format has only one.
/// Any thread.
std::string clipBytes(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

/// What the format cannot store of `clip`, one line each, for the user. Any thread.
std::vector<std::string> clipLosses(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

} // namespace physvib
