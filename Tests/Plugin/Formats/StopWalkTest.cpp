// SPDX-License-Identifier: GPL-3.0-or-later
// SILENCE and Esc in every state that the plug-in's window can be brought into by its own controls and menus.
#include "Host/StopWalk.h"
#include "../PluginTesting.h"
#include "PluginEditor.h"
#include <limits>

namespace physvib {
namespace {

using namespace test;

TEST(StopWalk, EveryStateOfTheEditorIsSilencedByEscAndByAPress) {
    juce::Desktop::setMousePosition({0, 0});
    const auto folder = juce::File::createTempFile("physvib-walk");
    folder.createDirectory();
    folder.setAsCurrentWorkingDirectory(); // what is saved on the way
    const SystemChooser chooser{folder};
    setenv("HOME", folder.getFullPathName().toRawUTF8(), 1);
    TestHost host{shakenBox(), 480};
    auto& bypass = host.plugin->parameter(Parameter::bypass);
    std::unique_ptr<juce::AudioProcessorEditor> editor;
    StopWalk walk{{[&] {
                       editor.reset();
                       editor.reset(host.plugin->createEditorIfNeeded());
                       editor->addToDesktop(0);
                       editor->setTopLeftPosition(100, 100);
                       editor->setVisible(true);
                   },
                   [] {}, [&] { return host.plugin->isStopped() || bypass.getValue() >= 0.5f; },
                   [&] { host.plugin->setStopped(false), bypass.setValueNotifyingHost(0.0f); },
                   [](const juce::StringArray&) { return false; }, 2}};
    walk.run(std::numeric_limits<int>::max(), 250.0);
    for (const auto& state : walk.modal()) std::cout << state << '\n';
    std::cout << walk.steps() << " steps, " << walk.states() << " menus, lists and dialogs" << std::endl;
    EXPECT_GT(walk.states(), 8);
    EXPECT_FALSE(chooser.wasCalled());
    EXPECT_TRUE(walk.faults.isEmpty()) << walk.faults.size() << " faults\n"
                                       << walk.faults.joinIntoString("\n");
    editor.reset();
    folder.deleteRecursively();
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    juce::JUCEApplicationBase::createInstance = [] {
        return static_cast<juce::JUCEApplicationBase*>(nullptr); // JUCE bears errors of X
    };
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
