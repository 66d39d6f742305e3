// SPDX-License-Identifier: GPL-3.0-or-later
// Opens and saves sessions, scenes and layouts; records and renders; asks before unsaved changes are lost.
#include "Calls/SessionMovie.h"
#include "Io/Disk/AtomicFile.h"
#include "Live/Recordings/Recording.h"
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/Window/Parts.h"
#include "Scene/FileKind.h"
#include "Scene/SceneFile.h"

namespace physvib {
namespace {

constexpr const char* sessionEnding = ".json";
constexpr double leastMovieSeconds = 1.0, usualMovieSeconds = 60.0;
constexpr double longestRender = 86'400.0; // the limit of `physvib render`

// without thousands separators
QuestionCard::Field secondsField(double seconds) {
    return {"Seconds", juce::String{std::ceil(10.0 * seconds) / 10.0, 1}, "0123456789."};
}

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
        // the copy may lack the last seconds; who has used this run has set other levels since
        const bool isAsLeft = isOwn && before_ && !isChanged();
        playLowered(isAsLeft ? *before_ : limits(), mixOf(session.value), document,
                    endsPaused(session.value));
        return true;
    }
    if (!desk_) play(firstMix(), {});
    say(utf8(session.error));
    return false;
}

void MixerWindow::playLowered(const DeskLimits& most, Mix mix, const juce::File& document, bool isPaused) {
    const Mix asked = mix;
    const auto lowered = lowerTo(most, mix);
    play(std::move(mix), document, isPaused);
    tellLowered(lowered, asked);
}

void MixerWindow::tellLowered(const std::string& lowered, const Mix& asked) {
    asked_ = lowered.empty() ? std::nullopt : std::optional{asked};
    if (asked_)
        desk_->messages().add({"Lowered to this desk: " + utf8(lowered),
                               false,
                               {"Levels of the file", [this] { takeAsked(); }},
                               "levels"});
}

// The user may set levels that a file may not.
void MixerWindow::takeAsked() {
    if (!asked_) return;
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
    if (mix) return playLowered(limits(), mix.value, {});
    play(firstMix(), {});
    say(utf8(mix.error));
}

juce::String MixerWindow::documentName() const {
    return document_ == juce::File{} ? juce::String{"session"} : document_.getFileNameWithoutExtension();
}

juce::File MixerWindow::folderOfDocuments() const {
    if (document_ != juce::File{}) return document_.getParentDirectory();
    const auto folder = folder_->make();
    return folder ? folder.value : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
}

void MixerWindow::tellSaved(const juce::String& words, const juce::File& file) {
    DeskMessage message{
        words + " " + file.getFullPathName(), true, {"Show", [file] { file.revealToUser(); }}, "saved"};
    desk_->isNews() ? desk_->messages().show(std::move(message)) : desk_->messages().add(std::move(message));
}

void MixerWindow::chooseFile(const juce::String& title, const juce::String& ending, bool isSaving,
                             std::function<void(const juce::File&)> use, const juce::String& suggested,
                             const juce::File& in) {
    const auto setting = "folder" + ending; // the last one, of each kind of file
    const juce::File last{files_.settings().getValue(setting)};
    const auto folder = in != juce::File{} ? in : last.isDirectory() ? last : folderOfDocuments();
    const auto name =
        suggested.isEmpty()
            ? juce::String{}
            : folder.getNonexistentChildFile(suggested, ending, false).getFileNameWithoutExtension();
    auto card = std::make_unique<FileCard>(FileCard::Choice{title, ending, folder, isSaving, name});
    // asynchronous, because its button's click is still being handled
    const auto close = [this](std::function<void()> then) {
        juce::MessageManager::callAsync(
            [safe = juce::Component::SafePointer<MixerWindow>{this}, then = std::move(then)] {
                if (safe == nullptr) return;
                safe->view_->setCard(nullptr);
                then();
            });
    };
    card->onCancel = [close] { close([] {}); };
    card->onFile = [this, setting, use = std::move(use), close](const juce::File& file) {
        files_.settings().setValue(setting, file.getParentDirectory().getFullPathName());
        close([use, file] { use(file); });
    };
    view_->setCard(std::move(card));
}

void MixerWindow::ask(const juce::String& title, const juce::String& words,
                      std::vector<std::pair<juce::String, std::function<void()>>> answers,
                      const std::vector<QuestionCard::Field>& fields) {
    std::vector<QuestionCard::Answer> all;
    for (auto& [answer, act] : answers) all.push_back({answer, std::move(act)});
    all.push_back(
        {"Cancel", [this] { view_->setCard(nullptr); }, true, juce::KeyPress{juce::KeyPress::escapeKey}});
    view_->setQuestion(std::make_unique<QuestionCard>(title, words, std::move(all), fields));
}

juce::String MixerWindow::takeAnswer(const juce::String& field) {
    const auto value = view_->question() ? view_->question()->value(field) : juce::String{};
    view_->setCard(nullptr);
    return value;
}

void MixerWindow::askThen(std::function<void()> goOn) {
    if (!isChanged()) return goOn();
    ask("Save the session?", "What was changed since it was saved would be lost.",
        {{"Save",
          [this, goOn] {
              view_->setCard(nullptr);
              save(goOn);
          }},
         {"Do not save", [this, goOn] {
              view_->setCard(nullptr);
              goOn();
          }}});
}

void MixerWindow::newDocument() {
    askThen([this] {
        files_.copies().forget();
        play(firstMix(), {});
    });
}

void MixerWindow::openDocument() {
    chooseFile("Open a session, a scene or a layout", sessionEnding, false,
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

void MixerWindow::save(std::function<void()> then) {
    if (document_ == juce::File{}) return saveAs(std::move(then));
    if (saveTo(document_) && then) then();
}

void MixerWindow::saveAs(std::function<void()> then) {
    chooseFile(
        "Save the session", sessionEnding, true,
        [this, then = std::move(then)](const juce::File& file) {
            if (!saveTo(file)) return;
            if (then) then(); // which may open another session
            tellSaved("Saved", file);
        },
        documentName());
}

bool MixerWindow::saveTo(const juce::File& file) {
    const auto edits = desk_->edits();
    if (const auto error = writeFile(
            pathOf(file), sessionJson(desk_->saved(), std::filesystem::path{pathOf(file)}.parent_path()));
        !error.empty())
        return say(utf8(error)), false;
    document_ = file;
    savedEdits_ = edits;
    files_.copies().forget();
    files_.addRecent(file);
    nameWindow();
    return true;
}

void MixerWindow::record() {
    if (desk_->recording().isRunning()) return desk_->recording().stop();
    const auto file = folder_->fresh(documentName() + "-take", {".wav", ".csv"});
    const auto error = file ? desk_->recording().start(file.value) : file.error;
    view_->topBar().setRecording(error.empty());
    if (!error.empty()) say(utf8(error));
}

double MixerWindow::playedSeconds() const { return 1e-9 * static_cast<double>(desk_->saved().lengthNs); }

void MixerWindow::renderOffline() {
    const double played = playedSeconds();
    ask("Render the session",
        "It was played for " + number(played, 1) + " s. Beyond that its last scene goes on by itself.",
        {{"Choose a file" + dots(),
          [this] {
              const double seconds = takeAnswer("Seconds").getDoubleValue();
              if (!(seconds >= 0.1 && seconds <= longestRender))
                  return say("Seconds to render: expected 0.1 to " + number(longestRender, 0));
              chooseFile(
                  "Render the session to", ".wav", true,
                  [this, seconds](const juce::File& file) { renderTo(file, seconds); }, documentName());
          }}},
        {secondsField(played)});
}

void MixerWindow::make(const juce::File& file, const juce::String& doneWords, RenderTask::Work work) {
    if (rendering_) return say(rendering_->file().getFileName() + " is being made: one file at a time");
    rendering_ = std::make_unique<RenderTask>(
        file, std::move(work), [this, file, doneWords](const std::string& error, bool isCancelled) {
            rendering_.reset();
            if (isCancelled)
                desk_->tell("Cancelled; nothing was written");
            else if (!error.empty())
                say(utf8(error));
            else
                tellSaved(doneWords, file);
        });
    view_->setProgress(rendering_.get());
}

void MixerWindow::renderTo(const juce::File& file, double seconds) {
    const int rateHz = std::max(8000, desk_->output().sampleRateHz());
    make(file, "Rendered",
         [session = desk_->saved(), seconds, rateHz, path = pathOf(file)](const auto& progress) {
             return renderSessionWav(session, {rateHz, seconds, progress}, path, "physvib " PHYSVIB_VERSION);
         });
}

void MixerWindow::saveMovie() {
    const double played = playedSeconds();
    if (played < leastMovieSeconds) return say("Save movie: expected a session of at least a second");
    ask("Save a movie",
        "It was played for " + number(played, 1) + " s. The movie has the last seconds of that.",
        {{"Choose a file" + dots(),
          [this] {
              const double seconds = takeAnswer("Seconds").getDoubleValue();
              if (!(seconds >= leastMovieSeconds && seconds <= longestMovieSeconds))
                  return say("Seconds of the movie: expected " + number(leastMovieSeconds, 0) + " to " +
                             number(longestMovieSeconds, 0));
              chooseFile(
                  "Save the movie", utf8(movieEnding()), true,
                  [this, seconds](const juce::File& file) { saveMovieTo(file, seconds); },
                  documentName() + "-movie");
          }}},
        {secondsField(std::min(usualMovieSeconds, played))});
}

void MixerWindow::saveMovieTo(const juce::File& file, double seconds) {
    make(file,
         file.hasFileExtension("mp4") ? "Saved the movie"
                                      : "Saved the movie without sound, which needs the program ffmpeg:",
         [session = desk_->saved(), layout = desk_->mix().layout, seconds, path = pathOf(file)](
             const auto& progress) { return writeSessionMovie(session, layout, seconds, path, progress); });
}

void MixerWindow::exportLayout() {
    chooseFile(
        "Save the layout to", sessionEnding, true,
        [this](const juce::File& file) {
            if (const auto error = writeFile(pathOf(file), layoutJson(desk_->mix().layout)); !error.empty())
                return say(utf8(error));
            tellSaved("Saved the layout", file);
        },
        "layout");
}

void MixerWindow::import(const juce::String& title) {
    chooseFile(title, sessionEnding, false, [this](const juce::File& file) { openFile(file); });
}

} // namespace physvib
