// SPDX-License-Identifier: GPL-3.0-or-later
// Never the working directory, which may be anything when a program is started from a menu.
#include "Mixer/Desk/UserFolder.h"

namespace physvib {
namespace {

constexpr const char* folderName = "PhysVib";

/// Whether it can be written, or created in the nearest folder above it that exists.
bool canBeWritten(juce::File folder) {
    while (!folder.exists() && folder.getParentDirectory() != folder) folder = folder.getParentDirectory();
    return folder.isDirectory() && folder.hasWriteAccess();
}

} // namespace

juce::Array<juce::File> UserFolder::candidates() const {
    juce::Array<juce::File> all;
    if (chosen_ != juce::File{}) all.add(chosen_);
    for (const auto where : {juce::File::userDocumentsDirectory, juce::File::userHomeDirectory})
        all.add(juce::File::getSpecialLocation(where).getChildFile(folderName));
    return all;
}

juce::File UserFolder::place() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder)) return folder;
    return {};
}

Result<juce::File> UserFolder::make() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder) && folder.createDirectory().wasOk()) return folder;
    return Failure{candidates().getFirst().getFullPathName().toStdString() +
                   ": expected a folder that can be written"};
}

Result<juce::File> UserFolder::fresh(const juce::String& name, const juce::StringArray& endings) const {
    const auto folder = make();
    if (!folder) return folder;
    for (int k = 1;; ++k) {
        const auto numbered = name + (k == 1 ? juce::String{} : "-" + juce::String{k});
        bool isTaken = false;
        for (const auto& ending : endings)
            isTaken = isTaken || folder.value.getChildFile(numbered + ending).exists();
        if (!isTaken) return folder.value.getChildFile(numbered + endings[0]);
    }
}

} // namespace physvib
