// SPDX-License-Identifier: MIT
// Recordings of contacts, as read from files and resampled to the renderer's rate.
#pragma once
#include "Core/RenderControl.h"
#include "Live/Documents/RecordingFile.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// A recording from its onset on, with its original level.
struct ContactRecording {
    double frequencyHz = 0.0; ///< of the events that play it, unless its file names a material
    int sampleRateHz = 0;
    std::vector<float> samples;
    RecordingFile file{}; ///< its file, with hash
    std::string note{};   ///< a line for the user on what reading has removed; usually empty
    bool operator==(const ContactRecording&) const = default;
};

/// The files of recordings. Any thread.
std::vector<RecordingFile> filesOf(const std::vector<ContactRecording>& recordings);

/// Their notes, without duplicates. Any thread.
std::vector<std::string> notesOf(const std::vector<ContactRecording>& recordings);

/// Recordings at one rate, and the list of them for a renderer. Both are valid as long as this object, which
/// must not move meanwhile. Any thread but the render thread (R).
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
