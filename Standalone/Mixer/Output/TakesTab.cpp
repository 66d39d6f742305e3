// SPDX-License-Identifier: GPL-3.0-or-later
// Lists, plays, copies and removes recordings.
#include "Mixer/Output/TakesTab.h"
#include "Mixer/Output/KeptPart.h"
#include "Mixer/Output/TakePart.h"
#include "Mixer/Window/CardHost.h"
#include <algorithm>
#include <juce_audio_formats/juce_audio_formats.h>

namespace physvib {
namespace {

constexpr int takeRowPixels = 24, takeFootPixels = 32, trimPixels = 44, widestButton = 76;
constexpr double takeLookMs = 1000.0;

juce::File eventsOf(const juce::File& wav) { return wav.withFileExtension("csv"); }

juce::String lengthText(double seconds) {
    return seconds < 60.0 ? number(seconds, 1) + " s"
                          : juce::String{static_cast<int>(seconds) / 60} + ":" +
                                juce::String{static_cast<int>(seconds) % 60}.paddedLeft('0', 2);
}

} // namespace

juce::String TakesTab::Take::length() const {
    const auto all = lengthText(seconds);
    return isTrimmed() ? lengthText(part.getLength()) + " of " + all : all;
}

TakesTab::TakesTab(Desk& desk)
    : desk_{desk} {
    setTitle("Takes");
    list_.setTitle("List of takes");
    list_.setRowHeight(takeRowPixels);
    caption(none_, "No recordings yet: Record, or Ctrl+R, makes one");
    const auto button = [this](auto& made, const char* words, const char* name, void (TakesTab::*act)()) {
        made = quietButton(words, name);
        made->onClick = [this, act] { (this->*act)(); };
        addAndMakeVisible(*made);
    };
    button(play_, "Play", "Play the take on the device", &TakesTab::play);
    button(trim_, "Trim", "Trim the take", &TakesTab::trim);
    button(export_, "Export", "Copy the take elsewhere", &TakesTab::askExport);
    button(erase_, "Delete", "Delete the take", &TakesTab::askErase);
    show_ = quietButton("Show", "Show the folder of the takes");
    show_->onClick = [this] { folder_->place().revealToUser(); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{show_.get(), &list_})
        addAndMakeVisible(c);
    addChildComponent(none_);
    addChildComponent(trimmer_);
    trimmer_.onChange = [this](juce::Range<double> part) {
        if (!take()) return;
        take()->part = part;
        showChosen();
        list_.repaint();
    };
    trimmer_.onEnd = [this] {
        if (!take()) return;
        if (const auto error = keepPart(take()->file, take()->seconds, take()->part); !error.empty())
            desk_.report(utf8(error));
    };
    showChosen();
}

TakesTab::Take* TakesTab::take() {
    const int row = list_.getSelectedRow();
    return row >= 0 && row < static_cast<int>(takes_.size()) ? &takes_[static_cast<std::size_t>(row)]
                                                             : nullptr;
}

// A recording may have ended, or another program changed the folder.
void TakesTab::refresh(const DeskMoment&) {
    if (const double now = nowMs(); now - lookedAtMs_ < takeLookMs)
        return;
    else
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
    if (!take()->isTrimmed()) return desk_.strikes().playTake(take()->file);
    const auto part = take()->part;
    const auto file = partsFolder(take()->file)
                          .getChildFile(take()->file.getFileNameWithoutExtension() + " " +
                                        number(1e3 * part.getStart(), 0) + " to " +
                                        number(1e3 * part.getEnd(), 0) + " ms.wav");
    if (!file.existsAsFile() || file.getLastModificationTime() < take()->at) {
        file.getParentDirectory().createDirectory();
        if (const auto error = writeTakePart(take()->file, part, file); !error.empty())
            return desk_.report(utf8(error));
    }
    desk_.strikes().playTake(file);
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
    juce::String error;
    if (take()->isTrimmed())
        error = utf8(writeTakePart(from, take()->part, file));
    else if (!from.copyFileTo(file) ||
             (eventsOf(from).existsAsFile() && !eventsOf(from).copyFileTo(eventsOf(file))))
        error = file.getFullPathName() + ": cannot be written";
    if (error.isNotEmpty()) return desk_.report(error);
    desk_.messages().show(
        {"Copied to " + file.getFullPathName(), true, {"Show", [file] { file.revealToUser(); }}, "saved"});
}

void TakesTab::askErase() {
    if (!take()) return;
    askForValues(*this, "Delete " + take()->file.getFileName() + "?", "Delete", {},
                 [this](const juce::StringArray&) { erase(); });
}

void TakesTab::erase() {
    if (!take()) return;
    const auto [file, seconds] = std::pair{take()->file, take()->seconds};
    const auto remove = [](const juce::File& f) { return f.moveToTrash() || f.deleteFile(); }; // some have no
                                                                                               // bin
    const bool isGone = remove(file);
    if (eventsOf(file).existsAsFile()) remove(eventsOf(file));
    if (isGone)
        (void)keepPart(file, seconds, {0.0, seconds}); // what stays is of no take
    else
        desk_.report(file.getFullPathName() + ": cannot be deleted");
    look();
}

juce::String TakesTab::getNameForRow(int row) {
    if (row < 0 || row >= static_cast<int>(takes_.size())) return {};
    const Take& t = takes_[static_cast<std::size_t>(row)];
    return t.file.getFileNameWithoutExtension() + ", " + t.length();
}

void TakesTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= static_cast<int>(takes_.size())) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) {
        g.setColour(shade(*this, Shade::accent).withAlpha(0.22f));
        g.fillRect(area);
    }
    area.reduce(10, 0);
    const Take& t = takes_[static_cast<std::size_t>(row)];
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
    const auto cell = [&](const juce::String& words, int wide) {
        g.drawText(words, area.removeFromRight(wide), juce::Justification::centredRight, true);
    };
    cell(t.at.formatted("%Y-%m-%d %H:%M"), 120);
    cell(juce::String{t.channels} + (t.channels == 1 ? " channel" : " channels"), 90);
    g.setColour(shade(*this, Shade::text));
    cell(t.length(), t.isTrimmed() ? 110 : 70);
    g.setFont(juce::Font{text::medium});
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

} // namespace physvib
