// SPDX-License-Identifier: GPL-3.0-or-later
// The window on the screen with its document: open, save, record, render, and what is asked before anything
// is lost.
#pragma once
#include "Mixer/Output/HitFiles.h"
#include "Mixer/Window/MixerFiles.h"
#include "Mixer/Window/MixerView.h"
#include "Mixer/Window/RenderTask.h"
#include "Scene/Drawing/BodyEdits.h"

namespace physvib {

class MixerWindow final : public juce::DocumentWindow,
                          public juce::FileDragAndDropTarget,
                          private juce::Timer {
public:
    /// `file` is opened (see openFile), or will be made when it is saved; none: a new session. A device that
    /// is named replaces the one of the settings.
    MixerWindow(AudioDeviceTypes types, const juce::String& device, const juce::File& file,
                const juce::File& folder = mixerFolder());
    ~MixerWindow() override;

    // What the menu does. M.
    void newDocument();
    void openDocument();
    void openDocument(const juce::File& file); ///< asks first if something would be lost
    /// A session is opened, a scene or layout taken over; what is neither is told.
    void openFile(const juce::File& file);
    void save();
    void saveAs();
    void record();        ///< starts or ends
    void renderOffline(); ///< asks for the length and the file
    void renderTo(const juce::File& file, double seconds);
    void saveMovie(); ///< of the last minute; asks for the file
    void saveMovieTo(const juce::File& file, double seconds);
    void import(const juce::String& title); ///< a scene or a layout
    void exportLayout();
    void saveScene(bool isNow); ///< asks for the file; as drawn, or with bodies where they are now
    std::string saveSceneTo(const juce::File& file, bool isNow); ///< empty, or what is wrong
    void recordScript();               ///< of what hands do in the world: starts or ends
    void newScene(SceneGround ground); ///< in the field, with the materials of the present one
    /// Asks if something would be lost, then quits.
    void requestQuit();

    bool isChanged() const { return desk_->edits() != savedEdits_; }
    const juce::File& document() const noexcept { return document_; }
    const juce::File& lastRecording() const noexcept { return lastRecording_; }
    Desk& desk() noexcept { return *desk_; }
    MixerView& view() noexcept { return *view_; }

    void closeButtonPressed() override { requestQuit(); }
    bool keyPressed(const juce::KeyPress& key) override;
    bool isInterestedInFileDrag(const juce::StringArray& files) override;
    void fileDragEnter(const juce::StringArray&, int, int) override { view_->setDropShown(true); }
    void fileDragExit(const juce::StringArray&) override { view_->setDropShown(false); }
    void filesDropped(const juce::StringArray& files, int, int) override;

private:
    void timerCallback() override;
    void showFirstStart();
    FirstStart& addFirstStart(std::vector<FeltChoice> choices);
    void testBeside(int outputs);
    void tellInstead();
    void start(const juce::File& file);
    void play(Mix mix, const juce::File& document);
    /// `isOwn`: what this mixer has kept itself is played as it is.
    bool load(const juce::File& file, const juce::File& document, bool isOwn = false);
    /// A file's mix, lowered to what the desk was; what was lowered is told, and can be had from the menu.
    void playLowered(Mix mix, const juce::File& document);
    void tellLowered(const std::string& lowered, const Mix& asked);
    void takeAsked();
    DeskLimits limits() const { return desk_ ? DeskLimits::of(desk_->mix()) : files_.limits(); }
    void useSinks(const DeviceChoice& choice);
    void saveTo(const juce::File& file);
    void askThen(std::function<void()> goOn);
    void chooseFile(const juce::String& title, const juce::String& pattern, bool isSaving,
                    std::function<void(const juce::File&)> use,
                    const juce::String& suggested = {}); ///< `suggested`: a name, without its ending
    void offerRecovery();
    void showCopy(const std::vector<std::filesystem::path>& copies, std::size_t at);
    void takeUp(const std::filesystem::path& copy);
    void offerMonitor();
    Mix firstMix(); ///< whose enchanters leave the monitor's outputs alone
    void showMenu(juce::Component& from);
    void setGround(Ground ground);
    void setDisplayWidth(double mm);
    void askDisplayWidth();
    void nameWindow();
    void say(const juce::String& words) { desk_->report(words); }
    void sayAlso(const juce::String& words) {
        say(desk_->trouble().isEmpty() || desk_->isNews() ? words : desk_->trouble() + "; " + words);
    }
    juce::File folderOfDocuments() const;
    juce::String documentName() const;
    void make(const juce::File& file, const juce::String& doneWords, RenderTask::Work work);

    AudioDeviceTypes types_;
    MixerFiles files_;
    juce::SharedResourcePointer<DraggedFiles> dragged_;
    DeviceChoice device_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<MixerView> view_;
    juce::File document_, lastRecording_;
    std::optional<Mix> asked_;                              // of the last file, if it was lowered
    std::optional<DeskLimits> before_;                      // the desk of a run that ended badly
    static constexpr std::uint64_t neverSaved = UINT64_MAX; // as no count of edits
    std::uint64_t savedEdits_ = 0;
    std::unique_ptr<juce::FileChooser> chooser_;
    std::unique_ptr<juce::Thread> rendering_;
};

} // namespace physvib
