// SPDX-License-Identifier: MIT
// Recorded contacts, made fit for a renderer: at its rate.
#pragma once
#include "Core/RecordedContact.h"
#include "Live/Documents/RecordingFile.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// A recording as it was read, from its onset on, at its level.
struct ContactRecording {
    double frequencyHz = 0.0; ///< of the events that it stands for
    int sampleRateHz = 0;
    std::vector<float> samples;
    RecordingFile file{}; ///< what it was read from, with its hash
    std::string note{};   ///< a line for people on what was taken away when it was read; mostly empty
    bool operator==(const ContactRecording&) const = default;
};

/// The files of recordings. Any thread.
std::vector<RecordingFile> filesOf(const std::vector<ContactRecording>& recordings);

/// Their notes, each once. Any thread.
std::vector<std::string> notesOf(const std::vector<ContactRecording>& recordings);

/// Recordings at one rate, and the list of them that a renderer takes; both live as long as this object,
/// which stays where it is. Any thread but R.
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
