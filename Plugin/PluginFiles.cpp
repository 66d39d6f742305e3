// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a file by its detected kind, writes and lists presets; and the part of PluginEditor that has to do
// with files and menus: opening, saving, exporting, undo, the menu of a parameter, and MIDI learn.
#include "PluginFiles.h"
#include "EditorParts.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NameList.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionFile.h"
#include "Parameters.h"
#include "PluginEditor.h"
#include "PluginSettings.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <utility>

namespace physvib {

namespace {

/// Level and strips of `state` as limits of what a file may set; actuator j is on channel j.
MixerLimits loudnessLimitsOf(const PluginState& state) {
    MixerLimits limits{parameterValue(state, Parameter::level), state.strips};
    resizeStrips(limits.strips, state.layout.geometry.count);
    for (std::size_t j = 0; j < limits.strips.size(); ++j) limits.strips[j].output = static_cast<int>(j);
    return limits;
}

/// Lowers `mix` to the limits and returns what was lowered, in words. A channel cannot be without output
/// here, so it is muted instead.
std::string lowerByChannel(const MixerLimits& limits, Mix& mix) {
    for (std::size_t j = 0; j < mix.strips.size(); ++j) mix.strips[j].output = static_cast<int>(j);
    std::string lowered = lowerToLimits(limits, mix);
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (std::exchange(mix.strips[j].output, static_cast<int>(j)) < 0) mix.strips[j].isMuted = true;
    return lowered;
}

std::string loweredNote(const std::filesystem::path& path, const std::string& lowered) {
    return lowered.empty() ? lowered : path.filename().string() + ": lowered to this instance: " + lowered;
}

PluginState toPluginState(const SavedSession& session, Mix mix, PluginState state) {
    setScene(state, *mix.scene);
    state.seed = mix.seed;
    state.stepsPerSecond = session.run.stepsPerSecond;
    state.layout = mix.layout;
    state.strips = MixerLimits::fromMix(mix).strips; // with groups and automation at their loudest
    state.equalised = session.equalised;
    state.limiterEnabled |= session.limiterEnabled;
    setParameter(state, Parameter::law, valueFromText(rowOf(Parameter::law), nameOf(mix.law)));
    setParameter(state, Parameter::exponent, mix.exponent);
    setParameter(state, Parameter::level, mix.levelDb);
    return state;
}

bool hasUnsupportedSettings(const SavedSession& session) {
    return session.shaping != EventShaping{} || !session.log.recordings.empty() ||
           !session.log.clips.empty() || session.run.timing != ImpactTiming::onset ||
           session.run.location != ImpactLocation::contact;
}

std::string lowerStrips(const MixerLimits& limits, PluginState& state, double& levelDb) {
    Mix mix;
    mix.layout = state.layout;
    mix.strips = state.strips;
    mix.levelDb = levelDb;
    auto lowered = lowerByChannel(limits, mix);
    state.strips = std::move(mix.strips);
    levelDb = mix.levelDb;
    return lowered;
}

/// Reads a preset. Its level, strips and limiter are lowered to those of this instance; strikes and music to
/// those of this instance or their defaults, whichever are louder.
Result<OpenedFile> openPreset(const std::filesystem::path& path, const PluginState& now) {
    const auto read = loadText(path, limits::maxSceneFileBytes, readPluginState);
    if (!read) return Failure{read.error};
    PluginState state = read.value;
    if (const auto error = parameterError(state); !error.empty())
        return Failure{path.string() + ": " + error};
    fitToLayout(state);
    double levelDb = parameterValue(state, Parameter::level);
    std::string lowered = lowerStrips(loudnessLimitsOf(now), state, levelDb);
    const auto addLowered = [&lowered](const char* what) {
        lowered += (lowered.empty() ? "" : "; ") + std::string{what};
    };
    setParameter(state, Parameter::level, levelDb);
    setParameter(state, Parameter::bypass, parameterValue(now, Parameter::bypass)); // SILENCE is the user's
    for (const auto& [which, defaultDb] :
         {std::pair{Parameter::strikeLevel, presetStrikeDb(state)}, {Parameter::music, 0.0}}) {
        const double maxDb = std::max(parameterValue(now, which), defaultDb);
        if (parameterValue(state, which) <= maxDb) continue;
        setParameter(state, which, maxDb);
        addLowered(which == Parameter::music ? "music" : "the strike level");
    }
    if (now.limiterEnabled && !state.limiterEnabled) {
        state.limiterEnabled = true;
        addLowered("the limiter stays on");
    }
    state.editorWidth = now.editorWidth;
    state.editorHeight = now.editorHeight;
    return OpenedFile{std::move(state), loweredNote(path, lowered)};
}

juce::File themeFile() { return presetFolder().getSiblingFile("look"); }

} // namespace

Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state) {
    switch (fileKind(path)) {
    case FileKind::scene: {
        auto scene = loadScene(path);
        if (!scene) return Failure{scene.error};
        setScene(state, std::move(scene.value));
        return OpenedFile{std::move(state), {}};
    }
    case FileKind::layout: {
        auto layout = loadLayout(path);
        if (!layout) return Failure{layout.error};
        MixerLimits limits = loudnessLimitsOf(state);
        state.layout = std::move(layout.value);
        fitToLayout(state);
        const std::string lowered = lowerStrips(limits, state, limits.levelDb);
        return OpenedFile{std::move(state), loweredNote(path, lowered)};
    }
    case FileKind::session: {
        const auto session = loadSession(path);
        if (!session) return Failure{session.error};
        Mix mix = mixAtEnd(session.value);
        std::string lowered = lowerByChannel(loudnessLimitsOf(state), mix);
        if (state.limiterEnabled && !session.value.limiterEnabled)
            lowered += lowered.empty() ? "the limiter stays on" : "; the limiter stays on";
        std::string note =
            hasUnsupportedSettings(session.value)
                ? path.filename().string() + ": its method, timing and recordings are not played here"
                : std::string{};
        if (!note.empty() && !lowered.empty()) note += "; ";
        note += loweredNote(path, lowered);
        return OpenedFile{toPluginState(session.value, std::move(mix), std::move(state)), note};
    }
    case FileKind::pluginState: return openPreset(path, state);
    case FileKind::unknown: break;
    }
    return Failure{path.string() +
                   ": expected a preset of the plug-in, a scene, a layout or a saved session"};
}

std::vector<juce::File> presetFiles(const juce::File& folder) {
    constexpr int maxListed = 500; // more would not fit a menu
    auto found = folder.findChildFiles(juce::File::findFiles, false, "*.json");
    found.sort();
    std::vector<juce::File> files{found.begin(), found.end()};
    if (files.size() > maxListed) files.resize(maxListed);
    return files;
}

std::string savePreset(PluginState state, const juce::File& file) {
    state.editorWidth = state.editorHeight = 0;
    if (const auto created = file.getParentDirectory().createDirectory(); created.failed())
        return file.getParentDirectory().getFullPathName().toStdString() + ": " +
               created.getErrorMessage().toStdString();
    return writeFile(file.getFullPathName().toStdString(), pluginStateJson(state));
}

Theme savedTheme() { return themeFile().loadFileAsString().trim() == "light" ? Theme::light : Theme::dark; }

void saveTheme(Theme theme) {
    if (themeFile().getParentDirectory().createDirectory().failed()) return; // then only this window has it
    const std::string word = theme == Theme::light ? "light\n" : "dark\n";
    (void)writeFile(themeFile().getFullPathName().toStdString(), word);
}

void PluginEditor::fillPresets() {
    scene_.clear(juce::dontSendNotification);
    scene_.addSectionHeading("Instruments");
    const auto& presets = presetNames();
    const auto worlds = static_cast<int>(builtInScenes().size());
    for (int i = worlds; i < static_cast<int>(presets.size()); ++i)
        scene_.addItem(fromUtf8(presets[static_cast<std::size_t>(i)]), i + 1);
    scene_.addSectionHeading("Worlds");
    for (int i = 0; i < worlds; ++i)
        scene_.addItem(fromUtf8(displayName(presets[static_cast<std::size_t>(i)])), i + 1);
    presets_ = presetFiles(presetFolder());
    if (!presets_.empty()) scene_.addSectionHeading("Your presets");
    for (int id = firstUserPreset; const auto& file : presets_)
        scene_.addItem(file.getFileNameWithoutExtension(), id++);
}

juce::PopupMenu PluginEditor::makeFilesMenu() {
    juce::PopupMenu menu;
    menu.addItem(fromUtf8("Open\xe2\x80\xa6"), [this] {
        chooseFile(chooser_, "A preset, a scene, a layout or a session", openFlags,
                   [this](const juce::File& file) { open(file); });
    });
    menu.addItem(fromUtf8("Save as a preset\xe2\x80\xa6"), [this] {
        (void)presetFolder().createDirectory(); // or the chooser begins elsewhere
        chooseFile(
            chooser_, "A preset", saveFlags, [this](const juce::File& file) { savePresetAs(file); },
            presetFolder().getChildFile(fromUtf8(state_.scene.name) + ".json"));
    });
    menu.addItem(
        fromUtf8("Export what was felt\xe2\x80\xa6"), plugin_.playedEvents().hasEvents(), false, [this] {
            chooseFile(
                chooser_, "MIDI, a list of events or a haptic file: " + fromUtf8(nameList(playedEndings())),
                saveFlags, [this](const juce::File& file) { exportPlayedAs(file); },
                juce::File::getSpecialLocation(juce::File::userHomeDirectory).getChildFile("felt.mid"),
                "*" + fromUtf8(joinNames(playedEndings(), ";*")));
        });
    menu.addSeparator();
    using Direction = PluginProcessor::Direction;
    const auto addStep = [&](const juce::String& words, Direction direction) {
        menu.addItem(words, plugin_.canStep(direction), false, [this, direction] { stepHistory(direction); });
    };
    addStep("Undo", Direction::undo);
    addStep("Redo", Direction::redo);
    addStep(plugin_.isAtB() ? "Compare: back to A" : "Compare: go to B", Direction::exchange);
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
    return menu;
}

void PluginEditor::stepHistory(PluginProcessor::Direction direction) {
    message_.clear();
    plugin_.stepHistory(direction);
}

void PluginEditor::savePresetAs(const juce::File& file) {
    const auto name = file.hasFileExtension("json") ? file.getFileNameWithoutExtension() : file.getFileName();
    const auto target = file.getSiblingFile(name + ".json");
    if (target != file && target.exists()) // the chooser has asked only about `file`
        return report(target.getFileName() + " exists: choose it in the list to replace it");
    const std::string error = savePreset(plugin_.state(), target);
    report(error.empty() ? target.getFileName() + " is saved" : fromUtf8(error));
    fillPresets();
    stateChanged();
}

void PluginEditor::exportPlayedAs(const juce::File& file) {
    plugin_.drainEvents();
    const auto state = plugin_.state();
    const auto events = plugin_.playedEvents().events(state.transport == TransportMode::free);
    const auto value = [this](Parameter p) { return plugin_.parameter(p).value(); };
    const auto written = exportPlayed(
        {events, state, makePanner(state, lawFromValue(value(Parameter::law)), value(Parameter::exponent))},
        file.getFullPathName().toStdString());
    const auto dropped = plugin_.playedEvents().droppedCount();
    const juce::String droppedNote =
        dropped > 0 ? ", without " + juce::String{dropped} + " earlier ones, which had no room" : "";
    report(written ? fromUtf8(written.value).trim() + droppedNote : fromUtf8(written.error));
}

juce::PopupMenu PluginEditor::makeMenu(HostParameter& parameter, const std::function<void()>& editValue) {
    juce::PopupMenu menu;
    std::unique_ptr<juce::HostProvidedContextMenu> hostMenu;
    if (auto* const context = getHostContext()) hostMenu = context->getContextMenuForParameter(&parameter);
    if (hostMenu) menu = hostMenu->getEquivalentPopupMenu();
    if (menu.getNumItems() > 0) menu.addSeparator();
    const Parameter which = parameter.row().parameter;
    menu.addItem("Back to " + parameter.getText(parameter.getDefaultValue(), 0), [&parameter] {
        parameter.beginChangeGesture();
        parameter.setValueNotifyingHost(parameter.getDefaultValue());
        parameter.endChangeGesture();
    });
    if (editValue) menu.addItem("Type a value", editValue);
    menu.addItem("Learn a controller: move it now", true, learningParameter_ == static_cast<int>(which),
                 [this, which] { learn(which); });
    for (const auto& rule : state_.controllers)
        if (rule.parameter == parameter.row().id)
            menu.addItem("Forget controller " + juce::String{rule.controller}, [this, rule] {
                edit([&rule](PluginState& s) { std::erase(s.controllers, rule); });
            });
    return menu;
}

void PluginEditor::showMenu(juce::PopupMenu menu, juce::Component* below) {
    const auto at = juce::PopupMenu::Options{}.withTargetComponent(below ? below : this);
    menu.setLookAndFeel(&look_);
    menu.showMenuAsync((below ? at : at.withMousePosition()).withDeletionCheck(*this));
}

void PluginEditor::learn(Parameter which) {
    learningParameter_ = static_cast<int>(which);
    controllerBeforeLearning_ = plugin_.lastController();
    report("Move a controller: it will move " + fromUtf8(rowOf(which).name));
}

// Adds the rule, and removes others of this parameter or this controller.
void PluginEditor::finishLearning() {
    const std::uint32_t last = plugin_.lastController();
    if (learningParameter_ < 0 || last == controllerBeforeLearning_) return;
    const auto& row = rowOf(static_cast<Parameter>(std::exchange(learningParameter_, -1)));
    const int controller = PluginProcessor::controllerOf(last);
    edit([&row, controller](PluginState& s) {
        std::erase_if(s.controllers, [&row, controller](const ControllerRule& rule) {
            return rule.parameter == row.id || rule.controller == controller;
        });
        s.controllers.push_back({controller, std::string{row.id}});
    });
    report("Controller " + juce::String{controller} + " moves " + fromUtf8(row.name) +
           " over its whole range");
}

void PluginEditor::open(const juce::File& file) {
    auto opened = openFile(file.getFullPathName().toStdString(), plugin_.state());
    report(opened ? fromUtf8(opened.value.note) : fromUtf8(opened.error));
    if (opened) plugin_.open(std::move(opened.value.state));
}

} // namespace physvib
