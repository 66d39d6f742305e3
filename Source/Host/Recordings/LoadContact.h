// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded contacts from files: one channel, from the hit on, at a level that is known.
#pragma once
#include "Io/Result.h"
#include "Live/Session/ContactSounds.h"

namespace physvib {

/// From the onset on, the strength of a contact is measured for so long: most of a hit, little of a tail
/// (assumed).
constexpr double matchedSeconds = 0.25;

/// The loudest channel of a WAV file from its strongest hit's onset on; or one line naming the file. Its peak
/// is 1, as that of a mode's envelope, or, if `file.isMatched`, its root mean square over matchedSeconds is
/// that of the mode. A file that does not have the wanted hash has changed and is refused. M only.
Result<ContactRecording> loadContact(const RecordingFile& file);

} // namespace physvib
