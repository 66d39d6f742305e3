// SPDX-License-Identifier: MIT
// Reads audio files and haptic clips; all sounds from files enter the program here.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {
/// Usual extensions of recordings. Their content, not the extension, decides the format.
inline constexpr std::array<std::string_view, 6> soundEndings{".wav",  ".aiff", ".aif",
                                                              ".flac", ".ogg",  ".opus"};

/// Reads a recording (a sound, recognised by content) with its own rate and channels, or a clip (recognised
/// by file extension: Formats/ClipFile.h) at 48 kHz. Or one line naming the file. Only regular files within
/// the limits of recordings, whose content is as long as the header says, and finite. Any thread but R.
Result<SampledSound> readRecording(const std::filesystem::path& path);

/// Samples of a clip that was read from that file. Any thread.
Result<SampledSound> soundOf(const Clip& clip, const std::filesystem::path& path);

/// Removes content below 5 Hz from a recording for an actuator (Measure/HitExcerpt.h). Returns a note that
/// names the file, or empty. `fullScale`: the sample value that is played as full scale. Any thread but R.
std::string takeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale = 1.0);

/// Reads a recording of up to a day block by block, with constant memory. Returns empty, or one line naming
/// the file, with the file's error or that of `taker`. No clips. Any thread but R.
std::string streamRecording(const std::filesystem::path& path, SoundTaker& taker);

// The header of a sound file, checked against the file's content before a library reads it.

/// The part of a file that libsndfile is to read, and how.
struct SoundHead {
    int format = 0;           ///< of libsndfile, where the part is bare samples; 0: a file of its own
    std::string head;         ///< what stands before the part, instead of what the file has there
    std::int64_t begin = 0;   ///< of the part, in bytes
    std::int64_t bytes = 0;   ///< its length
    SoundShape shape{};       ///< as the file says; 0 frames: libsndfile knows
    bool isSurveyed = false;  ///< all samples are read once before, to find their number or alignment
    int bits = 0, room = 0;   ///< bits of a sample of WAVE, and of its container
    bool isLowRather = false; ///< assume the lower bits if the samples do not show the alignment
};

/// Reads the header of a file of `bytes` bytes. The error, without the file's name, tells another kind of
/// file, a wrong length or several streams. A length that the header leaves open is that of the file. Any
/// thread but R.
Result<SoundHead> readSoundHead(std::FILE& file, std::int64_t bytes);

// Samples of sound files, by libsndfile.

/// Decodes a file of `bytes` bytes that can be searched, block by block; full scale is 1. WAVE (RIFF, RIFX,
/// RF64, BW64; PCM, float, G.711), AIFF, FLAC, Ogg Vorbis and Opus. Read whole, or refused: returns empty, or
/// one line without the file's name: what is wrong with it, a sample that is not finite, or what `taker`
/// says. `mostSeconds` bounds what does not say how long it is. Any thread but R.
std::string decodeSound(std::FILE& file, std::int64_t bytes, std::int64_t mostSeconds, SoundTaker& taker);

} // namespace physvib
