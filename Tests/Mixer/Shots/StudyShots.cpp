// SPDX-License-Identifier: GPL-3.0-or-later
// A study is brought to a screen by answers of the simulated observer, and felt there as by a person.
#include "Mixer/Shots/StudyShots.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Mixer/Studies/StudiesTab.h"

namespace physvib {

namespace {

template <class Wanted>
Wanted* find(juce::Component& root, const juce::String& title) {
    if (auto* wanted = dynamic_cast<Wanted*>(&root); wanted != nullptr && root.getTitle() == title)
        return wanted;
    for (auto* child : root.getChildren())
        if (auto* wanted = find<Wanted>(*child, title)) return wanted;
    return nullptr;
}

void press(juce::Component& root, const juce::String& title) {
    if (auto* button = find<juce::Button>(root, title);
        button != nullptr && button->isEnabled() && button->onClick)
        button->onClick();
}

void wait(MixerView& view, double seconds) {
    for (const auto end = juce::Time::getMillisecondCounterHiRes() + 1e3 * seconds;
         juce::Time::getMillisecondCounterHiRes() < end; juce::Thread::sleep(30))
        view.refresh();
}

/// Removed when the program ends.
juce::File folder() {
    struct Folder {
        juce::File file = juce::File::createTempFile("study");
        Folder() { file.createDirectory(); }
        ~Folder() { file.deleteRecursively(); }
    };
    static const Folder folder;
    return folder.file;
}

/// The trials before the wanted one are answered by the observer.
void answerUntil(const Protocol& protocol, StudyTask task, int trial) {
    const Participant participant{"P01", 1, "person"};
    StudyInProgress study{{protocol, participant, folder().getFullPathName().toStdString()}};
    const SimulatedObserver observer{{}, protocol, participant};
    const auto isThere = [&] {
        return study.experiment().isDone() ||
               (study.experiment().trial().task == task && study.experiment().trial().number == trial);
    };
    while (!isThere()) {
        if (study.experiment().mayEnd())
            study.endSession();
        else if (!study.acceptAnswer(observer.answer(study.experiment())))
            return;
    }
}

StudiesTab& studies(MixerView& view) {
    view.tabs().choose("Studies");
    return *find<StudiesTab>(view, "Studies");
}

/// The tab with a protocol whose check is made.
StudiesTab& showChecked(MixerView& view) {
    auto& tab = studies(view);
    tab.setFolder(juce::File{"/home/lab/studies"});
    tab.chooseProtocol("model-or-sound");
    for (int tries = 0; tries < 200 && !tab.check(); ++tries) wait(view, 0.1);
    wait(view, 0.1);
    return tab;
}

/// The screen of that trial, behind its pause.
StudyScreen* show(MixerView& view, const std::string& protocol, StudyTask task, int trial,
                  bool isPauseSeen = false) {
    auto& tab = studies(view);
    tab.setFolder(folder());
    if (!tab.chooseProtocol(protocol).empty()) return nullptr;
    answerUntil(findProtocol(protocol).value, task, trial);
    if (!tab.begin().empty()) return nullptr;
    wait(view, 0.3);
    if (!isPauseSeen) press(*tab.screen(), "Next");
    return tab.screen();
}

/// Whole files of the simulated observer.
std::vector<juce::File> simulatedTrials(const std::string& name, int participants) {
    const auto protocol = findProtocol(name).value;
    std::vector<juce::File> files;
    for (int number = 1; number <= participants; ++number) {
        const Participant participant{"S0" + std::to_string(number), number, "simulated-RING"};
        StudyInProgress study{{protocol, participant, folder().getFullPathName().toStdString()}};
        const SimulatedObserver observer{*observerNamed(participant.observer), protocol, participant};
        while (!study.experiment().isDone() && study.acceptAnswer(observer.answer(study.experiment()))) {
        }
        files.emplace_back(study.path().string());
    }
    return files;
}

void feel(MixerView& view, StudyScreen* screen, double seconds) {
    if (screen == nullptr) return;
    screen->keyPressed(juce::KeyPress{juce::KeyPress::spaceKey});
    wait(view, seconds);
}

void type(StudyScreen* screen, char key) {
    if (screen != nullptr)
        screen->keyPressed(juce::KeyPress{key, juce::ModifierKeys{}, static_cast<juce::juce_wchar>(key)});
}

/// The box of `eight-methods` with a second for each pair.
std::string shortBox() {
    Protocol p = findProtocol("eight-methods").value;
    p.name = "eight-methods-short";
    for (SessionPlan& session : p.sessions) session.minSeconds = 1.0;
    const auto file = folder().getChildFile("eight-methods-short.json");
    return file.replaceWithText(utf8(protocolJson(p))) ? file.getFullPathName().toStdString() : std::string{};
}

/// Plays with a pair for a while.
void shake(MixerView& view, StudyScreen* screen, char pair) {
    type(screen, pair);
    wait(view, 0.4);
    for (int k = 0; k < 7 && screen != nullptr; ++k)
        screen->keyPressed(juce::KeyPress{juce::KeyPress::leftKey});
    wait(view, 0.9);
}

void setScale(MixerView& view, const juce::String& title, double points) {
    if (auto* slider = find<juce::Slider>(view, title)) slider->setValue(points, juce::sendNotificationSync);
}

} // namespace

const std::vector<StudyShot>& studyShots() {
    static const std::vector<StudyShot> shots{
        {"studies-tab", [](MixerModel&, MixerView& v) { showChecked(v); }},
        {"studies-findings",
         [](MixerModel&, MixerView& v) { press(showChecked(v), "Findings of the check"); }},
        {"studies-training",
         [](MixerModel&, MixerView& v) { type(show(v, "patterns", StudyTask::explore, 60), 'a'); }},
        {"studies-pattern",
         [](MixerModel&, MixerView& v) {
             auto* screen = show(v, "patterns", StudyTask::identify, 12);
             feel(v, screen, 1.6);
             type(screen, 'b');
         }},
        {"studies-grid",
         [](MixerModel&, MixerView& v) { feel(v, show(v, "phantom-grids", StudyTask::identify, 31), 1.8); }},
        {"studies-place",
         [](MixerModel&, MixerView& v) { feel(v, show(v, "phantom-places", StudyTask::locate, 48), 1.8); }},
        {"studies-match",
         [](MixerModel&, MixerView& v) {
             auto* screen = show(v, "model-or-sound", StudyTask::adjust, 2);
             feel(v, screen, 5.0);
             feel(v, screen, 5.0);
         }},
        {"studies-drop",
         [](MixerModel&, MixerView& v) { feel(v, show(v, "model-or-sound", StudyTask::choose, 4), 0.6); }},
        {"studies-choice",
         [](MixerModel&, MixerView& v) {
             auto* screen = show(v, "model-or-sound", StudyTask::choose, 5);
             feel(v, screen, 5.0);
             feel(v, screen, 5.0);
             type(screen, '2');
         }},
        {"studies-box",
         [](MixerModel&, MixerView& v) {
             auto* screen = show(v, shortBox(), StudyTask::rate, 5);
             shake(v, screen, '1');
             shake(v, screen, '2');
         }},
        {"studies-ratings",
         [](MixerModel&, MixerView& v) {
             auto* screen = show(v, shortBox(), StudyTask::rate, 5);
             for (const char pair : {'1', '2', '3'}) shake(v, screen, pair);
             press(v, "Pause");
             wait(v, 0.6);
             setScale(v, "Realism", 72.0);
             setScale(v, "Harmony", 41.0);
             wait(v, 0.1);
         }},
        {"studies-korean",
         [](MixerModel&, MixerView& v) {
             studies(v).chooseLanguage("ko");
             auto* screen = show(v, shortBox(), StudyTask::rate, 5);
             for (const char pair : {'1', '2', '3'}) shake(v, screen, pair);
             press(v, "Pause");
             wait(v, 0.6);
             setScale(v, "Realism", 72.0);
             wait(v, 0.1);
         }},
        {"studies-session",
         [](MixerModel&, MixerView& v) { show(v, "model-or-sound", StudyTask::choose, 1, true); }},
        {"studies-number",
         [](MixerModel&, MixerView& v) { feel(v, show(v, "magnitudes", StudyTask::estimate, 7), 1.2); }},
        {"studies-analysis",
         [](MixerModel&, MixerView& v) { studies(v).analyse(simulatedTrials("phantom-places", 2)); }},
        {"studies-break",
         [](MixerModel&, MixerView& v) { show(v, "eight-methods", StudyTask::rate, 9, true); }},
    };
    return shots;
}

} // namespace physvib
