// SPDX-License-Identifier: GPL-3.0-or-later
// The folder for what the mixer makes: recordings, movies, sessions and studies.
#pragma once
#include "Io/Result.h"
#include <juce_core/juce_core.h>

namespace physvib {

/// One for all windows of the process, as a juce::SharedResourcePointer. Message thread only.
class UserFolder {
public:
    /// The user's choice; without one, or where it cannot be written: PhysVib in the documents, else in the
    /// home folder.
    void choose(const juce::File& folder) { chosen_ = folder; }
    const juce::File& chosen() const noexcept { return chosen_; }

    /// The first of these that can be written or created; an empty file if none can.
    juce::File place() const;

    /// The same, created if missing; or one line with the reason.
    Result<juce::File> make() const;

    /// A file in it: no file has its name with any of `endings`, such as ".wav". It has the first of them.
    Result<juce::File> fresh(const juce::String& name, const juce::StringArray& endings) const;

private:
    juce::Array<juce::File> candidates() const;

    juce::File chosen_;
};

} // namespace physvib
