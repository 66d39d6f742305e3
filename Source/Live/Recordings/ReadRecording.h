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
/// Extensions under which recordings are listed; the content, not the extension, decides the format.
inline constexpr std::array<std::string_view, 6> soundFileExtensions{".wav",  ".aiff", ".aif",
                                                                     ".flac", ".ogg",  ".opus"};

/// Reads a sound (recognised by content) with its own rate and channels, or a clip (recognised by extension:
/// Formats/ClipFile.h) at 48 kHz. An error, with the file's name, if the file is not regular, too large or
/// not as long as its header says, or if a sample is not finite. Any thread but the render thread (R).
Result<SampledSound> readRecording(const std::filesystem::path& path);

/// Samples of a clip that was read from that file. Any thread.
Result<SampledSound> clipToSound(const Clip& clip, const std::filesystem::path& path);

/// Removes content below 5 Hz from a recording for an actuator (Measure/HitExcerpt.h). Returns a note that
/// names the file, or empty. `fullScale`: the sample value that is played as full scale. Any thread but R.
std::string removeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale = 1.0);

/// Reads a recording of up to a day block by block, with constant memory. Returns empty, or one line naming
/// the file, with the file's error or that of `receiver`. No clips. Any thread but R.
std::string streamRecording(const std::filesystem::path& path, SoundReceiver& receiver);

// The header of a sound file, checked against the file's content before a library reads it.

/// The part of a file that libsndfile is to read, and how.
struct SoundHeader {
    int format = 0;                  ///< of libsndfile, where the part is bare samples; 0: a file of its own
    std::string head;                ///< bytes that replace the file's own before the part
    std::int64_t begin = 0;          ///< first byte of the part
    std::int64_t bytes = 0;          ///< its length
    SoundFormat shape{};             ///< as the header says; 0 frames: libsndfile counts them
    bool needsScan = false;          ///< a first pass finds the number or alignment of the samples
    int bits = 0, containerBits = 0; ///< bits of a sample of WAVE, and of its container
    bool isLowAligned = false;       ///< assume the lower bits if the samples do not show the alignment
};

/// Reads the header of a file of `bytes` bytes. An error, without the file's name, for another kind of file,
/// a wrong length or several streams. Without a length in the header, the file's is used. Any thread but R.
Result<SoundHeader> readSoundHeader(std::FILE& file, std::int64_t bytes);

// Samples of sound files, by libsndfile.

/// Decodes a file of `bytes` bytes that can be searched, block by block; full scale is 1. WAVE (RIFF, RIFX,
/// RF64, BW64; PCM, float, G.711), AIFF, FLAC, Ogg Vorbis and Opus. Reads all or nothing. Returns empty, or
/// one line without the file's name: what is wrong with it, a sample that is not finite, or what `receiver`
/// says. `maxSeconds` bounds what does not say how long it is. Any thread but R.
std::string decodeSound(std::FILE& file, std::int64_t bytes, std::int64_t maxSeconds,
                        SoundReceiver& receiver);

} // namespace physvib
