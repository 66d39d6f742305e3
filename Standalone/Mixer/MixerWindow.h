// SPDX-License-Identifier: GPL-3.0-or-later
// The window on the screen with its document: open, save, record, render, and what is asked before anything is lost.
#pragma once
#include "Mixer/MixerFiles.h"
#include "Mixer/MixerView.h"

namespace physvib {

class MixerWindow final : public juce::DocumentWindow, private juce::Timer {
public:
    /// `file` is opened, or will be made when it is saved; none: a new session. A device that is named replaces the one
    /// of the settings.
    MixerWindow(AudioDeviceTypes types, const juce::String& device, const juce::File& file, const juce::File& folder = mixerFolder());
    ~MixerWindow() override;

    // What the menu does. M.
    void newDocument();
    void openDocument();
    void openDocument(const juce::File& file); ///< asks first if something would be lost
    void save();
    void saveAs();
    void record(); ///< starts or ends
    void renderOffline();
    void importLayout();
    void exportLayout();
    void importScene();
    /// Asks if something would be lost, then quits.
    void requestQuit();

    bool isChanged() const { return desk_->edits() != savedEdits_; }
    const juce::File& document() const noexcept { return document_; }
    const juce::File& lastRecording() const noexcept { return lastRecording_; }
    Desk& desk() noexcept { return *desk_; }
    MixerView& view() noexcept { return *view_; }

    void closeButtonPressed() override { requestQuit(); }
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void timerCallback() override;
    void play(Mix mix, const juce::File& document);
    bool load(const juce::File& file, const juce::File& document);
    void useBoard(const DeviceChoice& choice);
    void saveTo(const juce::File& file);
    void askThen(std::function<void()> goOn);
    void chooseFile(const juce::String& title, const juce::String& pattern, bool isSaving, std::function<void(const juce::File&)> use);
    void offerRecovery();
    void showMenu(juce::Component& from);
    void setGround(Ground ground);
    void nameWindow();
    void say(const juce::String& words) { desk_->report(words); }
    juce::File folderOfDocuments() const;

    AudioDeviceTypes types_;
    MixerFiles files_;
    DeviceChoice device_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<MixerView> view_;
    juce::File document_, lastRecording_;
    std::uint64_t savedEdits_ = 0;
    std::unique_ptr<juce::FileChooser> chooser_;
    std::unique_ptr<juce::Thread> rendering_;
};

} // namespace physvib
