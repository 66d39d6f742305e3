// SPDX-License-Identifier: GPL-3.0-or-later
// Lists folders and files, and checks a typed name.
#include "Mixer/Window/FileCard.h"
#include <algorithm>

namespace physvib {

FileCard::FileCard(const Choice& choice)
    : choice_{choice} {
    setTitle(choice.title);
    setWantsKeyboardFocus(true);
    title_.setText(choice.title, juce::dontSendNotification);
    title_.setFont(juce::Font{text::large, juce::Font::bold});
    for (auto* label : {&place_, &words_}) label->setFont(juce::Font{text::small});
    place_.setTitle("Folder");
    words_.setTitle("What is wrong");
    list_.setTitle("Files of the folder");
    list_.setRowHeight(rowHeight);
    list_.setMultipleSelectionEnabled(choice.areSeveral);
    name_.setTitle("Name of the file");
    name_.setFont(juce::Font{text::medium});
    name_.setText(choice.name, false);
    name_.setSelectAllWhenFocused(true);
    name_.setTextToShowWhenEmpty("name or path", juce::Colours::grey);
    name_.onReturnKey = [this] { take(); };
    name_.onEscapeKey = [this] { onCancel(); };
    name_.onTextChange = [this] {
        replaced_ = juce::File{};
        take_.setButtonText(takeWords());
        tell({}, Shade::text);
    };
    up_.setTitle("Parent folder");
    up_.onClick = [this] { enter(folder_.getParentDirectory()); };
    take_.setTitle(takeWords());
    take_.setButtonText(take_.getTitle());
    take_.setToggleState(true, juce::dontSendNotification); // Return presses it
    take_.onClick = [this] { take(); };
    cancel_.setTitle("Cancel");
    cancel_.onClick = [this] { onCancel(); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{&title_, &place_, &up_, &list_, &name_,
                                                                      &words_, &cancel_, &take_})
        addAndMakeVisible(c);
    prepareControls(*this);
    setSize(wide, high);
    enter(choice.folder);
}

juce::String FileCard::takeWords() const {
    return isFolder() ? "Take this folder" : choice_.isSaving ? "Save" : "Open";
}

bool FileCard::hasEnding(const juce::File& file) const {
    return !isFolder() && (file.hasFileExtension(choice_.ending) ||
                           std::ranges::any_of(choice_.endings, [&](const juce::String& ending) {
                               return file.hasFileExtension(ending);
                           }));
}

void FileCard::enter(const juce::File& folder) {
    folder_ = folder.isDirectory() ? folder : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    entries_ = folder_.findChildFiles(juce::File::findDirectories | juce::File::ignoreHiddenFiles, false);
    entries_.sort();
    auto files = folder_.findChildFiles(juce::File::findFiles | juce::File::ignoreHiddenFiles, false);
    files.sort();
    for (const auto& file : files)
        if (hasEnding(file)) entries_.add(file);
    place_.setText(folder_.getFullPathName(), juce::dontSendNotification);
    list_.deselectAllRows();
    list_.updateContent();
    list_.repaint();
    tell(!entries_.isEmpty() ? juce::String{}
         : isFolder()        ? juce::String{"No folders here"}
                             : "No folders or " + choice_.ending + " files here",
         Shade::muted);
}

void FileCard::selectedRowsChanged(int row) {
    if (juce::isPositiveAndBelow(row, entries_.size()) && !entries_[row].isDirectory())
        setName(entries_[row].getFileNameWithoutExtension());
}

void FileCard::take() {
    const int row = list_.getSelectedRow();
    if (list_.getNumSelectedRows() > 1) {
        juce::Array<juce::File> files;
        for (int k = 0; k < entries_.size(); ++k)
            if (list_.isRowSelected(k) && !entries_[k].isDirectory()) files.add(entries_[k]);
        if (files.size() > 1) return onFiles(files);
    }
    if (juce::isPositiveAndBelow(row, entries_.size()) && entries_[row].isDirectory())
        return enter(entries_[row]);
    if (name().isEmpty()) return isFolder() ? onFile(folder_) : tell("Expected a name", Shade::limit);
    const auto typed = folder_.getChildFile(name()); // or an absolute path
    if (typed.isDirectory()) return enter(typed);
    if (isFolder()) return tell(typed.getFullPathName() + ": expected a folder that is there", Shade::limit);
    const auto file = hasEnding(typed) ? typed : typed.getSiblingFile(typed.getFileName() + choice_.ending);
    if (!choice_.isSaving)
        return file.existsAsFile()
                   ? onFile(file)
                   : tell(file.getFileName() + ": expected a file that is there", Shade::limit);
    if (!file.getParentDirectory().isDirectory())
        return tell(file.getParentDirectory().getFullPathName() + ": expected a folder that is there",
                    Shade::limit);
    if (file.existsAsFile() && file != replaced_) {
        replaced_ = file;
        take_.setButtonText("Replace");
        return tell(file.getFileName() + " exists. Press again to replace it", Shade::now);
    }
    onFile(file);
}

void FileCard::tell(const juce::String& words, Shade which) {
    words_.setText(words, juce::dontSendNotification);
    wordsShade_ = which;
    takeColours();
}

void FileCard::takeColours() { words_.setColour(juce::Label::textColourId, shade(*this, wordsShade_)); }

bool FileCard::keyPressed(const juce::KeyPress& key) {
    if (key == juce::KeyPress::escapeKey) return onCancel(), true;
    if (key == juce::KeyPress::returnKey) return take(), true;
    if (key == juce::KeyPress::backspaceKey) return enter(folder_.getParentDirectory()), true;
    return false;
}

void FileCard::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= entries_.size()) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) {
        g.setColour(shade(*this, Shade::accent).withAlpha(0.22f));
        g.fillRect(area);
    }
    const auto& entry = entries_[row];
    const bool isFolder = entry.isDirectory();
    area.reduce(12, 0);
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
    g.drawText(isFolder ? juce::String{"folder"}
                        : entry.getLastModificationTime().formatted("%Y-%m-%d %H:%M"),
               area.removeFromRight(120), juce::Justification::centredRight, true);
    g.setFont(juce::Font{text::medium, isFolder ? juce::Font::bold : juce::Font::plain});
    g.setColour(shade(*this, Shade::text));
    g.drawText(entry.getFileName(), area, juce::Justification::centredLeft, true);
}

void FileCard::paint(juce::Graphics& g) { drawCard(g, *this); }

void FileCard::resized() {
    auto area = getLocalBounds().reduced(24, 20);
    title_.setBounds(area.removeFromTop(30));
    area.removeFromTop(6);
    auto row = area.removeFromTop(rowHeight);
    up_.setBounds(row.removeFromRight(70));
    place_.setBounds(row.withTrimmedRight(gap));
    row = area.removeFromBottom(rowHeight + 4);
    take_.setBounds(row.removeFromRight(120));
    row.removeFromRight(gap);
    cancel_.setBounds(row.removeFromRight(120));
    words_.setBounds(row);
    area.removeFromBottom(gap);
    name_.setBounds(area.removeFromBottom(rowHeight));
    area.removeFromBottom(gap);
    list_.setBounds(area.withTrimmedTop(8));
}

} // namespace physvib
