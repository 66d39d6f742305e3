// SPDX-License-Identifier: GPL-3.0-or-later
// SILENCE and Esc in every state that the mixer can be brought into by its own controls and menus.
#include "Host/StopWalk.h"
#include "../MixerTesting.h"
#include "Host/Devices/HostDrivers.h"
#include "Mixer/Window/MixerWindow.h"
#include <filesystem>
#include <fstream>
#include <limits>

namespace physvib::stop_walk_test {

using namespace test;

constexpr int gateSteps = 400; // of a thousand; 31 to 38 menus, lists and dialogs

/// How long the threads of this program have waited for a processor, in all: a busy machine's share of what
/// is late.
std::int64_t msWaited() {
    std::int64_t ns = 0;
    for (const auto& task : std::filesystem::directory_iterator{"/proc/self/task"}) {
        std::int64_t ran = 0, waited = 0;
        if (std::ifstream{task.path() / "schedstat"} >> ran >> waited) ns += waited;
    }
    return ns / 1'000'000;
}

TEST(StopWalk, EveryStateOfTheMixerIsSilencedByEscAndByAPress) {
    juce::Desktop::setMousePosition({0, 0});
    TestFolder folder;
    setenv("HOME", folder.folder.getFullPathName().toRawUTF8(), 1); // what is saved on the way
    const SystemChooser chooser{folder.folder};
    std::unique_ptr<MixerWindow> window;
    const char* const device = std::getenv("PHYSVIB_STOP_DEVICE"); // by Hostile/stop-walk.sh
    StopWalk walk{{[&] {
                       window.reset();
                       window = std::make_unique<MixerWindow>(
                           device ? withNullDevice(hostAudioDrivers) : onlyNoDevice(),
                           device ? device : "None:no device", juce::File{}, folder("config"));
                       window->view().setPanelLayout("play 00 01"); // as at a first start: the walk finds the
                                                                    // other mode
                       if (device == nullptr)
                           window->model().setSlowness(0); // pictures of a world at rest are few
                   },
                   [&] {
                       if (!window->hasUnsavedChanges())
                           window->model().change("Level", [](Mix& mix) { mix.levelDb -= 0.01; });
                   },
                   [&] { return window->model().isSilent() && window->model().output().isSilent(); },
                   [&] { window->model().setSilent(false); },
                   [](const juce::StringArray& steps) { return steps.size() > 3 && steps[2] == "item Quit"; },
                   2}};
    if (device != nullptr)
        walk.setMeasure([&](const juce::String& what) {
            if (what.isEmpty()) {
                std::cout << "over " << msWaited() << std::endl;
                return;
            }
            if (auto& output = window->model().device(); output.choice().name != device)
                output.open({device});                                     // the walk has chosen another
            window->model().inputs().configure({OscAccess::thisComputer}); // a tone comes there
            runFor(0.6);
            std::cout << "over " << msWaited() << '\n';
            std::cout << "stop " << juce::Time::currentTimeMillis() << ' ' << what << std::endl;
        });
    walk.run(device ? std::numeric_limits<int>::max() : gateSteps, device ? 280.0 : 900.0);
    for (const auto& state : walk.modal()) std::cout << state << '\n';
    std::cout << walk.steps() << " steps, " << walk.states() << " menus, lists and dialogs" << std::endl;
    EXPECT_GE(walk.states(), 24);
    EXPECT_GE(walk.steps(), device ? 150 : gateSteps);
    EXPECT_FALSE(chooser.wasCalled());
    EXPECT_TRUE(walk.faults.isEmpty()) << walk.faults.size() << " faults\n"
                                       << walk.faults.joinIntoString("\n");
    window.reset();
}

} // namespace physvib::stop_walk_test
