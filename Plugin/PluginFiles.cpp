// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a file by its detected kind; writes and lists presets. Menus of the plug-in's window: opening, saving
// and exporting files, and MIDI learn.
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

/// Level and strips of this instance as limits; actuator j is on channel j.
DeskLimits limitsOf(const PluginState& state) {
    DeskLimits limits{valueIn(state, Parameter::level), state.strips};
    resizeStrips(limits.strips, state.layout.geometry.count);
    for (std::size_t j = 0; j < limits.strips.size(); ++j) limits.strips[j].output = static_cast<int>(j);
    return limits;
}

/// The same of a file's mix; a channel cannot be left out, so it is muted. What was lowered.
std::string lowerByChannel(const DeskLimits& limits, Mix& mix) {
    for (std::size_t j = 0; j < mix.strips.size(); ++j) mix.strips[j].output = static_cast<int>(j);
    std::string lowered = lowerTo(limits, mix);
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (std::exchange(mix.strips[j].output, static_cast<int>(j)) < 0) mix.strips[j].isMuted = true;
    return lowered;
}

std::string noteOf(const std::filesystem::path& path, const std::string& lowered) {
    return lowered.empty() ? lowered : path.filename().string() + ": lowered to this instance: " + lowered;
}

PluginState leftBy(const SavedSession& session, Mix mix, PluginState state) {
    useScene(state, *mix.scene);
    state.seed = mix.seed;
    state.stepsPerSecond = session.run.stepsPerSecond;
    state.layout = mix.layout;
    state.strips = DeskLimits::of(mix).strips; // groups and lanes at their loudest: a host has its own
    state.equalised = session.equalised;
    state.limiterEnabled |= session.limiterEnabled;
    setParameter(state, Parameter::law, valueOf(rowOf(Parameter::law), nameOf(mix.law)));
    setParameter(state, Parameter::exponent, mix.exponent);
    setParameter(state, Parameter::level, mix.levelDb);
    return state;
}

bool isPlayedOtherwise(const SavedSession& session) {
    return session.shaping != EventShaping{} || !session.log.recordings.empty() ||
           !session.log.clips.empty() || session.run.timing != ImpactTiming::onset ||
           session.run.location != ImpactLocation::contact;
}

std::string lowerStrips(const DeskLimits& limits, PluginState& state, double& levelDb) {
    Mix mix;
    mix.layout = state.layout;
    mix.strips = state.strips;
    mix.levelDb = levelDb;
    auto lowered = lowerByChannel(limits, mix);
    state.strips = std::move(mix.strips);
    levelDb = mix.levelDb;
    return lowered;
}

/// A preset sounds as it is meant, up to the level, the strips and the limiter of this instance; strikes and
/// music up to what they are here or what is usual.
Result<OpenedFile> openPreset(const std::filesystem::path& path, const PluginState& now) {
    const auto read = loadText(path, limits::maxSceneFileBytes, readPluginState);
    if (!read) return Failure{read.error};
    PluginState state = read.value;
    if (const auto fault = faultOfParameters(state); !fault.empty())
        return Failure{path.string() + ": " + fault};
    fitToLayout(state);
    double levelDb = valueIn(state, Parameter::level);
    std::string lowered = lowerStrips(limitsOf(now), state, levelDb);
    const auto also = [&lowered](const char* what) {
        lowered += (lowered.empty() ? "" : "; ") + std::string{what};
    };
    setParameter(state, Parameter::level, levelDb);
    for (const auto& [which, usual] :
         {std::pair{Parameter::strikeLevel, usualStrikeDb(state)}, {Parameter::music, 0.0}}) {
        const double most = std::max(valueIn(now, which), usual);
        if (valueIn(state, which) <= most) continue;
        setParameter(state, which, most);
        also(which == Parameter::music ? "music" : "the strike level");
    }
    if (now.limiterEnabled && !state.limiterEnabled) {
        state.limiterEnabled = true;
        also("the limiter stays on");
    }
    state.editorWidth = now.editorWidth;
    state.editorHeight = now.editorHeight;
    return OpenedFile{std::move(state), noteOf(path, lowered)};
}

juce::File lookFile() { return presetFolder().getSiblingFile("look"); }

} // namespace

Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state) {
    switch (fileKind(path)) {
    case FileKind::scene: {
        auto scene = loadScene(path);
        if (!scene) return Failure{scene.error};
        useScene(state, std::move(scene.value));
        return OpenedFile{std::move(state), {}};
    }
    case FileKind::layout: {
        auto layout = loadLayout(path);
        if (!layout) return Failure{layout.error};
        DeskLimits limits = limitsOf(state);
        state.layout = std::move(layout.value);
        fitToLayout(state);
        const std::string lowered = lowerStrips(limits, state, limits.levelDb);
        return OpenedFile{std::move(state), noteOf(path, lowered)};
    }
    case FileKind::session: {
        const auto session = loadSession(path);
        if (!session) return Failure{session.error};
        Mix mix = mixOf(session.value);
        std::string lowered = lowerByChannel(limitsOf(state), mix);
        if (state.limiterEnabled && !session.value.limiterEnabled)
            lowered += lowered.empty() ? "the limiter stays on" : "; the limiter stays on";
        std::string note =
            isPlayedOtherwise(session.value)
                ? path.filename().string() + ": its method, timing and recordings are not played here"
                : std::string{};
        if (!note.empty() && !lowered.empty()) note += "; ";
        note += noteOf(path, lowered);
        return OpenedFile{leftBy(session.value, std::move(mix), std::move(state)), note};
    }
    case FileKind::pluginState: return openPreset(path, state);
    case FileKind::unknown: break;
    }
    return Failure{path.string() +
                   ": expected a preset of the plug-in, a scene, a layout or a saved session"};
}

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

Theme savedTheme() { return lookFile().loadFileAsString().trim() == "light" ? Theme::light : Theme::dark; }

void saveTheme(Theme theme) {
    if (lookFile().getParentDirectory().createDirectory().failed()) return; // it lasts as long as the window
    const std::string word = theme == Theme::light ? "light\n" : "dark\n";
    (void)writeFile(lookFile().getFullPathName().toStdString(), word);
}

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
    menu.addItem(words("Open\xe2\x80\xa6"), [this] {
        askFile(chooser_, "A preset, a scene, a layout or a session", toOpen,
                [this](const juce::File& file) { open(file); });
    });
    menu.addItem(words("Save as a preset\xe2\x80\xa6"), [this] {
        (void)presetFolder().createDirectory(); // or the chooser begins elsewhere
        askFile(
            chooser_, "A preset", toSave, [this](const juce::File& file) { savePresetAs(file); },
            presetFolder().getChildFile(words(state_.scene.name) + ".json"));
    });
    menu.addItem(words("Export what was felt\xe2\x80\xa6"), plugin_.felt().areThere(), false, [this] {
        askFile(
            chooser_, "MIDI, a list of events or a haptic file: " + words(listed(feltEndings())), toSave,
            [this](const juce::File& file) { exportFeltAs(file); },
            juce::File::getSpecialLocation(juce::File::userHomeDirectory).getChildFile("felt.mid"),
            "*" + words(joined(feltEndings(), ";*")));
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

// The host's own menu for this parameter, then our entries.
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
            menu.addItem("Forget controller " + juce::String{rule.controller}, [this, id] {
                edit([&id](PluginState& s) {
                    std::erase_if(s.controllers, [&id](const auto& other) { return other.parameter == id; });
                });
            });
    menu.setLookAndFeel(&look_);
    menu.showMenuAsync(
        juce::PopupMenu::Options{}.withTargetComponent(this).withMousePosition().withDeletionCheck(*this));
}

void PluginEditor::learn(Parameter which) {
    learning_ = static_cast<int>(which);
    learnsAfter_ = plugin_.lastController();
    report("Move a controller: it will move " + words(rowOf(which).name));
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

void PluginEditor::open(const juce::File& file) {
    auto opened = openFile(file.getFullPathName().toStdString(), plugin_.state());
    report(opened ? words(opened.value.note) : words(opened.error));
    if (opened) plugin_.open(std::move(opened.value.state));
}

} // namespace physvib
