// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded contacts from files, made fit for a renderer: one channel, a level that is known, its rate.
#pragma once
#include "Core/RecordedContact.h"
#include "Files/RecordingFile.h"
#include "Files/Result.h"
#include <string>
#include <vector>

namespace physvib {

/// A recording as it was read, from its onset on, at its level.
struct ContactRecording {
    double frequencyHz = 0.0; ///< of the events that it stands for
    int sampleRateHz = 0;
    std::vector<float> samples;
    RecordingFile file{}; ///< what it was read from, with its hash
    bool operator==(const ContactRecording&) const = default;
};

/// From the onset on, the strength of a contact is measured for so long: most of a hit, little of a tail (assumed).
constexpr double matchedSeconds = 0.25;

/// The loudest channel of a WAV file from its strongest hit's onset on; or one line naming the file. Its peak is 1, as that
/// of a mode's envelope, or, if `file.isMatched`, its root mean square over matchedSeconds is that of the mode. A file
/// that does not have the wanted hash has changed and is refused. M only.
Result<ContactRecording> loadContact(const RecordingFile& file);

/// The files of recordings. Any thread.
std::vector<RecordingFile> filesOf(const std::vector<ContactRecording>& recordings);

/// Recordings at one rate, and the list of them that a renderer takes; both live as long as this object, which stays where
/// it is. M only.
class ContactSounds {
public:
    ContactSounds() = default;
    ContactSounds(const std::vector<ContactRecording>& recordings, int sampleRateHz);
    ContactSounds(ContactSounds&&) = default; // vectors keep their memory
    ContactSounds& operator=(ContactSounds&&) = default;

    std::span<const RecordedContact> contacts() const noexcept { return contacts_; }

private:
    std::vector<std::vector<float>> samples_;
    std::vector<RecordedContact> contacts_;
};

} // namespace physvib
