// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's window: documents, settings, recovery, menus and keys, files to render, links to share.
#include "Mixer/Window/MixerWindow.h"
#include "Calls/MovieOutput.h"
#include "Core/Limits.h"
#include "Host/Views/WorldView.h"
#include "Io/Disk/AtomicFile.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Window/PageLink.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneValidation.h"

namespace physvib {
namespace {

// names in the settings, in the order of OscAccess
constexpr std::array<const char*, 3> oscAccessNames{"off", "this-computer", "any-computer"};

OscAccess oscAccessFromName(const juce::String& name) {
    const auto found = std::ranges::find(oscAccessNames, name.toStdString());
    return found == oscAccessNames.end() ? OscAccess::off
                                         : static_cast<OscAccess>(found - oscAccessNames.begin());
}

constexpr const char* deviceChosenSetting = "device-chosen"; // the user has chosen a device, or none
constexpr const char* silentSetting = "silent";
constexpr const char* outputsBeforeHeadphonesSetting = "outputs-before-headphones";
constexpr const char* panelLayoutSetting = "mode";    // mode and unfolded panels; none: play mode
constexpr const char* folderSetting = "files-folder"; // of the user's files; empty: that of UserFolder
constexpr const char* displayWidthSetting = "display-width-mm"; // 0: as the system reports
/// Size of borders and title bar; the exact size is known only after the window exists.
constexpr juce::Point<int> frameSize{8, 40};
constexpr auto command = juce::ModifierKeys::commandModifier, shift = juce::ModifierKeys::shiftModifier;

constexpr const char* sessionEnding = ".json";
constexpr double minMovieSeconds = 1.0, defaultMovieSeconds = 60.0;
constexpr double maxRenderSeconds = 86'400.0; // the limit of `physvib render`

juce::String secondsText(double seconds) { return juce::String{std::ceil(10.0 * seconds) / 10.0, 1}; }

// The field accepts digits and a point only, so its value has no thousands separators.
QuestionCard::Field secondsField(double seconds) { return {"Seconds", secondsText(seconds), "0123456789."}; }

/// Copy of `mix` with the scene or the layout of the file.
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
    } else
        return Failure{pathOf(file) + ": expected a session, a scene or a layout"};
    return mix;
}

constexpr std::size_t maxOfferedCopies = 20; // each is read when it is displayed

juce::String nameOf(const std::filesystem::path& copy) { return utf8(copy.filename().string()); }

/// Time and contents of a copy, or why it cannot be read.
juce::String describeCopy(const std::filesystem::path& copy, const Result<SavedSession>& session) {
    const auto time =
        juce::File{utf8(copy.string())}.getLastModificationTime().toString(true, true, true, true);
    if (!session) return "Of " + time + ": " + utf8(session.error).replace(utf8(copy.string()), nameOf(copy));
    const Mix mix = mixAtEnd(session.value);
    return "Kept at " + time + ": " + displayTitle(mix.scene->name) + " on " + juce::String{mix.count()} +
           " actuators, played for " + number(1e-9 * static_cast<double>(session.value.lengthNs), 1) + " s.";
}

constexpr const char *pageSetting = "page", *pageField = "Address of the page", *linkField = "Link",
                     *copyLabel = "Copy the link", *openLabel = "Open it", *serveLabel = "Serve it here";

constexpr std::array<int, 7> zoomPercents{60, 75, 100, 125, 150, 175, 200};
constexpr const char* zoomSetting = "zoom";
constexpr juce::Point<int> defaultDisplay{1920, 1080}; // at 100 %

/// Room of the display in pixels at 100 %.
juce::Point<int> displaySize() {
    auto& desktop = juce::Desktop::getInstance();
    const auto* display = desktop.getDisplays().getPrimaryDisplay();
    if (display == nullptr) return defaultDisplay;
    const auto area = userAreaOf(*display).toFloat() * desktop.getGlobalScaleFactor();
    return {juce::roundToInt(area.getWidth()), juce::roundToInt(area.getHeight())};
}

bool windowFits(int percent, juce::Point<int> room) {
    return 100 * room.x >= percent * MixerView::minWidth && 100 * room.y >= percent * MixerView::minHeight;
}

/// The largest zoom at which the window has at least the room of the default display.
int automaticZoom(juce::Point<int> room) {
    int best = 100;
    for (const int percent : zoomPercents)
        if (100 * room.x >= percent * defaultDisplay.x && 100 * room.y >= percent * defaultDisplay.y)
            best = std::max(best, percent);
    return best;
}

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
            : settings.getValue("device", juce::String{nullDeviceType} + ":" + nullDeviceName).toStdString(),
        settings.getIntValue("rate"), settings.getIntValue("block")};
    if (const int left = settings.getIntValue("monitor-left"), right = settings.getIntValue("monitor-right");
        left > 0 && right > 0)
        device_.monitorOutputs = {left - 1, right - 1};
    device_.monitorDb = settings.getDoubleValue("monitor-db", defaultContactDb);
    device_.markerOutput = settings.getIntValue("marker") - 1;
    device_.isHeadphones = device.isEmpty() && settings.getBoolValue("headphones");
    for (const auto& output :
         juce::StringArray::fromTokens(settings.getValue(outputsBeforeHeadphonesSetting), false))
        device_.outputsBeforeHeadphones.push_back(output.getIntValue());
    for (const SinkKind& kind : sinkKinds())
        device_.setSink(kind, settings.getValue(kind.settingKey.data()).toStdString());
    folder_->choose(juce::File::createFileWithoutCheckingPath(settings.getValue(folderSetting)));
    dragged_->setFormatIndex(std::max(0, hitFileExtensions().indexOf(settings.getValue("clip-ending"))));
    setUsingNativeTitleBar(true);
    const bool hasCrashed = !files_.copies().abandonedCopies().empty();
    if (hasCrashed) limitsBeforeCrash_ = files_.limits();
    start(file);
    // sizes and shows the window
    setResizable(true, false);
    applyZoom();
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()) {
        const auto room = userAreaOf(*display);
        centreWithSize(std::min(1440, room.getWidth() - frameSize.x),
                       std::min(900, room.getHeight() - frameSize.y));
    }
    addToDesktop();
    setVisible(true);
    view_->grabKeyboardFocus();
    // asks for a device at the first start, and offers what a crash has left
    const auto& name = settings.getValue("device");
    const bool isFirst = device.isEmpty() && !settings.getBoolValue(deviceChosenSetting) &&
                         (name.isEmpty() || name.startsWith(juce::String{nullDeviceType} + ":"));
    if (isFirst && !hasCrashed)
        callLater(*this, [](MixerWindow& window) {
            window.addFirstStart(playbackChoices(window.drivers_, detectSinks()));
        });
    suggestOtherDevice();
    offerRecovery();
    if (!files_.settingsError().empty())
        model_->messages().add({utf8(files_.settingsError()), false, {}, "settings"});
    startTimer(500);
}

MixerWindow::~MixerWindow() {
    stopTimer();
    files_.settings().setValue(silentSetting, model_->isSilent());
    savePanelLayout();
    files_.setLimits(limits());
    files_.setExposureToday(model_->exposure().squareGSeconds(), true);
    renderTask_.reset();
    clearContentComponent();
    view_.reset();
    model_.reset();
}

// A document gets a new MixerModel: its session starts at 0, without undo steps unless `history` is given.
void MixerWindow::beginSession(Mix mix, const juce::File& document, bool isPaused,
                               std::shared_ptr<MixerHistory> history) {
    const bool wasSilent = model_ ? model_->isSilent() : files_.settings().getBoolValue(silentSetting);
    const bool hadQuestion = view_ && view_->question() != nullptr;
    const double exposure = model_ ? model_->exposure().squareGSeconds() : files_.exposureToday();
    if (view_) savePanelLayout();
    // the new session replaces the previous model and view
    requestedMix_.reset();
    lostOutputs_.clear();
    clearContentComponent();
    view_.reset();
    model_.reset();
    model_ = std::make_unique<MixerModel>(drivers_, device_, std::move(mix),
                                          MixerStart{wasSilent, isPaused, std::move(history)});
    model_->exposure().addEarlierExposure(exposure);
    view_ = std::make_unique<MixerView>(*model_);
    view_->setProgress(renderTask_.get()); // a file of the previous session is still being written
    setContentNonOwned(view_.get(), getWidth() == 0);
    document_ = document;
    savedEditCount_ = model_->editCount();
    const auto& settings = files_.settings();
    auto& bar = view_->topBar();
    bar.onMenu = [this](juce::Component& anchor) { showMenu(anchor); };
    bar.onRecord = [this] { record(); };
    bar.onSave = [this] { save(); };
    bar.onDevice = [this] { view_->tabs().choose("Output"); };
    model_->device().onSinksRequested = [this](const DeviceChoice& choice) {
        callLater(*this, [choice](MixerWindow& window) { window.setSinks(choice); }); // deletes the tab
    };
    bar.onOpenScene = [this] { askToOpen("Scene"); };
    bar.setOwnScenes(files_.ownScenes());
    bar.onOwnScene = [this](const juce::File& scene) { openFile(scene); };
    model_->recording().onEnd = [this](const juce::File& file, const juce::String& error) {
        lastRecording_ = file;
        view_->topBar().setRecording(false);
        if (error.isNotEmpty())
            showError(file.getFileName() + ": " + error);
        else if (model_->recording().wasSilent())
            announceSaved("Nothing was played meanwhile: a silent recording,", file);
        else
            announceSaved("Recorded, with its events beside it:", file,
                          {"Play", [this, file] { model_->eventPlayer().playRecording(file); }});
    };
    // applies the settings that the new model and view do not have
    OscChoice osc{oscAccessFromName(settings.getValue("osc")), settings.getValue("osc-to").toStdString(),
                  settings.getDoubleValue("osc-turn")};
    if (const auto error = model_->inputs().configure(osc); !error.empty()) {
        osc.receiver.clear(); // the host name cannot be resolved now
        model_->inputs().configure(osc);
        model_->report("OSC: " + utf8(error));
    }
    model_->setDisplayWidth(1e-3 * settings.getDoubleValue(displayWidthSetting));
    view_->setTheme(settings.getValue("look") == "light" ? Theme::light : Theme::dark);
    view_->setDividers(Dividers::fromText(settings.getValue("panels")));
    view_->setPanelLayout(settings.getValue(panelLayoutSetting));
    view_->grabKeyboardFocus();
    updateTitle();
    if (hadQuestion) offerRecovery();
}

void MixerWindow::setSinks(const DeviceChoice& choice) {
    const auto restart = [this, choice] {
        device_ = choice;
        for (const SinkKind& kind : sinkKinds())
            files_.settings().setValue(kind.settingKey.data(), utf8(choice.sinkAddress(kind)));
        const bool isFirst = view_->firstStart() != nullptr, wasChanged = hasUnsavedChanges();
        Mix mix = mixAtEnd(model_->savedSession());
        const auto history = model_->history();
        history->drawnScenes.emplace_back(model_->mix().scene, mix.scene);
        beginSession(std::move(mix), document_, model_->session().world().slowness() == 0, history);
        if (wasChanged) savedEditCount_ = neverSaved;
        if (isFirst && !choice.sinks.empty())
            return addFirstStart({}).test(findSinkKind(choice.sinks.front()).actuators);
        view_->tabs().choose("Output"); // the tab where it was chosen
    };
    offerSaveThen(restart,
                  "Another output begins the session anew: mix, drawing and undo steps stay, its past is "
                  "lost.");
}

FirstStart& MixerWindow::addFirstStart(std::vector<PlaybackChoice> choices) {
    auto card = std::make_unique<FirstStart>(*model_, std::move(choices));
    card->onEnd = [this](bool hasChosen) {
        if (hasChosen) files_.settings().setValue(deviceChosenSetting, true);
        callLater(*this, [](MixerWindow& window) { window.view_->setFirstStart(nullptr); });
    };
    card->onSink = [this](const DeviceChoice& choice) {
        files_.settings().setValue(deviceChosenSetting, true);
        if (model_->device().onSinksRequested) model_->device().onSinksRequested(choice);
    };
    FirstStart& firstStart = *card;
    view_->setFirstStart(std::move(card));
    return firstStart;
}

void MixerWindow::suggestOtherDevice() {
    const auto& deviceName = device_.name;
    if (model_->messageText().isEmpty() || deviceName.starts_with(std::string{nullDeviceType} + ":")) return;
    for (const auto& other : sortedByLikelihood(listAudioDevices(drivers_)))
        if (other.type != nullDeviceType && other.channels > 0 && other.type + ":" + other.name != deviceName)
            return model_->messages().add({"There is " + utf8(other.type + ":" + other.name) + " (" +
                                           juce::String{other.channels} + " outputs) instead, under Output"});
}

void MixerWindow::updateTitle() {
    const auto name =
        document_ == juce::File{} ? juce::String{"new session"} : document_.getFileNameWithoutExtension();
    // ASCII only: JUCE passes other characters to X11 window managers as Latin-1
    const auto title = name + (hasUnsavedChanges() ? " *" : "") + " - PhysVib mixer";
    if (title != getName()) setName(title);
    if (view_) view_->topBar().setDocument(name);
}

void MixerWindow::timerCallback() {
    updateTitle();
    device_ = model_->device().choice();
    auto& settings = files_.settings();
    settings.setValue("device", utf8(device_.name));
    const auto colon = device_.name.find(':');
    if (const int all = model_->device().outputCount(); all > 0 && colon != std::string::npos)
        settings.setValue("outputs", device_.isHeadphones
                                         ? DeviceChoice::earCount
                                         : hardwareOutputCount({device_.name.substr(0, colon),
                                                                device_.name.substr(colon + 1), all}));
    settings.setValue("headphones", device_.isHeadphones);
    juce::StringArray outputs;
    for (const int output : device_.outputsBeforeHeadphones) outputs.add(juce::String{output});
    settings.setValue(outputsBeforeHeadphonesSetting, outputs.joinIntoString(" "));
    settings.setValue("rate", device_.sampleRateHz);
    settings.setValue("block", device_.blockFrames);
    settings.setValue("osc", nth(oscAccessNames, model_->inputs().choice().access));
    settings.setValue("osc-to", utf8(model_->inputs().choice().receiver));
    settings.setValue("osc-turn", model_->inputs().choice().phoneTurnDegrees);
    for (const std::size_t ear : {0u, 1u})
        settings.setValue(ear == 0 ? "monitor-left" : "monitor-right",
                          device_.monitorOutputs.size() > ear ? device_.monitorOutputs[ear] + 1 : 0);
    settings.setValue("monitor-db", device_.monitorDb);
    settings.setValue("marker", device_.markerOutput + 1);
    settings.setValue("clip-ending", hitFileExtensions()[dragged_->formatIndex()]);
    settings.setValue(silentSetting, model_->isSilent());
    savePanelLayout();
    files_.setLimits(limits());
    files_.setExposureToday(model_->exposure().squareGSeconds());
    offerMonitor();
    if (const auto error = files_.writeCopyIfDue(*model_, hasUnsavedChanges()); error && error->empty())
        model_->messages().withdraw("kept");
    else if (error)
        model_->messages().show({utf8(*error), false, {}, "kept"});
}

void MixerWindow::savePanelLayout() {
    files_.settings().setValue("panels", view_->dividers().toText());
    files_.settings().setValue(panelLayoutSetting, view_->panelLayout());
}

Mix MixerWindow::defaultMix() {
    const auto& settings = files_.settings();
    Mix mix = MixerModel::defaultMix();
    if (const int outputCount = settings.getIntValue("outputs");
        outputCount > 0 && settings.getValue("device") == utf8(device_.name) &&
        settings.getBoolValue("headphones") == device_.isHeadphones)
        fitLayoutTo(outputCount, mix, device_.name);
    const MixerLimits lastLimits = limits();
    mix.levelDb = std::min(mix.levelDb, lastLimits.loudestOutputDb());
    if (device_.isHeadphones) mix.levelDb = std::min(mix.levelDb, defaultContactDb);
    std::vector<int> outputs; // those in use, without the outputs of the monitor
    for (const Strip& strip : lastLimits.strips)
        outputs.push_back(std::ranges::find(device_.monitorOutputs, strip.output) ==
                                  device_.monitorOutputs.end()
                              ? strip.output
                              : -1);
    setStripOutputs(outputs, mix.strips);
    if (device_.isHeadphones) return mix;
    const auto stripCount =
        std::min(mix.strips.size(), device_.outputsBeforeHeadphones.size()); // they limit what comes after
    restoreOutputs(device_, maxStripOutputs, std::span{mix.strips}.first(stripCount),
                   settings.getBoolValue("headphones") ? 0 : lastLimits.strips.size());
    device_.outputsBeforeHeadphones.clear();
    return mix;
}

// Offers the monitor once, if headphones may be connected instead of actuators.
void MixerWindow::offerMonitor() {
    auto& settings = files_.settings();
    constexpr const char *offered = "monitor-offered", *label = "monitor-offer";
    if (model_->device().outputCount() != 2 || !device_.sinks.empty() || !device_.monitorOutputs.empty() ||
        device_.isHeadphones)
        return model_->messages().withdraw(label);
    if (settings.getBoolValue(offered)) return;
    settings.setValue(offered, true);
    model_->messages().add({"This device has two outputs. With headphones there, what is felt can be heard",
                            true,
                            {"Show Output", [this] { view_->tabs().choose("Output"); }},
                            label});
}

// No file is accepted while a study uses the mixer's output, or behind a card.
bool MixerWindow::isInterestedInFileDrag(const juce::StringArray& files) {
    return files.size() == 1 && juce::File{files[0]}.hasFileExtension("json") && view_->world().isVisible() &&
           view_->openCard() == nullptr;
}

void MixerWindow::filesDropped(const juce::StringArray& files, int, int) {
    view_->setDropShown(false);
    openFile(juce::File{files[0]});
}

void MixerWindow::requestQuit() {
    if (view_->pauseStudy()) return;
    offerSaveThen([this] {
        stopTimer(); // which may write another recovery copy
        files_.copies().discardOwn();
        juce::JUCEApplicationBase::quit();
    });
}

void MixerWindow::setTheme(Theme theme) {
    view_->setTheme(theme);
    files_.settings().setValue("look", theme == Theme::light ? "light" : "dark");
}

void MixerWindow::chooseFolder() {
    askForFile(view_->topBar(),
               {"The folder of recordings, sessions, movies and studies", {}, folder_->location()},
               [this](const juce::File& chosen) {
                   folder_->choose(chosen);
                   files_.settings().setValue(folderSetting, chosen.getFullPathName());
                   if (const auto folder = folder_->create(); folder)
                       announceSaved("Files go to", folder.value);
               });
}

// Display sizes reported by the system are often wrong.
void MixerWindow::askDisplayWidth() {
    const double widthMm =
        1e3 * displayOf(*view_).getWidth() / screenPixelsPerMetre(*view_, model_->displayWidthMetres());
    askForValues(
        view_->topBar(), "Width of the display", "Set", {{"Width in mm", number(widthMm, 0)}},
        [this](const juce::StringArray& values) {
            const auto& text = values[0];
            const double mm = text.isEmpty() ? 0.0 : text.replaceCharacter(',', '.').getDoubleValue();
            if (text.isNotEmpty() && !isDisplayWidth(1e-3 * mm))
                return showError("Width of the display: expected " + number(1e3 * minDisplayMetres, 0) +
                                 " to " + number(1e3 * maxDisplayMetres, 0) + " mm, found " + text);
            model_->setDisplayWidth(1e-3 * mm);
            files_.settings().setValue(displayWidthSetting, mm);
        },
        "Drags in the world are measured in metres of the screen. Measure its picture from left to right, in "
        "mm; empty: as the system says.");
}

// The zoom step of a key: 1, -1 or 0. Plus is typed with Shift on some keyboards, and may be on the keypad.
static int zoomStep(const juce::KeyPress& key) {
    if (!key.getModifiers().isCommandDown()) return 0;
    const int code = key.getKeyCode();
    if (code == '+' || code == '=' || code == juce::KeyPress::numberPadAdd) return 1;
    return code == '-' || code == juce::KeyPress::numberPadSubtract ? -1 : 0;
}

bool MixerWindow::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (view_->openCard() != nullptr) return view_->keyPressed(key);
    if (key == KeyPress{'q', command, 0}) return requestQuit(), true;
    if (key == KeyPress{'0', command, 0}) return setZoom(0), true;
    if (const int steps = zoomStep(key); steps != 0) return stepZoom(steps), true;
    if (!view_->world().isVisible()) return view_->keyPressed(key); // the rest is of what a screen hides
    if (key == KeyPress{'n', command, 0}) return newDocument(), true;
    if (key == KeyPress{'o', command, 0}) return openDocument(), true;
    if (key == KeyPress{'s', command, 0}) return save(), true;
    if (key == KeyPress{'s', command | shift, 0}) return saveAs(), true;
    if (key == KeyPress{'r', command, 0}) return record(), true;
    if (key == KeyPress{'r', command | shift, 0}) return recordScript(), true;
    if (key == KeyPress{'e', command, 0}) return renderOffline(), true;
    if (key == KeyPress::F11Key) return setShowMode(!view_->isShowMode()), true;
    if (key == KeyPress::F10Key) return showMenu(view_->topBar()), true;
    return view_->keyPressed(key);
}

namespace {

struct MenuItem {
    juce::String name, keys{};
    bool isEnabled = true, isTicked = false;
};

void add(juce::PopupMenu& menu, const MenuItem& item, std::function<void()> action) {
    juce::PopupMenu::Item entry{item.name};
    entry.shortcutKeyDescription = item.keys;
    entry.isEnabled = item.isEnabled;
    entry.isTicked = item.isTicked;
    menu.addItem(entry.setAction(std::move(action)));
}

constexpr const char* keys =
    "Esc\tsilence\nEsc, a card, menu or drag\tends it, silences what sounds or did 1.5 s before\n"
    "Space\tpause\n.\tone step of a paused world\nF2\tplay or engineer\nF3\tstrips, and what is below\n"
    "F4\tthe drawer\nF10, Ctrl+Q\tmenu, quit\nF11\tfull screen\nArrow keys\ttilt\nShift + drag\tholds a "
    "body\n"
    "A\tthe other of A and B\nCtrl+Z, Ctrl+Shift+Z\tundo, redo\nCtrl+R, Ctrl+Shift+R\trecord; record hands\n"
    "Ctrl+E\trender\nCtrl+N, O, S, Shift+S\tnew, open, save, save as\nCtrl++, Ctrl+-, Ctrl+0\tzoom\n"
    "T, Shift+T, G in a strip\ttest pulse, sweep, group\nTab\tthe next control\n"
    "Arrows, [ ], + -\tmove, turn, size what is selected\n"
    "Delete, Ctrl+C, V, D, A\tdelete, copy, paste, double, all\nG, Return\tgrid; one in the middle";

/// Card that lists keys and their effects in two columns.
class KeysCard final : public Card {
public:
    explicit KeysCard(std::function<void()> close)
        : Card{940} {
        rows_.addLines(keys);
        for (const auto& tool : drawTools)
            rows_.add(juce::String::charToString(static_cast<juce::juce_wchar>(tool.key)).toUpperCase() +
                      "\t" + tool.name);
        setTexts("Keys", {});
        close_.onClick = std::move(close);
        setAnswers({&close_});
        fitToContents();
    }
    bool keyPressed(const juce::KeyPress& key) override {
        if (key != juce::KeyPress::escapeKey && key != juce::KeyPress::returnKey) return false;
        return close_.onClick(), true;
    }
    void paint(juce::Graphics& g) override {
        Card::paint(g);
        g.setColour(shade(*this, Shade::text));
        for (int k = 0; k < rows_.size(); ++k) {
            auto row = content_.translated(k / halfRows() * columnWidth, k % halfRows() * keyRowHeight)
                           .withHeight(keyRowHeight);
            g.setFont(text::font(text::small, juce::Font::bold));
            g.drawText(rows_[k].upToFirstOccurrenceOf("\t", false, false), row.removeFromLeft(keysWidth),
                       juce::Justification::centredLeft);
            g.setFont(text::font(text::small));
            g.drawText(rows_[k].fromFirstOccurrenceOf("\t", false, false), row,
                       juce::Justification::centredLeft);
        }
    }

private:
    static constexpr int keyRowHeight = 20, columnWidth = 480, keysWidth = 180;
    int halfRows() const { return (rows_.size() + 1) / 2; }
    int contentHeight() const override { return halfRows() * keyRowHeight; }
    void placeContent(juce::Rectangle<int> content) override { content_ = content; }

    juce::StringArray rows_;
    juce::Rectangle<int> content_;
    juce::TextButton close_{"Close"};
};

} // namespace

void MixerWindow::showMenu(juce::Component& anchor) {
    juce::PopupMenu menu, help;
    add(help, {"First steps"}, [this] {
        model_->announce(
            "Drag a ball to throw it; the bar at the left draws. Esc silences everything, F2 has all "
            "controls.");
    });
    add(help, {"Keys" + ellipsis()}, [this] {
        view_->setCard(std::make_unique<KeysCard>(
            [this] { callLater(*this, [](MixerWindow& window) { window.view_->setCard(nullptr); }); }));
    });
    menu.addSubMenu("File", fileMenu());
    menu.addSubMenu("Edit", editMenu());
    menu.addSubMenu("World", worldMenu());
    menu.addSubMenu("View", viewMenu());
    menu.addSubMenu("Help", help);
    menu.setLookAndFeel(&view_->getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(anchor).withMinimumWidth(120));
}

juce::PopupMenu MixerWindow::fileMenu() {
    juce::PopupMenu menu, recent;
    for (int k = 0; k < files_.recentFiles().getNumFiles(); ++k) {
        const auto file = files_.recentFiles().getFile(k);
        recent.addItem(file.getFileName(), [this, file] { openDocument(file); });
    }
    add(menu, {"New", "Ctrl+N"}, [this] { newDocument(); });
    add(menu, {"Open" + ellipsis(), "Ctrl+O"}, [this] { openDocument(); });
    menu.addSubMenu("Recent", recent, recent.getNumItems() > 0);
    add(menu, {"Save", "Ctrl+S"}, [this] { save(); });
    add(menu, {"Save as" + ellipsis(), "Ctrl+Shift+S"}, [this] { saveAs(); });
    add(menu, {"Sessions left behind" + ellipsis(), {}, !files_.copies().abandonedCopies().empty()},
        [this] { offerRecovery(); });
    menu.addSeparator();
    add(menu, {model_->recording().isRunning() ? "End the recording" : "Record", "Ctrl+R"},
        [this] { record(); });
    add(menu, {"Render" + ellipsis(), "Ctrl+E"}, [this] { renderOffline(); });
    add(menu, {"Save movie" + ellipsis()}, [this] { saveMovie(); });
    add(menu, {"Share" + ellipsis()}, [this] { share(); });
    add(menu, {"Folder of recordings" + ellipsis()}, [this] { chooseFolder(); });
    menu.addSeparator();
    add(menu, {"Quit", "Ctrl+Q"}, [this] { requestQuit(); });
    return menu;
}

juce::PopupMenu MixerWindow::editMenu() {
    juce::PopupMenu menu;
    auto& undo = model_->undoManager();
    auto& comparison = view_->world().compare();
    add(menu,
        {undo.canUndo() ? "Undo: " + undo.getUndoDescription() : juce::String{"Undo"}, "Ctrl+Z",
         undo.canUndo()},
        [&undo] { undo.undo(); });
    add(menu,
        {undo.canRedo() ? "Redo: " + undo.getRedoDescription() : juce::String{"Redo"}, "Ctrl+Shift+Z",
         undo.canRedo()},
        [&undo] { undo.redo(); });
    auto& drawing = view_->world().drawing();
    add(menu, {"Select all", "Ctrl+A"}, [&drawing] { drawing.selectAll(); });
    add(menu, {"Delete", "Del", !drawing.selected().empty()},
        [&drawing] { drawing.eraseBodies(drawing.selected()); });
    menu.addSeparator();
    add(menu, {"Levels of the file", {}, requestedMix_.has_value()}, [this] { applyRequestedLevels(); });
    menu.addSeparator();
    add(menu,
        {comparison.isComparing() ? juce::String{"Play "} + (comparison.activeState() == 'A' ? "B" : "A")
                                  : juce::String{"Compare: make B, a copy of what plays"},
         "A"},
        [&comparison] { comparison.toggle(); });
    add(menu, {"Keep what plays", {}, comparison.isComparing()}, [this] {
        view_->world().compare().end();
        model_->sendChangeMessage();
    });
    return menu;
}

juce::PopupMenu MixerWindow::worldMenu() {
    juce::PopupMenu menu, newScenes;
    newScenes.addItem("Empty", [this] { newScene(SceneGround::empty); });
    newScenes.addItem("Box", [this] { newScene(SceneGround::box); });
    newScenes.addItem("Floor", [this] { newScene(SceneGround::floor); });
    menu.addSubMenu("New scene", newScenes);
    add(menu, {"Open a scene" + ellipsis()}, [this] { askToOpen("Scene"); });
    add(menu, {"Save as scene" + ellipsis()}, [this] { saveScene(false); });
    add(menu, {"Save as scene, bodies as they are now" + ellipsis()}, [this] { saveScene(true); });
    add(menu,
        {model_->script().isRecording() ? "End the recording of hands" : "Record hands as the scene's script",
         "Ctrl+Shift+R"},
        [this] { recordScript(); });
    menu.addSeparator();
    add(menu, {"Open a layout" + ellipsis()}, [this] { askToOpen("Layout of actuators"); });
    add(menu, {"Save the layout" + ellipsis()}, [this] { exportLayout(); });
    return menu;
}

bool MixerWindow::load(const juce::File& file, const juce::File& document, bool isCrashCopy) {
    auto session = loadSession(pathOf(file));
    if (session) {
        const auto warnOfUnsupported = [&] {
            if (const auto warning = unsupportedFeatures(session.value); warning.isNotEmpty())
                model_->messages().add({warning, false, {}, "lacking"});
            return true;
        };
        if (files_.isOwnSession(file, outputInUse())) { // unchanged since it was saved
            beginSession(mixAtEnd(session.value), document, endsPaused(session.value));
            return warnOfUnsupported();
        }
        // the copy may lack the last seconds; edits of this run may have set other levels
        const bool isUnchangedSinceCrash = isCrashCopy && limitsBeforeCrash_ && !hasUnsavedChanges();
        playLowered(isUnchangedSinceCrash ? *limitsBeforeCrash_ : limits(), mixAtEnd(session.value), document,
                    endsPaused(session.value));
        return warnOfUnsupported();
    }
    if (!model_) beginSession(defaultMix(), {});
    showError(utf8(session.error));
    return false;
}

void MixerWindow::playLowered(const MixerLimits& maxLevels, Mix mix, const juce::File& document,
                              bool isPaused) {
    std::vector<std::size_t> withoutHeadphone;
    if (device_.isHeadphones) withoutHeadphone = assignNewStrips(device_, mix.strips, 0); // only L and R
    const Mix fileMix = mix;
    const auto loweredText = lowerToLimits(maxLevels, mix);
    beginSession(std::move(mix), document, isPaused);
    reportNoHeadphoneOutput(*model_, withoutHeadphone);
    reportLowered(loweredText, fileMix, maxLevels);
}

void MixerWindow::reportLowered(const std::string& loweredText, const Mix& fileMix,
                                const MixerLimits& maxLevels) {
    const auto& strips = model_->mix().strips;
    lostOutputs_.clear();
    for (std::size_t j = 0; j < std::min(maxLevels.strips.size(), strips.size()); ++j)
        if (strips[j].output < 0 && fileMix.strips[j].output >= 0 && maxLevels.strips[j].output >= 0)
            lostOutputs_.emplace_back(j, maxLevels.strips[j]);
    requestedMix_ = loweredText.empty() ? std::nullopt : std::optional{fileMix};
    if (requestedMix_)
        model_->messages().add({"Lowered to this desk: " + utf8(loweredText),
                                false,
                                {"Levels of the file", [this] { applyRequestedLevels(); }},
                                "levels"});
}

// An output that an actuator lost to a file remains the user's choice: the next session gets it back, no
// louder than what was played meanwhile.
MixerLimits MixerWindow::limits() const {
    if (!model_) return files_.limits();
    MixerLimits current = MixerLimits::fromMix(model_->mix());
    const double maxGainDb = current.loudestOutputDb() - current.levelDb;
    for (const auto& [j, oldStrip] : lostOutputs_) {
        if (j >= current.strips.size() || current.strips[j].output >= 0 ||
            std::ranges::find(current.strips, oldStrip.output, &Strip::output) != current.strips.end())
            continue;
        current.strips[j] = oldStrip;
        current.strips[j].gainDb = std::min(oldStrip.gainDb, maxGainDb);
    }
    return current;
}

// The user may set levels that a file may not.
void MixerWindow::applyRequestedLevels() {
    if (!requestedMix_) return;
    model_->change("Levels of the file", [this](Mix& mix) {
        mix.levelDb = requestedMix_->levelDb;
        if (requestedMix_->count() == mix.count()) mix.strips = requestedMix_->strips;
    });
    requestedMix_.reset();
    lostOutputs_.clear();
    model_->messages().withdraw("levels");
}

// A file on the command line is not an edit, so there is nothing to save yet.
void MixerWindow::start(const juce::File& file) {
    if (file.isDirectory()) {
        beginSession(defaultMix(), {});
        return showError(file.getFullPathName() + ": expected a file, found a folder");
    }
    if (!file.existsAsFile()) return beginSession(defaultMix(), file);
    if (fileKind(pathOf(file)) == FileKind::session) return void(load(file, file));
    const auto mix = mixWith(defaultMix(), file);
    if (mix) return playLowered(limits(), mix.value, {});
    beginSession(defaultMix(), {});
    showError(utf8(mix.error));
}

juce::String MixerWindow::documentName() const {
    return document_ == juce::File{} ? juce::String{"session"} : document_.getFileNameWithoutExtension();
}

juce::File MixerWindow::folderOfDocuments() const {
    if (document_ != juce::File{}) return document_.getParentDirectory();
    const auto folder = folder_->create();
    return folder ? folder.value : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
}

/// The path, relative to the home folder if possible: long words would be broken into lines.
static juce::String fromHome(const juce::File& file) {
    const auto home = juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    return file.isAChildOf(home) ? "~/" + file.getRelativePathFrom(home) : file.getFullPathName();
}

void MixerWindow::announceSaved(const juce::String& text, const juce::File& file, MessageAction action) {
    if (!action.run) action = {"Show", [file] { file.revealToUser(); }};
    MixerMessage message{text + " " + fromHome(file), true, std::move(action), savedLabel};
    const bool isInFront = model_->isInfo() || model_->messages().current().label ==
                                                   noHeadphoneOutputLabel; // the latter is queued
    isInFront ? model_->messages().show(std::move(message)) : model_->messages().add(std::move(message));
}

void MixerWindow::chooseFile(const juce::String& title, const juce::String& ending, bool isSaving,
                             std::function<void(const juce::File&)> onAccept,
                             const juce::String& suggestedName, const juce::File& parent) {
    const auto setting = "folder" + ending; // the last folder for each kind of file
    const juce::File last{files_.settings().getValue(setting)};
    const auto folder = parent != juce::File{} ? parent : last.isDirectory() ? last : folderOfDocuments();
    const auto name =
        suggestedName.isEmpty()
            ? juce::String{}
            : folder.getNonexistentChildFile(suggestedName, ending, false).getFileNameWithoutExtension();
    askForFile(view_->topBar(), {title, ending, folder, isSaving, name},
               [this, setting, onAccept = std::move(onAccept)](const juce::File& file) {
                   files_.settings().setValue(setting, file.getParentDirectory().getFullPathName());
                   onAccept(file);
               });
}

void MixerWindow::ask(const juce::String& title, const juce::String& message,
                      std::vector<std::pair<juce::String, std::function<void()>>> answers,
                      const std::vector<QuestionCard::Field>& fields) {
    std::vector<QuestionCard::Answer> all;
    for (auto& [answer, action] : answers)
        all.push_back({answer, [this, action = std::move(action)] { view_->setCard(nullptr), action(); }});
    all.push_back(
        {"Cancel", [this] { view_->setCard(nullptr); }, true, juce::KeyPress{juce::KeyPress::escapeKey}});
    view_->setQuestion(std::make_unique<QuestionCard>(title, message, std::move(all), fields));
}

void MixerWindow::offerSaveThen(std::function<void()> proceed, const juce::String& text) {
    if (!hasUnsavedChanges()) return proceed();
    ask("Save the session?", text, {{"Save", [this, proceed] { save(proceed); }}, {"Do not save", proceed}});
}

void MixerWindow::newDocument() {
    offerSaveThen([this] {
        files_.copies().discardOwn();
        beginSession(defaultMix(), {});
    });
}

void MixerWindow::openDocument() { askToOpen("Open a session, a scene or a layout"); }

void MixerWindow::openDocument(const juce::File& file) {
    offerSaveThen([this, file] {
        if (!load(file, file)) return;
        files_.copies().discardOwn();
        files_.addRecent(file);
    });
}

void MixerWindow::openFile(const juce::File& file) {
    if (fileKind(pathOf(file)) == FileKind::session) return openDocument(file);
    auto mix = mixWith(model_->mix(), file);
    if (!mix) return showError(utf8(mix.error));
    const Mix fileMix = mix.value;
    const MixerLimits maxLevels = limits();
    const auto loweredText = lowerToLimits(maxLevels, mix.value);
    model_->edit(file.getFileName(), mix.value);
    reportLowered(loweredText, fileMix, maxLevels);
}

void MixerWindow::save(std::function<void()> onSaved) {
    if (document_ == juce::File{}) return saveAs(std::move(onSaved));
    if (!saveTo(document_)) return;
    onSaved ? onSaved() : announceSaved("Saved", document_);
}

void MixerWindow::saveAs(std::function<void()> onSaved) {
    chooseFile(
        "Save the session", sessionEnding, true,
        [this, onSaved = std::move(onSaved)](const juce::File& file) {
            if (!saveTo(file)) return;
            if (onSaved) onSaved(); // which may open another session
            announceSaved("Saved", file);
        },
        documentName());
}

bool MixerWindow::saveTo(const juce::File& file) {
    const auto edits = model_->editCount();
    const auto text = sessionJson(model_->savedSession(), std::filesystem::path{pathOf(file)}.parent_path());
    if (const auto error = writeFile(pathOf(file), text); !error.empty())
        return showError(utf8(error)), false;
    device_ = model_->device().choice();
    files_.addOwnSession(text, outputInUse());
    document_ = file;
    savedEditCount_ = edits;
    files_.copies().discardOwn();
    files_.addRecent(file);
    updateTitle();
    return true;
}

void MixerWindow::record() {
    if (model_->recording().isRunning()) return model_->recording().stop();
    const auto file = folder_->newFile(documentName() + "-take", {".wav", ".csv"});
    const auto error = file ? model_->recording().start(file.value) : file.error;
    view_->topBar().setRecording(error.empty());
    if (!error.empty()) showError(utf8(error));
}

void MixerWindow::askSeconds(const juce::String& title, const juce::String& text, double seconds,
                             juce::Range<double> limits, const juce::String& quantity,
                             std::function<void(double)> onAccept) {
    askForValues(
        view_->topBar(), title, "Choose a file" + ellipsis(), {secondsField(seconds)},
        [this, limits, quantity, onAccept = std::move(onAccept)](const juce::StringArray& values) {
            const double value = values[0].getDoubleValue();
            if (value >= limits.getStart() && value <= limits.getEnd()) return onAccept(value);
            showError(quantity + ": expected " + number(limits.getStart(), limits.getStart() < 1.0 ? 1 : 0) +
                      " to " + number(limits.getEnd(), 0));
        },
        "It was played for " + secondsText(playedSeconds()) + " s. " + text);
}

void MixerWindow::renderOffline() {
    askSeconds("Render the session", "Beyond that its last scene goes on by itself.", playedSeconds(),
               {0.1, maxRenderSeconds}, "Seconds to render", [this](double seconds) {
                   chooseFile(
                       "Render the session to", ".wav", true,
                       [this, seconds](const juce::File& file) { renderTo(file, seconds); }, documentName());
               });
}

void MixerWindow::startRender(const juce::File& file, const juce::String& doneWords, RenderTask::Work work) {
    if (renderTask_)
        return showError(renderTask_->file().getFileName() + " is being made: one file at a time");
    renderTask_ = std::make_unique<RenderTask>(
        file, std::move(work), [this, file, doneWords](const std::string& error, bool isCancelled) {
            renderTask_.reset();
            if (isCancelled)
                model_->announce("Cancelled; nothing was written");
            else if (!error.empty())
                showError(utf8(error));
            else
                announceSaved(doneWords, file);
        });
    view_->setProgress(renderTask_.get());
}

void MixerWindow::renderTo(const juce::File& file, double seconds) {
    const int rateHz = std::max(8000, model_->output().sampleRateHz());
    startRender(
        file, "Rendered",
        [session = model_->savedSession(), seconds, rateHz, path = pathOf(file)](const auto& progress) {
            return renderSessionWav(session, {rateHz, seconds, progress}, path, "physvib " PHYSVIB_VERSION);
        });
}

void MixerWindow::saveMovie() {
    const double played = playedSeconds();
    if (played < minMovieSeconds) return showError("Save movie: expected a session of at least a second");
    askSeconds("Save a movie", "The movie has the last seconds of that.",
               std::min(defaultMovieSeconds, played), {minMovieSeconds, maxMovieSeconds},
               "Seconds of the movie", [this](double seconds) {
                   chooseFile(
                       "Save the movie", utf8(movieEnding()), true,
                       [this, seconds](const juce::File& file) { saveMovieTo(file, seconds); },
                       documentName() + "-movie");
               });
}

void MixerWindow::saveMovieTo(const juce::File& file, double seconds) {
    startRender(
        file,
        file.hasFileExtension("mp4") ? "Saved the movie"
                                     : "Saved the movie without sound, which needs the program ffmpeg:",
        [session = model_->savedSession(), layout = model_->mix().layout, seconds, path = pathOf(file)](
            const auto& progress) { return writeSessionMovie(session, layout, seconds, path, progress); });
}

void MixerWindow::exportLayout() {
    chooseFile(
        "Save the layout to", sessionEnding, true,
        [this](const juce::File& file) {
            if (model_->reportIfError(writeFile(pathOf(file), layoutJson(model_->mix().layout)))) return;
            announceSaved("Saved the layout", file);
        },
        "layout");
}

void MixerWindow::askToOpen(const juce::String& title) {
    chooseFile(title, sessionEnding, false, [this](const juce::File& file) { openFile(file); });
}

// Shows the newest readable copy, with a line on the first unreadable one.
void MixerWindow::offerRecovery() {
    const auto copies = files_.copies().abandonedCopies();
    const std::size_t total = std::min(copies.size(), maxOfferedCopies);
    std::size_t index = 0;
    for (; index < total; ++index) {
        const auto session = RecoveryCopies::read(copies[index]);
        if (session) break;
        if (index == 0) model_->messages().add({utf8(session.error) + "; it stays until it is discarded"});
    }
    showCopy(copies, index == total ? 0 : index);
}

void MixerWindow::showCopy(const std::vector<std::filesystem::path>& copies, std::size_t index) {
    if (copies.empty()) {
        if (view_->question() != nullptr) view_->setQuestion(nullptr);
        return;
    }
    const std::size_t total = std::min(copies.size(), maxOfferedCopies);
    const auto copy = copies[index];
    const auto session = RecoveryCopies::read(copy);
    const auto count = [](std::size_t n) { return juce::String{static_cast<int>(n)}; };
    juce::String message = "The mixer ended without being closed. " + describeCopy(copy, session);
    if (total > 1) message += "\nCopy " + count(index + 1) + " of " + count(total) + ", the newest first.";
    if (total < copies.size())
        message +=
            " " + count(copies.size() - total) + " older ones stay in " + utf8(copy.parent_path().string());
    const auto discard = [this](std::vector<std::filesystem::path> copiesToDiscard) {
        std::string error;
        for (const auto& copyFile : copiesToDiscard)
            if (auto problem = RecoveryCopies::remove(copyFile); !problem.empty()) error = std::move(problem);
        offerRecovery();
        if (!error.empty()) showError(utf8(error));
    };
    std::vector<QuestionCard::Answer> answers{
        {"Take it up", [this, copy] { recover(copy); }, static_cast<bool>(session)},
        {"Discard it", [discard, copy] { discard({copy}); }},
        {"Not now", [this] { view_->setQuestion(nullptr); }}};
    if (total > 1) {
        answers.push_back({"Newer", [this, copies, index] { showCopy(copies, index - 1); }, index > 0,
                           juce::KeyPress{juce::KeyPress::leftKey}});
        answers.push_back({"Older", [this, copies, index] { showCopy(copies, index + 1); }, index + 1 < total,
                           juce::KeyPress{juce::KeyPress::rightKey}});
        answers.push_back({"Discard all " + count(total), [discard, copies, total] {
                               discard({copies.begin(), copies.begin() + static_cast<std::ptrdiff_t>(total)});
                           }});
    }
    view_->setQuestion(std::make_unique<QuestionCard>(
        total > 1 ? "Take up a session?" : "Take up the last session?", message, std::move(answers)));
}

// The copy is kept until this run's own copy is on disk.
void MixerWindow::recover(const std::filesystem::path& copy) {
    offerSaveThen([this, copy] {
        view_->setQuestion(nullptr);
        if (!load(juce::File{utf8(copy.string())}, {}, true)) return offerRecovery();
        savedEditCount_ = neverSaved;
        files_.copies().discardOwn(); // the previous session was saved or discarded by the user
        files_.copies().adopt(copy);
        model_->reportIfError(files_.writeCopyNow(*model_));
    });
}

void MixerWindow::saveScene(bool hasCurrentPoses, const juce::File& parent) {
    files_.scenesFolder().createDirectory();
    chooseFile(
        "Save as scene", ".json", true,
        [this, hasCurrentPoses](const juce::File& file) {
            if (model_->reportIfError(saveSceneTo(file, hasCurrentPoses))) return;
            announceSaved("Saved the scene", file);
        },
        "scene", parent != juce::File{} ? parent : files_.scenesFolder());
}

std::string MixerWindow::saveSceneTo(const juce::File& file, bool hasCurrentPoses) {
    const auto& world = model_->world();
    Scene scene = world.drawing().drawn();
    if (hasCurrentPoses) scene = sceneNow(scene, world.posesNow());
    scene.name = file.getFileNameWithoutExtension().toStdString();
    scene.variables.clear();
    if (auto invalid = validate(scene); !invalid.empty()) return invalid;
    auto error = writeFile(pathOf(file), sceneJson(scene));
    if (error.empty()) view_->topBar().setOwnScenes(files_.ownScenes());
    return error;
}

void MixerWindow::recordScript() {
    auto& script = model_->script();
    script.isRecording() ? script.stop() : script.start();
    if (script.isRecording()) view_->world().drawing().setTool(DrawTool::hand);
}

void MixerWindow::newScene(SceneGround ground) {
    model_->change("New scene", [&](Mix& mix) {
        mix.scene = std::make_shared<const Scene>(physvib::newScene(*MixerModel::defaultMix().scene, ground));
    });
    view_->world().drawing().setTool(DrawTool::ball);
}

// Without the address of a page, it offers to start a server, or a movie or scene file.
void MixerWindow::share(bool asksAddress) {
    const auto link = pageLink(model_->mix(), model_->world().drawing().drawn());
    if (!link) return showError(utf8(link.error));
    const auto saved = files_.settings().getValue(pageSetting);
    const auto page = servedAddress_.isNotEmpty() ? servedAddress_
                      : isLoopback(saved)         ? juce::String{}
                                                  : saved;
    if (page.isEmpty() && !asksAddress) {
        const bool canServe = PageServer::isAvailable();
        std::vector<std::pair<juce::String, std::function<void()>>> options{
            {"Save movie" + ellipsis(), [this] { saveMovie(); }},
            {"Save as scene" + ellipsis(), [this] { saveScene(false, folderOfDocuments()); }},
            {"Other page" + ellipsis(), [this] { share(true); }}};
        if (canServe) options.insert(options.begin(), {serveLabel, [this] { startPageServer(); }});
        return ask("Share the world",
                   canServe
                       ? "Serve it here gives a web page with this world to phones in this network, with a "
                         "code.\nA movie plays on any phone; a scene is felt in another mixer."
                       : "A movie plays on any phone.\nA scene is felt in another mixer, or on a web page of "
                         "PhysVib. That page is a part of a release (physvib-page): unpacked into the "
                         "mixer's folder, Share serves it to phones, with a code.",
                   std::move(options));
    }
    const auto makeLink = [fragment = utf8(link.value)](const juce::String& address) {
        return address.isEmpty() ? address
                                 : address.upToFirstOccurrenceOf("#", false, false) + "#" + fragment;
    };
    const auto typedAddress = std::make_shared<juce::String>(page);
    const auto fullLink = [this, makeLink, typedAddress] {
        if (*typedAddress != servedAddress_) files_.settings().setValue(pageSetting, *typedAddress);
        return makeLink(*typedAddress);
    };
    const auto show = [makeLink, typedAddress, isServed = servedAddress_.isNotEmpty()](
                          QuestionCard& card, const juce::String& address) {
        *typedAddress = address;
        const bool isLoopbackPage = isLoopback(address), hasAddress = address.isNotEmpty();
        card.setValue(linkField, makeLink(address));
        for (const char* label : {copyLabel, openLabel}) card.enableAnswer(label, hasAddress);
        const auto code =
            isLoopbackPage || !hasAddress ? juce::Image{} : qrPicture(makeLink(address).toStdString());
        card.setPicture(code, isLoopbackPage ? "No code: this address leads nowhere on a phone, only here"
                              : !hasAddress  ? "A phone's code comes with the address"
                                             : "No code: this world's link is too long for one");
        card.setTexts(
            "Share the world",
            hasAddress ? juce::String{"Who opens the link gets the same world and samples."} +
                             (isServed ? " The page is here while the mixer runs; a browser warns once of "
                                         "its certificate."
                                       : "")
                       : "Type the address of a web page of PhysVib: the link to this world there follows.");
    };
    std::vector<std::pair<juce::String, std::function<void()>>> answers{
        {copyLabel,
         [this, fullLink] {
             const auto copiedLink = fullLink();
             juce::SystemClipboard::copyTextToClipboard(copiedLink);
             model_->announce("Copied a link of " + juce::String{copiedLink.length()} + " characters");
         }},
        {openLabel, [fullLink] { openLink(fullLink()); }}};
    if (servedAddress_.isEmpty() && PageServer::isAvailable())
        answers.push_back({serveLabel, [this] { startPageServer(); }});
    ask("Share the world", {}, std::move(answers), {{pageField, page, {}, {}, show}, {linkField, {}}});
    show(*view_->question(), page);
}

// Phones allow sound and sensors only with https; making its certificate takes a moment, so a thread waits.
void MixerWindow::startPageServer() {
    server_ = std::make_shared<PageServer>();
    juce::Thread::launch([server = server_, window = SafePointer{this}] {
        juce::MessageManager::callAsync([window, address = server->start()] {
            if (window == nullptr) return;
            if (!address) return window->showError(utf8(address.error));
            if (isLoopback(utf8(address.value)))
                return window->showError("This computer is in no network: nobody would reach the page");
            window->servedAddress_ = utf8(address.value);
            window->share();
        });
    });
}

int MixerWindow::zoom() {
    const int percent = files_.settings().getIntValue(zoomSetting); // the file may hold any number
    return std::ranges::find(zoomPercents, percent) == zoomPercents.end() ? 0 : percent;
}

void MixerWindow::setZoom(int percent) {
    files_.settings().setValue(zoomSetting, percent);
    applyZoom();
}

void MixerWindow::stepZoom(int steps) {
    const int percentNow = juce::roundToInt(100.0f * juce::Desktop::getInstance().getGlobalScaleFactor());
    const auto index = std::ranges::lower_bound(zoomPercents, percentNow) - zoomPercents.begin() + steps;
    if (index >= 0 && index < std::ssize(zoomPercents) && windowFits(nth(zoomPercents, index), displaySize()))
        setZoom(nth(zoomPercents, index));
}

// The window keeps its size on the screen.
void MixerWindow::applyZoom() {
    auto& desktop = juce::Desktop::getInstance();
    const auto room = displaySize();
    int percent = zoom() > 0 ? zoom() : automaticZoom(room);
    while (percent > zoomPercents.front() && !windowFits(percent, room))
        percent = std::max(zoomPercents.front(), percent - 25);
    const float oldScale = desktop.getGlobalScaleFactor(), newScale = 0.01f * static_cast<float>(percent);
    const float limitScale = std::min(1.0f, newScale); // JUCE has limits in pixels of the display
    setResizeLimits(juce::roundToInt(limitScale * MixerView::minWidth),
                    juce::roundToInt(limitScale * MixerView::minHeight), 7680, 4320);
    if (juce::approximatelyEqual(oldScale, newScale)) return;
    const auto bounds = (getBounds().toFloat() * (oldScale / newScale)).toNearestInt();
    desktop.setGlobalScaleFactor(newScale);
    if (isOnDesktop()) setBounds(bounds);
}

void MixerWindow::setShowMode(bool isShowMode) {
    juce::Desktop::getInstance().setKioskModeComponent(isShowMode ? this : nullptr, false);
    view_->setShowMode(isShowMode);
    view_->grabKeyboardFocus();
}

juce::PopupMenu MixerWindow::viewMenu() {
    juce::PopupMenu menu, zoomMenu;
    const bool isPlayMode = view_->mode() == Mode::play, isLight = view_->theme() == Theme::light;
    const Panels panels = view_->panels();
    add(menu, {"Play", "F2", true, isPlayMode}, [this] { view_->setMode(Mode::play); });
    add(menu, {"Engineer", "F2", true, !isPlayMode}, [this] { view_->setMode(Mode::engineer); });
    menu.addSeparator();
    add(menu, {"Strips, and what is played", "F3", true, panels.hasLower}, [this, panels] {
        view_->setPanels({panels.hasDrawer, !panels.hasLower});
    });
    for (const auto& name : view_->tabs().names())
        add(menu, {name, name == "Actuators" ? "F4" : ""}, [this, name] { view_->tabs().choose(name); });
    add(menu, {"Automatic panels", {}, view_->dividers() != Dividers{}}, [this] { view_->setDividers({}); });
    menu.addSeparator();
    add(menu, {"Dark", {}, true, !isLight}, [this] { setTheme(Theme::dark); });
    add(menu, {"Light", {}, true, isLight}, [this] { setTheme(Theme::light); });
    add(zoomMenu, {"By the display", "Ctrl+0", true, zoom() == 0}, [this] { setZoom(0); });
    for (const int percent : zoomPercents)
        add(zoomMenu,
            {juce::String{percent} + " %", {}, windowFits(percent, displaySize()), zoom() == percent},
            [this, percent] { setZoom(percent); });
    menu.addSubMenu("Zoom", zoomMenu);
    add(menu, {"Full screen for a show", "F11", true, view_->isShowMode()},
        [this] { setShowMode(!view_->isShowMode()); });
    add(menu, {"Width of the display" + ellipsis()}, [this] { askDisplayWidth(); });
    return menu;
}

} // namespace physvib
