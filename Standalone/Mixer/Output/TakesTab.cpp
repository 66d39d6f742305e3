// SPDX-License-Identifier: GPL-3.0-or-later
// Lists, plays, copies and removes recordings.
#include "Mixer/Output/TakesTab.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/ReadRecording.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/EventsCsv.h"
#include <juce_audio_formats/juce_audio_formats.h>

namespace physvib {
namespace {

constexpr int takeRowPixels = 24, takeFootPixels = 32, trimPixels = 44, widestButton = 76;
constexpr double takeLookMs = 1000.0;

juce::File eventsOf(const juce::File& wav) { return wav.withFileExtension("csv"); }

bool remove(const juce::File& file) { return file.moveToTrash() || file.deleteFile(); } // some have no bin

juce::String lengthText(double seconds) {
    if (seconds < 59.95) return number(seconds, 1) + " s"; // not 60.0 s
    const int whole = static_cast<int>(std::max(60.0, seconds));
    return juce::String{whole / 60} + ":" + juce::String{whole % 60}.paddedLeft('0', 2);
}

/// To a thousandth, so that another part has another name.
juce::String millisecondsText(double seconds) {
    return number(1e3 * seconds, 3).trimCharactersAtEnd("0").trimCharactersAtEnd(".");
}

constexpr int columns = 400;
constexpr double leastSeconds = 0.02, step = 0.01;
constexpr float leastFelt = 0.001f; // -60 dB of full scale
constexpr double fadeSeconds = 0.005;

/// The largest sample in each of the columns of a recording, which is streamed: a long one takes no more
/// memory than a short one.
struct Levels final : SoundTaker {
    explicit Levels(std::function<bool()> goesOn)
        : keepGoing{std::move(goesOn)} {}
    std::string begin(const SoundShape& of) override {
        shape = of;
        return shape.frames > 0 ? std::string{} : "no samples";
    }
    std::string take(const float* const* channels, int frames) override {
        for (int k = 0; k < frames && at < shape.frames; ++k, ++at) {
            float& level = nth(levels, at * columns / shape.frames);
            for (int c = 0; c < shape.channels; ++c) level = std::max(level, std::abs(channels[c][k]));
        }
        return keepGoing() ? std::string{} : "cancelled";
    }
    std::vector<float> levels = std::vector<float>(columns);
    const std::function<bool()> keepGoing;
    SoundShape shape;
    std::int64_t at = 0;
};

Provenance provenanceOf(const juce::File& take) {
    return {PHYSVIB_VERSION, {{"part_of", take.getFileName().toStdString()}}};
}

/// A part of a take, as a recording of its own. An edge within the sound fades in 5 ms.
class Part final : public SoundTaker {
public:
    Part(const juce::File& take, juce::Range<double> seconds, const juce::File& to)
        : take_{take}
        , seconds_{seconds}
        , to_{to} {}
    /// Empty, or one line.
    std::string write() {
        auto error = streamRecording(pathOf(take_), *this);
        return error.empty() ? sink_->finish() : error;
    }
    std::string begin(const SoundShape& shape) override {
        const auto frameOf = [&](double s) {
            return std::clamp<std::int64_t>(std::llround(s * static_cast<double>(shape.sampleRateHz)), 0,
                                            shape.frames);
        };
        from_ = frameOf(seconds_.getStart());
        end_ = frameOf(seconds_.getEnd());
        frames_ = shape.frames;
        fade_ = std::max<std::int64_t>(1, frameOf(fadeSeconds));
        rateHz_ = static_cast<int>(shape.sampleRateHz);
        block_.resize(static_cast<std::size_t>(shape.channels));
        sink_.emplace(pathOf(to_), static_cast<int>(shape.channels), rateHz_,
                      provenanceLine(provenanceOf(take_)));
        return sink_->error();
    }
    std::string take(const float* const* channels, int frames) override {
        for (auto& samples : block_) samples.clear();
        for (int k = 0; k < frames; ++k, ++at_)
            if (at_ >= from_ && at_ < end_)
                for (std::size_t c = 0; c < block_.size(); ++c)
                    block_[c].push_back(channels[c][k] * gainAt(at_));
        std::vector<const float*> pointers;
        for (const auto& samples : block_) pointers.push_back(samples.data());
        sink_->write(pointers.data(), static_cast<int>(block_[0].size()));
        return sink_->error();
    }
    std::int64_t nsOf(std::int64_t frames) const { return frames * 1'000'000'000 / rateHz_; }
    std::int64_t fromNs() const { return nsOf(from_); }
    std::int64_t endNs() const { return nsOf(end_); }

private:
    float gainAt(std::int64_t frame) const {
        const auto in = from_ == 0 ? fade_ : frame - from_ + 1, out = end_ == frames_ ? fade_ : end_ - frame;
        return static_cast<float>(std::min({fade_, in, out})) / static_cast<float>(fade_);
    }
    const juce::File take_;
    const juce::Range<double> seconds_;
    const juce::File to_;
    std::optional<WavSink> sink_;
    std::vector<std::vector<float>> block_;
    int rateHz_ = 1;
    std::int64_t from_ = 0, end_ = 0, frames_ = 0, fade_ = 1, at_ = 0;
};

/// True if nothing follows the header, which readers of lists refuse.
bool hasNoRows(std::string_view list) {
    const auto lines = juce::StringArray::fromLines(utf8(std::string{list}));
    return std::ranges::count_if(lines, [](const juce::String& line) {
               return line.trim().isNotEmpty() && !line.startsWithChar('#');
           }) <= 1;
}

/// Reads the events of a take; a list without rows is valid: nothing was played.
Result<EventList> eventsOfTake(const juce::File& list) {
    const std::string path = pathOf(list);
    auto read = loadEventsCsv(path);
    if (read) return read;
    const auto text = readFile(path, limits::maxEventsFileBytes);
    return text && hasNoRows(text.value) ? Result<EventList>{EventList{}} : read;
}

/// Writes the part with its events. Empty, or an error; unreadable events prevent it.
std::string exportTakePart(const juce::File& take, juce::Range<double> seconds, const juce::File& to) {
    const bool hasList = eventsOf(take).existsAsFile();
    auto list = hasList ? eventsOfTake(eventsOf(take)) : Result<EventList>{EventList{}};
    if (!list) return list.error;
    Part part{take, seconds, to};
    if (auto error = part.write(); !error.empty() || !hasList) return error;
    auto& events = list.value.events;
    std::erase_if(events, [&](const CollisionEvent& e) {
        return e.timeNs < part.fromNs() || e.timeNs >= part.endNs();
    });
    for (auto& event : events) event.timeNs -= part.fromNs();
    return writeFile(pathOf(eventsOf(to)),
                     eventsCsv(events, list.value.field, provenanceOf(take), list.value.names));
}

constexpr const char *fromField = "from_s", *toField = "to_s", *ofField = "of_s";
constexpr double sameLength = 1e-6; // as written in text

/// Below the takes, for what belongs to them and is not listed.
juce::File partsFolder(const juce::File& take) { return take.getSiblingFile("parts"); }

/// File with the selected part of a take: the recording and its events stay unchanged.
juce::File fileOf(const juce::File& take) {
    return partsFolder(take).getChildFile(take.getFileNameWithoutExtension() + ".json");
}

/// Writes that file, or deletes it if all of the take is selected. Empty, or one line.
std::string keepPart(const juce::File& take, double seconds, juce::Range<double> part) {
    const auto file = fileOf(take);
    if (part == juce::Range{0.0, seconds})
        return !file.existsAsFile() || file.deleteFile() ? std::string{}
                                                         : pathOf(file) + ": cannot be deleted";
    auto* const fields = new juce::DynamicObject; // owned by the value below
    const juce::var kept{fields};
    fields->setProperty(fromField, part.getStart());
    fields->setProperty(toField, part.getEnd());
    fields->setProperty(ofField, seconds);
    file.getParentDirectory().createDirectory();
    return writeFile(pathOf(file), juce::JSON::toString(kept, true, 15).toStdString() + "\n");
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
    const auto button = [this](auto& made, const char* words, const char* name, void (TakesTab::*act)()) {
        made = quietButton(words, name, [this, act] { (this->*act)(); });
        addAndMakeVisible(*made);
    };
    button(play_, "Play", "Play the take on the device", &TakesTab::play);
    button(trim_, "Trim", "Trim the take", &TakesTab::trim);
    button(export_, "Export", "Copy the take elsewhere", &TakesTab::askExport);
    button(erase_, "Delete", "Delete the take", &TakesTab::askErase);
    show_ = quietButton("Show", "Show the folder of the takes", [this] { folder_->place().revealToUser(); });
    addAll(*this, {show_.get(), &list_});
    addHidden(*this, {&none_, &trimmer_});
    trimmer_.onChange = [this](juce::Range<double> part) {
        if (!take()) return;
        take()->part = part;
        showChosen();
        list_.repaint();
    };
    trimmer_.onEnd = [this] {
        if (!take()) return;
        model_.reportFault(keepPart(take()->file, take()->seconds, take()->part));
    };
    showChosen();
}

TakesTab::Take* TakesTab::take() {
    const int row = list_.getSelectedRow();
    return row >= 0 && row < static_cast<int>(takes_.size()) ? &nth(takes_, row) : nullptr;
}

// A recording may have ended, or another program changed the folder.
void TakesTab::refresh(const MixerMoment&) {
    const double now = nowMs();
    const bool plays = take() && playing_ == std::pair{take()->file, take()->part} && now < endsAtMs_;
    play_->setButtonText(plays ? "Stop" : "Play");
    trimmer_.showPlayed(plays ? take()->part.getEnd() - 1e-3 * (endsAtMs_ - now) : -1.0);
    if (now - lookedAtMs_ < takeLookMs) return;
    lookedAtMs_ = now;
    if (folder_->place().getLastModificationTime() != seenAt_) look();
}

void TakesTab::look() {
    if (!isVisible()) return;
    seenAt_ = folder_->place().getLastModificationTime();
    const auto before = take() ? take()->file : juce::File{};
    juce::WavAudioFormat wav;
    takes_.clear();
    for (const auto& file : folder_->place().findChildFiles(juce::File::findFiles, false, "*.wav")) {
        const std::unique_ptr<juce::AudioFormatReader> reader{
            wav.createReaderFor(file.createInputStream().release(), true)};
        if (reader == nullptr || reader->sampleRate <= 0.0) continue; // not complete yet, or no recording
        const double seconds = static_cast<double>(reader->lengthInSamples) / reader->sampleRate;
        takes_.push_back({file, file.getLastModificationTime(), seconds,
                          static_cast<int>(reader->numChannels), keptPart(file, seconds)});
    }
    std::ranges::sort(takes_, [](const Take& a, const Take& b) { return b.at < a.at; });
    list_.updateContent();
    const auto same = std::ranges::find(takes_, before, &Take::file);
    if (same != takes_.end())
        list_.selectRow(static_cast<int>(same - takes_.begin()));
    else
        list_.deselectAllRows();
    none_.setVisible(takes_.empty());
    list_.repaint();
    showChosen();
}

void TakesTab::showChosen() {
    for (auto* button : {play_.get(), trim_.get(), export_.get(), erase_.get()})
        button->setEnabled(take() != nullptr);
    trim_->setButtonText(take() && take()->isTrimmed() ? "Whole" : "Trim");
    if (take()) trimmer_.show(take()->file, take()->seconds, take()->part);
    if (trimmer_.isVisible() == (take() != nullptr)) return;
    trimmer_.setVisible(take() != nullptr);
    resized();
}

void TakesTab::trim() {
    if (!take()) return;
    if (take()->isTrimmed())
        trimmer_.showAll();
    else
        trimmer_.trimSilence();
}

// A session that plays a part keeps the part's file, so it stays; in a folder beside the takes.
void TakesTab::play() {
    if (!take()) return;
    const double now = nowMs();
    const auto part = take()->part;
    auto file = take()->file;
    const bool plays = now < endsAtMs_, isSame = playing_ == std::pair{file, part};
    if (plays) (void)model_.session().submit({Stop{}});
    endsAtMs_ = 0.0;
    if (plays && isSame) return;
    playing_ = {file, part};
    if (take()->isTrimmed()) {
        file = partsFolder(file).getChildFile(file.getFileNameWithoutExtension() + " " +
                                              millisecondsText(part.getStart()) + " to " +
                                              millisecondsText(part.getEnd()) + " ms.wav");
        if (!file.existsAsFile() || file.getLastModificationTime() < take()->at) {
            file.getParentDirectory().createDirectory();
            if (model_.reportFault(Part{take()->file, part, file}.write())) return;
        }
    }
    model_.strikes().playTake(file);
    endsAtMs_ = now + 1e3 * part.getLength();
}

void TakesTab::askExport() {
    if (!take()) return;
    const auto home = juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    askForFile(*this, {"Copy the take to", ".wav", home, true, take()->file.getFileNameWithoutExtension()},
               [this](const juce::File& file) { exportTo(file); });
}

void TakesTab::exportTo(const juce::File& file) {
    if (!take() || file == take()->file) return;
    const auto from = take()->file;
    const auto events = eventsOf(file);
    if (events.existsAsFile() && !file.existsAsFile())
        return model_.report(events.getFullPathName() + ": is there already, without " + file.getFileName() +
                             "; expected another name");
    juce::String error;
    if (take()->isTrimmed())
        error = utf8(exportTakePart(from, take()->part, file));
    else if (!from.copyFileTo(file) || (eventsOf(from).existsAsFile() && !eventsOf(from).copyFileTo(events)))
        error = file.getFullPathName() + ": cannot be written";
    // those of the recording that was replaced
    if (error.isEmpty() && !eventsOf(from).existsAsFile() && events.existsAsFile() && !remove(events))
        error = events.getFullPathName() + ": is of another recording and cannot be deleted";
    if (error.isNotEmpty()) return model_.report(error);
    model_.messages().show(
        {"Copied to " + file.getFullPathName(), true, {"Show", [file] { file.revealToUser(); }}, savedLabel});
}

void TakesTab::askErase() {
    if (!take()) return;
    askForValues(*this, "Delete " + take()->file.getFileName() + "?", "Delete", {},
                 [this](const juce::StringArray&) { erase(); });
}

void TakesTab::erase() {
    if (!take()) return;
    const auto [file, seconds] = std::pair{take()->file, take()->seconds};
    const bool isGone = remove(file);
    if (eventsOf(file).existsAsFile()) remove(eventsOf(file));
    if (isGone)
        (void)keepPart(file, seconds, {0.0, seconds}); // what stays is of no take
    else
        model_.report(file.getFullPathName() + ": cannot be deleted");
    look();
}

juce::String TakesTab::getNameForRow(int row) {
    if (row < 0 || row >= static_cast<int>(takes_.size())) return {};
    const Take& t = nth(takes_, row);
    return t.file.getFileNameWithoutExtension() + ", " + t.length();
}

void TakesTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= static_cast<int>(takes_.size())) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) drawChosenRow(g, *this, width, height, 0.22f);
    area.reduce(10, 0);
    const Take& t = nth(takes_, row);
    ink(g, *this, Shade::muted, text::small);
    const auto cell = [&](const juce::String& words, int wide) {
        g.drawText(words, area.removeFromRight(wide), juce::Justification::centredRight, true);
    };
    cell(t.at.formatted("%Y-%m-%d %H:%M"), 120);
    if (width > 400) cell(countOf(t.channels, "channel"), 90);
    g.setColour(shade(*this, Shade::text));
    cell(t.length(), t.isTrimmed() ? 110 : 70);
    g.setFont(text::font(text::medium));
    g.drawText(t.file.getFileNameWithoutExtension(), area, juce::Justification::centredLeft, true);
}

void TakesTab::resized() {
    auto area = getLocalBounds().reduced(panelInset, 4);
    auto foot = area.removeFromBottom(takeFootPixels).withTrimmedTop(4);
    const int wide = std::min(widestButton, (foot.getWidth() - 4 * 8) / 5);
    for (auto* button : {play_.get(), trim_.get(), export_.get(), erase_.get(), show_.get()}) {
        button->setBounds(foot.removeFromLeft(wide));
        foot.removeFromLeft(8);
    }
    if (trimmer_.isVisible()) trimmer_.setBounds(area.removeFromBottom(trimPixels).withTrimmedTop(4));
    list_.setBounds(area);
    none_.setBounds(area.withHeight(rowHeight).reduced(10, 0));
}

TakeTrim::TakeTrim() {
    describe(*this, "Start and end of the take",
             "Drag the start or the end; arrows move the start, with Shift the end; double click: all of it");
    setWantsKeyboardFocus(true);
    setMouseCursor(juce::MouseCursor::LeftRightResizeCursor);
}

TakeTrim::~TakeTrim() {
    ++reading_;
    constexpr int untilItHasStopped = -1;
    reader_.removeAllJobs(true, untilItHasStopped);
    cancelPendingUpdate();
}

void TakeTrim::show(const juce::File& take, double seconds, juce::Range<double> part) {
    part_ = part;
    seconds_ = seconds;
    repaint();
    if (take == take_) return;
    take_ = take;
    levels_.clear();
    isWaiting_ = false;
    const int number = ++reading_;
    reader_.addJob([this, take, number] {
        Levels read{[&] { return number == reading_; }};
        const bool isRead = streamRecording(pathOf(take), read).empty();
        const std::lock_guard lock{mutex_};
        if (number != reading_) return;
        read_ = isRead ? std::move(read.levels) : std::vector<float>{};
        triggerAsyncUpdate();
    });
}

void TakeTrim::handleAsyncUpdate() {
    {
        const std::lock_guard lock{mutex_};
        levels_ = std::exchange(read_, {});
    }
    if (std::exchange(isWaiting_, false)) trimSilence();
    repaint();
}

void TakeTrim::trimSilence() {
    if (levels_.empty())
        isWaiting_ = true;
    else
        changeAtOnce(soundingPart(levels_, seconds_));
}

void TakeTrim::change(juce::Range<double> part) {
    part_ = part;
    repaint();
    if (onChange) onChange(part_);
}

void TakeTrim::changeAtOnce(juce::Range<double> part) {
    change(part);
    end();
}

void TakeTrim::moveTo(double seconds) {
    const double least = std::min(leastSeconds, seconds_);
    auto part = part_;
    if (movesEnd_)
        part.setEnd(
            juce::jlimit(part.getStart() + least, std::max(part.getStart() + least, seconds_), seconds));
    else
        part.setStart(juce::jlimit(0.0, std::max(0.0, part.getEnd() - least), seconds));
    change(part);
}

bool TakeTrim::keyPressed(const juce::KeyPress& key) {
    const bool isLeft = key.isKeyCode(juce::KeyPress::leftKey);
    if (!isLeft && !key.isKeyCode(juce::KeyPress::rightKey)) return false;
    movesEnd_ = key.getModifiers().isShiftDown();
    moveTo((movesEnd_ ? part_.getEnd() : part_.getStart()) + (isLeft ? -step : step));
    end();
    return true;
}

void TakeTrim::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().toFloat(), 3.0f);
    const float middle = 0.5f * static_cast<float>(getHeight()), from = pixelOf(part_.getStart()),
                to = pixelOf(part_.getEnd());
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        const float x = static_cast<float>(k) * static_cast<float>(getWidth()) / columns,
                    half = std::max(0.5f, levels_[k] * (middle - 2.0f));
        g.setColour(shade(*this, x >= from && x < to ? Shade::accent : Shade::line));
        g.fillRect(x, middle - half, static_cast<float>(getWidth()) / columns + 0.2f, 2.0f * half);
    }
    g.setColour(shade(*this, Shade::now));
    for (const float x : {from, to})
        g.fillRect(juce::jlimit(0.0f, static_cast<float>(getWidth()) - 3.0f, x - 1.5f), 0.0f, 3.0f,
                   2.0f * middle);
    g.setColour(shade(*this, Shade::text));
    if (played_ >= 0.0) g.fillRect(pixelOf(played_), 0.0f, 1.0f, 2.0f * middle);
}

juce::Range<double> soundingPart(const std::vector<float>& levels, double seconds) {
    const auto isFelt = [](float level) { return level >= leastFelt; };
    const auto first = std::ranges::find_if(levels, isFelt);
    if (first == levels.end()) return {0.0, seconds};
    const auto last = std::find_if(levels.rbegin(), levels.rend(), isFelt).base();
    const auto secondsOf = [&](auto at) {
        return seconds * static_cast<double>(at - levels.begin()) / static_cast<double>(levels.size());
    };
    return {secondsOf(first), secondsOf(last)};
}

// The length is kept as well, because a later recording may have the name of one that is gone.
juce::Range<double> keptPart(const juce::File& take, double seconds) {
    const juce::Range<double> whole{0.0, seconds};
    const auto kept = juce::JSON::parse(fileOf(take).loadFileAsString());
    const auto field = [&](const char* name) { return static_cast<double>(kept.getProperty(name, -1.0)); };
    const double from = field(fromField), to = field(toField);
    const bool isOfThisTake = std::abs(field(ofField) - seconds) <= sameLength;
    return isOfThisTake && from >= 0.0 && from < to && to <= seconds ? juce::Range{from, to} : whole;
}

} // namespace physvib
