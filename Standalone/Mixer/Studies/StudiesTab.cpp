// SPDX-License-Identifier: GPL-3.0-or-later
// The studies tab: selects and checks a study, says what prevents its start, and opens its screens.
#include "Mixer/Studies/StudiesTab.h"
#include "Core/Units.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {
namespace {

// item ids of the lists
constexpr int fileId = 1000, noNoiseId = 1, protocolLanguageId = 1, englishId = 2, firstLanguageId = 3;
constexpr int answersHereId = 1, answersElsewhereId = 2;
constexpr std::array<int, 8> noiseLevels{-70, -60, -50, -45, -40, -35, -30, -25};

std::filesystem::path typedPath(const juce::String& typed) {
    return std::filesystem::path{pathOf(juce::File::getCurrentWorkingDirectory().getChildFile(typed))};
}

juce::String exposureText(const std::vector<TrialRecord>& records) {
    if (records.empty() || !records.back().answer.exposure) return {};
    return ". A(8) of that day: " + number(*records.back().answer.exposure, 2) + " of " +
           number(exposureActionMetresPerSecond2, 1) + utf8(" m/s\u00b2");
}

juce::String describeProtocol(const Protocol& protocol) {
    juce::StringArray conditions, sessions;
    for (const auto& condition : protocol.conditions)
        conditions.add(utf8(condition.name).replaceCharacter('-', 0x2011)); // hyphens without line breaks
    for (const auto& session : protocol.sessions) sessions.add(utf8(session.name));
    const auto title = utf8(protocol.title);
    return title.substring(0, 1).toUpperCase() + title.substring(1) +
           ".\nConditions: " + conditions.joinIntoString(", ") +
           ".\nIn each: " + sessions.joinIntoString(", ") + ".";
}

constexpr std::size_t maxPictureBytes = 16'000'000;
constexpr unsigned maxPixels = 4096; // maximum width and height

/// Reads a side of a PNG: a big-endian number after its signature.
unsigned readPngSide(const std::string& png, std::size_t offset) {
    unsigned side = 0;
    for (std::size_t i = offset; i < offset + 4; ++i) side = 256 * side + static_cast<unsigned char>(png[i]);
    return side;
}

bool isSmallPng(const std::string& text) {
    constexpr std::string_view begin{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16};
    if (text.size() < 24 || !text.starts_with(begin)) return false;
    return std::ranges::all_of(std::initializer_list<unsigned>{readPngSide(text, 16), readPngSide(text, 20)},
                               [](unsigned side) { return side > 0 && side <= maxPixels; });
}

/// The participant's pictures of materials, or an error line. The files are untrusted, so their size is
/// checked before decoding.
Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant) {
    std::vector<MaterialPicture> pictures;
    for (std::size_t i = 0; i < protocol.pictures.size(); ++i) {
        const std::string field = "pictures[" + std::to_string(i) + "].file: ",
                          path = picturePath(protocol.pictures[i], participant);
        if (auto error = linkError(protocol.folder, path); !error.empty()) return Failure{field + error};
        const auto text = readFile(resolveProtocolPath(protocol.folder, path), maxPictureBytes);
        if (!text) return Failure{field + text.error};
        auto image = isSmallPng(text.value)
                         ? juce::ImageFileFormat::loadFrom(text.value.data(), text.value.size())
                         : juce::Image{};
        if (image.isNull())
            return Failure{field + path + ": expected a PNG picture of at most " + std::to_string(maxPixels) +
                           " x " + std::to_string(maxPixels) + " pixels"};
        pictures.push_back({protocol.pictures[i].material, std::move(image)});
    }
    return pictures;
}

/// Empty, or an error if the protocol has a display scale but the width of the display is not set (0).
std::string displayScaleError(const Protocol& protocol, double displayWidthMetres) {
    if (displayWidthMetres > 0.0) return {};
    for (const ConditionPlan& condition : protocol.conditions)
        if (const auto* const world = std::get_if<WorldSet>(&condition.stimuli);
            world != nullptr && world->displayScale > 0.0)
            return "condition " + printable(condition.name) +
                   ": display_scale: expected the width of the display to be set in the mixer's menu, as 1:" +
                   numberText(world->displayScale) + " is measured on it";
    return {};
}

/// The layout with the most actuators, and its name.
std::pair<std::string, LayoutDescription> largestLayout(const Protocol& protocol) {
    std::pair<std::string, LayoutDescription> largest;
    for (const ConditionPlan& condition : protocol.conditions)
        if (auto layout = resolveLayout(resolveProtocolPath(protocol.folder, condition.layout));
            layout && layout.value.actuators.size() > largest.second.actuators.size())
            largest = {condition.layout, std::move(layout.value)};
    return largest;
}

} // namespace

StudiesTab::StudiesTab(MixerModel& model)
    : model_{model} {
    setTitle("Studies");
    noiseChoice_.setTitle("Outputs of the pink noise");
    noiseChoice_.onChange = [this] { repaint(); };
    noiseChoice_.setTooltip("Headphones on outputs of the same device; louder or softer by their own knob");
    describe(noiseLevel_, "Level of the pink noise", "Root mean square, in dB of full scale: start low");
    for (const int db : noiseLevels) noiseLevel_.addItem(number(db, 0) + " dBFS", -db);
    protocolChoice_.setTitle("Protocol");
    for (int id = 1; const Protocol& protocol : knownProtocols())
        protocolChoice_.addItem(displayTitle(protocol.name), id++);
    protocolChoice_.addSeparator();
    protocolChoice_.addItem(juce::String::fromUTF8("Protocol file\xe2\x80\xa6"), fileId);
    protocolChoice_.onChange = [this] { handleProtocolChoice(); };
    languageChoice_.setTitle("Language of the participant");
    languageChoice_.addItem("what the protocol says", protocolLanguageId);
    languageChoice_.addItem("English", englishId);
    for (int id = firstLanguageId; const Translation& entry : builtInTranslations())
        languageChoice_.addItem(
            hasLetters({}, utf8(entry.language)) ? utf8(entry.language) : utf8(entry.englishName), id++);
    languageChoice_.addItem("Words file" + ellipsis(), fileId);
    languageChoice_.setSelectedId(protocolLanguageId, juce::dontSendNotification);
    languageChoice_.onChange = [this] { handleLanguageChoice(); };
    answersChoice_.setTitle("Where answers are given");
    answersChoice_.addItem("in this window", answersHereId);
    answersChoice_.addItem("in a second window", answersElsewhereId);
    answersChoice_.setSelectedId(answersHereId, juce::dontSendNotification);
    answersChoice_.setTooltip("A second window opens over another display, if there is one");
    describe(code_, "Participant's code", "The only personal datum that is kept");
    code_.setInputRestrictions(32, "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_");
    describe(number_, "Participant's number",
             "Decides the orders: 1 for the first participant, 2 for the second");
    number_.setInputRestrictions(6, "0123456789");
    folder_.setTitle("Folder of the trial files");
    browse_ = makeLinkButton("Choose", "Choose the folder of the trial files", [this] {
        askForFile(*this, {"The folder of the trial files", {}, juce::File{folder_.getText()}},
                   [this](const juce::File& folder) { setFolder(folder); });
    });
    analyse_ =
        makeLinkButton("Analyse", "Analyse the participant's trials, or other files", [this] { analyse(); });
    findings_ = makeLinkButton("Checking" + ellipsis(), "What `study check` found: levels, orders, times");
    findings_->setTitle("Findings of the check");
    findings_->onClick = [this] { showFindings(); };
    begin_.setTitle("Begin the study");
    begin_.onClick = [this] {
        if (check_) return void(begin());
        beginsAfterCheck_ = !beginsAfterCheck_;
        refreshStatus();
    };
    for (auto* editor : {&code_, &number_, &folder_}) {
        editor->setFont(text::font(text::medium));
        editor->setEscapeAndReturnKeysConsumed(false); // Esc must reach the silence button from here, too
        editor->onTextChange = [this] { refreshStatus(); };
    }
    addAll(*this, {&protocolLabel_, &protocolChoice_,  &codeLabel_,  &code_,          &numberLabel_,
                   &number_,        &folderLabel_,     &folder_,     browse_.get(),   &noiseLabel_,
                   &noiseChoice_,   &noiseLevelLabel_, &noiseLevel_, &languageLabel_, &languageChoice_,
                   &answersLabel_,  &answersChoice_,   &begin_,      analyse_.get(),  findings_.get(),
                   &master_});
    setFolder(juce::SharedResourcePointer<UserFolder> {} -> location());
    setParticipant("P01", 1);
    // level-steps, with two short pulses per trial, needs four actuators
    chooseProtocol(model.mix().count() < 4 ? "model-or-sound" : "level-steps");
}

StudiesTab::~StudiesTab() {
    end();
    stopCheck();
}

std::string StudiesTab::chooseProtocol(const std::string& nameOrPath) {
    auto protocol = loadCheckedProtocol(nameOrPath);
    auto error = protocol ? protocolError(protocol.value, nameOrPath) : protocol.error;
    if (!error.empty()) return setStatus(utf8(error), Shade::limit), error;
    stopCheck();
    check_.reset();
    beginsAfterCheck_ = false;
    protocol_ = std::move(protocol.value);
    const auto& choices = knownProtocols();
    const auto builtIn = std::ranges::find(choices, nameOrPath, &Protocol::name);
    if (builtIn != choices.end())
        protocolChoice_.setSelectedId(1 + static_cast<int>(builtIn - choices.begin()),
                                      juce::dontSendNotification);
    else
        protocolChoice_.setText(juce::File{utf8(nameOrPath)}.getFileName(), juce::dontSendNotification);
    description_ = describeProtocol(*protocol_);
    const int noiseId = -juce::roundToInt(protocol_->pinkNoiseDb);
    noiseLevel_.setSelectedId(noiseId == -protocol_->pinkNoiseDb ? noiseId : 0, juce::dontSendNotification);
    if (noiseLevel_.getSelectedId() == 0)
        noiseLevel_.setText(number(protocol_->pinkNoiseDb, 1) + " dBFS", juce::dontSendNotification);
    refreshStatus();
    repaint();
    return {};
}

void StudiesTab::handleProtocolChoice() {
    const int id = protocolChoice_.getSelectedId();
    const auto showChosen = [this] {
        if (protocol_) protocolChoice_.setText(displayTitle(protocol_->name), juce::dontSendNotification);
    };
    if (id == fileId)
        askForFile(
            *this, {"A protocol", ".json", juce::File{folder_.getText()}},
            [this, showChosen](const juce::File& file) {
                if (!chooseProtocol(pathOf(file)).empty()) showChosen();
            },
            showChosen);
    else if (id > 0)
        chooseProtocol(nth(knownProtocols(), id - 1).name), offerLayout();
}

std::string StudiesTab::chooseLanguage(const std::string& nameOrPath) {
    const auto translation = findTranslation(nameOrPath);
    if (!translation) return setStatus(utf8(translation.error), Shade::limit), translation.error;
    languagePath_ = nameOrPath;
    const auto& choices = builtInTranslations();
    const auto builtIn = std::ranges::find(choices, nameOrPath, &Translation::name);
    if (builtIn != choices.end())
        languageChoice_.setSelectedId(firstLanguageId + static_cast<int>(builtIn - choices.begin()),
                                      juce::dontSendNotification);
    else if (translation.value.name.empty())
        languageChoice_.setSelectedId(nameOrPath.empty() ? protocolLanguageId : englishId,
                                      juce::dontSendNotification);
    else
        languageChoice_.setText(utf8(translation.value.language), juce::dontSendNotification);
    return {};
}

void StudiesTab::handleLanguageChoice() {
    const int id = languageChoice_.getSelectedId();
    if (id == fileId)
        askForFile(
            *this, {"Words of a language", ".json", juce::File{folder_.getText()}},
            [this](const juce::File& file) {
                if (!chooseLanguage(pathOf(file)).empty()) chooseLanguage(languagePath_);
            },
            [this] { chooseLanguage(languagePath_); });
    else if (id == protocolLanguageId || id == englishId)
        chooseLanguage(id == englishId ? "en" : "");
    else if (id >= firstLanguageId)
        chooseLanguage(nth(builtInTranslations(), id - firstLanguageId).name);
}

void StudiesTab::setAnswerWindow(bool hasWindow) {
    answersChoice_.setSelectedId(hasWindow ? answersElsewhereId : answersHereId, juce::dontSendNotification);
}

void StudiesTab::setParticipant(const juce::String& code, int number) {
    code_.setText(code, false);
    number_.setText(juce::String{number}, false);
    refreshStatus();
}

void StudiesTab::setFolder(const juce::File& folder) {
    folder_.setText(folder.getFullPathName(), false);
    folder_.moveCaretToEnd(); // shows the folder's name, even of a long path
    refreshStatus();
}

std::vector<std::vector<int>> StudiesTab::noiseChoices() const {
    std::vector<int> free;
    const auto& strips = model_.mix().strips;
    for (int k = 0; k < model_.device().outputCount(); ++k)
        if (std::ranges::find(strips, k, &Strip::output) == strips.end()) free.push_back(k);
    std::vector<std::vector<int>> choices;
    for (std::size_t i = 0; i + 1 < free.size(); ++i)
        if (free[i] % 2 == 0 && free[i + 1] == free[i] + 1) choices.push_back({free[i], free[i + 1]});
    for (const int k : free) choices.push_back({k});
    return choices;
}

void StudiesTab::refreshNoiseChoices() {
    const auto selected = listening().noise;
    noiseOutputs_ = noiseChoices();
    noiseChoice_.clear(juce::dontSendNotification);
    noiseChoice_.addItem("no output", noNoiseId);
    int id = noNoiseId;
    for (const auto& outputs : noiseOutputs_)
        noiseChoice_.addItem(outputs.size() > 1 ? "outputs " + juce::String{outputs[0] + 1} + " and " +
                                                      juce::String{outputs[1] + 1}
                                                : "output " + juce::String{outputs[0] + 1},
                             ++id);
    chooseNoise(selected);
}

void StudiesTab::chooseNoise(const std::vector<int>& outputs) {
    const auto entry = std::ranges::find(noiseOutputs_, outputs);
    noiseChoice_.setSelectedId(entry == noiseOutputs_.end()
                                   ? noNoiseId
                                   : static_cast<int>(entry - noiseOutputs_.begin()) + noNoiseId + 1,
                               juce::dontSendNotification);
}

void StudiesTab::setNoise(const std::vector<int>& outputs, double db) {
    chooseNoise(outputs);
    noiseLevel_.setSelectedId(-juce::roundToInt(db), juce::dontSendNotification);
    repaint();
}

ListeningSettings StudiesTab::listening() const {
    ListeningSettings settings;
    if (const int index = noiseChoice_.getSelectedId() - noNoiseId - 1;
        index >= 0 && index < static_cast<int>(noiseOutputs_.size()))
        settings.noise = nth(noiseOutputs_, index);
    settings.noiseDb = noiseLevel_.getSelectedId() > 0 ? -noiseLevel_.getSelectedId()
                       : protocol_                     ? protocol_->pinkNoiseDb
                                                       : PinkNoise::safeDb;
    return settings;
}

StudyRun StudiesTab::selectedRun() const {
    return {*protocol_,
            {code_.getText().toStdString(), std::clamp(number_.getText().getIntValue(), 1, 100000), "person"},
            typedPath(folder_.getText())};
}

bool StudiesTab::isDone(const StudyRun& run, const std::vector<TrialRecord>& records) {
    Experiment experiment{run.protocol, run.participant, true};
    for (const TrialRecord& record : records)
        if (!experiment.replay(record).empty()) return false;
    return experiment.isDone();
}

/// Shows whether the trial file exists and can be continued.
void StudiesTab::refreshStatus() {
    if (!protocol_) return;
    lastBeginError_.clear();
    outputsError_ = utf8(outputsError(*protocol_, model_));
    const StudyRun selected = selectedRun();
    const auto path = selected.trialFile();
    std::error_code ignored;
    begin_.setEnabled(!code_.isEmpty());
    if (beginsAfterCheck_)
        return begin_.setButtonText("Checking" + ellipsis()),
               setStatus("It begins once it is checked", Shade::text);
    if (code_.isEmpty()) return begin_.setButtonText("Begin"), setStatus("Expected a code", Shade::muted);
    if (!std::filesystem::exists(path, ignored))
        return begin_.setButtonText("Begin"),
               setStatus("The rows will be in " + utf8(path.filename().string()), Shade::muted);
    const auto text = readFile(path, limits::maxTableBytes);
    const auto log = text ? readTrialLog(text.value, path.string(), selected.protocol, selected.participant)
                          : Result<TrialLog>{Failure{text.error}};
    const bool isFinished = log && isDone(selected, log.value.records);
    begin_.setButtonText(isFinished ? "Begin" : "Go on");
    if (isFinished)
        begin_.setEnabled(false),
            setStatus(utf8(path.filename().string()) + " has all its trials: expected another code",
                      Shade::muted);
    else if (log)
        setStatus(utf8(path.filename().string()) + " has " + utf8(plural(log.value.records.size(), "trial")) +
                      exposureText(log.value.records),
                  Shade::text);
    else
        setStatus(utf8(log.error), Shade::limit);
}

void StudiesTab::stopCheck() {
    keepsChecking_ = false;
    checkFuture_ = {}; // waits for the stimulus that is being rendered
}

/// Starts the check of a new protocol beside the message thread, and takes its result.
void StudiesTab::updateCheck() {
    if (checkFuture_.valid() && checkFuture_.wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
        check_ = checkFuture_.get();
        const bool begins = std::exchange(beginsAfterCheck_, false) && isShowing();
        refreshStatus();
        if (begins) begin();
    }
    if (!check_ && !checkFuture_.valid() && protocol_ && isVisible()) {
        keepsChecking_ = true;
        checkFuture_ = std::async(std::launch::async, [this, protocol = *protocol_] {
            return checkStudy(protocol, 0, [this] { return keepsChecking_.load(); });
        });
    }
    const auto count = check_ ? check_->errors.size() + check_->warnings.size() : 0;
    findings_->setEnabled(check_.has_value());
    findings_->setButtonText(!check_      ? "Checking" + ellipsis()
                             : count == 0 ? juce::String{"Checked"}
                             : count == 1 ? juce::String{"1 finding"}
                                          : juce::String{static_cast<int>(count)} + " findings");
}

void StudiesTab::showFindings() {
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !check_ || host == nullptr) return;
    AnalysisReport report;
    for (const auto* lines : {&check_->facts, &check_->deviations})
        for (const std::string& line : *lines) report.text += line + "\n\n";
    for (const std::string& line : check_->errors) report.warnings.push_back("Refused: " + line);
    report.warnings.insert(report.warnings.end(), check_->warnings.begin(), check_->warnings.end());
    analysis_ = std::make_unique<AnalysisScreen>(model_, "Check of " + displayTitle(protocol_->name),
                                                 std::move(report));
    analysis_->onClose = makeCloseCallback();
    host->setScreen(analysis_.get());
}

void StudiesTab::setStatus(const juce::String& message, Shade shade) {
    status_ = message;
    statusShade_ = shade;
    repaint();
}

// Offers a layout or another study if the mixer, or headphones, have too few actuators.
void StudiesTab::offerLayout() {
    constexpr std::size_t earCount = 2;
    const auto [name, layout] = largestLayout(*protocol_);
    const std::size_t minCount = layout.actuators.size();
    const auto study = std::ranges::find_if(knownProtocols(), [](const Protocol& p) {
        return largestLayout(p).second.actuators.size() <= earCount;
    });
    MixerMessage message{
        "This study is felt on " + utf8(plural(minCount, "actuator")), true, {}, "study-layout"};
    if (model_.device().choice().isHeadphones && minCount > earCount && study != knownProtocols().end()) {
        message.text += ", and headphones are two";
        message.action = {"Choose " + displayTitle(study->name) + " instead",
                          [this, name = study->name] { chooseProtocol(name), offerLayout(); }};
    } else if (minCount > model_.mix().strips.size())
        message.action = {"Use " + utf8(name), [this, newLayout = layout] {
                              model_.change("Layout of the study", [&newLayout](Mix& mix) {
                                  mix.layout = newLayout;
                                  mix.resizeStrips();
                              });
                              offerLayout();
                          }};
    if (!message.action.run) return model_.messages().withdraw(message.label);
    model_.messages().show(std::move(message));
}

/// Offers the master level of the previous trials, because a mixer opens at a low level.
void StudiesTab::offerLevel(double db) {
    const auto levelText = number(db, 1) + " dB";
    model_.messages().show({"The trials before had a master level of " + levelText,
                            true,
                            {"Set " + levelText,
                             [this, db] {
                                 model_.change("Master level", [db](Mix& mix) { mix.levelDb = db; });
                                 model_.messages().withdraw("study-level");
                             }},
                            "study-level"});
}

std::string StudiesTab::begin() {
    const auto fail = [this](const std::string& error) {
        setStatus(utf8(error), Shade::limit);
        lastBeginError_ = status_;
        return error;
    };
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !protocol_ || host == nullptr) return "expected a mixer without a study";
    if (code_.isEmpty()) return fail("expected a participant's code");
    stopCheck(); // the check may still run, unless the button called this
    if (auto error = studyRunError(selectedRun()); !error.empty()) return fail(error);
    if (auto error = outputsError(*protocol_, model_); !error.empty()) return offerLayout(), fail(error);
    if (auto error = findPlaybackError(*protocol_, model_); !error.empty()) return fail(error);
    if (auto error = !check_                  ? findStudyError(*protocol_)
                     : check_->errors.empty() ? ""
                                              : check_->errors.front();
        !error.empty())
        return fail(protocol_->name + ": " + error);
    auto translation =
        findTranslation(languagePath_.empty() ? resolveProtocolPath(protocol_->folder, protocol_->translation)
                                              : languagePath_);
    if (!translation) return fail(translation.error);
    const auto typeface = typefaceFor(translation.value);
    if (!typeface)
        return fail("expected a font with the letters of " + translation.value.name +
                    ", found none; on Debian, fonts-nanum has Korean ones");
    if (auto error = displayScaleError(*protocol_, model_.displayWidthMetres()); !error.empty())
        return fail(error);
    auto pictures = materialPictures(*protocol_, selectedRun().participant.code);
    if (!pictures) return fail(pictures.error);
    juce::File{folder_.getText()}.createDirectory(); // a failure is reported with the file's name
    auto study = std::make_unique<StudyInProgress>(selectedRun());
    if (!study->error().empty()) return fail(study->error());
    if (auto error = model_.device().listening().beginStudy(listening()); !error.empty()) return fail(error);
    Apparatus apparatus = currentApparatus(model_);
    apparatus.language = translation.value.name.empty() ? "en" : translation.value.name;
    auto apparatusError = study->apparatusError(apparatus);
    if (const auto db = study->previousMasterDb(apparatus))
        offerLevel(*db);
    else if (!apparatusError.empty()) // a message has room for the whole text
        model_.report(utf8(apparatusError));
    if (apparatusError.empty()) apparatusError = study->logStart(apparatus);
    if (!apparatusError.empty()) return model_.device().listening().endStudy(), fail(apparatusError);
    screen_ = std::make_unique<StudyScreen>(model_, std::move(study), std::move(translation.value),
                                            answersChoice_.getSelectedId() == answersElsewhereId,
                                            std::move(pictures.value));
    typeface_ = std::make_unique<TypefaceOverride>(*typeface);
    screen_->onClose = makeCloseCallback();
    host->setScreen(screen_.get());
    return {};
}

void StudiesTab::analyse(std::vector<juce::File> files) {
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !protocol_ || host == nullptr) return;
    if (files.empty()) files.emplace_back(selectedRun().trialFile().string());
    analysis_ = std::make_unique<AnalysisScreen>(model_, files);
    analysis_->onClose = makeCloseCallback();
    host->setScreen(analysis_.get());
}

// The callback may run after the tab was deleted.
std::function<void()> StudiesTab::makeCloseCallback() {
    return [tab = SafePointer{this}] {
        if (tab != nullptr) tab->end();
    };
}

void StudiesTab::end() {
    if (!screen_ && !analysis_) return;
    screen_.reset();
    typeface_.reset();
    analysis_.reset();
    model_.device().listening().endStudy();
    if (auto* host = findParentComponentOfClass<CardHost>()) host->setScreen(nullptr);
    refreshStatus();
    model_.sendChangeMessage();
}

void StudiesTab::mixChanged() {
    if (noiseOutputs_ != noiseChoices() || noiseChoice_.getNumItems() == 0) refreshNoiseChoices();
    const auto& mix = model_.mix();
    const double factor = fromDecibels(-mix.levelDb);
    const auto weakText = mix.levelDb <= minStripDb ? juce::String{"nothing is felt"}
                                                    : number(factor, factor < 10.0 ? 1 : 0) + " times weaker";
    levelAdvice_ = factor > 1.0
                       ? "The master is at " + number(mix.levelDb, 1) + " dB: " + weakText +
                             " than the protocol says. Its g are those at 0 dB: the fader below raises it."
                       : juce::String{};
    if (model_.device().hasNoDevice())
        levelAdvice_ = "There is no device: the study can be seen, and is felt by nobody.";
    master_.setWarning(factor > 1.0 ? weakText : juce::String{});
    master_.mixChanged();
    outputsError_ = protocol_ ? utf8(outputsError(*protocol_, model_)) : juce::String{};
    if (lastBeginError_.isNotEmpty() && lastBeginError_ != outputsError_)
        refreshStatus(); // the cause of the error may have ended
    repaint();
}

// The most important line is first, as a small window has space for one line only.
juce::StringArray StudiesTab::advice() const {
    juce::StringArray lines;
    if (outputsError_.isNotEmpty() && outputsError_ != lastBeginError_) lines.add(outputsError_);
    if (protocol_ && protocol_->hasPinkNoise && listening().noise.empty())
        lines.add("It asks for pink noise: choose who hears it.");
    if (levelAdvice_.isNotEmpty()) lines.add(levelAdvice_);
    if (check_ && !check_->errors.empty())
        lines.add(utf8(check_->errors.front()));
    else if (check_ && !check_->warnings.empty())
        lines.add(utf8(check_->warnings.front()));
    return lines;
}

void StudiesTab::paint(juce::Graphics& g) {
    g.setFont(text::font(text::medium));
    const int lineHeight = juce::roundToInt(std::ceil(g.getCurrentFont().getHeight()));
    const auto drawLines = [&](const juce::String& paragraph, Shade colour, juce::Rectangle<int> area) {
        g.setColour(shade(*this, colour));
        if (const int lines = area.getHeight() / lineHeight; lines > 0) // whole lines, in the full font size
            g.drawFittedText(paragraph, area, juce::Justification::centredLeft, lines, 1.0f);
    };
    const auto drawIfFits = [&](juce::Rectangle<int>& freeArea, const juce::String& paragraph, Shade colour) {
        const float rowCount = static_cast<float>(text::pixelWidth(g.getCurrentFont(), paragraph)) /
                               static_cast<float>(std::max(1, freeArea.getWidth()));
        const int needed = lineHeight * (rowCount <= 1.0f ? 1 : static_cast<int>(std::ceil(1.1f * rowCount))),
                  height = std::min(needed, freeArea.getHeight());
        const bool fits = height == needed || colour == Shade::limit; // errors are always drawn
        if (fits) drawLines(paragraph, colour, freeArea.removeFromTop(height));
        return fits;
    };
    auto textArea = descriptionArea_, freeArea = adviceArea_;
    for (const juce::String& paragraph : juce::StringArray::fromLines(description_))
        if (!drawIfFits(textArea, paragraph, Shade::muted)) break;
    const bool isStatusFirst = statusShade_ == Shade::limit || !begin_.isEnabled(); // says what is missing
    if (isStatusFirst) drawIfFits(freeArea, status_, statusShade_);
    for (const juce::String& paragraph : advice()) drawIfFits(freeArea, paragraph, Shade::highlight);
    if (!isStatusFirst) drawIfFits(freeArea, status_, statusShade_);
}

void StudiesTab::resized() {
    constexpr int captionHeight = 15, spacing = 5, footerHeight = 32, lower = 24; // pixels
    const int lineHeight = std::clamp((getHeight() - controlsHeight) / 5 + 21, 21, rowHeight);
    auto area = getLocalBounds();
    const auto place = [&area](juce::Label& label) { label.setBounds(area.removeFromTop(captionHeight)); };
    place(protocolLabel_);
    auto protocolRow = area.removeFromTop(lineHeight);
    findings_->setBounds(protocolRow.removeFromRight(100));
    protocolChoice_.setBounds(protocolRow.withTrimmedRight(gap));
    area.removeFromTop(spacing);
    descriptionArea_ = area.removeFromTop(std::clamp(getHeight() - controlsHeight - lower - 42, 0, 98));
    const auto placePair = [&area, lineHeight](juce::Label& leftName, juce::Component& left,
                                               juce::Label& rightName, juce::Component& right) {
        auto captionRow = area.removeFromTop(captionHeight), row = area.removeFromTop(lineHeight);
        const int leftWidth = row.getWidth() * 3 / 5;
        leftName.setBounds(captionRow.removeFromLeft(leftWidth));
        left.setBounds(row.removeFromLeft(leftWidth - gap));
        row.removeFromLeft(gap);
        rightName.setBounds(captionRow);
        right.setBounds(row);
    };
    placePair(codeLabel_, code_, numberLabel_, number_);
    area.removeFromTop(spacing);
    place(folderLabel_);
    auto row = area.removeFromTop(lineHeight);
    browse_->setBounds(row.removeFromRight(80));
    folder_.setBounds(row.withTrimmedRight(gap));
    area.removeFromTop(spacing);
    placePair(noiseLabel_, noiseChoice_, noiseLevelLabel_, noiseLevel_);
    area.removeFromTop(spacing);
    placePair(languageLabel_, languageChoice_, answersLabel_, answersChoice_);
    area.removeFromTop(spacing + 2);
    adviceArea_ = area.removeFromTop(std::clamp(area.getHeight() - footerHeight, 0, 63));
    row = area.removeFromTop(std::min(footerHeight, area.getHeight()));
    begin_.setBounds(row.removeFromLeft(84));
    analyse_->setBounds(row.removeFromRight(72));
    master_.setBounds(row.reduced(gap, 0));
}

} // namespace physvib
