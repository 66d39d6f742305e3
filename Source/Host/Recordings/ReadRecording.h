// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings in: the one door through which sounds come from files.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <filesystem>
#include <string>

namespace physvib {

/// A recording (WAV, FLAC, Ogg Vorbis, by what is in it) as it is: its rate and channels; or a clip (by its
/// ending: Formats/ClipFile.h) at 48 kHz; or one line naming the file. Only a regular file, within the limits
/// of recordings, and only if it holds what its header says. Any thread but R.
Result<SampledSound> readRecording(const std::filesystem::path& path);

/// The same of a clip that has been read from that file. Any thread.
Result<SampledSound> soundOf(const Clip& clip, const std::filesystem::path& path);

/// Takes what lies below 5 Hz out of a recording that is to be felt (Measure/SlowPart.h): what is to be said
/// of it, naming the file, or nothing. `fullScale` is what is played as such. Any thread but R.
std::string takeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale = 1.0);

/// The same of a recording of up to a day, block by block, so that memory does not grow with it: empty, or
/// one line naming the file: what is wrong with it, or what `taker` says. No clips. Any thread but R.
std::string streamRecording(const std::filesystem::path& path, SoundTaker& taker);

} // namespace physvib
