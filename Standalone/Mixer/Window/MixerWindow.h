// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's window with its document: opens, saves, records, renders, and asks before changes are lost.
#pragma once
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Window/MixerFiles.h"
#include "Mixer/Window/MixerView.h"
#include "Mixer/Window/PageLink.h"

namespace physvib {

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
    void save(std::function<void()> then = {}); ///< `then`: once it is saved
    void saveAs(std::function<void()> then = {});
    void record();        ///< starts or ends
    void renderOffline(); ///< asks for duration and file
    void renderTo(const juce::File& file, double seconds);
    void saveMovie(); ///< of the last seconds; asks how many, and for a file
    void saveMovieTo(const juce::File& file, double seconds);
    void import(const juce::String& title); ///< a scene or a layout
    void exportLayout();
    /// Shows a link to the web page; `isElsewhere`: to one whose address is typed.
    void share(bool isElsewhere = false);
    /// Asks for a file; bodies as drawn, or at their current places. `in`: none, the folder of own scenes.
    void saveScene(bool isNow, const juce::File& in = {});
    std::string saveSceneTo(const juce::File& file, bool isNow); ///< empty, or an error
    void recordScript();               ///< records user input in the world: starts or ends
    void newScene(SceneGround ground); ///< with the field and the materials of the first start
    /// Size of everything in the window; 0: by the display's size. A percentage that leaves no room for the
    /// window is lowered.
    void setZoom(int percent);
    int zoom();            ///< %, as asked for
    void stepZoom(int by); ///< to the next larger (1) or smaller (-1) one
    /// Full screen: the world alone, and the button that silences.
    void setShow(bool isShow);
    /// Asks if changes would be lost, then quits.
    void requestQuit();

    bool isChanged() const { return model_->edits() != savedEdits_; }
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
    FirstStart& addFirstStart(std::vector<FeltChoice> choices);
    void reportInstead();
    void start(const juce::File& file);
    void play(Mix mix, const juce::File& document, bool isPaused = false,
              std::shared_ptr<MixerHistory> history = {});
    /// `isOwn`: a copy of the run that crashed is lowered to the levels at its end.
    bool load(const juce::File& file, const juce::File& document, bool isOwn = false);
    /// Plays a file with its levels lowered to `most`. Reports what was lowered; a button restores it.
    void playLowered(const DeskLimits& most, Mix mix, const juce::File& document, bool isPaused = false);
    void reportLowered(const std::string& lowered, const Mix& asked, const DeskLimits& most);
    void useAskedLevels();
    DeskLimits limits() const;
    void useSinks(const DeviceChoice& choice);
    /// The device and how it is worn: levels saved for one are not right for another.
    std::string outputInUse() const { return device_.name + (device_.isHeadphones ? " on the ears" : ""); }
    bool saveTo(const juce::File& file);
    void askThen(std::function<void()> goOn,
                 const juce::String& words = "What was changed since it was saved would be lost.");
    /// `suggested`: a file name without extension; `in`: a folder instead of the last one.
    void chooseFile(const juce::String& title, const juce::String& ending, bool isSaving,
                    std::function<void(const juce::File&)> use, const juce::String& suggested = {},
                    const juce::File& in = {});
    /// Asks in the window; each answer closes the card.
    void ask(const juce::String& title, const juce::String& words,
             std::vector<std::pair<juce::String, std::function<void()>>> answers,
             const std::vector<QuestionCard::Field>& fields = {});
    /// Asks how many seconds; `what` begins the error if they are beyond the limits.
    void askSeconds(const juce::String& title, const juce::String& words, double seconds,
                    juce::Range<double> limits, const juce::String& what, std::function<void(double)> use);
    void offerRecovery();
    void showCopy(const std::vector<std::filesystem::path>& copies, std::size_t at);
    void recover(const std::filesystem::path& copy);
    void offerMonitor();
    void keepOrder(); ///< of the panels, in the settings
    /// With the default levels, but no louder than the loudest actuator was left; on outputs that were in
    /// use, and not on the monitor's.
    Mix firstMix();
    void showMenu(juce::Component& from);
    void setTheme(Theme theme);
    void applyZoom();
    juce::PopupMenu fileMenu();
    juce::PopupMenu editMenu();
    juce::PopupMenu worldMenu();
    juce::PopupMenu viewMenu();
    void askDisplayWidth();
    void nameWindow();
    void say(const juce::String& words) { model_->report(words); }
    /// With a button that shows the file, or `act`.
    void announceSaved(const juce::String& words, const juce::File& file, MixerAct act = {});
    void serve();
    void chooseFolder();
    juce::File folderOfDocuments() const;
    juce::String documentName() const;
    double playedSeconds() const { return 1e-9 * static_cast<double>(model_->saved().lengthNs); }
    void make(const juce::File& file, const juce::String& doneWords, RenderTask::Work work);

    AudioDrivers drivers_;
    MixerFiles files_;
    juce::SharedResourcePointer<DraggedFiles> dragged_;
    juce::SharedResourcePointer<UserFolder> folder_;
    DeviceChoice device_;
    std::unique_ptr<MixerModel> model_;
    std::unique_ptr<MixerView> view_;
    juce::File document_, lastRecording_;
    std::optional<Mix> asked_;                        // state of the last file, if its levels were lowered
    std::vector<std::pair<std::size_t, Strip>> lost_; // outputs that it took from strips
    std::optional<DeskLimits> before_;                // limits before a run that crashed
    static constexpr std::uint64_t neverSaved = UINT64_MAX; // never equals a count of edits
    std::uint64_t savedEdits_ = 0;
    std::unique_ptr<RenderTask> rendering_;
    std::shared_ptr<PageServer> server_;
    juce::String served_; // its address; empty: none
};

} // namespace physvib
