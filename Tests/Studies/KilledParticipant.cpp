// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-studies-killed FOLDER TRIALS: a participant begins, or goes on with, a short study in the mixer's
// window, answers so many trials, and the mixer is killed (SIGKILL) while the next one is felt. Ends with 0
// if the study ends before.
#include "Participant.h"
#include <csignal>
#include <cstdlib>

namespace physvib {
namespace {

constexpr const char* protocol = R"({"physvib_protocol": 1, "name": "short", "seed": 7,
  "conditions": [{"name": "c", "layout": "phone4", "stimuli": "grid", "columns": 3, "rows": 2, "seconds": 0.05}],
  "sessions": [{"name": "main", "task": "identify", "repetitions": 2}]})";

int answer(const juce::File& folder, int trials) {
    test::Participant p;
    const auto file = folder.getChildFile("short.json");
    file.replaceWithText(protocol);
    p.tab().setFolder(folder);
    if (const auto error = p.tab().chooseProtocol(file.getFullPathName().toStdString()); !error.empty())
        return std::puts(error.c_str()), 1;
    if (const auto error = p.tab().begin(); !error.empty()) return std::puts(error.c_str()), 1;
    p.pump();
    for (int n = 0; p.screen()->page() != StudyScreen::Page::done; ++n) {
        if (p.screen()->page() == StudyScreen::Page::ready) p.click("Next");
        const int taken = p.experiment().answeredTrials();
        if (n == trials) {
            p.space();
            std::raise(SIGKILL);
        }
        p.feel();
        // whatever was felt
        p.click("Row " + juce::String{1 + taken % 2} + ", column " + juce::String{1 + taken % 3});
        p.click("Next");
        if (!test::runUntil([&] { return p.experiment().answeredTrials() > taken; })) return 1;
        p.pump();
    }
    return 0;
}

} // namespace
} // namespace physvib

int main(int, char** argv) {
    // a program of its own: JUCE outlives errors of X
    juce::JUCEApplicationBase::createInstance = []() -> juce::JUCEApplicationBase* { return nullptr; };
    const juce::ScopedJuceInitialiser_GUI juce;
    return physvib::answer(juce::File{argv[1]}, std::atoi(argv[2]));
}
