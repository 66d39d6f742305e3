// SPDX-License-Identifier: GPL-3.0-or-later
// Documents, keys and menu.
#include "Mixer/MixerWindow.h"
#include "Files/AtomicFile.h"
#include "Files/FileKind.h"
#include "Files/SceneFile.h"
#include "Host/NoDevice.h"
#include "Mixer/RenderTask.h"

namespace physvib {

namespace {

constexpr const char* sessionPattern = "*.json";
constexpr double longestRender = 86'400.0; // as `physvib render` makes at most
constexpr auto command = juce::ModifierKeys::commandModifier, shift = juce::ModifierKeys::shiftModifier;
const juce::String dots = juce::String::charToString(0x2026);

std::string pathOf(const juce::File& file) { return file.getFullPathName().toStdString(); }

/// `mix` with the scene or the layout of that file.
Result<Mix> mixWith(Mix mix, const juce::File& file) {
    const FileKind kind = fileKind(pathOf(file));
    if (kind == FileKind::scene) {
        const auto scene = loadScene(pathOf(file));
        if (!scene) return Failure{scene.error};
        mix.scene = std::make_shared<const Scene>(scene.value);
    } else if (kind == FileKind::layout) {
        const auto layout = loadLayout(pathOf(file));
        if (!layout) return Failure{layout.error};
        mix.layout = layout.value;
        mix.resizeStrips();
    } else return Failure{pathOf(file) + ": expected a session, a scene or a layout"};
    return mix;
}

} // namespace

MixerWindow::MixerWindow(AudioDeviceTypes types, const juce::String& device, const juce::File& file, const juce::File& folder)
    : juce::DocumentWindow{"PhysVib mixer", palette::ground, allButtons, false}
    , types_{std::move(types)}
    , files_{folder} {
    auto& settings = files_.settings();
    device_ = {device.isNotEmpty() ? device.toStdString() : settings.getValue("device", juce::String{noDeviceType} + ":" + noDeviceName).toStdString(),
               settings.getIntValue("rate"), settings.getIntValue("block"), settings.getValue("board").toStdString()};
    setUsingNativeTitleBar(true);
    start(file);
    setResizable(true, false);
    setResizeLimits(MixerView::leastWidth, MixerView::leastHeight, 7680, 4320);
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()) {
        const auto room = display->userArea;
        centreWithSize(std::min(1440, room.getWidth()), std::min(900, room.getHeight()));
    }
    addToDesktop();
    setVisible(true);
    view_->grabKeyboardFocus();
    if (!settings.getBoolValue("hint-seen")) view_->setHint(true);
    settings.setValue("hint-seen", true);
    offerRecovery();
    startTimer(500);
}

MixerWindow::~MixerWindow() {
    stopTimer();
    rendering_.reset();
    clearContentComponent();
    view_.reset();
    desk_.reset();
}

// What the command line names is not an edit: there is nothing to save yet.
void MixerWindow::start(const juce::File& file) {
    if (!file.existsAsFile()) return play(Desk::firstMix(), file);
    if (fileKind(pathOf(file)) == FileKind::session) return void(load(file, file));
    const auto mix = mixWith(Desk::firstMix(), file);
    play(mix ? mix.value : Desk::firstMix(), {});
    if (!mix) say(utf8(mix.error));
}

// Another document is another desk: its session begins at 0, with nothing to undo.
void MixerWindow::play(Mix mix, const juce::File& document) {
    clearContentComponent();
    view_.reset();
    desk_.reset();
    desk_ = std::make_unique<Desk>(types_, device_, std::move(mix));
    view_ = std::make_unique<MixerView>(*desk_);
    setContentNonOwned(view_.get(), getWidth() == 0);
    document_ = document;
    savedEdits_ = desk_->edits();
    view_->topBar().onMenu = [this](juce::Component& from) { showMenu(from); };
    view_->topBar().onRecord = [this] { record(); };
    desk_->onBoardWanted = [safe = juce::Component::SafePointer<MixerWindow>{this}](const DeviceChoice& choice) {
        juce::MessageManager::callAsync([safe, choice] { // the tab that asked goes with its desk
            if (safe != nullptr) safe->useBoard(choice);
        });
    };
    view_->topBar().onOpenScene = [this] { import("Scene"); };
    desk_->onRecorded = [this](const juce::File& file, const juce::String& error) {
        lastRecording_ = file;
        view_->topBar().setRecording(false);
        if (error.isEmpty()) desk_->tell("Recorded " + file.getFullPathName() + ", and its events beside it");
        else say(file.getFileName() + ": " + error);
    };
    view_->setGround(files_.settings().getValue("look") == "light" ? Ground::light : Ground::dark);
    view_->grabKeyboardFocus();
    nameWindow();
}

void MixerWindow::useBoard(const DeviceChoice& choice) {
    askThen([this, choice] {
        device_ = choice;
        files_.settings().setValue("board", utf8(choice.board));
        play(Mix{desk_->mix()}, document_);
        view_->tabs().choose("Output"); // where it was chosen
    });
}

bool MixerWindow::load(const juce::File& file, const juce::File& document) {
    auto session = loadSession(pathOf(file));
    if (session) {
        play(mixOf(session.value), document);
        return true;
    }
    if (!desk_) play(Desk::firstMix(), {});
    say(utf8(session.error));
    return false;
}

void MixerWindow::nameWindow() {
    const auto name = document_ == juce::File{} ? juce::String{"new session"} : document_.getFileNameWithoutExtension();
    const auto title = name + (isChanged() ? " *" : "") + juce::String::fromUTF8(" \xe2\x80\x93 PhysVib mixer");
    if (title != getName()) setName(title);
}

void MixerWindow::timerCallback() {
    nameWindow();
    device_ = desk_->device();
    auto& settings = files_.settings();
    settings.setValue("device", utf8(device_.name));
    settings.setValue("rate", device_.sampleRateHz);
    settings.setValue("block", device_.blockFrames);
    if (const auto error = files_.keep(*desk_, isChanged()); !error.empty()) say(utf8(error));
}

juce::File MixerWindow::folderOfDocuments() const {
    return document_ != juce::File{} ? document_.getParentDirectory() : juce::File::getCurrentWorkingDirectory();
}

void MixerWindow::chooseFile(const juce::String& title, const juce::String& pattern, bool isSaving, std::function<void(const juce::File&)> use) {
    using B = juce::FileBrowserComponent;
    chooser_ = std::make_unique<juce::FileChooser>(title, folderOfDocuments(), pattern, false);
    chooser_->launchAsync((isSaving ? B::saveMode | B::warnAboutOverwriting : B::openMode) | B::canSelectFiles, [use = std::move(use)](const juce::FileChooser& c) {
        if (c.getResult() != juce::File{}) use(c.getResult());
    });
}

void MixerWindow::askThen(std::function<void()> goOn) {
    if (!isChanged()) return goOn();
    juce::AlertWindow::showYesNoCancelBox(juce::MessageBoxIconType::QuestionIcon, "Save the session?", "What was changed since it was saved would be lost.", "Save", "Do not save",
                                          "Cancel", view_.get(), juce::ModalCallbackFunction::create([this, goOn = std::move(goOn)](int answer) {
                                              if (answer == 0) return;
                                              if (answer == 1) save();
                                              if (answer == 2 || !isChanged()) goOn();
                                          }));
}

void MixerWindow::newDocument() {
    askThen([this] {
        files_.forget();
        play(Desk::firstMix(), {});
    });
}

void MixerWindow::openDocument() {
    chooseFile("Open a session, a scene or a layout", sessionPattern, false, [this](const juce::File& file) { openFile(file); });
}

void MixerWindow::openFile(const juce::File& file) {
    if (fileKind(pathOf(file)) == FileKind::session) return openDocument(file);
    const auto mix = mixWith(desk_->mix(), file);
    if (!mix) return say(utf8(mix.error));
    desk_->edit(file.getFileName(), mix.value);
}

// Not while a study covers the desk: its stimuli are felt through it.
bool MixerWindow::isInterestedInFileDrag(const juce::StringArray& files) {
    return files.size() == 1 && juce::File{files[0]}.hasFileExtension("json") && view_->world().isVisible();
}

void MixerWindow::filesDropped(const juce::StringArray& files, int, int) {
    view_->setDropShown(false);
    openFile(juce::File{files[0]});
}

void MixerWindow::openDocument(const juce::File& file) {
    askThen([this, file] {
        if (!load(file, file)) return;
        files_.forget();
        files_.addRecent(file);
    });
}

void MixerWindow::save() {
    if (document_ == juce::File{}) saveAs();
    else saveTo(document_);
}

void MixerWindow::saveAs() {
    chooseFile("Save the session", sessionPattern, true, [this](const juce::File& file) { saveTo(file.withFileExtension("json")); });
}

void MixerWindow::saveTo(const juce::File& file) {
    const auto edits = desk_->edits();
    if (const auto error = writeFile(pathOf(file), sessionJson(desk_->saved())); !error.empty()) return say(utf8(error));
    document_ = file;
    savedEdits_ = edits;
    files_.forget();
    files_.addRecent(file);
    nameWindow();
}

void MixerWindow::record() {
    if (desk_->isRecording()) return desk_->stopRecording();
    const auto name = document_ == juce::File{} ? juce::String{"session"} : document_.getFileNameWithoutExtension();
    const auto file = folderOfDocuments().getNonexistentChildFile(name + "-take", ".wav", false);
    const auto error = desk_->startRecording(file);
    view_->topBar().setRecording(error.empty());
    if (!error.empty()) say(utf8(error));
}

void MixerWindow::renderOffline() {
    const double played = 1e-9 * static_cast<double>(desk_->saved().lengthNs);
    auto* window = new juce::AlertWindow{"Render the session", "It was played for " + number(played, 1) + " s. Beyond that its last scene goes on by itself.", juce::MessageBoxIconType::NoIcon, view_.get()};
    window->addTextEditor("seconds", number(std::ceil(10.0 * played) / 10.0, 1), "Seconds");
    window->getTextEditor("seconds")->setInputRestrictions(8, "0123456789.");
    window->addButton("Choose a file" + dots, 1, juce::KeyPress{juce::KeyPress::returnKey});
    window->addButton("Cancel", 0, juce::KeyPress{juce::KeyPress::escapeKey});
    window->enterModalState(true, juce::ModalCallbackFunction::create([this, window](int answer) {
        const double seconds = window->getTextEditorContents("seconds").getDoubleValue();
        if (answer == 0) return;
        if (!(seconds >= 0.1 && seconds <= longestRender)) return say("Seconds to render: expected 0.1 to " + number(longestRender, 0));
        chooseFile("Render the session to", "*.wav", true, [this, seconds](const juce::File& file) { renderTo(file.withFileExtension("wav"), seconds); });
    }), true);
}

void MixerWindow::renderTo(const juce::File& file, double seconds) {
    rendering_ = std::make_unique<RenderTask>(desk_->saved(), seconds, file, std::max(8000, desk_->output().sampleRateHz()),
                                              [this](const juce::String& words, bool isGood) { isGood ? desk_->tell(words) : say(words); }, *view_);
}

void MixerWindow::exportLayout() {
    chooseFile("Save the layout to", sessionPattern, true, [this](const juce::File& file) {
        if (const auto error = writeFile(pathOf(file.withFileExtension("json")), layoutJson(desk_->mix().layout)); !error.empty()) say(utf8(error));
    });
}

void MixerWindow::import(const juce::String& title) {
    chooseFile(title, sessionPattern, false, [this](const juce::File& file) { openFile(file); });
}

void MixerWindow::requestQuit() {
    askThen([this] {
        files_.forget();
        juce::JUCEApplicationBase::quit();
    });
}

void MixerWindow::offerRecovery() {
    const auto copies = files_.leftBehind();
    if (copies.empty()) return;
    const auto file = copies.front();
    juce::AlertWindow::showOkCancelBox(juce::MessageBoxIconType::QuestionIcon, "Take up the last session?",
                                       "The mixer ended without being closed. A copy of its session was kept at " + file.getLastModificationTime().toString(true, true, false, true) + ".",
                                       "Take it up", "Discard it", view_.get(), juce::ModalCallbackFunction::create([this, copies](int answer) {
                                           if (answer == 1 && load(copies.front(), {})) savedEdits_ = desk_->edits() + 1; // to be saved
                                           for (const auto& copy : copies)
                                               if (copy != copies.front() || answer != 1 || desk_->trouble().isEmpty()) copy.deleteFile();
                                       }));
}

void MixerWindow::setGround(Ground ground) {
    view_->setGround(ground);
    files_.settings().setValue("look", ground == Ground::light ? "light" : "dark");
}

bool MixerWindow::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (key == KeyPress{'n', command, 0}) return newDocument(), true;
    if (key == KeyPress{'o', command, 0}) return openDocument(), true;
    if (key == KeyPress{'s', command, 0}) return save(), true;
    if (key == KeyPress{'s', command | shift, 0}) return saveAs(), true;
    if (key == KeyPress{'r', command, 0}) return record(), true;
    if (key == KeyPress{'e', command, 0}) return renderOffline(), true;
    if (key == KeyPress{'q', command, 0}) return requestQuit(), true;
    if (key == KeyPress::F10Key) return showMenu(view_->topBar()), true;
    return view_->keyPressed(key);
}

void MixerWindow::showMenu(juce::Component& from) {
    auto& undo = desk_->undoManager();
    juce::PopupMenu menu, look, recent;
    const auto item = [&menu](const juce::String& name, const juce::String& keys, std::function<void()> act, bool isEnabled = true) {
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
    item("Open" + dots, "Ctrl+O", [this] { openDocument(); });
    menu.addSubMenu("Recent", recent, recent.getNumItems() > 0);
    item("Save", "Ctrl+S", [this] { save(); });
    item("Save as" + dots, "Ctrl+Shift+S", [this] { saveAs(); });
    menu.addSeparator();
    item(undo.canUndo() ? "Undo: " + undo.getUndoDescription() : juce::String{"Undo"}, "Ctrl+Z", [&undo] { undo.undo(); }, undo.canUndo());
    item(undo.canRedo() ? "Redo: " + undo.getRedoDescription() : juce::String{"Redo"}, "Ctrl+Shift+Z", [&undo] { undo.redo(); }, undo.canRedo());
    menu.addSeparator();
    item("Scene" + dots, {}, [this] { import("Scene"); });
    item("Layout" + dots, {}, [this] { import("Layout of enchanters"); });
    item("Save the layout" + dots, {}, [this] { exportLayout(); });
    menu.addSeparator();
    item(desk_->isRecording() ? "End the recording" : "Record", "Ctrl+R", [this] { record(); });
    item("Render" + dots, "Ctrl+E", [this] { renderOffline(); });
    menu.addSeparator();
    const auto isLight = view_->ground() == Ground::light;
    look.addItem("Dark", true, !isLight, [this] { setGround(Ground::dark); });
    look.addItem("Light", true, isLight, [this] { setGround(Ground::light); });
    menu.addSubMenu("Look", look);
    item("Hint", {}, [this] { view_->setHint(true); });
    item("Quit", "Ctrl+Q", [this] { requestQuit(); });
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from).withMinimumWidth(240));
}

} // namespace physvib
