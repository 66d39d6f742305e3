// SPDX-License-Identifier: MIT
// Reads audio files and haptic clips; all sounds from files enter the program here.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// Names of recordings usually end so; what they are is decided by their content.
inline constexpr std::array<std::string_view, 6> soundEndings{".wav",  ".aiff", ".aif",
                                                              ".flac", ".ogg",  ".opus"};

/// Reads a recording (DecodeSound.h, recognised by content) with its own rate and channels, or a clip
/// (recognised by file extension: Formats/ClipFile.h) at 48 kHz. Or one line naming the file. Only regular
/// files within the limits of recordings, whose content is as long as the header says, and finite. Any thread
/// but R.
Result<SampledSound> readRecording(const std::filesystem::path& path);

/// Samples of a clip that was read from that file. Any thread.
Result<SampledSound> soundOf(const Clip& clip, const std::filesystem::path& path);

/// Removes content below 5 Hz from a recording for an actuator (Measure/SlowPart.h). Returns a note that
/// names the file, or empty. `fullScale`: the sample value that is played as full scale. Any thread but R.
std::string takeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale = 1.0);

/// Reads a recording of up to a day block by block, with constant memory. Returns empty, or one line naming
/// the file, with the file's error or that of `taker`. No clips. Any thread but R.
std::string streamRecording(const std::filesystem::path& path, SoundTaker& taker);

} // namespace physvib
