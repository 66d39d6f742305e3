// SPDX-License-Identifier: GPL-3.0-or-later
// Exports the selected contacts of the events list to files.
#include "Mixer/Desk/UserFolder.h"
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Window/CardHost.h"
#include <algorithm>
#include <limits>

namespace physvib {

void EventsTab::showMenu() {
    juce::PopupMenu menu;
    menu.addItem("Save as clip" + dots(), [safe = juce::Component::SafePointer<EventsTab>{this}] {
        if (safe != nullptr) safe->saveAs();
    });
    menu.showMenuAsync(juce::PopupMenu::Options{}.withMousePosition());
}

/// From the scene's name and the time of the first contact.
juce::String EventsTab::fileName() const {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const RecentContact& contact : shown_)
        if (isChosen(contact)) first = std::min(first, contact.event.timeNs);
    return juce::File::createLegalFileName(utf8(desk_.mix().scene->name) + "-" +
                                           juce::String{1e-9 * static_cast<double>(first), 3} + "s") +
           hitEndings()[files_->ending()];
}

void EventsTab::saveAs() {
    if (chosen_.empty()) return;
    const auto folder = juce::SharedResourcePointer<UserFolder> {
        } -> place();
    const auto name = juce::File::createFileWithoutCheckingPath("/" + fileName());
    askForFile(*this,
               {"Save the chosen contacts as a clip", name.getFileExtension(), folder, true,
                name.getFileNameWithoutExtension(), hitEndings()},
               [this](const juce::File& file) { saveTo(file); });
}

std::vector<juce::File> EventsTab::write(const juce::File& file, bool tellsHow) {
    std::vector<CollisionEvent> hits;
    for (const RecentContact& contact : shown_)
        if (isChosen(contact)) desk_.recent().appendEvents(contact, hits);
    const auto written =
        writeHits(std::move(hits), desk_.mix(), std::max(8000, desk_.output().sampleRateHz()), file);
    if (!written) return desk_.report(utf8(written.error)), std::vector<juce::File>{};
    std::vector<juce::File> files;
    for (const auto& path : written.value.paths) files.emplace_back(utf8(path));
    juce::StringArray words{"Saved " + files.front().getFullPathName() +
                            (files.size() > 1
                                 ? " and " + juce::String{static_cast<int>(files.size()) - 1} + " more"
                                 : juce::String{})};
    for (const auto& loss : written.value.losses) words.add(utf8(loss));
    if (tellsHow) desk_.tell(words.joinIntoString("; "));
    return files;
}

void EventsTab::saveTo(const juce::File& file) {
    write(file.getFileExtension().isEmpty() ? file.withFileExtension(hitEndings()[files_->ending()]) : file,
          true);
}

// As escaped URLs, which the drop target receives.
juce::StringArray EventsTab::filesToDrag() {
    juce::StringArray addresses;
    if (chosen_.empty()) return addresses;
    const auto folder = files_->makeFolder();
    if (!folder) return desk_.report(utf8(folder.error)), addresses;
    for (const auto& file : write(folder.value.getChildFile(fileName()), false))
        addresses.add(juce::URL{file}.toString(false));
    return addresses;
}

} // namespace physvib
