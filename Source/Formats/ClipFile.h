// SPDX-License-Identifier: MIT
// Haptic files of others by their endings: one door in, one out.
#pragma once
#include "Formats/Clip.h"
#include "Formats/FrequencyScale.h"
#include "Io/Result.h"
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

enum class ClipFormat { hjif, hmpg, haptic, ahap };
/// as ClipFormat
constexpr std::array<std::string_view, 4> clipEndings{".hjif", ".hmpg", ".haptic", ".ahap"};

/// By the file's ending, in any case of letters. Any thread.
std::optional<ClipFormat> clipFormatOf(std::string_view path) noexcept;

/// Whether the format has one channel only. Any thread.
constexpr bool isMono(ClipFormat format) noexcept {
    return format == ClipFormat::haptic || format == ClipFormat::ahap;
}

/// The clip of a file's bytes; or one line. `scale` says what phones' frequencies are. Any thread.
Result<Clip> readClip(std::string_view bytes, std::string_view name, ClipFormat format,
                      const FrequencyScale& scale = {});

/// The same of a file. Any thread but R.
Result<Clip> loadClip(const std::filesystem::path& path, ClipFormat format, const FrequencyScale& scale = {});

/// The file of `clip`, of its first channel if the format has one only; or one line: what it has no numbers
/// for. Any thread.
Result<std::string> clipBytes(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

/// What of `clip` the format cannot carry, a line each, for people. Any thread.
std::vector<std::string> clipLosses(const Clip& clip, ClipFormat format, const FrequencyScale& scale = {});

} // namespace physvib
