// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the editor in a window, again and again, while the plug-in plays; fails if a window does not come or
// if the memory in use grows. Run by openings.sh. Usage: physvib-editor-openings COUNT
#include "Host/MessageLoop.h"
#include "PluginProcessor.h"
#include <cstdio>
#include <cstdlib>
#include <malloc.h>
// X11's macros come last
#include "Plugin/Formats/DisplayNames.h"

namespace {

using namespace physvib;

constexpr int framesPerBlock = 512;
constexpr double mostGrowthBytes = 1.0e6; // caches fill first; 25 that are kept hold 3 MB

double bytesInUse() {
    const auto heap = mallinfo2();
    return static_cast<double>(heap.uordblks + heap.hblkhd);
}

/// What the open editor holds; 0 if no window came.
double openOnce(PluginProcessor& plugin, juce::AudioBuffer<float>& buffer) {
    const double before = bytesInUse();
    const std::unique_ptr<juce::AudioProcessorEditor> editor{plugin.createEditorIfNeeded()};
    editor->addToDesktop(juce::ComponentPeer::windowHasTitleBar);
    editor->setVisible(true);
    juce::MidiBuffer midi;
    for (int b = 0; b < 5; ++b) {
        plugin.processBlock(buffer, midi);
        test::runFor(0.015);
    }
    return editor->getPeer() != nullptr && editor->isShowing() ? bytesInUse() - before : 0.0;
}

} // namespace

int main(int argc, char** argv) {
    const int count = argc == 2 ? std::atoi(argv[1]) : 0;
    if (count < 2) return 2;
    Display* const display = test::openDisplayWithNames();
    if (display == nullptr) {
        std::puts("there is no display");
        return 1;
    }
    const juce::ScopedJuceInitialiser_GUI juce;
    PluginProcessor plugin{"PhysVib", {}};
    plugin.prepareToPlay(48000.0, framesPerBlock);
    juce::AudioBuffer<float> buffer(plugin.getTotalNumOutputChannels(), framesPerBlock);
    const int first = count / 2; // by then most caches are filled
    double before = 0.0, held = 0.0;
    for (int i = 0; i < count; ++i) {
        if (i == first) before = bytesInUse();
        held = openOnce(plugin, buffer);
        if (held <= 0.0) {
            std::printf("opening %d: no window\n", i + 1);
            return 1;
        }
        test::runFor(0.005);
        plugin.runs().drainLog(); // which grows while the plug-in plays
    }
    const double growth = bytesInUse() - before;
    std::printf("editor: %d openings; %.1f MB in use, and %.0f kB while it is open; %.0f bytes more per "
                "opening since number %d\n",
                count, bytesInUse() / 1e6, held / 1e3, growth / (count - first), first);
    XCloseDisplay(display);
    return growth <= mostGrowthBytes ? 0 : 1;
}
