// SPDX-License-Identifier: GPL-3.0-or-later
// Mixer tab that selects and checks a study, and opens its screens.
#include "Mixer/Studies/StudiesTab.h"
#include "Core/Units.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {
namespace {

// item ids of the lists
constexpr int fileId = 1000, noNoiseId = 1, protocolWordsId = 1, englishId = 2, firstWordsId = 3;
constexpr int answersHereId = 1, answersElsewhereId = 2;
constexpr std::array<int, 8> noiseLevels{-70, -60, -50, -45, -40, -35, -30, -25};

std::filesystem::path typedPath(const juce::String& words) {
    return std::filesystem::path{pathOf(juce::File::getCurrentWorkingDirectory().getChildFile(words))};
}

juce::String exposureWords(const std::vector<TrialRecord>& records) {
    if (records.empty() || !records.back().answer.exposure) return {};
    return ". A(8) of that day: " + number(*records.back().answer.exposure, 2) + " of " +
           number(exposureActionValue, 1) + utf8(" m/s\u00b2");
}

juce::String aboutText(const Protocol& protocol) {
    juce::StringArray conditions, sessions;
    for (const auto& condition : protocol.conditions)
        conditions.add(utf8(condition.name).replaceCharacter('-', 0x2011)); // broken nowhere
    for (const auto& session : protocol.sessions) sessions.add(utf8(session.name));
    const auto title = utf8(protocol.title);
    return title.substring(0, 1).toUpperCase() + title.substring(1) +
           ".\nConditions: " + conditions.joinIntoString(", ") +
           ".\nIn each: " + sessions.joinIntoString(", ") + ".";
}

constexpr std::size_t maxPictureBytes = 16'000'000;
constexpr unsigned mostPixels = 4096; // maximum width and height

/// Reads a side of a PNG: a big-endian number after its signature.
unsigned sideAt(const std::string& png, std::size_t at) {
    unsigned side = 0;
    for (std::size_t i = at; i < at + 4; ++i) side = 256 * side + static_cast<unsigned char>(png[i]);
    return side;
}

bool isSmallPng(const std::string& text) {
    constexpr std::string_view begin{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16};
    if (text.size() < 24 || !text.starts_with(begin)) return false;
    return std::ranges::all_of(std::initializer_list<unsigned>{sideAt(text, 16), sideAt(text, 20)},
                               [](unsigned side) { return side > 0 && side <= mostPixels; });
}

/// That participant's pictures of materials, or an error line. The files are untrusted, so their size is
/// checked before decoding.
Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant) {
    std::vector<MaterialPicture> pictures;
    for (std::size_t i = 0; i < protocol.pictures.size(); ++i) {
        const std::string at = "pictures[" + std::to_string(i) + "].file: ",
                          path = picturePath(protocol.pictures[i], participant);
        if (auto fault = linkFault(protocol.folder, path); !fault.empty()) return Failure{at + fault};
        const auto text = readFile(besideProtocol(protocol.folder, path), maxPictureBytes);
        if (!text) return Failure{at + text.error};
        auto image = isSmallPng(text.value)
                         ? juce::ImageFileFormat::loadFrom(text.value.data(), text.value.size())
                         : juce::Image{};
        if (image.isNull())
            return Failure{at + path + ": expected a PNG picture of at most " + std::to_string(mostPixels) +
                           " x " + std::to_string(mostPixels) + " pixels"};
        pictures.push_back({protocol.pictures[i].material, std::move(image)});
    }
    return pictures;
}

/// Empty, or an error if the protocol has a display scale but the width of the display is not set (0).
std::string displayScaleFault(const Protocol& protocol, double displayWidthMetres) {
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
        if (auto layout = layoutNamed(besideProtocol(protocol.folder, condition.layout));
            layout && layout.value.enchanters.size() > largest.second.enchanters.size())
            largest = {condition.layout, std::move(layout.value)};
    return largest;
}

} // namespace

StudiesTab::StudiesTab(MixerModel& model)
    : model_{model} {
    setTitle("Studies");
    noise_.setTitle("Outputs of the pink noise");
    noise_.onChange = [this] { repaint(); };
    noise_.setTooltip("Headphones on outputs of the same device; louder or softer by their own knob");
    describe(noiseLevel_, "Level of the pink noise", "Root mean square, in dB of full scale: start low");
    for (const int db : noiseLevels) noiseLevel_.addItem(number(db, 0) + " dBFS", -db);
    choice_.setTitle("Protocol");
    for (int id = 1; const Protocol& protocol : knownProtocols())
        choice_.addItem(titleOf(protocol.name), id++);
    choice_.addSeparator();
    choice_.addItem(juce::String::fromUTF8("Protocol file\xe2\x80\xa6"), fileId);
    choice_.onChange = [this] { pickProtocol(); };
    wordsChoice_.setTitle("Language of the participant");
    wordsChoice_.addItem("what the protocol says", protocolWordsId);
    wordsChoice_.addItem("English", englishId);
    for (int id = firstWordsId; const Words& words : builtInWords())
        wordsChoice_.addItem(
            hasLetters({}, utf8(words.language)) ? utf8(words.language) : utf8(words.inEnglish), id++);
    wordsChoice_.addItem("Words file" + dots(), fileId);
    wordsChoice_.setSelectedId(protocolWordsId, juce::dontSendNotification);
    wordsChoice_.onChange = [this] { pickWords(); };
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
    browse_ = quietButton("Choose", "Choose the folder of the trial files", [this] {
        askForFile(*this, {"The folder of the trial files", {}, juce::File{folder_.getText()}},
                   [this](const juce::File& folder) { setFolder(folder); });
    });
    analyse_ =
        quietButton("Analyse", "Analyse the participant's trials, or other files", [this] { analyse(); });
    findings_ = quietButton("Checking" + dots(), "What `study check` found: levels, orders, times");
    findings_->setTitle("Findings of the check");
    findings_->onClick = [this] { showFindings(); };
    begin_.setTitle("Begin the study");
    begin_.onClick = [this] {
        if (check_) return void(begin());
        isBeginWanted_ = !isBeginWanted_;
        look();
    };
    for (auto* editor : {&code_, &number_, &folder_}) {
        editor->setFont(text::font(text::medium));
        editor->setEscapeAndReturnKeysConsumed(false); // Esc must reach the silence button from here, too
        editor->onTextChange = [this] { look(); };
    }
    addAll(*this,
           {&choiceName_,   &choice_,        &codeName_,    &code_,        &numberName_,    &number_,
            &folderName_,   &folder_,        browse_.get(), &noiseName_,   &noise_,         &noiseLevelName_,
            &noiseLevel_,   &wordsName_,     &wordsChoice_, &answersName_, &answersChoice_, &begin_,
            analyse_.get(), findings_.get(), &master_});
    setFolder(juce::SharedResourcePointer<UserFolder> {} -> place());
    setParticipant("P01", 1);
    // two short pulses a trial, where there are actuators for it
    chooseProtocol(model.mix().count() < 4 ? "model-or-sound" : "level-steps");
}

StudiesTab::~StudiesTab() {
    end();
    stopCheck();
}

std::string StudiesTab::chooseProtocol(const std::string& nameOrPath) {
    auto protocol = protocolNamed(nameOrPath);
    auto fault = protocol ? protocolFault(protocol.value, nameOrPath) : protocol.error;
    if (!fault.empty()) return say(utf8(fault), Shade::limit), fault;
    stopCheck();
    check_.reset();
    isBeginWanted_ = false;
    protocol_ = std::move(protocol.value);
    const auto& all = knownProtocols();
    const auto known = std::ranges::find(all, nameOrPath, &Protocol::name);
    if (known != all.end())
        choice_.setSelectedId(1 + static_cast<int>(known - all.begin()), juce::dontSendNotification);
    else
        choice_.setText(juce::File{utf8(nameOrPath)}.getFileName(), juce::dontSendNotification);
    about_ = aboutText(*protocol_);
    noiseLevel_.setSelectedId(-juce::roundToInt(protocol_->pinkNoiseDb), juce::dontSendNotification);
    if (noiseLevel_.getSelectedId() == 0)
        noiseLevel_.setText(number(protocol_->pinkNoiseDb, 1) + " dBFS", juce::dontSendNotification);
    look();
    repaint();
    return {};
}

void StudiesTab::pickProtocol() {
    const int id = choice_.getSelectedId();
    if (id == fileId)
        askForFile(
            *this, {"A protocol", ".json", juce::File{folder_.getText()}},
            [this](const juce::File& file) { chooseProtocol(pathOf(file)); },
            [this] {
                if (protocol_) choice_.setText(titleOf(protocol_->name), juce::dontSendNotification);
            });
    else if (id > 0)
        chooseProtocol(nth(knownProtocols(), id - 1).name), offerLayout();
}

std::string StudiesTab::chooseWords(const std::string& nameOrPath) {
    const auto words = findWords(nameOrPath);
    if (!words) return say(utf8(words.error), Shade::limit), words.error;
    wordsPath_ = nameOrPath;
    const auto& all = builtInWords();
    const auto known = std::ranges::find(all, nameOrPath, &Words::name);
    if (known != all.end())
        wordsChoice_.setSelectedId(firstWordsId + static_cast<int>(known - all.begin()),
                                   juce::dontSendNotification);
    else if (words.value.name.empty())
        wordsChoice_.setSelectedId(nameOrPath.empty() ? protocolWordsId : englishId,
                                   juce::dontSendNotification);
    else
        wordsChoice_.setText(utf8(words.value.language), juce::dontSendNotification);
    return {};
}

void StudiesTab::pickWords() {
    const int id = wordsChoice_.getSelectedId();
    if (id == fileId)
        askForFile(
            *this, {"Words of a language", ".json", juce::File{folder_.getText()}},
            [this](const juce::File& file) {
                if (!chooseWords(pathOf(file)).empty()) chooseWords(wordsPath_);
            },
            [this] { chooseWords(wordsPath_); });
    else if (id == protocolWordsId || id == englishId)
        chooseWords(id == englishId ? "en" : "");
    else if (id >= firstWordsId)
        chooseWords(nth(builtInWords(), id - firstWordsId).name);
}

void StudiesTab::setAnswersElsewhere(bool areElsewhere) {
    answersChoice_.setSelectedId(areElsewhere ? answersElsewhereId : answersHereId,
                                 juce::dontSendNotification);
}

void StudiesTab::setParticipant(const juce::String& code, int number) {
    code_.setText(code, false);
    number_.setText(juce::String{number}, false);
    look();
}

void StudiesTab::setFolder(const juce::File& folder) {
    folder_.setText(folder.getFullPathName(), false);
    folder_.moveCaretToEnd(); // shows the folder's name, even of a long path
    look();
}

std::vector<std::vector<int>> StudiesTab::noiseChoices() const {
    std::vector<int> free;
    const auto& strips = model_.mix().strips;
    for (int k = 0; k < model_.device().outputs(); ++k)
        if (std::ranges::find(strips, k, &Strip::output) == strips.end()) free.push_back(k);
    std::vector<std::vector<int>> all;
    for (std::size_t i = 0; i + 1 < free.size(); ++i)
        if (free[i] % 2 == 0 && free[i + 1] == free[i] + 1) all.push_back({free[i], free[i + 1]});
    for (const int k : free) all.push_back({k});
    return all;
}

void StudiesTab::listNoise() {
    const auto chosen = listening().noise;
    noiseOutputs_ = noiseChoices();
    noise_.clear(juce::dontSendNotification);
    noise_.addItem("no output", noNoiseId);
    int id = noNoiseId;
    for (const auto& outputs : noiseOutputs_)
        noise_.addItem(outputs.size() > 1 ? "outputs " + juce::String{outputs[0] + 1} + " and " +
                                                juce::String{outputs[1] + 1}
                                          : "output " + juce::String{outputs[0] + 1},
                       ++id);
    chooseNoise(chosen);
}

void StudiesTab::chooseNoise(const std::vector<int>& outputs) {
    const auto at = std::ranges::find(noiseOutputs_, outputs);
    noise_.setSelectedId(
        at == noiseOutputs_.end() ? noNoiseId : static_cast<int>(at - noiseOutputs_.begin()) + noNoiseId + 1,
        juce::dontSendNotification);
}

void StudiesTab::setNoise(const std::vector<int>& outputs, double db) {
    chooseNoise(outputs);
    noiseLevel_.setSelectedId(-juce::roundToInt(db), juce::dontSendNotification);
    repaint();
}

ListeningSettings StudiesTab::listening() const {
    ListeningSettings l;
    if (const int index = noise_.getSelectedId() - noNoiseId - 1;
        index >= 0 && index < static_cast<int>(noiseOutputs_.size()))
        l.noise = nth(noiseOutputs_, index);
    l.noiseDb = noiseLevel_.getSelectedId() > 0 ? -noiseLevel_.getSelectedId()
                : protocol_                     ? protocol_->pinkNoiseDb
                                                : PinkNoise::safeDb;
    return l;
}

StudyRun StudiesTab::run() const {
    return {*protocol_,
            {code_.getText().toStdString(), std::clamp(number_.getText().getIntValue(), 1, 100000), "person"},
            typedPath(folder_.getText())};
}

bool StudiesTab::isDone(const StudyRun& run, const std::vector<TrialRecord>& records) {
    Experiment experiment{run.protocol, run.participant, true};
    for (const TrialRecord& record : records)
        if (!experiment.redo(record).empty()) return false;
    return experiment.isDone();
}

/// Shows whether the trial file exists and can be continued.
void StudiesTab::look() {
    if (!protocol_) return;
    refused_.clear();
    outputs_ = utf8(outputsFault(*protocol_, model_));
    const StudyRun chosen = run();
    const auto path = chosen.trialFile();
    std::error_code none;
    begin_.setEnabled(!code_.isEmpty());
    if (isBeginWanted_)
        return begin_.setButtonText("Checking" + dots()), say("It begins once it is checked", Shade::text);
    if (code_.isEmpty()) return begin_.setButtonText("Begin"), say("Expected a code", Shade::muted);
    if (!std::filesystem::exists(path, none))
        return begin_.setButtonText("Begin"),
               say("The rows will be in " + utf8(path.filename().string()), Shade::muted);
    const auto text = readFile(path, limits::maxTableBytes);
    const auto log = text ? readTrialLog(text.value, path.string(), chosen.protocol, chosen.participant)
                          : Result<TrialLog>{Failure{text.error}};
    const bool isFinished = log && isDone(chosen, log.value.records);
    begin_.setButtonText(isFinished ? "Begin" : "Go on");
    if (isFinished)
        begin_.setEnabled(false),
            say(utf8(path.filename().string()) + " has all its trials: expected another code", Shade::muted);
    else if (log)
        say(utf8(path.filename().string()) + " has " + utf8(counted(log.value.records.size(), "trial")) +
                exposureWords(log.value.records),
            Shade::text);
    else
        say(utf8(log.error), Shade::limit);
}

void StudiesTab::stopCheck() {
    isCheckWanted_ = false;
    checking_ = {}; // waits for the stimulus that is being rendered
}

/// Starts the check of a new protocol beside the message thread, and takes its result.
void StudiesTab::updateCheck() {
    if (checking_.valid() && checking_.wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
        check_ = checking_.get();
        const bool begins = std::exchange(isBeginWanted_, false) && isShowing();
        look();
        if (begins) begin();
    }
    if (!check_ && !checking_.valid() && protocol_ && isVisible()) {
        isCheckWanted_ = true;
        checking_ = std::async(std::launch::async, [this, protocol = *protocol_] {
            return checkStudy(protocol, 0, [this] { return isCheckWanted_.load(); });
        });
    }
    const auto count = check_ ? check_->errors.size() + check_->warnings.size() : 0;
    findings_->setEnabled(check_.has_value());
    findings_->setButtonText(!check_      ? "Checking" + dots()
                             : count == 0 ? juce::String{"Checked"}
                             : count == 1 ? juce::String{"1 finding"}
                                          : juce::String{static_cast<int>(count)} + " findings");
}

void StudiesTab::showFindings() {
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !check_ || host == nullptr) return;
    AnalysisReport report;
    for (const auto* lines : {&check_->facts, &check_->deviations})
        for (const std::string& line : *lines) report.words += line + "\n\n";
    for (const std::string& line : check_->errors) report.warnings.push_back("Refused: " + line);
    report.warnings.insert(report.warnings.end(), check_->warnings.begin(), check_->warnings.end());
    analysis_ =
        std::make_unique<AnalysisScreen>(model_, "Check of " + titleOf(protocol_->name), std::move(report));
    analysis_->onClose = ending();
    host->setScreen(analysis_.get());
}

void StudiesTab::say(const juce::String& words, Shade shade) {
    words_ = words;
    wordsShade_ = shade;
    repaint();
}

// Offers a layout or another study if the mixer, or headphones, have too few actuators.
void StudiesTab::offerLayout() {
    constexpr std::size_t ears = 2;
    const auto [name, layout] = largestLayout(*protocol_);
    const std::size_t wanted = layout.enchanters.size();
    const auto other = std::ranges::find_if(knownProtocols(), [](const Protocol& p) {
        return largestLayout(p).second.enchanters.size() <= ears;
    });
    MixerMessage offer{
        "This study is felt on " + utf8(counted(wanted, "actuator")), true, {}, "study-layout"};
    if (model_.device().choice().isHeadphones && wanted > ears && other != knownProtocols().end()) {
        offer.words += ", and headphones are two";
        offer.act = {"Choose " + titleOf(other->name) + " instead",
                     [this, name = other->name] { chooseProtocol(name), offerLayout(); }};
    } else if (wanted > model_.mix().strips.size())
        offer.act = {"Use " + utf8(name), [this, own = layout] {
                         model_.change("Layout of the study", [&own](Mix& mix) {
                             mix.layout = own;
                             mix.resizeStrips();
                         });
                         offerLayout();
                     }};
    if (!offer.act.run) return model_.messages().withdraw(offer.label);
    model_.messages().show(std::move(offer));
}

/// Offers the master level of the previous trials, because a mixer opens at a low level.
void StudiesTab::offerLevel(double db) {
    const auto words = number(db, 1) + " dB";
    model_.messages().show({"The trials before had a master level of " + words,
                            true,
                            {"Set " + words,
                             [this, db] {
                                 model_.change("Master level", [db](Mix& mix) { mix.levelDb = db; });
                                 model_.messages().withdraw("study-level");
                             }},
                            "study-level"});
}

std::string StudiesTab::begin() {
    const auto refuse = [this](const std::string& why) {
        say(utf8(why), Shade::limit);
        refused_ = words_;
        return why;
    };
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !protocol_ || host == nullptr) return "expected a mixer without a study";
    if (code_.isEmpty()) return refuse("expected a participant's code");
    stopCheck(); // it may still run if a program called this; the button waits for its end
    if (auto fault = faultOf(run()); !fault.empty()) return refuse(fault);
    if (auto fault = outputsFault(*protocol_, model_); !fault.empty()) return offerLayout(), refuse(fault);
    if (auto fault = feltFault(*protocol_, model_); !fault.empty()) return refuse(fault);
    if (auto fault = !check_                  ? studyFault(*protocol_)
                     : check_->errors.empty() ? ""
                                              : check_->errors.front();
        !fault.empty())
        return refuse(protocol_->name + ": " + fault);
    auto words =
        findWords(wordsPath_.empty() ? besideProtocol(protocol_->folder, protocol_->words) : wordsPath_);
    if (!words) return refuse(words.error);
    const auto typeface = typefaceFor(words.value);
    if (!typeface)
        return refuse("expected a font with the letters of " + words.value.name +
                      ", found none; on Debian, fonts-nanum has Korean ones");
    if (auto fault = displayScaleFault(*protocol_, model_.displayWidthMetres()); !fault.empty())
        return refuse(fault);
    auto pictures = materialPictures(*protocol_, run().participant.code);
    if (!pictures) return refuse(pictures.error);
    juce::File{folder_.getText()}.createDirectory(); // a failure is reported with the file's name
    auto study = std::make_unique<StudyInProgress>(run());
    if (!study->error().empty()) return refuse(study->error());
    if (auto fault = model_.device().listening().hear(listening()); !fault.empty()) return refuse(fault);
    Apparatus apparatus = apparatusOf(model_);
    apparatus.language = words.value.name.empty() ? "en" : words.value.name;
    auto unlike = study->apparatusFault(apparatus);
    if (const auto db = study->otherLevelDb(apparatus))
        offerLevel(*db);
    else if (!unlike.empty()) // which has room for all of it
        model_.report(utf8(unlike));
    if (unlike.empty()) unlike = study->begin(apparatus);
    if (!unlike.empty()) return model_.device().listening().endStudy(), refuse(unlike);
    screen_ = std::make_unique<StudyScreen>(model_, std::move(study), std::move(words.value),
                                            answersChoice_.getSelectedId() == answersElsewhereId,
                                            std::move(pictures.value));
    font_ = std::make_unique<StudyFont>(*typeface);
    screen_->onClose = ending();
    host->setScreen(screen_.get());
    return {};
}

void StudiesTab::analyse(std::vector<juce::File> files) {
    auto* host = findParentComponentOfClass<CardHost>();
    if (screen_ || analysis_ || !protocol_ || host == nullptr) return;
    if (files.empty()) files.emplace_back(run().trialFile().string());
    analysis_ = std::make_unique<AnalysisScreen>(model_, files);
    analysis_->onClose = ending();
    host->setScreen(analysis_.get());
}

// The callback may run after the tab was deleted.
std::function<void()> StudiesTab::ending() {
    return [tab = SafePointer{this}] {
        if (tab != nullptr) tab->end();
    };
}

void StudiesTab::end() {
    if (!screen_ && !analysis_) return;
    screen_.reset();
    font_.reset();
    analysis_.reset();
    model_.device().listening().endStudy();
    if (auto* host = findParentComponentOfClass<CardHost>()) host->setScreen(nullptr);
    look();
    model_.sendChangeMessage();
}

void StudiesTab::mixChanged() {
    if (noiseOutputs_ != noiseChoices() || noise_.getNumItems() == 0) listNoise();
    const auto& mix = model_.mix();
    const double times = fromDecibels(-mix.levelDb);
    const auto weak = mix.levelDb <= leastStripDb ? juce::String{"nothing is felt"}
                                                  : number(times, times < 10.0 ? 1 : 0) + " times weaker";
    level_ = times > 1.0 ? "The master is at " + number(mix.levelDb, 1) + " dB: " + weak +
                               " than the protocol says. Its g are those at 0 dB: the fader below raises it."
                         : juce::String{};
    if (model_.device().isNone())
        level_ = "There is no device: the study can be seen, and is felt by nobody.";
    master_.setRemark(times > 1.0 ? weak : juce::String{});
    master_.mixChanged();
    outputs_ = protocol_ ? utf8(outputsFault(*protocol_, model_)) : juce::String{};
    if (refused_.isNotEmpty() && refused_ != outputs_) look(); // the cause of a refusal may be gone
    repaint();
}

// By importance: a small window has space for the first line only.
juce::StringArray StudiesTab::advice() const {
    juce::StringArray lines;
    if (outputs_.isNotEmpty() && outputs_ != refused_) lines.add(outputs_);
    if (protocol_ && protocol_->hasPinkNoise && listening().noise.empty())
        lines.add("It asks for pink noise: choose who hears it.");
    if (level_.isNotEmpty()) lines.add(level_);
    if (check_ && !check_->errors.empty())
        lines.add(utf8(check_->errors.front()));
    else if (check_ && !check_->warnings.empty())
        lines.add(utf8(check_->warnings.front()));
    return lines;
}

void StudiesTab::paint(juce::Graphics& g) {
    g.setFont(text::font(text::medium));
    const int line = juce::roundToInt(std::ceil(g.getCurrentFont().getHeight()));
    const auto write = [&](const juce::String& words, Shade colour, juce::Rectangle<int> area) {
        g.setColour(shade(*this, colour));
        if (const int lines = area.getHeight() / line; lines > 0) // whole ones, none smaller
            g.drawFittedText(words, area, juce::Justification::centredLeft, lines, 1.0f);
    };
    const auto add = [&](juce::Rectangle<int>& room, const juce::String& words, Shade colour) {
        const float rows = static_cast<float>(text::pixels(g.getCurrentFont(), words)) /
                           static_cast<float>(std::max(1, room.getWidth()));
        const int wanted = line * (rows <= 1.0f ? 1 : static_cast<int>(std::ceil(1.1f * rows))),
                  high = std::min(wanted, room.getHeight());
        const bool fits = high == wanted || colour == Shade::limit; // what is wrong is never left out
        if (fits) write(words, colour, room.removeFromTop(high));
        return fits;
    };
    auto about = aboutArea_, room = levelArea_;
    for (const juce::String& words : juce::StringArray::fromLines(about_))
        if (!add(about, words, Shade::muted)) break;
    const bool isFirst = wordsShade_ == Shade::limit || !begin_.isEnabled(); // why it does not begin
    if (isFirst) add(room, words_, wordsShade_);
    for (const juce::String& words : advice()) add(room, words, Shade::now);
    if (!isFirst) add(room, words_, wordsShade_);
}

void StudiesTab::resized() {
    constexpr int captionHeight = 15, space = 5, foot = 32, lower = 24; // all of it in a small window
    const int line = std::clamp((getHeight() - controlsHeight) / 5 + 21, 21, rowHeight);
    auto area = getLocalBounds();
    const auto caption = [&area](juce::Label& label) { label.setBounds(area.removeFromTop(captionHeight)); };
    caption(choiceName_);
    auto first = area.removeFromTop(line);
    findings_->setBounds(first.removeFromRight(100));
    choice_.setBounds(first.withTrimmedRight(gap));
    area.removeFromTop(space);
    aboutArea_ = area.removeFromTop(std::clamp(getHeight() - controlsHeight - lower - 42, 0, 98));
    const auto pair = [&area, line](juce::Label& leftName, juce::Component& left, juce::Label& rightName,
                                    juce::Component& right) {
        auto names = area.removeFromTop(captionHeight), row = area.removeFromTop(line);
        const int wide = row.getWidth() * 3 / 5;
        leftName.setBounds(names.removeFromLeft(wide));
        left.setBounds(row.removeFromLeft(wide - gap));
        row.removeFromLeft(gap);
        rightName.setBounds(names);
        right.setBounds(row);
    };
    pair(codeName_, code_, numberName_, number_);
    area.removeFromTop(space);
    caption(folderName_);
    auto row = area.removeFromTop(line);
    browse_->setBounds(row.removeFromRight(80));
    folder_.setBounds(row.withTrimmedRight(gap));
    area.removeFromTop(space);
    pair(noiseName_, noise_, noiseLevelName_, noiseLevel_);
    area.removeFromTop(space);
    pair(wordsName_, wordsChoice_, answersName_, answersChoice_);
    area.removeFromTop(space + 2);
    levelArea_ = area.removeFromTop(std::clamp(area.getHeight() - foot, 0, 63));
    row = area.removeFromTop(std::min(foot, area.getHeight()));
    begin_.setBounds(row.removeFromLeft(84));
    analyse_->setBounds(row.removeFromRight(72));
    master_.setBounds(row.reduced(gap, 0));
}

} // namespace physvib
