// SPDX-License-Identifier: GPL-3.0-or-later
// Opens and saves sessions, scenes and layouts; records and renders; asks before unsaved changes are lost.
#include "Calls/SessionMovie.h"
#include "Io/Disk/AtomicFile.h"
#include "Live/Recordings/SessionWav.h"
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/Window/Parts.h"
#include "Scene/FileKind.h"
#include "Scene/SceneFile.h"

namespace physvib {
namespace {

constexpr const char* sessionPattern = "*.json";
constexpr double movieSeconds = 60.0;
constexpr double longestRender = 86'400.0; // the limit of `physvib render`

std::string pathOf(const juce::File& file) { return file.getFullPathName().toStdString(); }

/// Copy of `mix` with the scene or the layout of the file.
Result<Mix> mixWith(Mix mix, const juce::File& file) {
    const FileKind kind = fileKind(pathOf(file));
    if (kind == FileKind::scene) {
        const auto scene = loadScene(pathOf(file));
        if (!scene) return Failure{scene.error};
        mix.scene = std::make_shared<const Scene>(scene.value);
    } else if (kind == FileKind::layout) {
        const auto layout = loadLayout(pathOf(file));
        if (!layout) return Failure{layout.error};
        mix.layout = layout.value;
        mix.resizeStrips();
    } else
        return Failure{pathOf(file) + ": expected a session, a scene or a layout"};
    return mix;
}

} // namespace

bool MixerWindow::load(const juce::File& file, const juce::File& document, bool isOwn) {
    auto session = loadSession(pathOf(file));
    if (session) {
        Mix mix = mixOf(session.value);
        if (!isOwn) return playLowered(std::move(mix), document), true;
        if (before_) lowerTo(*before_, mix); // the copy may lack the last seconds
        return play(std::move(mix), document), true;
    }
    if (!desk_) play(firstMix(), {});
    say(utf8(session.error));
    return false;
}

void MixerWindow::playLowered(Mix mix, const juce::File& document) {
    const Mix asked = mix;
    const auto lowered = lowerTo(limits(), mix);
    play(std::move(mix), document);
    tellLowered(lowered, asked);
}

void MixerWindow::tellLowered(const std::string& lowered, const Mix& asked) {
    asked_ = lowered.empty() ? std::nullopt : std::optional{asked};
    if (asked_) say("Lowered to this desk: " + utf8(lowered) + ". The menu has the file's own levels");
}

// The user may set levels that a file may not.
void MixerWindow::takeAsked() {
    desk_->change("Levels of the file", [this](Mix& mix) {
        mix.levelDb = asked_->levelDb;
        if (asked_->count() == mix.count()) mix.strips = asked_->strips;
    });
    asked_.reset();
}

// A file on the command line is not an edit, so there is nothing to save yet.
void MixerWindow::start(const juce::File& file) {
    if (!file.existsAsFile()) return play(firstMix(), file);
    if (fileKind(pathOf(file)) == FileKind::session) return void(load(file, file));
    const auto mix = mixWith(firstMix(), file);
    if (mix) return playLowered(mix.value, {});
    play(firstMix(), {});
    say(utf8(mix.error));
}

juce::String MixerWindow::documentName() const {
    return document_ == juce::File{} ? juce::String{"session"} : document_.getFileNameWithoutExtension();
}

juce::File MixerWindow::folderOfDocuments() const {
    return document_ != juce::File{} ? document_.getParentDirectory()
                                     : juce::File::getCurrentWorkingDirectory();
}

void MixerWindow::chooseFile(const juce::String& title, const juce::String& pattern, bool isSaving,
                             std::function<void(const juce::File&)> use, const juce::String& suggested) {
    using B = juce::FileBrowserComponent;
    const auto folder = folderOfDocuments();
    const auto first =
        suggested.isEmpty() ? folder : folder.getNonexistentChildFile(suggested, pattern.substring(1), false);
    chooser_ = std::make_unique<juce::FileChooser>(title, first, pattern, false);
    chooser_->launchAsync((isSaving ? B::saveMode | B::warnAboutOverwriting : B::openMode) |
                              B::canSelectFiles,
                          [use = std::move(use)](const juce::FileChooser& c) {
                              if (c.getResult() != juce::File{}) use(c.getResult());
                          });
}

void MixerWindow::askThen(std::function<void()> goOn) {
    if (!isChanged()) return goOn();
    juce::AlertWindow::showYesNoCancelBox(
        juce::MessageBoxIconType::QuestionIcon, "Save the session?",
        "What was changed since it was saved would be lost.", "Save", "Do not save", "Cancel", view_.get(),
        juce::ModalCallbackFunction::create([this, goOn = std::move(goOn)](int answer) {
            if (answer == 0) return;
            if (answer == 1) save();
            if (answer == 2 || !isChanged()) goOn();
        }));
}

void MixerWindow::newDocument() {
    askThen([this] {
        files_.copies().forget();
        play(firstMix(), {});
    });
}

void MixerWindow::openDocument() {
    chooseFile("Open a session, a scene or a layout", sessionPattern, false,
               [this](const juce::File& file) { openFile(file); });
}

void MixerWindow::openDocument(const juce::File& file) {
    askThen([this, file] {
        if (!load(file, file)) return;
        files_.copies().forget();
        files_.addRecent(file);
    });
}

void MixerWindow::openFile(const juce::File& file) {
    if (fileKind(pathOf(file)) == FileKind::session) return openDocument(file);
    auto mix = mixWith(desk_->mix(), file);
    if (!mix) return say(utf8(mix.error));
    const Mix asked = mix.value;
    const auto lowered = lowerTo(limits(), mix.value);
    desk_->edit(file.getFileName(), mix.value);
    tellLowered(lowered, asked);
}

void MixerWindow::save() {
    if (document_ == juce::File{})
        saveAs();
    else
        saveTo(document_);
}

void MixerWindow::saveAs() {
    chooseFile(
        "Save the session", sessionPattern, true,
        [this](const juce::File& file) { saveTo(file.withFileExtension("json")); }, documentName());
}

void MixerWindow::saveTo(const juce::File& file) {
    const auto edits = desk_->edits();
    if (const auto error = writeFile(
            pathOf(file), sessionJson(desk_->saved(), std::filesystem::path{pathOf(file)}.parent_path()));
        !error.empty())
        return say(utf8(error));
    document_ = file;
    savedEdits_ = edits;
    files_.copies().forget();
    files_.addRecent(file);
    nameWindow();
}

void MixerWindow::record() {
    if (desk_->recording().isRunning()) return desk_->recording().stop();
    const auto file = folderOfDocuments().getNonexistentChildFile(documentName() + "-take", ".wav", false);
    const auto error = desk_->recording().start(file);
    view_->topBar().setRecording(error.empty());
    if (!error.empty()) say(utf8(error));
}

void MixerWindow::renderOffline() {
    const double played = 1e-9 * static_cast<double>(desk_->saved().lengthNs);
    auto* window = new juce::AlertWindow{"Render the session",
                                         "It was played for " + number(played, 1) +
                                             " s. Beyond that its last scene goes on by itself.",
                                         juce::MessageBoxIconType::NoIcon, view_.get()};
    // without thousands separators
    window->addTextEditor("seconds", juce::String{std::ceil(10.0 * played) / 10.0, 1}, "Seconds");
    window->getTextEditor("seconds")->setInputRestrictions(8, "0123456789.");
    window->addButton("Choose a file" + dots(), 1, juce::KeyPress{juce::KeyPress::returnKey});
    window->addButton("Cancel", 0, juce::KeyPress{juce::KeyPress::escapeKey});
    window->enterModalState(
        true, juce::ModalCallbackFunction::create([this, window](int answer) {
            const double seconds = window->getTextEditorContents("seconds").getDoubleValue();
            if (answer == 0) return;
            if (!(seconds >= 0.1 && seconds <= longestRender))
                return say("Seconds to render: expected 0.1 to " + number(longestRender, 0));
            chooseFile(
                "Render the session to", "*.wav", true,
                [this, seconds](const juce::File& file) { renderTo(file.withFileExtension("wav"), seconds); },
                documentName());
        }),
        true);
}

void MixerWindow::make(const juce::File& file, const juce::String& doneWords, RenderTask::Work work) {
    rendering_ = std::make_unique<RenderTask>(
        file, doneWords, std::move(work),
        [this](const juce::String& words, bool isGood) { isGood ? desk_->tell(words) : say(words); }, *view_);
}

void MixerWindow::renderTo(const juce::File& file, double seconds) {
    const int rateHz = std::max(8000, desk_->output().sampleRateHz());
    make(file, "Rendered",
         [session = desk_->saved(), seconds, rateHz, path = pathOf(file)](const auto& progress) {
             return renderSessionWav(session, {rateHz, seconds, progress}, path, "physvib " PHYSVIB_VERSION);
         });
}

void MixerWindow::saveMovie() {
    if (desk_->saved().lengthNs < 1'000'000'000)
        return say("Save movie: expected a session of at least a second");
    chooseFile(
        "Save the last minute as a movie", "*.webp", true,
        [this](const juce::File& file) { saveMovieTo(file.withFileExtension("webp"), movieSeconds); },
        documentName() + "-movie");
}

void MixerWindow::saveMovieTo(const juce::File& file, double seconds) {
    make(file, "Saved the movie",
         [session = desk_->saved(), layout = desk_->mix().layout, seconds, path = pathOf(file)](
             const auto& progress) { return writeSessionMovie(session, layout, seconds, path, progress); });
}

void MixerWindow::exportLayout() {
    chooseFile(
        "Save the layout to", sessionPattern, true,
        [this](const juce::File& file) {
            if (const auto error =
                    writeFile(pathOf(file.withFileExtension("json")), layoutJson(desk_->mix().layout));
                !error.empty())
                say(utf8(error));
        },
        "layout");
}

void MixerWindow::import(const juce::String& title) {
    chooseFile(title, sessionPattern, false, [this](const juce::File& file) { openFile(file); });
}

} // namespace physvib
