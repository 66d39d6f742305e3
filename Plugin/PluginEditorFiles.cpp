// SPDX-License-Identifier: GPL-3.0-or-later
// Menus of the plug-in's window: opening, saving and exporting files, and MIDI learn.
#include "EditorParts.h"
#include "Io/Text/NameList.h"
#include "PluginEditor.h"
#include "PluginFiles.h"
#include "PluginSettings.h"
#include "Scene/SceneFile.h"
#include <utility>

namespace physvib {

void PluginEditor::fillPresets() {
    const auto shown = scene_.getText();
    scene_.clear(juce::dontSendNotification);
    scene_.addSectionHeading("Instruments");
    const auto& presets = presetNames();
    const auto worlds = static_cast<int>(builtInScenes().size());
    for (int i = worlds; i < static_cast<int>(presets.size()); ++i)
        scene_.addItem(words(presets[static_cast<std::size_t>(i)]), i + 1);
    scene_.addSectionHeading("Worlds");
    for (int i = 0; i < worlds; ++i)
        scene_.addItem(words(shownName(presets[static_cast<std::size_t>(i)])), i + 1);
    presets_ = presetFiles(presetFolder());
    if (!presets_.empty()) scene_.addSectionHeading("Your presets");
    for (int id = firstOwnPreset; const auto& file : presets_)
        scene_.addItem(file.getFileNameWithoutExtension(), id++);
    scene_.setText(shown, juce::dontSendNotification);
}

void PluginEditor::showFiles() {
    juce::PopupMenu menu;
    menu.addItem(juce::String::fromUTF8("Open\xe2\x80\xa6"), [this] { askFile(); });
    menu.addItem(juce::String::fromUTF8("Save as a preset\xe2\x80\xa6"), [this] {
        askSave("A preset", presetFolder().getChildFile(words(state_.scene.name) + ".json"), "*.json",
                &PluginEditor::savePresetAs);
    });
    menu.addItem(
        juce::String::fromUTF8("Export what was felt\xe2\x80\xa6"), plugin_.felt().areThere(), false, [this] {
            askSave("MIDI, a list of events or a haptic file: " + words(listed(feltEndings())),
                    juce::File::getSpecialLocation(juce::File::userHomeDirectory).getChildFile("felt.mid"),
                    "*" + words(joined(feltEndings(), ";*")), &PluginEditor::exportFeltAs);
        });
    menu.addSeparator();
    using Step = PluginProcessor::Step;
    const auto addStep = [&](const juce::String& words, Step step) {
        menu.addItem(words, plugin_.can(step), false, [this, step] { go(step); });
    };
    addStep("Undo", Step::undo);
    addStep("Redo", Step::redo);
    addStep(plugin_.isAtB() ? "Compare: back to A" : "Compare: go to B", Step::exchange);
    menu.addSeparator();
    menu.addItem("About PhysVib", [this] {
        report("PhysVib " PHYSVIB_VERSION
               ", GPL-3.0-or-later; JUCE 7, Box2D and others: LICENSES. Help: Docs/plugin.md");
    });
    const bool isLight = look_.theme() == Theme::light;
    menu.addItem("Light window", true, isLight, [this, isLight] {
        setTheme(isLight ? Theme::dark : Theme::light);
        saveTheme(look_.theme());
    });
    menu.setLookAndFeel(&look_);
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(files_).withDeletionCheck(*this));
}

void PluginEditor::go(PluginProcessor::Step step) {
    news_.clear();
    plugin_.go(step);
}

void PluginEditor::askSave(const juce::String& title, const juce::File& initial, const juce::String& endings,
                           void (PluginEditor::*save)(const juce::File&)) {
    // or the chooser begins elsewhere
    if (endings == "*.json") (void)initial.getParentDirectory().createDirectory();
    chooser_ = std::make_unique<juce::FileChooser>(title, initial, endings, false);
    using Browser = juce::FileBrowserComponent;
    chooser_->launchAsync(Browser::saveMode | Browser::canSelectFiles | Browser::warnAboutOverwriting,
                          [this, save](const juce::FileChooser& chooser) {
                              if (const auto file = chooser.getResult(); file != juce::File{})
                                  (this->*save)(file);
                          });
}

void PluginEditor::savePresetAs(const juce::File& file) {
    const auto target = file.withFileExtension("json");
    const std::string error = savePreset(plugin_.state(), target);
    report(error.empty() ? target.getFileName() + " is saved" : words(error));
    fillPresets();
}

void PluginEditor::exportFeltAs(const juce::File& file) {
    plugin_.drainEvents();
    const auto state = plugin_.state();
    const auto events = plugin_.felt().events(state.transport == TransportMode::free);
    const auto value = [this](Parameter p) { return plugin_.parameter(p).value(); };
    const auto written =
        exportFelt({events, state, pannerOf(state, lawOf(value(Parameter::law)), value(Parameter::exponent))},
                   file.getFullPathName().toStdString());
    const auto leftOut = plugin_.felt().leftOut();
    const juce::String without =
        leftOut > 0 ? ", without " + juce::String{leftOut} + " earlier ones, which had no room" : "";
    report(written ? words(written.value).trim() + without : words(written.error));
}

// What the host has for this parameter, and below it what is ours.
void PluginEditor::showMenu(HostParameter& parameter, const std::function<void()>& type) {
    juce::PopupMenu menu;
    std::unique_ptr<juce::HostProvidedContextMenu> hosts;
    if (auto* const context = getHostContext()) hosts = context->getContextMenuForParameter(&parameter);
    if (hosts) menu = hosts->getEquivalentPopupMenu();
    if (menu.getNumItems() > 0) menu.addSeparator();
    const Parameter which = parameter.row().parameter;
    menu.addItem("Back to " + parameter.getText(parameter.getDefaultValue(), 0), [&parameter] {
        parameter.beginChangeGesture();
        parameter.setValueNotifyingHost(parameter.getDefaultValue());
        parameter.endChangeGesture();
    });
    if (type) menu.addItem("Type a value", type);
    menu.addItem("Learn a controller: move it now", true, learning_ == static_cast<int>(which),
                 [this, which] { learn(which); });
    const std::string id{parameter.row().id};
    for (const auto& rule : state_.controllers)
        if (rule.parameter == id)
            menu.addItem("Forget controller " + juce::String{rule.controller},
                         [this, id] { forgetController(id); });
    menu.setLookAndFeel(&look_);
    menu.showMenuAsync(
        juce::PopupMenu::Options{}.withTargetComponent(this).withMousePosition().withDeletionCheck(*this));
}

void PluginEditor::learn(Parameter which) {
    learning_ = static_cast<int>(which);
    learnsAfter_ = plugin_.lastController();
    report("Move a controller: it will move " + words(rowOf(which).name));
}

void PluginEditor::forgetController(const std::string& parameter) {
    edit([&parameter](PluginState& s) {
        std::erase_if(s.controllers,
                      [&parameter](const ControllerRule& rule) { return rule.parameter == parameter; });
    });
}

// A controller moves one parameter, and a parameter learned anew has one controller.
void PluginEditor::followLearning() {
    const std::uint32_t last = plugin_.lastController();
    if (learning_ < 0 || last == learnsAfter_) return;
    const auto& row = rowOf(static_cast<Parameter>(std::exchange(learning_, -1)));
    const int controller = PluginProcessor::controllerOf(last);
    edit([&row, controller](PluginState& s) {
        std::erase_if(s.controllers, [&row, controller](const ControllerRule& rule) {
            return rule.parameter == row.id || rule.controller == controller;
        });
        s.controllers.push_back({controller, std::string{row.id}});
    });
    report("Controller " + juce::String{controller} + " moves " + words(row.name) + " over its whole range");
}

void PluginEditor::askFile() {
    chooser_ = std::make_unique<juce::FileChooser>("A preset, a scene, a layout or a session", juce::File{},
                                                   "*.json", false);
    chooser_->launchAsync(juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                          [this](const juce::FileChooser& chooser) {
                              if (const auto file = chooser.getResult(); file != juce::File{}) open(file);
                          });
}

void PluginEditor::open(const juce::File& file) {
    auto opened = openFile(file.getFullPathName().toStdString(), plugin_.state());
    report(opened ? words(opened.value.note) : words(opened.error));
    if (opened) plugin_.open(std::move(opened.value.state));
}

} // namespace physvib
