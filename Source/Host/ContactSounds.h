// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded contacts from files, made fit for a renderer: one channel, peak 1, its rate.
#pragma once
#include "Core/SamplePlayer.h"
#include "Files/Result.h"
#include <string>
#include <vector>

namespace physvib {

/// A recording as it was read, from its onset on, with peak 1.
struct ContactRecording {
    double frequencyHz = 0.0; ///< of the events that it stands for
    int sampleRateHz = 0;
    std::vector<float> samples;
};

/// The loudest channel of a WAV file from its strongest hit's onset on; or one line naming the file. M only.
Result<ContactRecording> loadContact(const std::string& path, double frequencyHz);

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
