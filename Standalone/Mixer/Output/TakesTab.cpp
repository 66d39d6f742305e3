// SPDX-License-Identifier: GPL-3.0-or-later
// Lists, plays, trims, copies and removes recordings. LevelReader and PartWriter stream their files, so long
// ones need no more memory; savePart() and loadPart() keep the selected part in a JSON file.
#include "Mixer/Output/TakesTab.h"
#include "Core/ClockLaw.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/ReadRecording.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/EventsCsv.h"
#include <juce_audio_formats/juce_audio_formats.h>

namespace physvib {
namespace {

constexpr int takeRowPixels = 24, takeFootPixels = 32, trimmerPixels = 44, maxButtonWidth = 76;
constexpr double folderCheckMs = 1000.0;

juce::File toEventsFile(const juce::File& wav) { return wav.withFileExtension("csv"); }

bool discardFile(const juce::File& file) { return file.moveToTrash() || file.deleteFile(); } // or deletes it

juce::String lengthText(double seconds) {
    if (seconds < 59.95) return number(seconds, 1) + " s"; // longer ones would be rounded to 60.0 s
    const int rounded = static_cast<int>(std::max(60.0, seconds));
    return juce::String{rounded / 60} + ":" + juce::String{rounded % 60}.paddedLeft('0', 2);
}

/// Milliseconds with three decimals: different parts get different file names.
juce::String millisecondsText(double seconds) {
    return number(1e3 * seconds, 3).trimCharactersAtEnd("0").trimCharactersAtEnd(".");
}

constexpr int levelCount = 400;
constexpr double minPartSeconds = 0.02, keyStepSeconds = 0.01;
constexpr float minPerceptibleLevel = 0.001f; // -60 dB of full scale
constexpr double fadeSeconds = 0.005;

/// Finds the peak in each of levelCount sections of a streamed recording.
struct LevelReader final : SoundReceiver {
    explicit LevelReader(std::function<bool()> shouldContinue)
        : mayContinue{std::move(shouldContinue)} {}
    std::string begin(const SoundFormat& soundFormat) override {
        format = soundFormat;
        return format.frames > 0 ? std::string{} : "no samples";
    }
    std::string receive(const float* const* channels, int frames) override {
        for (int k = 0; k < frames && frame < format.frames; ++k, ++frame) {
            float& level = nth(levels, frame * levelCount / format.frames);
            for (int c = 0; c < format.channels; ++c) level = std::max(level, std::abs(channels[c][k]));
        }
        return mayContinue() ? std::string{} : "cancelled";
    }
    std::vector<float> levels = std::vector<float>(levelCount);
    const std::function<bool()> mayContinue;
    SoundFormat format;
    std::int64_t frame = 0;
};

Provenance makeProvenance(const juce::File& take) {
    return {PHYSVIB_VERSION, {{"part_of", take.getFileName().toStdString()}}};
}

/// Writes a part of a take as a recording of its own. A cut within the sound is faded in 5 ms.
class PartWriter final : public SoundReceiver {
public:
    PartWriter(const juce::File& take, juce::Range<double> seconds, const juce::File& target)
        : take_{take}
        , seconds_{seconds}
        , target_{target} {}
    /// Empty, or one line.
    std::string write() {
        auto error = streamRecording(pathOf(take_), *this);
        return error.empty() ? sink_->finish() : error;
    }
    std::string begin(const SoundFormat& format) override {
        const auto toFrame = [&](double s) {
            return std::clamp<std::int64_t>(std::llround(s * static_cast<double>(format.sampleRateHz)), 0,
                                            format.frames);
        };
        startFrame_ = toFrame(seconds_.getStart());
        endFrame_ = toFrame(seconds_.getEnd());
        totalFrames_ = format.frames;
        fadeFrames_ = std::max<std::int64_t>(1, toFrame(fadeSeconds));
        rateHz_ = static_cast<int>(format.sampleRateHz);
        block_.resize(static_cast<std::size_t>(format.channels));
        sink_.emplace(pathOf(target_), static_cast<int>(format.channels), rateHz_,
                      provenanceLine(makeProvenance(take_)));
        return sink_->error();
    }
    std::string receive(const float* const* channels, int frames) override {
        for (auto& samples : block_) samples.clear();
        for (int k = 0; k < frames; ++k, ++frame_)
            if (frame_ >= startFrame_ && frame_ < endFrame_)
                for (std::size_t c = 0; c < block_.size(); ++c)
                    block_[c].push_back(channels[c][k] * gainAt(frame_));
        std::vector<const float*> pointers;
        for (const auto& samples : block_) pointers.push_back(samples.data());
        sink_->write(pointers.data(), static_cast<int>(block_[0].size()));
        return sink_->error();
    }
    std::int64_t toNs(std::int64_t frames) const { return FrameClock{rateHz_}.timeNs(frames); }
    std::int64_t startNs() const { return toNs(startFrame_); }
    std::int64_t endNs() const { return toNs(endFrame_); }

private:
    float gainAt(std::int64_t frame) const {
        const auto fadeIn = startFrame_ == 0 ? fadeFrames_ : frame - startFrame_ + 1,
                   fadeOut = endFrame_ == totalFrames_ ? fadeFrames_ : endFrame_ - frame;
        return static_cast<float>(std::min({fadeFrames_, fadeIn, fadeOut})) / static_cast<float>(fadeFrames_);
    }
    const juce::File take_;
    const juce::Range<double> seconds_;
    const juce::File target_;
    std::optional<WavSink> sink_;
    std::vector<std::vector<float>> block_;
    int rateHz_ = 1;
    std::int64_t startFrame_ = 0, endFrame_ = 0, totalFrames_ = 0, fadeFrames_ = 1, frame_ = 0;
};

/// True if no row follows the header; the reader of event lists rejects such files.
bool isEmptyList(std::string_view csv) {
    const auto lines = juce::StringArray::fromLines(utf8(std::string{csv}));
    return std::ranges::count_if(lines, [](const juce::String& line) {
               return line.trim().isNotEmpty() && !line.startsWithChar('#');
           }) <= 1;
}

/// Reads the events of a take. A list without rows is valid here: nothing was played.
Result<EventList> readTakeEvents(const juce::File& file) {
    const std::string path = pathOf(file);
    auto list = loadEventsCsv(path);
    if (list) return list;
    const auto text = readFile(path, limits::maxEventsFileBytes);
    return text && isEmptyList(text.value) ? Result<EventList>{EventList{}} : list;
}

/// Writes the part and its events. Empty, or an error; nothing is written if the events are unreadable.
std::string exportTakePart(const juce::File& take, juce::Range<double> seconds, const juce::File& target) {
    const bool hasList = toEventsFile(take).existsAsFile();
    auto list = hasList ? readTakeEvents(toEventsFile(take)) : Result<EventList>{EventList{}};
    if (!list) return list.error;
    PartWriter part{take, seconds, target};
    if (auto error = part.write(); !error.empty() || !hasList) return error;
    auto& events = list.value.events;
    std::erase_if(events, [&](const CollisionEvent& e) {
        return e.timeNs < part.startNs() || e.timeNs >= part.endNs();
    });
    for (auto& event : events) event.timeNs -= part.startNs();
    return writeFile(pathOf(toEventsFile(target)),
                     eventsCsv(events, list.value.field, makeProvenance(take), list.value.names));
}

constexpr const char *startField = "from_s", *endField = "to_s", *takeLengthField = "of_s";
constexpr double lengthToleranceSeconds = 1e-6; // of lengths that are read from text

/// Folder beside the takes for files that belong to them and are not listed.
juce::File partsFolder(const juce::File& take) { return take.getSiblingFile("parts"); }

/// File with the selected part of a take: the recording and its events stay unchanged.
juce::File toPartFile(const juce::File& take) {
    return partsFolder(take).getChildFile(take.getFileNameWithoutExtension() + ".json");
}

/// Writes the part file, or deletes it if all of the take is selected. Empty, or one line of error.
std::string savePart(const juce::File& take, double seconds, juce::Range<double> part) {
    const auto file = toPartFile(take);
    if (part == juce::Range{0.0, seconds})
        return !file.existsAsFile() || file.deleteFile() ? std::string{}
                                                         : pathOf(file) + ": cannot be deleted";
    auto* const fields = new juce::DynamicObject; // owned by the value below
    const juce::var json{fields};
    fields->setProperty(startField, part.getStart());
    fields->setProperty(endField, part.getEnd());
    fields->setProperty(takeLengthField, seconds);
    file.getParentDirectory().createDirectory();
    return writeFile(pathOf(file), juce::JSON::toString(json, true, 15).toStdString() + "\n");
}

} // namespace

juce::String TakesTab::Take::length() const {
    const auto all = lengthText(seconds);
    return isTrimmed() ? lengthText(part.getLength()) + " of " + all : all;
}

TakesTab::TakesTab(MixerModel& model)
    : model_{model} {
    setTitle("Takes");
    list_.setTitle("List of takes");
    list_.setRowHeight(takeRowPixels);
    const auto button = [this](auto& member, const char* label, const char* name, void (TakesTab::*act)()) {
        member = makeLinkButton(label, name, [this, act] { (this->*act)(); });
        addAndMakeVisible(*member);
    };
    button(playButton_, "Play", "Play the take on the device", &TakesTab::play);
    button(trimButton_, "Trim", "Trim the take", &TakesTab::trim);
    button(exportButton_, "Export", "Copy the take elsewhere", &TakesTab::askExport);
    button(eraseButton_, "Delete", "Delete the take", &TakesTab::askErase);
    showButton_ = makeLinkButton("Show", "Show the folder of the takes",
                                 [this] { folder_->location().revealToUser(); });
    addAll(*this, {showButton_.get(), &list_});
    addHidden(*this, {&emptyHint_, &trimmer_});
    trimmer_.onChange = [this](juce::Range<double> part) {
        if (!selectedTake()) return;
        selectedTake()->part = part;
        showSelection();
        list_.repaint();
    };
    trimmer_.onEnd = [this] {
        if (!selectedTake()) return;
        model_.reportIfError(savePart(selectedTake()->file, selectedTake()->seconds, selectedTake()->part));
    };
    showSelection();
}

TakesTab::Take* TakesTab::selectedTake() {
    const int row = list_.getSelectedRow();
    return row >= 0 && row < static_cast<int>(takes_.size()) ? &nth(takes_, row) : nullptr;
}

// Checks the folder: a recording may have ended, or another program may have changed it.
void TakesTab::refresh(const MixerSnapshot&) {
    const double now = nowMs();
    const bool isPlaying = selectedTake() &&
                           lastPlayed_ == std::pair{selectedTake()->file, selectedTake()->part} &&
                           now < playsUntilMs_;
    playButton_->setButtonText(isPlaying ? "Stop" : "Play");
    trimmer_.setPlayhead(isPlaying ? selectedTake()->part.getEnd() - 1e-3 * (playsUntilMs_ - now) : -1.0);
    if (now - folderCheckedAtMs_ < folderCheckMs) return;
    folderCheckedAtMs_ = now;
    if (folder_->location().getLastModificationTime() != folderChangedAt_) rescan();
}

void TakesTab::rescan() {
    if (!isVisible()) return;
    folderChangedAt_ = folder_->location().getLastModificationTime();
    const auto selectedFile = selectedTake() ? selectedTake()->file : juce::File{};
    juce::WavAudioFormat wav;
    takes_.clear();
    for (const auto& file : folder_->location().findChildFiles(juce::File::findFiles, false, "*.wav")) {
        const std::unique_ptr<juce::AudioFormatReader> reader{
            wav.createReaderFor(file.createInputStream().release(), true)};
        if (reader == nullptr || reader->sampleRate <= 0.0) continue; // not complete yet, or no recording
        const double seconds = static_cast<double>(reader->lengthInSamples) / reader->sampleRate;
        takes_.push_back({file, file.getLastModificationTime(), seconds,
                          static_cast<int>(reader->numChannels), loadPart(file, seconds)});
    }
    std::ranges::sort(takes_, [](const Take& a, const Take& b) { return b.modifiedAt < a.modifiedAt; });
    list_.updateContent();
    const auto same = std::ranges::find(takes_, selectedFile, &Take::file);
    if (same != takes_.end())
        list_.selectRow(static_cast<int>(same - takes_.begin()));
    else
        list_.deselectAllRows();
    emptyHint_.setVisible(takes_.empty());
    list_.repaint();
    showSelection();
}

void TakesTab::showSelection() {
    for (auto* button : {playButton_.get(), trimButton_.get(), exportButton_.get(), eraseButton_.get()})
        button->setEnabled(selectedTake() != nullptr);
    trimButton_->setButtonText(selectedTake() && selectedTake()->isTrimmed() ? "Whole" : "Trim");
    if (selectedTake()) trimmer_.setTake(selectedTake()->file, selectedTake()->seconds, selectedTake()->part);
    if (trimmer_.isVisible() == (selectedTake() != nullptr)) return;
    trimmer_.setVisible(selectedTake() != nullptr);
    resized();
}

void TakesTab::trim() {
    if (!selectedTake()) return;
    if (selectedTake()->isTrimmed())
        trimmer_.selectAll();
    else
        trimmer_.trimSilence();
}

// Plays a part from its own file, which stays in the folder of parts, because saved sessions refer to it.
void TakesTab::play() {
    if (!selectedTake()) return;
    const double now = nowMs();
    const auto part = selectedTake()->part;
    auto file = selectedTake()->file;
    const bool isPlaying = now < playsUntilMs_, isSame = lastPlayed_ == std::pair{file, part};
    if (isPlaying) (void)model_.session().submit({Stop{}});
    playsUntilMs_ = 0.0;
    if (isPlaying && isSame) return;
    lastPlayed_ = {file, part};
    if (selectedTake()->isTrimmed()) {
        file = partsFolder(file).getChildFile(file.getFileNameWithoutExtension() + " " +
                                              millisecondsText(part.getStart()) + " to " +
                                              millisecondsText(part.getEnd()) + " ms.wav");
        if (!file.existsAsFile() || file.getLastModificationTime() < selectedTake()->modifiedAt) {
            file.getParentDirectory().createDirectory();
            if (model_.reportIfError(PartWriter{selectedTake()->file, part, file}.write())) return;
        }
    }
    model_.eventPlayer().playRecording(file);
    playsUntilMs_ = now + 1e3 * part.getLength();
}

void TakesTab::askExport() {
    if (!selectedTake()) return;
    const auto home = juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    askForFile(*this,
               {"Copy the take to", ".wav", home, true, selectedTake()->file.getFileNameWithoutExtension()},
               [this](const juce::File& file) { exportTo(file); });
}

void TakesTab::exportTo(const juce::File& file) {
    if (!selectedTake() || file == selectedTake()->file) return;
    const auto source = selectedTake()->file;
    const auto events = toEventsFile(file);
    if (events.existsAsFile() && !file.existsAsFile())
        return model_.report(events.getFullPathName() + ": is there already, without " + file.getFileName() +
                             "; expected another name");
    juce::String error;
    if (selectedTake()->isTrimmed())
        error = utf8(exportTakePart(source, selectedTake()->part, file));
    else if (!source.copyFileTo(file) ||
             (toEventsFile(source).existsAsFile() && !toEventsFile(source).copyFileTo(events)))
        error = file.getFullPathName() + ": cannot be written";
    // deletes the events of the recording that was replaced
    if (error.isEmpty() && !toEventsFile(source).existsAsFile() && events.existsAsFile() &&
        !discardFile(events))
        error = events.getFullPathName() + ": is of another recording and cannot be deleted";
    if (error.isNotEmpty()) return model_.report(error);
    model_.messages().show(
        {"Copied to " + file.getFullPathName(), true, {"Show", [file] { file.revealToUser(); }}, savedLabel});
}

void TakesTab::askErase() {
    if (!selectedTake()) return;
    askForValues(*this, "Delete " + selectedTake()->file.getFileName() + "?", "Delete", {},
                 [this](const juce::StringArray&) { erase(); });
}

void TakesTab::erase() {
    if (!selectedTake()) return;
    const auto [file, seconds] = std::pair{selectedTake()->file, selectedTake()->seconds};
    if (discardFile(file)) {
        if (toEventsFile(file).existsAsFile()) discardFile(toEventsFile(file));
        (void)savePart(file, seconds, {0.0, seconds}); // deletes the file of the part
    } else
        model_.report(file.getFullPathName() + ": cannot be deleted");
    rescan();
}

juce::String TakesTab::getNameForRow(int row) {
    if (row < 0 || row >= static_cast<int>(takes_.size())) return {};
    const Take& take = nth(takes_, row);
    return take.file.getFileNameWithoutExtension() + ", " + take.length();
}

void TakesTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= static_cast<int>(takes_.size())) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) drawSelectedRow(g, *this, width, height, 0.22f);
    area.reduce(10, 0);
    const Take& take = nth(takes_, row);
    setInk(g, *this, Shade::muted, text::small);
    const auto cell = [&](const juce::String& cellText, int cellWidth) {
        g.drawText(cellText, area.removeFromRight(cellWidth), juce::Justification::centredRight, true);
    };
    cell(take.modifiedAt.formatted("%Y-%m-%d %H:%M"), 120);
    if (width > 400) cell(countText(take.channels, "channel"), 90);
    g.setColour(shade(*this, Shade::text));
    cell(take.length(), take.isTrimmed() ? 110 : 70);
    g.setFont(text::font(text::medium));
    g.drawText(take.file.getFileNameWithoutExtension(), area, juce::Justification::centredLeft, true);
}

void TakesTab::resized() {
    auto area = getLocalBounds().reduced(panelInset, 4);
    auto foot = area.removeFromBottom(takeFootPixels).withTrimmedTop(4);
    const int buttonWidth = std::min(maxButtonWidth, (foot.getWidth() - 4 * 8) / 5);
    for (auto* button :
         {playButton_.get(), trimButton_.get(), exportButton_.get(), eraseButton_.get(), showButton_.get()}) {
        button->setBounds(foot.removeFromLeft(buttonWidth));
        foot.removeFromLeft(8);
    }
    if (trimmer_.isVisible()) trimmer_.setBounds(area.removeFromBottom(trimmerPixels).withTrimmedTop(4));
    list_.setBounds(area);
    emptyHint_.setBounds(area.withHeight(rowHeight).reduced(10, 0));
}

TakeTrimmer::TakeTrimmer() {
    describe(*this, "Start and end of the take",
             "Drag the start or the end; arrows move the start, with Shift the end; double click: all of it");
    setWantsKeyboardFocus(true);
    setMouseCursor(juce::MouseCursor::LeftRightResizeCursor);
}

TakeTrimmer::~TakeTrimmer() {
    ++requestedReadNumber_;
    constexpr int noTimeoutMs = -1;
    reader_.removeAllJobs(true, noTimeoutMs);
    cancelPendingUpdate();
}

void TakeTrimmer::setTake(const juce::File& take, double seconds, juce::Range<double> part) {
    part_ = part;
    seconds_ = seconds;
    repaint();
    if (take == take_) return;
    take_ = take;
    levels_.clear();
    trimsSilenceWhenRead_ = false;
    const int readNumber = ++requestedReadNumber_;
    reader_.addJob([this, take, readNumber] {
        LevelReader levelReader{[&] { return readNumber == requestedReadNumber_; }};
        const bool isRead = streamRecording(pathOf(take), levelReader).empty();
        const std::lock_guard lock{mutex_};
        if (readNumber != requestedReadNumber_) return;
        newLevels_ = isRead ? std::move(levelReader.levels) : std::vector<float>{};
        triggerAsyncUpdate();
    });
}

void TakeTrimmer::handleAsyncUpdate() {
    {
        const std::lock_guard lock{mutex_};
        levels_ = std::exchange(newLevels_, {});
    }
    if (std::exchange(trimsSilenceWhenRead_, false)) trimSilence();
    repaint();
}

void TakeTrimmer::trimSilence() {
    if (levels_.empty())
        trimsSilenceWhenRead_ = true;
    else
        setPartAndEnd(perceptiblePart(levels_, seconds_));
}

void TakeTrimmer::setPart(juce::Range<double> part) {
    part_ = part;
    repaint();
    if (onChange) onChange(part_);
}

void TakeTrimmer::setPartAndEnd(juce::Range<double> part) {
    setPart(part);
    notifyEnd();
}

void TakeTrimmer::moveEdgeTo(double seconds) {
    const double minPart = std::min(minPartSeconds, seconds_);
    auto part = part_;
    if (isDraggingEnd_)
        part.setEnd(
            juce::jlimit(part.getStart() + minPart, std::max(part.getStart() + minPart, seconds_), seconds));
    else
        part.setStart(juce::jlimit(0.0, std::max(0.0, part.getEnd() - minPart), seconds));
    setPart(part);
}

bool TakeTrimmer::keyPressed(const juce::KeyPress& key) {
    const bool isLeft = key.isKeyCode(juce::KeyPress::leftKey);
    if (!isLeft && !key.isKeyCode(juce::KeyPress::rightKey)) return false;
    isDraggingEnd_ = key.getModifiers().isShiftDown();
    moveEdgeTo((isDraggingEnd_ ? part_.getEnd() : part_.getStart()) +
               (isLeft ? -keyStepSeconds : keyStepSeconds));
    notifyEnd();
    return true;
}

void TakeTrimmer::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().toFloat(), 3.0f);
    const float middleY = 0.5f * static_cast<float>(getHeight()), startX = toPixel(part_.getStart()),
                endX = toPixel(part_.getEnd());
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        const float x = static_cast<float>(k) * static_cast<float>(getWidth()) / levelCount,
                    half = std::max(0.5f, levels_[k] * (middleY - 2.0f));
        g.setColour(shade(*this, x >= startX && x < endX ? Shade::accent : Shade::line));
        g.fillRect(x, middleY - half, static_cast<float>(getWidth()) / levelCount + 0.2f, 2.0f * half);
    }
    g.setColour(shade(*this, Shade::highlight));
    for (const float x : {startX, endX})
        g.fillRect(juce::jlimit(0.0f, static_cast<float>(getWidth()) - 3.0f, x - 1.5f), 0.0f, 3.0f,
                   2.0f * middleY);
    g.setColour(shade(*this, Shade::text));
    if (playheadSeconds_ >= 0.0) g.fillRect(toPixel(playheadSeconds_), 0.0f, 1.0f, 2.0f * middleY);
}

juce::Range<double> perceptiblePart(const std::vector<float>& levels, double seconds) {
    const auto isPerceptible = [](float level) { return level >= minPerceptibleLevel; };
    const auto first = std::ranges::find_if(levels, isPerceptible);
    if (first == levels.end()) return {0.0, seconds};
    const auto last = std::find_if(levels.rbegin(), levels.rend(), isPerceptible).base();
    const auto toSeconds = [&](auto level) {
        return seconds * static_cast<double>(level - levels.begin()) / static_cast<double>(levels.size());
    };
    return {toSeconds(first), toSeconds(last)};
}

// The file also has the length of its take, because a later recording may have the name of a deleted one.
juce::Range<double> loadPart(const juce::File& take, double seconds) {
    const juce::Range<double> all{0.0, seconds};
    const auto json = juce::JSON::parse(toPartFile(take).loadFileAsString());
    const auto field = [&](const char* name) { return static_cast<double>(json.getProperty(name, -1.0)); };
    const double start = field(startField), end = field(endField);
    const bool isOfThisTake = std::abs(field(takeLengthField) - seconds) <= lengthToleranceSeconds;
    return isOfThisTake && start >= 0.0 && start < end && end <= seconds ? juce::Range{start, end} : all;
}

} // namespace physvib
