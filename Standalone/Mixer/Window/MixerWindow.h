// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's window with its document: opens, saves, records, renders, shares, recovers lost sessions, and
// asks before changes are lost.
#pragma once
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Window/MixerFiles.h"
#include "Mixer/Window/MixerView.h"
#include "Mixer/Window/PageLink.h"

namespace physvib {

/// The window, which owns model and view of the open session. Message thread.
class MixerWindow final : public juce::DocumentWindow,
                          public juce::FileDragAndDropTarget,
                          private juce::Timer {
public:
    /// `file` is opened (see openFile), or created when saving; none: a new session. `device` overrides the
    /// device of the settings.
    MixerWindow(AudioDrivers drivers, const juce::String& device, const juce::File& file,
                const juce::File& folder = mixerFolder());
    ~MixerWindow() override;

    // Menu commands. Message thread.
    void newDocument();
    void openDocument();
    void openDocument(const juce::File& file); ///< asks first if changes would be lost
    /// Opens a session, or applies a scene or layout; reports any other file.
    void openFile(const juce::File& file);
    void save(std::function<void()> onSaved = {}); ///< `onSaved` is called once it is saved
    void saveAs(std::function<void()> onSaved = {});
    void record();        ///< starts or ends a recording
    void renderOffline(); ///< asks for duration and file
    void renderTo(const juce::File& file, double seconds);
    void saveMovie(); ///< of the last seconds; asks for their number and a file
    void saveMovieTo(const juce::File& file, double seconds);
    void askToOpen(const juce::String& title); ///< asks for a scene or a layout and opens it
    void exportLayout();
    /// Shows a link to the web page; `asksAddress`: the user types the address of the page.
    void share(bool asksAddress = false);
    /// Saves bodies as drawn or now, to a file asked for in `parent`; none: the folder of own scenes.
    void saveScene(bool hasCurrentPoses, const juce::File& parent = {});
    std::string saveSceneTo(const juce::File& file, bool hasCurrentPoses); ///< empty, or an error
    void recordScript();               ///< records user input in the world: starts or ends
    void newScene(SceneGround ground); ///< with the field and the materials of the first start
    /// Size of everything in the window; 0: by the display's size. A percentage that leaves no room for the
    /// window is lowered.
    void setZoom(int percent);
    int zoom();                        ///< %, as chosen; 0: by the display's size
    void stepZoom(int steps);          ///< to the next larger (1) or smaller (-1) one
    void setShowMode(bool isShowMode); ///< full screen: the world alone, and the button that silences
    void requestQuit();                ///< asks if changes would be lost, then quits

    bool hasUnsavedChanges() const { return model_->editCount() != savedEditCount_; }
    const juce::File& document() const noexcept { return document_; }
    const juce::File& lastRecording() const noexcept { return lastRecording_; }
    MixerModel& model() noexcept { return *model_; }
    MixerView& view() noexcept { return *view_; }

    void closeButtonPressed() override { requestQuit(); }
    bool keyPressed(const juce::KeyPress& key) override;
    bool isInterestedInFileDrag(const juce::StringArray& files) override;
    void fileDragEnter(const juce::StringArray&, int, int) override { view_->setDropShown(true); }
    void fileDragExit(const juce::StringArray&) override { view_->setDropShown(false); }
    void filesDropped(const juce::StringArray& files, int, int) override;

private:
    void timerCallback() override;
    FirstStart& addFirstStart(std::vector<PlaybackChoice> choices);
    void suggestOtherDevice();
    void start(const juce::File& file);
    void beginSession(Mix mix, const juce::File& document, bool isPaused = false,
                      std::shared_ptr<MixerHistory> history = {});
    /// `isCrashCopy`: the file is a copy of the run that crashed, and is limited to the levels at its end.
    bool load(const juce::File& file, const juce::File& document, bool isCrashCopy = false);
    /// Plays a file with its levels lowered to `maxLevels`. Reports what was lowered; a button restores it.
    void playLowered(const MixerLimits& maxLevels, Mix mix, const juce::File& document,
                     bool isPaused = false);
    void reportLowered(const std::string& loweredText, const Mix& fileMix, const MixerLimits& maxLevels);
    void applyRequestedLevels();
    MixerLimits limits() const;
    void setSinks(const DeviceChoice& choice);
    /// The device and how it is worn. Levels that were saved for one output do not suit another.
    std::string outputInUse() const { return device_.name + (device_.isHeadphones ? " on the ears" : ""); }
    bool saveTo(const juce::File& file);
    void offerSaveThen(std::function<void()> proceed,
                       const juce::String& text = "What was changed since it was saved would be lost.");
    /// `suggestedName`: a file name without extension; `parent`: a folder instead of the last one.
    void chooseFile(const juce::String& title, const juce::String& ending, bool isSaving,
                    std::function<void(const juce::File&)> onAccept, const juce::String& suggestedName = {},
                    const juce::File& parent = {});
    /// Asks in the window; each answer closes the card.
    void ask(const juce::String& title, const juce::String& message,
             std::vector<std::pair<juce::String, std::function<void()>>> answers,
             const std::vector<QuestionCard::Field>& fields = {});
    /// Asks for a duration in s; `quantity` begins the error message if it is beyond the limits.
    void askSeconds(const juce::String& title, const juce::String& text, double seconds,
                    juce::Range<double> limits, const juce::String& quantity,
                    std::function<void(double)> onAccept);
    void offerRecovery();
    void showCopy(const std::vector<std::filesystem::path>& copies, std::size_t index);
    void recover(const std::filesystem::path& copy);
    void offerMonitor();
    void savePanelLayout(); ///< to the settings
    /// The default state, no louder than the loudest actuator of the last session, on the outputs that it
    /// used, except those of the monitor.
    Mix defaultMix();
    void showMenu(juce::Component& anchor);
    void setTheme(Theme theme);
    void applyZoom();
    juce::PopupMenu fileMenu();
    juce::PopupMenu editMenu();
    juce::PopupMenu worldMenu();
    juce::PopupMenu viewMenu();
    void askDisplayWidth();
    void updateTitle();
    void showError(const juce::String& error) { model_->report(error); }
    /// Announces a written file, with a button that shows it, or with `action`.
    void announceSaved(const juce::String& text, const juce::File& file, MessageAction action = {});
    void startPageServer();
    void chooseFolder();
    juce::File folderOfDocuments() const;
    juce::String documentName() const;
    double playedSeconds() const { return 1e-9 * static_cast<double>(model_->savedSession().lengthNs); }
    void startRender(const juce::File& file, const juce::String& doneWords, RenderTask::Work work);

    AudioDrivers drivers_;
    MixerFiles files_;
    juce::SharedResourcePointer<DraggedFiles> dragged_;
    juce::SharedResourcePointer<UserFolder> folder_;
    DeviceChoice device_;
    std::unique_ptr<MixerModel> model_;
    std::unique_ptr<MixerView> view_;
    juce::File document_, lastRecording_;
    std::optional<Mix> requestedMix_; // state of the last file, if its levels were lowered
    std::vector<std::pair<std::size_t, Strip>> lostOutputs_; // by strip: its state before it lost its output
    std::optional<MixerLimits> limitsBeforeCrash_;           // limits before a run that crashed
    static constexpr std::uint64_t neverSaved = UINT64_MAX;  // never equals a count of edits
    std::uint64_t savedEditCount_ = 0;
    std::unique_ptr<RenderTask> renderTask_;
    std::shared_ptr<PageServer> server_;
    juce::String servedAddress_; // of the served page; empty: none
};

} // namespace physvib
