// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's window: document, settings, keys and menu.
#include "Mixer/Window/MixerWindow.h"
#include "Core/Limits.h"
#include "Host/Views/DisplayScale.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/NoDevice.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <array>

namespace physvib {
namespace {

// in the order of OscUse
constexpr std::array<const char*, 3> oscUseNames{"off", "this-computer", "any-computer"};

OscUse oscUseNamed(const juce::String& name) {
    const auto found = std::ranges::find(oscUseNames, name.toStdString());
    return found == oscUseNames.end() ? OscUse::off : static_cast<OscUse>(found - oscUseNames.begin());
}

constexpr const char* chosenSetting = "device-chosen"; // the user has chosen a device, or none
constexpr const char* silentSetting = "silent";
constexpr const char* folderSetting = "files-folder"; // of recordings and documents; empty: UserFolder's own
constexpr const char* displayWidthSetting = "display-width-mm"; // 0: as the system reports
/// Size of borders and title bar; the exact size is known only after the window exists.
constexpr juce::Point<int> frameRoom{8, 40};
constexpr auto command = juce::ModifierKeys::commandModifier, shift = juce::ModifierKeys::shiftModifier;

} // namespace

MixerWindow::MixerWindow(AudioDrivers drivers, const juce::String& device, const juce::File& file,
                         const juce::File& folder)
    : juce::DocumentWindow{"PhysVib mixer", palette::ground, allButtons, false}
    , drivers_{std::move(drivers)}
    , files_{folder} {
    auto& settings = files_.settings();
    device_ = {
        device.isNotEmpty()
            ? device.toStdString()
            : settings.getValue("device", juce::String{noDeviceType} + ":" + noDeviceName).toStdString(),
        settings.getIntValue("rate"), settings.getIntValue("block")};
    if (const int left = settings.getIntValue("monitor-left"), right = settings.getIntValue("monitor-right");
        left > 0 && right > 0)
        device_.monitor = {left - 1, right - 1};
    device_.monitorDb = settings.getDoubleValue("monitor-db", safeContactDb);
    device_.marker = settings.getIntValue("marker") - 1;
    device_.isHeadphones = device.isEmpty() && settings.getBoolValue("headphones");
    for (const SinkKind& kind : sinkKinds())
        device_.want(kind, settings.getValue(kind.setting.data()).toStdString());
    folder_->choose(juce::File::createFileWithoutCheckingPath(settings.getValue(folderSetting)));
    dragged_->setEnding(std::max(0, hitEndings().indexOf(settings.getValue("clip-ending"))));
    setUsingNativeTitleBar(true);
    const bool endedBadly = !files_.copies().leftBehind().empty();
    if (endedBadly) before_ = files_.limits();
    start(file);
    setResizable(true, false);
    setResizeLimits(MixerView::leastWidth, MixerView::leastHeight, 7680, 4320);
    applyZoom();
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()) {
        const auto room = display->userArea;
        centreWithSize(std::min(1440, room.getWidth() - frameRoom.x),
                       std::min(900, room.getHeight() - frameRoom.y));
    }
    addToDesktop();
    setVisible(true);
    view_->grabKeyboardFocus();
    const auto& chosen = settings.getValue("device");
    const bool isFirst = device.isEmpty() && !settings.getBoolValue(chosenSetting) &&
                         (chosen.isEmpty() || chosen.startsWith(juce::String{noDeviceType} + ":"));
    if (isFirst && !endedBadly)
        juce::MessageManager::callAsync([safe = juce::Component::SafePointer<MixerWindow>{this}] {
            if (safe != nullptr) safe->showFirstStart();
        });
    tellInstead();
    offerRecovery();
    if (!isFirst && !endedBadly) showHintOnce(); // else after the questions
    if (!files_.settingsFault().empty()) desk_->messages().add({utf8(files_.settingsFault())});
    startTimer(500);
}

MixerWindow::~MixerWindow() {
    stopTimer();
    files_.settings().setValue(silentSetting, desk_->isSilent());
    files_.setLimits(limits());
    files_.setExposureToday(desk_->exposure().squareGSeconds(), true);
    rendering_.reset();
    clearContentComponent();
    view_.reset();
    desk_.reset();
}

// A document gets a new Desk: its session starts at 0, without undo steps.
void MixerWindow::play(Mix mix, const juce::File& document, bool isPaused) {
    const bool wasSilent = desk_ ? desk_->isSilent() : files_.settings().getBoolValue(silentSetting);
    const bool wasAsked = view_ && view_->question() != nullptr;
    const double exposure = desk_ ? desk_->exposure().squareGSeconds() : files_.exposureToday();
    asked_.reset();
    clearContentComponent();
    view_.reset();
    desk_.reset();
    desk_ = std::make_unique<Desk>(drivers_, device_, std::move(mix), DeskStart{wasSilent, isPaused});
    desk_->exposure().goOnFrom(exposure);
    view_ = std::make_unique<MixerView>(*desk_);
    view_->setProgress(rendering_.get()); // of another session, which goes on
    setContentNonOwned(view_.get(), getWidth() == 0);
    document_ = document;
    savedEdits_ = desk_->edits();
    view_->topBar().onMenu = [this](juce::Component& from) { showMenu(from); };
    view_->topBar().onRecord = [this] { record(); };
    view_->topBar().onSave = [this] { save(); };
    desk_->device().onSinksWanted =
        [safe = juce::Component::SafePointer<MixerWindow>{this}](const DeviceChoice& choice) {
            juce::MessageManager::callAsync([safe, choice] { // asynchronous, because the calling tab is
                                                             // destroyed with its Desk
                if (safe != nullptr) safe->useSinks(choice);
            });
        };
    view_->topBar().onOpenScene = [this] { import("Scene"); };
    view_->topBar().setOwnScenes(files_.ownScenes());
    view_->topBar().onOwnScene = [this](const juce::File& own) { openFile(own); };
    desk_->recording().onEnd = [this](const juce::File& file, const juce::String& error) {
        lastRecording_ = file;
        view_->topBar().setRecording(false);
        if (error.isEmpty())
            tellSaved("Recorded, with its events beside it:", file);
        else
            say(file.getFileName() + ": " + error);
    };
    OscChoice osc{oscUseNamed(files_.settings().getValue("osc")),
                  files_.settings().getValue("osc-to").toStdString(),
                  files_.settings().getDoubleValue("osc-turn")};
    if (const auto error = desk_->inputs().use(osc); !error.empty()) {
        osc.receiver.clear(); // the host name cannot be resolved now
        desk_->inputs().use(osc);
        desk_->report("OSC: " + utf8(error));
    }
    desk_->setDisplayWidth(1e-3 * files_.settings().getDoubleValue(displayWidthSetting));
    view_->setGround(files_.settings().getValue("look") == "light" ? Ground::light : Ground::dark);
    view_->setDividers(Dividers::of(files_.settings().getValue("panels")));
    view_->grabKeyboardFocus();
    nameWindow();
    if (wasAsked) offerRecovery();
}

void MixerWindow::useSinks(const DeviceChoice& choice) {
    askThen([this, choice] {
        device_ = choice;
        for (const SinkKind& kind : sinkKinds())
            files_.settings().setValue(kind.setting.data(), utf8(choice.placeOf(kind)));
        const bool isFirst = view_->firstStart() != nullptr;
        play(Mix{desk_->mix()}, document_, desk_->session().world().slowness() == 0);
        if (isFirst && !choice.sinks.empty()) return testBeside(kindOf(choice.sinks.front()).actuators);
        view_->tabs().choose("Output"); // the tab where it was chosen
    });
}

// ---- the first start, and messages on devices that replace missing ones

void MixerWindow::showFirstStart() { addFirstStart(feltChoices(drivers_, likelySinks())); }

FirstStart& MixerWindow::addFirstStart(std::vector<FeltChoice> choices) {
    auto card = std::make_unique<FirstStart>(*desk_, std::move(choices));
    card->onEnd = [this](bool hasChosen) {
        if (hasChosen) files_.settings().setValue(chosenSetting, true);
        // asynchronous, because its button's click is still being handled
        juce::MessageManager::callAsync([safe = juce::Component::SafePointer<MixerWindow>{this}] {
            if (safe == nullptr) return;
            safe->view_->setFirstStart(nullptr);
            safe->showHintOnce();
        });
    };
    card->onBeside = [this](const DeviceChoice& choice) {
        files_.settings().setValue(chosenSetting, true);
        if (desk_->device().onSinksWanted) desk_->device().onSinksWanted(choice);
    };
    FirstStart& shown = *card;
    view_->setFirstStart(std::move(card));
    return shown;
}

void MixerWindow::testBeside(int outputs) { addFirstStart({}).test(outputs); }

void MixerWindow::tellInstead() {
    const auto& wanted = device_.name;
    if (desk_->trouble().isEmpty() || wanted.starts_with(std::string{noDeviceType} + ":")) return;
    for (const auto& there : byLikelihood(listAudioDevices(drivers_)))
        if (there.type != noDeviceType && there.type + ":" + there.name != wanted)
            return desk_->messages().add({"There is " + utf8(there.type + ": " + there.name) + " (" +
                                          juce::String{there.channels} + " outputs) instead, under Output"});
}

void MixerWindow::showHintOnce() {
    auto& settings = files_.settings();
    if (!settings.getBoolValue("hint-seen")) view_->setHint(true);
    settings.setValue("hint-seen", true);
}

void MixerWindow::nameWindow() {
    const auto name =
        document_ == juce::File{} ? juce::String{"new session"} : document_.getFileNameWithoutExtension();
    // ASCII, since JUCE passes other characters to X11 window managers as Latin-1
    const auto title = name + (isChanged() ? " *" : "") + " - PhysVib mixer";
    if (title != getName()) setName(title);
}

void MixerWindow::timerCallback() {
    nameWindow();
    device_ = desk_->device().choice();
    auto& settings = files_.settings();
    settings.setValue("device", utf8(device_.name));
    const auto colon = device_.name.find(':');
    if (const int all = desk_->device().outputs(); all > 0 && colon != std::string::npos)
        settings.setValue("outputs", device_.isHeadphones
                                         ? DeviceChoice::ears
                                         : ownOutputs({device_.name.substr(0, colon),
                                                       device_.name.substr(colon + 1), all}));
    settings.setValue("headphones", device_.isHeadphones);
    settings.setValue("rate", device_.sampleRateHz);
    settings.setValue("block", device_.blockFrames);
    settings.setValue("osc", oscUseNames[static_cast<std::size_t>(desk_->inputs().choice().use)]);
    settings.setValue("osc-to", utf8(desk_->inputs().choice().receiver));
    settings.setValue("osc-turn", desk_->inputs().choice().turnDegrees);
    for (const std::size_t ear : {0u, 1u})
        settings.setValue(ear == 0 ? "monitor-left" : "monitor-right",
                          device_.monitor.size() > ear ? device_.monitor[ear] + 1 : 0);
    settings.setValue("monitor-db", device_.monitorDb);
    settings.setValue("marker", device_.marker + 1);
    settings.setValue("clip-ending", hitEndings()[dragged_->ending()]);
    settings.setValue(silentSetting, desk_->isSilent());
    settings.setValue("panels", view_->dividers().text());
    files_.setLimits(limits());
    files_.setExposureToday(desk_->exposure().squareGSeconds());
    offerMonitor();
    if (const auto error = files_.keep(*desk_, isChanged()); !error.empty()) say(utf8(error));
}

Mix MixerWindow::firstMix() {
    const auto& settings = files_.settings();
    Mix mix = Desk::firstMix();
    if (const int outputs = settings.getIntValue("outputs");
        outputs > 0 && settings.getValue("device") == utf8(device_.name))
        keepTo(outputs, mix, device_.name);
    const DeskLimits left = limits();
    mix.levelDb = std::min(mix.levelDb, left.loudestOutputDb());
    if (device_.isHeadphones) mix.levelDb = std::min(mix.levelDb, safeContactDb);
    for (Strip& strip : mix.strips)
        if (std::ranges::find(left.strips, strip.output, &Strip::output) == left.strips.end() ||
            std::ranges::find(device_.monitor, strip.output) != device_.monitor.end())
            strip.output = -1;
    return mix;
}

// Shown once, if headphones may be connected in place of actuators.
void MixerWindow::offerMonitor() {
    auto& settings = files_.settings();
    if (settings.getBoolValue("monitor-offered") || desk_->device().outputs() != 2 ||
        !device_.sinks.empty() || !device_.monitor.empty() || device_.isHeadphones)
        return;
    settings.setValue("monitor-offered", true);
    desk_->messages().add(
        {"This device has two outputs. With headphones there, what is felt can be heard: choose "
         "them under Output",
         true});
}

// Not while a study uses the mixer's output, or behind a card.
bool MixerWindow::isInterestedInFileDrag(const juce::StringArray& files) {
    return files.size() == 1 && juce::File{files[0]}.hasFileExtension("json") && view_->world().isVisible() &&
           view_->openCard() == nullptr;
}

void MixerWindow::filesDropped(const juce::StringArray& files, int, int) {
    view_->setDropShown(false);
    openFile(juce::File{files[0]});
}

void MixerWindow::requestQuit() {
    if (pauseStudy(*view_)) return;
    askThen([this] {
        files_.copies().forget();
        juce::JUCEApplicationBase::quit();
    });
}

void MixerWindow::setGround(Ground ground) {
    view_->setGround(ground);
    files_.settings().setValue("look", ground == Ground::light ? "light" : "dark");
}

void MixerWindow::setDisplayWidth(double mm) {
    desk_->setDisplayWidth(1e-3 * mm);
    files_.settings().setValue(displayWidthSetting, mm);
}

void MixerWindow::chooseFolder() {
    askForFile(view_->topBar(),
               {"The folder of recordings, sessions, movies and studies", {}, folder_->place()},
               [this](const juce::File& chosen) {
                   folder_->choose(chosen);
                   files_.settings().setValue(folderSetting, chosen.getFullPathName());
                   if (const auto folder = folder_->make(); folder) tellSaved("Files go to", folder.value);
               });
}

// Display sizes reported by the system are often wrong.
void MixerWindow::askDisplayWidth() {
    const double now =
        1e3 * displayOf(*view_).getWidth() / screenPixelsPerMetre(*view_, desk_->displayWidthMetres());
    ask("Width of the display",
        "Drags in the world are measured in metres of the screen. Measure its picture from left to right, in "
        "mm; "
        "empty: as the system says.",
        {{"Set",
          [this] {
              const auto words = takeAnswer("Width in mm");
              const double mm = words.isEmpty() ? 0.0 : words.replaceCharacter(',', '.').getDoubleValue();
              if (words.isEmpty() || isDisplayWidth(1e-3 * mm)) return setDisplayWidth(mm);
              say("Width of the display: expected " + number(1e3 * leastDisplayMetres, 0) + " to " +
                  number(1e3 * mostDisplayMetres, 0) + " mm, found " + words);
          }}},
        {{"Width in mm", number(now, 0)}});
}

bool MixerWindow::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (view_->openCard() != nullptr) return view_->keyPressed(key);
    if (key == KeyPress{'n', command, 0}) return newDocument(), true;
    if (key == KeyPress{'o', command, 0}) return openDocument(), true;
    if (key == KeyPress{'s', command, 0}) return save(), true;
    if (key == KeyPress{'s', command | shift, 0}) return saveAs(), true;
    if (key == KeyPress{'r', command, 0}) return record(), true;
    if (key == KeyPress{'r', command | shift, 0}) return recordScript(), true;
    if (key == KeyPress{'e', command, 0}) return renderOffline(), true;
    if (key == KeyPress{'q', command, 0}) return requestQuit(), true;
    if (key == KeyPress::F11Key) return setShow(!view_->isShow()), true;
    if (key == KeyPress{'0', command, 0}) return setZoom(0), true;
    if (const int by = zoomStepOf(key); by != 0) return stepZoom(by), true;
    if (key == KeyPress::F10Key) return showMenu(view_->topBar()), true;
    return view_->keyPressed(key);
}

void MixerWindow::showMenu(juce::Component& from) {
    auto& undo = desk_->undoManager();
    juce::PopupMenu menu, look, recent;
    const auto item = [&menu](const juce::String& name, const juce::String& keys, std::function<void()> act,
                              bool isEnabled = true) {
        juce::PopupMenu::Item i{name};
        i.shortcutKeyDescription = keys;
        i.action = std::move(act);
        i.isEnabled = isEnabled;
        menu.addItem(i);
    };
    for (int k = 0; k < files_.recent().getNumFiles(); ++k) {
        const auto file = files_.recent().getFile(k);
        recent.addItem(file.getFileName(), [this, file] { openDocument(file); });
    }
    item("New", "Ctrl+N", [this] { newDocument(); });
    item("Open" + dots(), "Ctrl+O", [this] { openDocument(); });
    menu.addSubMenu("Recent", recent, recent.getNumItems() > 0);
    item("Save", "Ctrl+S", [this] { save(); });
    item("Save as" + dots(), "Ctrl+Shift+S", [this] { saveAs(); });
    item(
        "Sessions left behind" + dots(), {}, [this] { offerRecovery(); },
        !files_.copies().leftBehind().empty());
    menu.addSeparator();
    item(
        undo.canUndo() ? "Undo: " + undo.getUndoDescription() : juce::String{"Undo"}, "Ctrl+Z",
        [&undo] { undo.undo(); }, undo.canUndo());
    item(
        undo.canRedo() ? "Redo: " + undo.getRedoDescription() : juce::String{"Redo"}, "Ctrl+Shift+Z",
        [&undo] { undo.redo(); }, undo.canRedo());
    menu.addSeparator();
    juce::PopupMenu fresh;
    fresh.addItem("Empty", [this] { newScene(SceneGround::empty); });
    fresh.addItem("Box", [this] { newScene(SceneGround::box); });
    fresh.addItem("Floor", [this] { newScene(SceneGround::floor); });
    menu.addSubMenu("New scene", fresh);
    item("Scene" + dots(), {}, [this] { import("Scene"); });
    item("Save as scene" + dots(), {}, [this] { saveScene(false); });
    item("Save as scene, bodies as they are now" + dots(), {}, [this] { saveScene(true); });
    item(desk_->script().isRecording() ? "End the recording of hands" : "Record hands as the scene's script",
         "Ctrl+Shift+R", [this] { recordScript(); });
    item("Layout" + dots(), {}, [this] { import("Layout of actuators"); });
    item("Save the layout" + dots(), {}, [this] { exportLayout(); });
    if (asked_) item("Levels of the file", {}, [this] { takeAsked(); });
    menu.addSeparator();
    item(desk_->recording().isRunning() ? "End the recording" : "Record", "Ctrl+R", [this] { record(); });
    item("Render" + dots(), "Ctrl+E", [this] { renderOffline(); });
    item("Save movie" + dots(), {}, [this] { saveMovie(); });
    item("Share" + dots(), {}, [this] { share(); });
    menu.addSeparator();
    const auto isLight = view_->ground() == Ground::light;
    look.addItem("Dark", true, !isLight, [this] { setGround(Ground::dark); });
    look.addItem("Light", true, isLight, [this] { setGround(Ground::light); });
    menu.addSubMenu("Look", look);
    item("Folder of recordings" + dots(), {}, [this] { chooseFolder(); });
    menu.addSubMenu("View", viewMenu());
    juce::PopupMenu compare;
    auto& ab = view_->world().compare();
    compare.addItem(ab.isOn() ? juce::String{"Play "} + (ab.shown() == 'A' ? "B" : "A") + " (A)"
                              : juce::String{"Make B, a copy of what plays (A)"},
                    [&ab] { ab.toggle(); });
    compare.addItem("Keep what plays", ab.isOn(), false, [this] {
        view_->world().compare().end();
        desk_->sendChangeMessage();
    });
    menu.addSubMenu("Compare laws, layouts, mixes", compare);
    item("Width of the display" + dots(), {}, [this] { askDisplayWidth(); });
    item("Hint", {}, [this] { view_->setHint(true); });
    item("Quit", "Ctrl+Q", [this] { requestQuit(); });
    menu.setLookAndFeel(&view_->getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from).withMinimumWidth(240));
}

} // namespace physvib
