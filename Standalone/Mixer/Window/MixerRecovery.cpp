// SPDX-License-Identifier: GPL-3.0-or-later
// Offers recovery copies of earlier runs one by one, to be opened or discarded.
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr std::size_t mostOffered = 20; // as many as a user may look through; each is read when it is shown

juce::String nameOf(const std::filesystem::path& copy) { return utf8(copy.filename().string()); }

/// Time and contents of a copy, or why it cannot be read.
juce::String describe(const std::filesystem::path& copy, const Result<SavedSession>& session) {
    const auto time =
        juce::File{utf8(copy.string())}.getLastModificationTime().toString(true, true, true, true);
    if (!session) return "Of " + time + ": " + utf8(session.error).replace(utf8(copy.string()), nameOf(copy));
    const Mix mix = mixOf(session.value);
    return "Kept at " + time + ": " + titleOf(mix.scene->name) + " on " + juce::String{mix.count()} +
           " actuators, played for " + number(1e-9 * static_cast<double>(session.value.lengthNs), 1) + " s.";
}

} // namespace

// Shows the newest readable copy, with a line on the first unreadable one.
void MixerWindow::offerRecovery() {
    const auto copies = files_.copies().leftBehind();
    const std::size_t most = std::min(copies.size(), mostOffered);
    std::size_t shown = 0;
    for (; shown < most; ++shown) {
        const auto session = RecoveryCopies::read(copies[shown]);
        if (session) break;
        if (shown == 0) desk_->messages().add({utf8(session.error) + "; it stays until it is discarded"});
    }
    showCopy(copies, shown == most ? 0 : shown);
}

void MixerWindow::showCopy(const std::vector<std::filesystem::path>& copies, std::size_t at) {
    if (copies.empty()) {
        if (view_->question() == nullptr) return;
        view_->setQuestion(nullptr);
        return showHintOnce();
    }
    const std::size_t most = std::min(copies.size(), mostOffered);
    const auto copy = copies[at];
    const auto session = RecoveryCopies::read(copy);
    const auto count = [](std::size_t n) { return juce::String{static_cast<int>(n)}; };
    juce::String words = "The mixer ended without being closed. " + describe(copy, session);
    if (most > 1) words += "\nCopy " + count(at + 1) + " of " + count(most) + ", the newest first.";
    if (most < copies.size())
        words +=
            " " + count(copies.size() - most) + " older ones stay in " + utf8(copy.parent_path().string());
    const auto discard = [this](std::vector<std::filesystem::path> declined) {
        std::string error;
        for (const auto& each : declined)
            if (auto why = RecoveryCopies::remove(each); !why.empty()) error = std::move(why);
        offerRecovery();
        if (!error.empty()) say(utf8(error));
    };
    std::vector<QuestionCard::Answer> answers{
        {"Take it up", [this, copy] { takeUp(copy); }, static_cast<bool>(session)},
        {"Discard it", [discard, copy] { discard({copy}); }},
        {"Not now", [this] { view_->setQuestion(nullptr), showHintOnce(); }}};
    if (most > 1) {
        answers.push_back({"Newer", [this, copies, at] { showCopy(copies, at - 1); }, at > 0,
                           juce::KeyPress{juce::KeyPress::leftKey}});
        answers.push_back({"Older", [this, copies, at] { showCopy(copies, at + 1); }, at + 1 < most,
                           juce::KeyPress{juce::KeyPress::rightKey}});
        answers.push_back({"Discard all " + count(most), [discard, copies, most] {
                               discard({copies.begin(), copies.begin() + static_cast<std::ptrdiff_t>(most)});
                           }});
    }
    view_->setQuestion(std::make_unique<QuestionCard>(
        most > 1 ? "Take up a session?" : "Take up the last session?", words, std::move(answers)));
}

// The copy is kept until this run's own copy is on disk.
void MixerWindow::takeUp(const std::filesystem::path& copy) {
    askThen([this, copy] {
        view_->setQuestion(nullptr);
        if (!load(juce::File{utf8(copy.string())}, {}, true)) return offerRecovery();
        savedEdits_ = neverSaved;
        files_.copies().forget(); // the previous session was saved or discarded by the user
        files_.copies().goOnFrom(copy);
        showHintOnce();
        if (const auto error = files_.keepNow(*desk_); !error.empty()) say(utf8(error));
    });
}

} // namespace physvib
