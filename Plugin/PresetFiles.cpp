// SPDX-License-Identifier: GPL-3.0-or-later
// Writing and listing presets; OpenedFile.cpp reads them.
#include "PresetFiles.h"
#include "Io/Disk/AtomicFile.h"

namespace physvib {

std::vector<juce::File> presetFiles(const juce::File& folder) {
    constexpr int mostListed = 500; // a menu
    auto found = folder.findChildFiles(juce::File::findFiles, false, "*.json");
    found.sort();
    std::vector<juce::File> files{found.begin(), found.end()};
    if (files.size() > mostListed) files.resize(mostListed);
    return files;
}

std::string savePreset(PluginState state, const juce::File& file) {
    state.editorWidth = state.editorHeight = 0;
    if (const auto made = file.getParentDirectory().createDirectory(); made.failed())
        return file.getParentDirectory().getFullPathName().toStdString() + ": " +
               made.getErrorMessage().toStdString();
    return writeFile(file.getFullPathName().toStdString(), pluginStateJson(state));
}

namespace {

juce::File lookFile() { return presetFolder().getSiblingFile("look"); }

} // namespace

Ground savedGround() {
    return lookFile().loadFileAsString().trim() == "light" ? Ground::light : Ground::dark;
}

void saveGround(Ground ground) {
    if (lookFile().getParentDirectory().createDirectory().failed()) return; // it lasts as long as the window
    const std::string word = ground == Ground::light ? "light\n" : "dark\n";
    (void)writeFile(lookFile().getFullPathName().toStdString(), word);
}

} // namespace physvib
