// SPDX-License-Identifier: GPL-3.0-or-later
// Labels, backgrounds and distances common to the parts of the editor.
#pragma once
#include "Host/Views/Look.h"
#include <memory>

namespace physvib {

constexpr int panelInset = 12, panelGap = 8;
constexpr auto number = readable::numberString;

constexpr int openFlags = juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
              saveFlags = juce::FileBrowserComponent::saveMode | juce::FileBrowserComponent::canSelectFiles |
                          juce::FileBrowserComponent::warnAboutOverwriting;

/// Asks for a file `openFlags` or `saveFlags`, and hands it to `onFile`; `chooser` lives as long as its
/// window. M.
template <class OnFile>
void chooseFile(std::unique_ptr<juce::FileChooser>& chooser, const juce::String& title, int flags,
                OnFile onFile, const juce::File& initial = {}, const juce::String& endings = "*.json") {
    chooser = std::make_unique<juce::FileChooser>(title, initial, endings, false);
    chooser->launchAsync(flags, [onFile](const juce::FileChooser& chosen) {
        if (const auto file = chosen.getResult(); file != juce::File{}) onFile(file);
    });
}

/// Fills a panel with rounded corners. M.
inline void fillPanel(juce::Graphics& g, const juce::Component& component, juce::Rectangle<int> area) {
    g.setColour(shade(component, Shade::panel));
    g.fillRoundedRectangle(area.toFloat(), 8.0f);
}

} // namespace physvib
