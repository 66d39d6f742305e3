// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's window: document, settings, keys and menu.
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

// in the order of OscUse
constexpr std::array<const char*, 3> oscUseNames{"off", "this-computer", "any-computer"};

OscUse oscUseNamed(const juce::String& name) {
    const auto found = std::ranges::find(oscUseNames, name.toStdString());
    return found == oscUseNames.end() ? OscUse::off : static_cast<OscUse>(found - oscUseNames.begin());
}

constexpr const char* chosenSetting = "device-chosen"; // the user has chosen a device, or none
constexpr const char* silentSetting = "silent";
constexpr const char* beforeEarsSetting = "outputs-before-headphones";
constexpr const char* orderSetting = "mode";          // and which panels are unfolded; none: to play
constexpr const char* folderSetting = "files-folder"; // of recordings and documents; empty: UserFolder's own
constexpr const char* displayWidthSetting = "display-width-mm"; // 0: as the system reports
/// Size of borders and title bar; the exact size is known only after the window exists.
constexpr juce::Point<int> frameRoom{8, 40};
constexpr auto command = juce::ModifierKeys::commandModifier, shift = juce::ModifierKeys::shiftModifier;

constexpr const char* sessionEnding = ".json";
constexpr double minMovieSeconds = 1.0, usualMovieSeconds = 60.0;
constexpr double longestRender = 86'400.0; // the limit of `physvib render`

juce::String tenths(double seconds) { return juce::String{std::ceil(10.0 * seconds) / 10.0, 1}; }

// without thousands separators
QuestionCard::Field secondsField(double seconds) { return {"Seconds", tenths(seconds), "0123456789."}; }

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

constexpr std::size_t maxOffered = 20; // as many as a user may look through; each is read when it is shown

juce::String nameOf(const std::filesystem::path& copy) { return utf8(copy.filename().string()); }

/// Time and contents of a copy, or why it cannot be read.
juce::String describe(const std::filesystem::path& copy, const Result<SavedSession>& session) {
    const auto time =
        juce::File{utf8(copy.string())}.getLastModificationTime().toString(true, true, true, true);
    if (!session) return "Of " + time + ": " + utf8(session.error).replace(utf8(copy.string()), nameOf(copy));
    const Mix mix = mixOf(session.value);
    return "Kept at " + time + ": " + titleOf(mix.scene->name) + " on " + juce::String{mix.count()} +
           " actuators, played for " + number(1e-9 * static_cast<double>(session.value.lengthNs), 1) + " s.";
}

constexpr const char *pageSetting = "page", *pageField = "Address of the page", *linkField = "Link",
                     *copyWords = "Copy the link", *openWords = "Open it", *serveWords = "Serve it here";

constexpr std::array<int, 7> zooms{60, 75, 100, 125, 150, 175, 200};
constexpr const char* zoomSetting = "zoom";
constexpr juce::Point<int> usualDisplay{1920, 1080}; // at 100 %

/// Room of the display in pixels at 100 %.
juce::Point<int> displayRoom() {
    auto& desktop = juce::Desktop::getInstance();
    const auto* display = desktop.getDisplays().getPrimaryDisplay();
    if (display == nullptr) return usualDisplay;
    const auto area = usableOf(*display).toFloat() * desktop.getGlobalScaleFactor();
    return {juce::roundToInt(area.getWidth()), juce::roundToInt(area.getHeight())};
}

bool fits(int percent, juce::Point<int> room) {
    return 100 * room.x >= percent * MixerView::minWidth && 100 * room.y >= percent * MixerView::minHeight;
}

/// The largest zoom that leaves the window the room of a usual display.
int automaticZoom(juce::Point<int> room) {
    int best = 100;
    for (const int percent : zooms)
        if (100 * room.x >= percent * usualDisplay.x && 100 * room.y >= percent * usualDisplay.y)
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
            : settings.getValue("device", juce::String{noDeviceType} + ":" + noDeviceName).toStdString(),
        settings.getIntValue("rate"), settings.getIntValue("block")};
    if (const int left = settings.getIntValue("monitor-left"), right = settings.getIntValue("monitor-right");
        left > 0 && right > 0)
        device_.monitor = {left - 1, right - 1};
    device_.monitorDb = settings.getDoubleValue("monitor-db", safeContactDb);
    device_.marker = settings.getIntValue("marker") - 1;
    device_.isHeadphones = device.isEmpty() && settings.getBoolValue("headphones");
    for (const auto& output : juce::StringArray::fromTokens(settings.getValue(beforeEarsSetting), false))
        device_.beforeEars.push_back(output.getIntValue());
    for (const SinkKind& kind : sinkKinds())
        device_.want(kind, settings.getValue(kind.setting.data()).toStdString());
    folder_->choose(juce::File::createFileWithoutCheckingPath(settings.getValue(folderSetting)));
    dragged_->setEnding(std::max(0, hitEndings().indexOf(settings.getValue("clip-ending"))));
    setUsingNativeTitleBar(true);
    const bool endedBadly = !files_.copies().leftBehind().empty();
    if (endedBadly) before_ = files_.limits();
    start(file);
    setResizable(true, false);
    applyZoom();
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()) {
        const auto room = usableOf(*display);
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
        later(*this,
              [](MixerWindow& window) { window.addFirstStart(feltChoices(window.drivers_, likelySinks())); });
    reportInstead();
    offerRecovery();
    if (!files_.settingsFault().empty())
        model_->messages().add({utf8(files_.settingsFault()), false, {}, "settings"});
    startTimer(500);
}

MixerWindow::~MixerWindow() {
    stopTimer();
    files_.settings().setValue(silentSetting, model_->isSilent());
    keepOrder();
    files_.setLimits(limits());
    files_.setExposureToday(model_->exposure().squareGSeconds(), true);
    rendering_.reset();
    clearContentComponent();
    view_.reset();
    model_.reset();
}

// A document gets a new MixerModel: its session starts at 0, and without undo steps unless they are given.
void MixerWindow::play(Mix mix, const juce::File& document, bool isPaused,
                       std::shared_ptr<MixerHistory> history) {
    const bool wasSilent = model_ ? model_->isSilent() : files_.settings().getBoolValue(silentSetting);
    const bool wasAsked = view_ && view_->question() != nullptr;
    const double exposure = model_ ? model_->exposure().squareGSeconds() : files_.exposureToday();
    if (view_) keepOrder();
    asked_.reset();
    lost_.clear();
    clearContentComponent();
    view_.reset();
    model_.reset();
    model_ = std::make_unique<MixerModel>(drivers_, device_, std::move(mix),
                                          MixerStart{wasSilent, isPaused, std::move(history)});
    model_->exposure().goOnFrom(exposure);
    view_ = std::make_unique<MixerView>(*model_);
    view_->setProgress(rendering_.get()); // of another session, which goes on
    setContentNonOwned(view_.get(), getWidth() == 0);
    document_ = document;
    savedEdits_ = model_->edits();
    const auto& settings = files_.settings();
    auto& bar = view_->topBar();
    bar.onMenu = [this](juce::Component& from) { showMenu(from); };
    bar.onRecord = [this] { record(); };
    bar.onSave = [this] { save(); };
    bar.onDevice = [this] { view_->tabs().choose("Output"); };
    model_->device().onSinksWanted = [this](const DeviceChoice& choice) {
        later(*this, [choice](MixerWindow& window) { window.useSinks(choice); }); // the calling tab goes with
                                                                                  // its model
    };
    bar.onOpenScene = [this] { import("Scene"); };
    bar.setOwnScenes(files_.ownScenes());
    bar.onOwnScene = [this](const juce::File& own) { openFile(own); };
    model_->recording().onEnd = [this](const juce::File& file, const juce::String& error) {
        lastRecording_ = file;
        view_->topBar().setRecording(false);
        if (error.isNotEmpty())
            say(file.getFileName() + ": " + error);
        else if (model_->recording().wasSilent())
            announceSaved("Nothing was played meanwhile: a silent recording,", file);
        else
            announceSaved("Recorded, with its events beside it:", file,
                          {"Play", [this, file] { model_->strikes().playTake(file); }});
    };
    OscChoice osc{oscUseNamed(settings.getValue("osc")), settings.getValue("osc-to").toStdString(),
                  settings.getDoubleValue("osc-turn")};
    if (const auto error = model_->inputs().use(osc); !error.empty()) {
        osc.receiver.clear(); // the host name cannot be resolved now
        model_->inputs().use(osc);
        model_->report("OSC: " + utf8(error));
    }
    model_->setDisplayWidth(1e-3 * settings.getDoubleValue(displayWidthSetting));
    view_->setTheme(settings.getValue("look") == "light" ? Theme::light : Theme::dark);
    view_->setDividers(Dividers::of(settings.getValue("panels")));
    view_->setOrder(settings.getValue(orderSetting));
    view_->grabKeyboardFocus();
    nameWindow();
    if (wasAsked) offerRecovery();
}

void MixerWindow::useSinks(const DeviceChoice& choice) {
    const auto use = [this, choice] {
        device_ = choice;
        for (const SinkKind& kind : sinkKinds())
            files_.settings().setValue(kind.setting.data(), utf8(choice.placeOf(kind)));
        const bool isFirst = view_->firstStart() != nullptr, wasChanged = isChanged();
        Mix mix = mixOf(model_->saved());
        const auto history = model_->history();
        history->drawn.emplace_back(model_->mix().scene, mix.scene);
        play(std::move(mix), document_, model_->session().world().slowness() == 0, history);
        if (wasChanged) savedEdits_ = neverSaved;
        if (isFirst && !choice.sinks.empty())
            return addFirstStart({}).test(kindOf(choice.sinks.front()).actuators);
        view_->tabs().choose("Output"); // the tab where it was chosen
    };
    askThen(use, "Another output begins the session anew: mix, drawing and undo steps stay, its past is "
                 "lost.");
}

FirstStart& MixerWindow::addFirstStart(std::vector<FeltChoice> choices) {
    auto card = std::make_unique<FirstStart>(*model_, std::move(choices));
    card->onEnd = [this](bool hasChosen) {
        if (hasChosen) files_.settings().setValue(chosenSetting, true);
        later(*this, [](MixerWindow& window) { window.view_->setFirstStart(nullptr); });
    };
    card->onSink = [this](const DeviceChoice& choice) {
        files_.settings().setValue(chosenSetting, true);
        if (model_->device().onSinksWanted) model_->device().onSinksWanted(choice);
    };
    FirstStart& shown = *card;
    view_->setFirstStart(std::move(card));
    return shown;
}

void MixerWindow::reportInstead() {
    const auto& wanted = device_.name;
    if (model_->trouble().isEmpty() || wanted.starts_with(std::string{noDeviceType} + ":")) return;
    for (const auto& there : byLikelihood(listAudioDevices(drivers_)))
        if (there.type != noDeviceType && there.channels > 0 && there.type + ":" + there.name != wanted)
            return model_->messages().add({"There is " + utf8(there.type + ":" + there.name) + " (" +
                                           juce::String{there.channels} + " outputs) instead, under Output"});
}

void MixerWindow::nameWindow() {
    const auto name =
        document_ == juce::File{} ? juce::String{"new session"} : document_.getFileNameWithoutExtension();
    // ASCII, since JUCE passes other characters to X11 window managers as Latin-1
    const auto title = name + (isChanged() ? " *" : "") + " - PhysVib mixer";
    if (title != getName()) setName(title);
    if (view_) view_->topBar().setDocument(name);
}

void MixerWindow::timerCallback() {
    nameWindow();
    device_ = model_->device().choice();
    auto& settings = files_.settings();
    settings.setValue("device", utf8(device_.name));
    const auto colon = device_.name.find(':');
    if (const int all = model_->device().outputs(); all > 0 && colon != std::string::npos)
        settings.setValue("outputs", device_.isHeadphones
                                         ? DeviceChoice::ears
                                         : ownOutputs({device_.name.substr(0, colon),
                                                       device_.name.substr(colon + 1), all}));
    settings.setValue("headphones", device_.isHeadphones);
    juce::StringArray before;
    for (const int output : device_.beforeEars) before.add(juce::String{output});
    settings.setValue(beforeEarsSetting, before.joinIntoString(" "));
    settings.setValue("rate", device_.sampleRateHz);
    settings.setValue("block", device_.blockFrames);
    settings.setValue("osc", nth(oscUseNames, model_->inputs().choice().use));
    settings.setValue("osc-to", utf8(model_->inputs().choice().receiver));
    settings.setValue("osc-turn", model_->inputs().choice().turnDegrees);
    for (const std::size_t ear : {0u, 1u})
        settings.setValue(ear == 0 ? "monitor-left" : "monitor-right",
                          device_.monitor.size() > ear ? device_.monitor[ear] + 1 : 0);
    settings.setValue("monitor-db", device_.monitorDb);
    settings.setValue("marker", device_.marker + 1);
    settings.setValue("clip-ending", hitEndings()[dragged_->ending()]);
    settings.setValue(silentSetting, model_->isSilent());
    keepOrder();
    files_.setLimits(limits());
    files_.setExposureToday(model_->exposure().squareGSeconds());
    offerMonitor();
    if (const auto fault = files_.keep(*model_, isChanged()); fault && fault->empty())
        model_->messages().withdraw("kept");
    else if (fault)
        model_->messages().show({utf8(*fault), false, {}, "kept"});
}

void MixerWindow::keepOrder() {
    files_.settings().setValue("panels", view_->dividers().text());
    files_.settings().setValue(orderSetting, view_->order());
}

Mix MixerWindow::firstMix() {
    const auto& settings = files_.settings();
    Mix mix = MixerModel::firstMix();
    if (const int outputs = settings.getIntValue("outputs");
        outputs > 0 && settings.getValue("device") == utf8(device_.name) &&
        settings.getBoolValue("headphones") == device_.isHeadphones)
        fitLayoutTo(outputs, mix, device_.name);
    const DeskLimits left = limits();
    mix.levelDb = std::min(mix.levelDb, left.loudestOutputDb());
    if (device_.isHeadphones) mix.levelDb = std::min(mix.levelDb, safeContactDb);
    std::vector<int> routes; // as they were chosen: no output that was not in use
    for (const Strip& strip : left.strips)
        routes.push_back(
            std::ranges::find(device_.monitor, strip.output) == device_.monitor.end() ? strip.output : -1);
    showPlayedOutputs(routes, mix.strips);
    if (device_.isHeadphones) return mix;
    const auto before = std::min(mix.strips.size(), device_.beforeEars.size()); // they limit what comes after
    takeOffHeadphones(device_, mostStripOutputs, std::span{mix.strips}.first(before),
                      settings.getBoolValue("headphones") ? 0 : left.strips.size());
    device_.beforeEars.clear();
    return mix;
}

// Shown once, if headphones may be connected in place of actuators.
void MixerWindow::offerMonitor() {
    auto& settings = files_.settings();
    constexpr const char *offered = "monitor-offered", *label = "monitor-offer";
    if (model_->device().outputs() != 2 || !device_.sinks.empty() || !device_.monitor.empty() ||
        device_.isHeadphones)
        return model_->messages().withdraw(label);
    if (settings.getBoolValue(offered)) return;
    settings.setValue(offered, true);
    model_->messages().add({"This device has two outputs. With headphones there, what is felt can be heard",
                            true,
                            {"Show Output", [this] { view_->tabs().choose("Output"); }},
                            label});
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
    if (view_->pauseStudy()) return;
    askThen([this] {
        stopTimer(); // else it may keep another copy before the end
        files_.copies().forget();
        juce::JUCEApplicationBase::quit();
    });
}

void MixerWindow::setTheme(Theme theme) {
    view_->setTheme(theme);
    files_.settings().setValue("look", theme == Theme::light ? "light" : "dark");
}

void MixerWindow::chooseFolder() {
    askForFile(view_->topBar(),
               {"The folder of recordings, sessions, movies and studies", {}, folder_->place()},
               [this](const juce::File& chosen) {
                   folder_->choose(chosen);
                   files_.settings().setValue(folderSetting, chosen.getFullPathName());
                   if (const auto folder = folder_->make(); folder)
                       announceSaved("Files go to", folder.value);
               });
}

// Display sizes reported by the system are often wrong.
void MixerWindow::askDisplayWidth() {
    const double now =
        1e3 * displayOf(*view_).getWidth() / screenPixelsPerMetre(*view_, model_->displayWidthMetres());
    askForValues(
        view_->topBar(), "Width of the display", "Set", {{"Width in mm", number(now, 0)}},
        [this](const juce::StringArray& values) {
            const auto& words = values[0];
            const double mm = words.isEmpty() ? 0.0 : words.replaceCharacter(',', '.').getDoubleValue();
            if (words.isNotEmpty() && !isDisplayWidth(1e-3 * mm))
                return say("Width of the display: expected " + number(1e3 * minDisplayMetres, 0) + " to " +
                           number(1e3 * maxDisplayMetres, 0) + " mm, found " + words);
            model_->setDisplayWidth(1e-3 * mm);
            files_.settings().setValue(displayWidthSetting, mm);
        },
        "Drags in the world are measured in metres of the screen. Measure its picture from left to right, in "
        "mm; empty: as the system says.");
}

// Plus needs Shift on some keyboards, and has a key of its own beside the digits.
static int zoomStepOf(const juce::KeyPress& key) {
    if (!key.getModifiers().isCommandDown()) return 0;
    const int code = key.getKeyCode();
    if (code == '+' || code == '=' || code == juce::KeyPress::numberPadAdd) return 1;
    return code == '-' || code == juce::KeyPress::numberPadSubtract ? -1 : 0;
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

namespace {

struct MenuItem {
    juce::String name, keys{};
    bool isEnabled = true, isTicked = false;
};

void add(juce::PopupMenu& menu, const MenuItem& item, std::function<void()> act) {
    juce::PopupMenu::Item made{item.name};
    made.shortcutKeyDescription = item.keys;
    made.isEnabled = item.isEnabled;
    made.isTicked = item.isTicked;
    menu.addItem(made.setAction(std::move(act)));
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

/// A key and what it does in each row, in two halves side by side.
class KeysCard final : public Card {
public:
    explicit KeysCard(std::function<void()> close)
        : Card{940} {
        rows_.addLines(keys);
        for (const auto& tool : drawTools)
            rows_.add(juce::String::charToString(static_cast<juce::juce_wchar>(tool.key)).toUpperCase() +
                      "\t" + tool.name);
        say("Keys", {});
        close_.onClick = std::move(close);
        setAnswers({&close_});
        fit();
    }
    bool keyPressed(const juce::KeyPress& key) override {
        if (key != juce::KeyPress::escapeKey && key != juce::KeyPress::returnKey) return false;
        return close_.onClick(), true;
    }
    void paint(juce::Graphics& g) override {
        Card::paint(g);
        g.setColour(shade(*this, Shade::text));
        for (int k = 0; k < rows_.size(); ++k) {
            auto row = content_.translated(k / half() * 480, k % half() * line).withHeight(line);
            g.setFont(text::font(text::small, juce::Font::bold));
            g.drawText(rows_[k].upToFirstOccurrenceOf("\t", false, false), row.removeFromLeft(180),
                       juce::Justification::centredLeft);
            g.setFont(text::font(text::small));
            g.drawText(rows_[k].fromFirstOccurrenceOf("\t", false, false), row,
                       juce::Justification::centredLeft);
        }
    }

private:
    static constexpr int line = 20;
    int half() const { return (rows_.size() + 1) / 2; }
    int contentHigh() const override { return half() * line; }
    void place(juce::Rectangle<int> content) override { content_ = content; }

    juce::StringArray rows_;
    juce::Rectangle<int> content_;
    juce::TextButton close_{"Close"};
};

} // namespace

void MixerWindow::showMenu(juce::Component& from) {
    juce::PopupMenu menu, help;
    add(help, {"First steps"}, [this] {
        model_->announce(
            "Drag a ball to throw it; the bar at the left draws. Esc silences everything, F2 has all "
            "controls.");
    });
    add(help, {"Keys" + dots()}, [this] {
        view_->setCard(std::make_unique<KeysCard>(
            [this] { later(*this, [](MixerWindow& window) { window.view_->setCard(nullptr); }); }));
    });
    menu.addSubMenu("File", fileMenu());
    menu.addSubMenu("Edit", editMenu());
    menu.addSubMenu("World", worldMenu());
    menu.addSubMenu("View", viewMenu());
    menu.addSubMenu("Help", help);
    menu.setLookAndFeel(&view_->getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from).withMinimumWidth(120));
}

juce::PopupMenu MixerWindow::fileMenu() {
    juce::PopupMenu menu, recent;
    for (int k = 0; k < files_.recent().getNumFiles(); ++k) {
        const auto file = files_.recent().getFile(k);
        recent.addItem(file.getFileName(), [this, file] { openDocument(file); });
    }
    add(menu, {"New", "Ctrl+N"}, [this] { newDocument(); });
    add(menu, {"Open" + dots(), "Ctrl+O"}, [this] { openDocument(); });
    menu.addSubMenu("Recent", recent, recent.getNumItems() > 0);
    add(menu, {"Save", "Ctrl+S"}, [this] { save(); });
    add(menu, {"Save as" + dots(), "Ctrl+Shift+S"}, [this] { saveAs(); });
    add(menu, {"Sessions left behind" + dots(), {}, !files_.copies().leftBehind().empty()},
        [this] { offerRecovery(); });
    menu.addSeparator();
    add(menu, {model_->recording().isRunning() ? "End the recording" : "Record", "Ctrl+R"},
        [this] { record(); });
    add(menu, {"Render" + dots(), "Ctrl+E"}, [this] { renderOffline(); });
    add(menu, {"Save movie" + dots()}, [this] { saveMovie(); });
    add(menu, {"Share" + dots()}, [this] { share(); });
    add(menu, {"Folder of recordings" + dots()}, [this] { chooseFolder(); });
    menu.addSeparator();
    add(menu, {"Quit", "Ctrl+Q"}, [this] { requestQuit(); });
    return menu;
}

juce::PopupMenu MixerWindow::editMenu() {
    juce::PopupMenu menu;
    auto& undo = model_->undoManager();
    auto& ab = view_->world().compare();
    add(menu,
        {undo.canUndo() ? "Undo: " + undo.getUndoDescription() : juce::String{"Undo"}, "Ctrl+Z",
         undo.canUndo()},
        [&undo] { undo.undo(); });
    add(menu,
        {undo.canRedo() ? "Redo: " + undo.getRedoDescription() : juce::String{"Redo"}, "Ctrl+Shift+Z",
         undo.canRedo()},
        [&undo] { undo.redo(); });
    auto& drawing = view_->world().drawing();
    add(menu, {"Select all", "Ctrl+A"}, [&drawing] { drawing.chooseAll(); });
    add(menu, {"Delete", "Del", !drawing.chosen().empty()},
        [&drawing] { drawing.eraseAll(drawing.chosen()); });
    menu.addSeparator();
    add(menu, {"Levels of the file", {}, asked_.has_value()}, [this] { useAskedLevels(); });
    menu.addSeparator();
    add(menu,
        {ab.isOn() ? juce::String{"Play "} + (ab.shown() == 'A' ? "B" : "A")
                   : juce::String{"Compare: make B, a copy of what plays"},
         "A"},
        [&ab] { ab.toggle(); });
    add(menu, {"Keep what plays", {}, ab.isOn()}, [this] {
        view_->world().compare().end();
        model_->sendChangeMessage();
    });
    return menu;
}

juce::PopupMenu MixerWindow::worldMenu() {
    juce::PopupMenu menu, fresh;
    fresh.addItem("Empty", [this] { newScene(SceneGround::empty); });
    fresh.addItem("Box", [this] { newScene(SceneGround::box); });
    fresh.addItem("Floor", [this] { newScene(SceneGround::floor); });
    menu.addSubMenu("New scene", fresh);
    add(menu, {"Open a scene" + dots()}, [this] { import("Scene"); });
    add(menu, {"Save as scene" + dots()}, [this] { saveScene(false); });
    add(menu, {"Save as scene, bodies as they are now" + dots()}, [this] { saveScene(true); });
    add(menu,
        {model_->script().isRecording() ? "End the recording of hands" : "Record hands as the scene's script",
         "Ctrl+Shift+R"},
        [this] { recordScript(); });
    menu.addSeparator();
    add(menu, {"Open a layout" + dots()}, [this] { import("Layout of actuators"); });
    add(menu, {"Save the layout" + dots()}, [this] { exportLayout(); });
    return menu;
}

bool MixerWindow::load(const juce::File& file, const juce::File& document, bool isOwn) {
    auto session = loadSession(pathOf(file));
    if (session) {
        const auto tellLacking = [&] {
            if (const auto words = lackingOf(session.value); words.isNotEmpty())
                model_->messages().add({words, false, {}, "lacking"});
            return true;
        };
        if (files_.isOwn(file, outputInUse())) { // nobody has changed it since
            play(mixOf(session.value), document, endsPaused(session.value));
            return tellLacking();
        }
        // the copy may lack the last seconds; who has used this run has set other levels since
        const bool isAsLeft = isOwn && before_ && !isChanged();
        playLowered(isAsLeft ? *before_ : limits(), mixOf(session.value), document,
                    endsPaused(session.value));
        return tellLacking();
    }
    if (!model_) play(firstMix(), {});
    say(utf8(session.error));
    return false;
}

void MixerWindow::playLowered(const DeskLimits& most, Mix mix, const juce::File& document, bool isPaused) {
    std::vector<std::size_t> withoutEar;
    if (device_.isHeadphones) withoutEar = placeNew(device_, mix.strips, 0); // L and R, whatever it played on
    const Mix asked = mix;
    const auto lowered = lowerTo(most, mix);
    play(std::move(mix), document, isPaused);
    reportNoEar(*model_, withoutEar);
    reportLowered(lowered, asked, most);
}

void MixerWindow::reportLowered(const std::string& lowered, const Mix& asked, const DeskLimits& most) {
    const auto& strips = model_->mix().strips;
    lost_.clear();
    for (std::size_t j = 0; j < std::min(most.strips.size(), strips.size()); ++j)
        if (strips[j].output < 0 && asked.strips[j].output >= 0 && most.strips[j].output >= 0)
            lost_.emplace_back(j, most.strips[j]);
    asked_ = lowered.empty() ? std::nullopt : std::optional{asked};
    if (asked_)
        model_->messages().add({"Lowered to this desk: " + utf8(lowered),
                                false,
                                {"Levels of the file", [this] { useAskedLevels(); }},
                                "levels"});
}

// An output that an actuator lost to a file is still the user's: the next session has it again, no louder
// than what was played meanwhile.
DeskLimits MixerWindow::limits() const {
    if (!model_) return files_.limits();
    DeskLimits now = DeskLimits::of(model_->mix());
    const double loudestDb = now.loudestOutputDb() - now.levelDb;
    for (const auto& [j, own] : lost_) {
        if (j >= now.strips.size() || now.strips[j].output >= 0 ||
            std::ranges::find(now.strips, own.output, &Strip::output) != now.strips.end())
            continue;
        now.strips[j] = own;
        now.strips[j].gainDb = std::min(own.gainDb, loudestDb);
    }
    return now;
}

// The user may set levels that a file may not.
void MixerWindow::useAskedLevels() {
    if (!asked_) return;
    model_->change("Levels of the file", [this](Mix& mix) {
        mix.levelDb = asked_->levelDb;
        if (asked_->count() == mix.count()) mix.strips = asked_->strips;
    });
    asked_.reset();
    lost_.clear();
    model_->messages().withdraw("levels");
}

// A file on the command line is not an edit, so there is nothing to save yet.
void MixerWindow::start(const juce::File& file) {
    if (file.isDirectory()) {
        play(firstMix(), {});
        return say(file.getFullPathName() + ": expected a file, found a folder");
    }
    if (!file.existsAsFile()) return play(firstMix(), file);
    if (fileKind(pathOf(file)) == FileKind::session) return void(load(file, file));
    const auto mix = mixWith(firstMix(), file);
    if (mix) return playLowered(limits(), mix.value, {});
    play(firstMix(), {});
    say(utf8(mix.error));
}

juce::String MixerWindow::documentName() const {
    return document_ == juce::File{} ? juce::String{"session"} : document_.getFileNameWithoutExtension();
}

juce::File MixerWindow::folderOfDocuments() const {
    if (document_ != juce::File{}) return document_.getParentDirectory();
    const auto folder = folder_->make();
    return folder ? folder.value : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
}

/// Path from the home folder: a shorter one, as long words are broken.
static juce::String fromHome(const juce::File& file) {
    const auto home = juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    return file.isAChildOf(home) ? "~/" + file.getRelativePathFrom(home) : file.getFullPathName();
}

void MixerWindow::announceSaved(const juce::String& words, const juce::File& file, MixerAct act) {
    if (!act.run) act = {"Show", [file] { file.revealToUser(); }};
    MixerMessage message{words + " " + fromHome(file), true, std::move(act), savedLabel};
    const bool isInFront = model_->isNews() || model_->messages().shown().label == noEarLabel; // which waits
    isInFront ? model_->messages().show(std::move(message)) : model_->messages().add(std::move(message));
}

void MixerWindow::chooseFile(const juce::String& title, const juce::String& ending, bool isSaving,
                             std::function<void(const juce::File&)> use, const juce::String& suggested,
                             const juce::File& in) {
    const auto setting = "folder" + ending; // the last one, of each kind of file
    const juce::File last{files_.settings().getValue(setting)};
    const auto folder = in != juce::File{} ? in : last.isDirectory() ? last : folderOfDocuments();
    const auto name =
        suggested.isEmpty()
            ? juce::String{}
            : folder.getNonexistentChildFile(suggested, ending, false).getFileNameWithoutExtension();
    askForFile(view_->topBar(), {title, ending, folder, isSaving, name},
               [this, setting, use = std::move(use)](const juce::File& file) {
                   files_.settings().setValue(setting, file.getParentDirectory().getFullPathName());
                   use(file);
               });
}

void MixerWindow::ask(const juce::String& title, const juce::String& words,
                      std::vector<std::pair<juce::String, std::function<void()>>> answers,
                      const std::vector<QuestionCard::Field>& fields) {
    std::vector<QuestionCard::Answer> all;
    for (auto& [answer, act] : answers)
        all.push_back({answer, [this, act = std::move(act)] { view_->setCard(nullptr), act(); }});
    all.push_back(
        {"Cancel", [this] { view_->setCard(nullptr); }, true, juce::KeyPress{juce::KeyPress::escapeKey}});
    view_->setQuestion(std::make_unique<QuestionCard>(title, words, std::move(all), fields));
}

void MixerWindow::askThen(std::function<void()> goOn, const juce::String& words) {
    if (!isChanged()) return goOn();
    ask("Save the session?", words, {{"Save", [this, goOn] { save(goOn); }}, {"Do not save", goOn}});
}

void MixerWindow::newDocument() {
    askThen([this] {
        files_.copies().forget();
        play(firstMix(), {});
    });
}

void MixerWindow::openDocument() { import("Open a session, a scene or a layout"); }

void MixerWindow::openDocument(const juce::File& file) {
    askThen([this, file] {
        if (!load(file, file)) return;
        files_.copies().forget();
        files_.addRecent(file);
    });
}

void MixerWindow::openFile(const juce::File& file) {
    if (fileKind(pathOf(file)) == FileKind::session) return openDocument(file);
    auto mix = mixWith(model_->mix(), file);
    if (!mix) return say(utf8(mix.error));
    const Mix asked = mix.value;
    const DeskLimits most = limits();
    const auto lowered = lowerTo(most, mix.value);
    model_->edit(file.getFileName(), mix.value);
    reportLowered(lowered, asked, most);
}

void MixerWindow::save(std::function<void()> then) {
    if (document_ == juce::File{}) return saveAs(std::move(then));
    if (!saveTo(document_)) return;
    then ? then() : announceSaved("Saved", document_);
}

void MixerWindow::saveAs(std::function<void()> then) {
    chooseFile(
        "Save the session", sessionEnding, true,
        [this, then = std::move(then)](const juce::File& file) {
            if (!saveTo(file)) return;
            if (then) then(); // which may open another session
            announceSaved("Saved", file);
        },
        documentName());
}

bool MixerWindow::saveTo(const juce::File& file) {
    const auto edits = model_->edits();
    const auto text = sessionJson(model_->saved(), std::filesystem::path{pathOf(file)}.parent_path());
    if (const auto error = writeFile(pathOf(file), text); !error.empty()) return say(utf8(error)), false;
    device_ = model_->device().choice();
    files_.addOwn(text, outputInUse());
    document_ = file;
    savedEdits_ = edits;
    files_.copies().forget();
    files_.addRecent(file);
    nameWindow();
    return true;
}

void MixerWindow::record() {
    if (model_->recording().isRunning()) return model_->recording().stop();
    const auto file = folder_->fresh(documentName() + "-take", {".wav", ".csv"});
    const auto error = file ? model_->recording().start(file.value) : file.error;
    view_->topBar().setRecording(error.empty());
    if (!error.empty()) say(utf8(error));
}

void MixerWindow::askSeconds(const juce::String& title, const juce::String& words, double seconds,
                             juce::Range<double> limits, const juce::String& what,
                             std::function<void(double)> use) {
    askForValues(
        view_->topBar(), title, "Choose a file" + dots(), {secondsField(seconds)},
        [this, limits, what, use = std::move(use)](const juce::StringArray& values) {
            const double wanted = values[0].getDoubleValue();
            if (wanted >= limits.getStart() && wanted <= limits.getEnd()) return use(wanted);
            say(what + ": expected " + number(limits.getStart(), limits.getStart() < 1.0 ? 1 : 0) + " to " +
                number(limits.getEnd(), 0));
        },
        "It was played for " + tenths(playedSeconds()) + " s. " + words);
}

void MixerWindow::renderOffline() {
    askSeconds("Render the session", "Beyond that its last scene goes on by itself.", playedSeconds(),
               {0.1, longestRender}, "Seconds to render", [this](double seconds) {
                   chooseFile(
                       "Render the session to", ".wav", true,
                       [this, seconds](const juce::File& file) { renderTo(file, seconds); }, documentName());
               });
}

void MixerWindow::make(const juce::File& file, const juce::String& doneWords, RenderTask::Work work) {
    if (rendering_) return say(rendering_->file().getFileName() + " is being made: one file at a time");
    rendering_ = std::make_unique<RenderTask>(
        file, std::move(work), [this, file, doneWords](const std::string& error, bool isCancelled) {
            rendering_.reset();
            if (isCancelled)
                model_->announce("Cancelled; nothing was written");
            else if (!error.empty())
                say(utf8(error));
            else
                announceSaved(doneWords, file);
        });
    view_->setProgress(rendering_.get());
}

void MixerWindow::renderTo(const juce::File& file, double seconds) {
    const int rateHz = std::max(8000, model_->output().sampleRateHz());
    make(file, "Rendered",
         [session = model_->saved(), seconds, rateHz, path = pathOf(file)](const auto& progress) {
             return renderSessionWav(session, {rateHz, seconds, progress}, path, "physvib " PHYSVIB_VERSION);
         });
}

void MixerWindow::saveMovie() {
    const double played = playedSeconds();
    if (played < minMovieSeconds) return say("Save movie: expected a session of at least a second");
    askSeconds("Save a movie", "The movie has the last seconds of that.", std::min(usualMovieSeconds, played),
               {minMovieSeconds, longestMovieSeconds}, "Seconds of the movie", [this](double seconds) {
                   chooseFile(
                       "Save the movie", utf8(movieEnding()), true,
                       [this, seconds](const juce::File& file) { saveMovieTo(file, seconds); },
                       documentName() + "-movie");
               });
}

void MixerWindow::saveMovieTo(const juce::File& file, double seconds) {
    make(file,
         file.hasFileExtension("mp4") ? "Saved the movie"
                                      : "Saved the movie without sound, which needs the program ffmpeg:",
         [session = model_->saved(), layout = model_->mix().layout, seconds, path = pathOf(file)](
             const auto& progress) { return writeSessionMovie(session, layout, seconds, path, progress); });
}

void MixerWindow::exportLayout() {
    chooseFile(
        "Save the layout to", sessionEnding, true,
        [this](const juce::File& file) {
            if (model_->reportFault(writeFile(pathOf(file), layoutJson(model_->mix().layout)))) return;
            announceSaved("Saved the layout", file);
        },
        "layout");
}

void MixerWindow::import(const juce::String& title) {
    chooseFile(title, sessionEnding, false, [this](const juce::File& file) { openFile(file); });
}

// Shows the newest readable copy, with a line on the first unreadable one.
void MixerWindow::offerRecovery() {
    const auto copies = files_.copies().leftBehind();
    const std::size_t most = std::min(copies.size(), maxOffered);
    std::size_t shown = 0;
    for (; shown < most; ++shown) {
        const auto session = RecoveryCopies::read(copies[shown]);
        if (session) break;
        if (shown == 0) model_->messages().add({utf8(session.error) + "; it stays until it is discarded"});
    }
    showCopy(copies, shown == most ? 0 : shown);
}

void MixerWindow::showCopy(const std::vector<std::filesystem::path>& copies, std::size_t at) {
    if (copies.empty()) {
        if (view_->question() != nullptr) view_->setQuestion(nullptr);
        return;
    }
    const std::size_t most = std::min(copies.size(), maxOffered);
    const auto copy = copies[at];
    const auto session = RecoveryCopies::read(copy);
    const auto count = [](std::size_t n) { return juce::String{static_cast<int>(n)}; };
    juce::String words = "The mixer ended without being closed. " + describe(copy, session);
    if (most > 1) words += "\nCopy " + count(at + 1) + " of " + count(most) + ", the newest first.";
    if (most < copies.size())
        words +=
            " " + count(copies.size() - most) + " older ones stay in " + utf8(copy.parent_path().string());
    const auto discard = [this](std::vector<std::filesystem::path> declined) {
        std::string error;
        for (const auto& each : declined)
            if (auto why = RecoveryCopies::remove(each); !why.empty()) error = std::move(why);
        offerRecovery();
        if (!error.empty()) say(utf8(error));
    };
    std::vector<QuestionCard::Answer> answers{
        {"Take it up", [this, copy] { recover(copy); }, static_cast<bool>(session)},
        {"Discard it", [discard, copy] { discard({copy}); }},
        {"Not now", [this] { view_->setQuestion(nullptr); }}};
    if (most > 1) {
        answers.push_back({"Newer", [this, copies, at] { showCopy(copies, at - 1); }, at > 0,
                           juce::KeyPress{juce::KeyPress::leftKey}});
        answers.push_back({"Older", [this, copies, at] { showCopy(copies, at + 1); }, at + 1 < most,
                           juce::KeyPress{juce::KeyPress::rightKey}});
        answers.push_back({"Discard all " + count(most), [discard, copies, most] {
                               discard({copies.begin(), copies.begin() + static_cast<std::ptrdiff_t>(most)});
                           }});
    }
    view_->setQuestion(std::make_unique<QuestionCard>(
        most > 1 ? "Take up a session?" : "Take up the last session?", words, std::move(answers)));
}

// The copy is kept until this run's own copy is on disk.
void MixerWindow::recover(const std::filesystem::path& copy) {
    askThen([this, copy] {
        view_->setQuestion(nullptr);
        if (!load(juce::File{utf8(copy.string())}, {}, true)) return offerRecovery();
        savedEdits_ = neverSaved;
        files_.copies().forget(); // the previous session was saved or discarded by the user
        files_.copies().goOnFrom(copy);
        model_->reportFault(files_.keepNow(*model_));
    });
}

void MixerWindow::saveScene(bool isNow, const juce::File& in) {
    files_.scenesFolder().createDirectory();
    chooseFile(
        "Save as scene", ".json", true,
        [this, isNow](const juce::File& file) {
            if (model_->reportFault(saveSceneTo(file, isNow))) return;
            announceSaved("Saved the scene", file);
        },
        "scene", in != juce::File{} ? in : files_.scenesFolder());
}

std::string MixerWindow::saveSceneTo(const juce::File& file, bool isNow) {
    const auto& world = model_->world();
    Scene scene = world.drawing().drawn();
    if (isNow) scene = sceneNow(scene, world.posesNow());
    scene.name = file.getFileNameWithoutExtension().toStdString();
    scene.variables.clear();
    if (auto fault = validate(scene); !fault.empty()) return fault;
    auto error = writeFile(pathOf(file), sceneJson(scene));
    if (error.empty()) view_->topBar().setOwnScenes(files_.ownScenes());
    return error;
}

void MixerWindow::recordScript() {
    auto& script = model_->script();
    script.isRecording() ? script.stop() : script.start();
    if (script.isRecording()) view_->world().drawing().use(DrawTool::hand);
}

void MixerWindow::newScene(SceneGround ground) {
    model_->change("New scene", [&](Mix& mix) {
        mix.scene = std::make_shared<const Scene>(physvib::newScene(*MixerModel::firstMix().scene, ground));
    });
    view_->world().drawing().use(DrawTool::ball);
}

// Without the address of a page, it offers to start a server, or a movie or scene file.
void MixerWindow::share(bool isElsewhere) {
    const auto link = pageLink(model_->mix(), model_->world().drawing().drawn());
    if (!link) return say(utf8(link.error));
    const auto kept = files_.settings().getValue(pageSetting);
    const auto page = served_.isNotEmpty() ? served_ : isLoopback(kept) ? juce::String{} : kept;
    if (page.isEmpty() && !isElsewhere) {
        const bool canServe = PageServer::isThere();
        std::vector<std::pair<juce::String, std::function<void()>>> ways{
            {"Save movie" + dots(), [this] { saveMovie(); }},
            {"Save as scene" + dots(), [this] { saveScene(false, folderOfDocuments()); }},
            {"Other page" + dots(), [this] { share(true); }}};
        if (canServe) ways.insert(ways.begin(), {serveWords, [this] { serve(); }});
        return ask("Share the world",
                   canServe
                       ? "Serve it here gives a web page with this world to phones in this network, with a "
                         "code.\nA movie plays on any phone; a scene is felt in another mixer."
                       : "A movie plays on any phone.\nA scene is felt in another mixer, or on a web page of "
                         "PhysVib. That page is a part of a release (physvib-page): unpacked into the "
                         "mixer's folder, Share serves it to phones, with a code.",
                   std::move(ways));
    }
    const auto at = [behind = utf8(link.value)](const juce::String& address) {
        return address.isEmpty() ? address : address.upToFirstOccurrenceOf("#", false, false) + "#" + behind;
    };
    const auto typed = std::make_shared<juce::String>(page);
    const auto whole = [this, at, typed] {
        if (*typed != served_) files_.settings().setValue(pageSetting, *typed);
        return at(*typed);
    };
    const auto show = [at, typed, isServed = served_.isNotEmpty()](QuestionCard& card,
                                                                   const juce::String& address) {
        *typed = address;
        const bool isAlone = isLoopback(address), isThere = address.isNotEmpty();
        card.setValue(linkField, at(address));
        for (const char* words : {copyWords, openWords}) card.enable(words, isThere);
        const auto code = isAlone || !isThere ? juce::Image{} : qrPicture(at(address).toStdString());
        card.setPicture(code, isAlone    ? "No code: this address leads nowhere on a phone, only here"
                              : !isThere ? "A phone's code comes with the address"
                                         : "No code: this world's link is too long for one");
        card.say("Share the world",
                 isThere
                     ? juce::String{"Who opens the link gets the same world and samples."} +
                           (isServed ? " The page is here while the mixer runs; a browser warns once of "
                                       "its certificate."
                                     : "")
                     : "Type the address of a web page of PhysVib: the link to this world there follows.");
    };
    std::vector<std::pair<juce::String, std::function<void()>>> answers{
        {copyWords,
         [this, whole] {
             const auto words = whole();
             juce::SystemClipboard::copyTextToClipboard(words);
             model_->announce("Copied a link of " + juce::String{words.length()} + " characters");
         }},
        {openWords, [whole] { openLink(whole()); }}};
    if (served_.isEmpty() && PageServer::isThere()) answers.push_back({serveWords, [this] { serve(); }});
    ask("Share the world", {}, std::move(answers), {{pageField, page, {}, {}, show}, {linkField, {}}});
    show(*view_->question(), page);
}

// Phones give no sound and no sensors to a page without https; its certificate takes a moment.
void MixerWindow::serve() {
    server_ = std::make_shared<PageServer>();
    juce::Thread::launch([server = server_, window = SafePointer{this}] {
        juce::MessageManager::callAsync([window, address = server->begin()] {
            if (window == nullptr) return;
            if (!address) return window->say(utf8(address.error));
            if (isLoopback(utf8(address.value)))
                return window->say("This computer is in no network: nobody would reach the page");
            window->served_ = utf8(address.value);
            window->share();
        });
    });
}

int MixerWindow::zoom() {
    const int percent = files_.settings().getIntValue(zoomSetting); // which may hold anything
    return std::ranges::find(zooms, percent) == zooms.end() ? 0 : percent;
}

void MixerWindow::setZoom(int percent) {
    files_.settings().setValue(zoomSetting, percent);
    applyZoom();
}

void MixerWindow::stepZoom(int by) {
    const int now = juce::roundToInt(100.0f * juce::Desktop::getInstance().getGlobalScaleFactor());
    const auto at = std::ranges::lower_bound(zooms, now) - zooms.begin() + by;
    if (at >= 0 && at < std::ssize(zooms) && fits(nth(zooms, at), displayRoom())) setZoom(nth(zooms, at));
}

// The window keeps its size on the screen.
void MixerWindow::applyZoom() {
    auto& desktop = juce::Desktop::getInstance();
    const auto room = displayRoom();
    int percent = zoom() > 0 ? zoom() : automaticZoom(room);
    while (percent > zooms.front() && !fits(percent, room)) percent = std::max(zooms.front(), percent - 25);
    const float before = desktop.getGlobalScaleFactor(), after = 0.01f * static_cast<float>(percent);
    const float shrunk = std::min(1.0f, after); // JUCE has limits in pixels of the display
    setResizeLimits(juce::roundToInt(shrunk * MixerView::minWidth),
                    juce::roundToInt(shrunk * MixerView::minHeight), 7680, 4320);
    if (juce::approximatelyEqual(before, after)) return;
    const auto bounds = (getBounds().toFloat() * (before / after)).toNearestInt();
    desktop.setGlobalScaleFactor(after);
    if (isOnDesktop()) setBounds(bounds);
}

void MixerWindow::setShow(bool isShow) {
    juce::Desktop::getInstance().setKioskModeComponent(isShow ? this : nullptr, false);
    view_->setShow(isShow);
    view_->grabKeyboardFocus();
}

juce::PopupMenu MixerWindow::viewMenu() {
    juce::PopupMenu menu, zoomMenu;
    const bool isPlay = view_->mode() == Mode::play, isLight = view_->theme() == Theme::light;
    const Panels panels = view_->panels();
    add(menu, {"Play", "F2", true, isPlay}, [this] { view_->setMode(Mode::play); });
    add(menu, {"Engineer", "F2", true, !isPlay}, [this] { view_->setMode(Mode::engineer); });
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
    for (const int percent : zooms)
        add(zoomMenu, {juce::String{percent} + " %", {}, fits(percent, displayRoom()), zoom() == percent},
            [this, percent] { setZoom(percent); });
    menu.addSubMenu("Zoom", zoomMenu);
    add(menu, {"Full screen for a show", "F11", true, view_->isShow()},
        [this] { setShow(!view_->isShow()); });
    add(menu, {"Width of the display" + dots()}, [this] { askDisplayWidth(); });
    return menu;
}

} // namespace physvib
