// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer's window does with a world that is too much: prints how long the first picture, the message,
// other pictures and the end took, and what processor time of the window's own thread. ../big-world.sh runs
// it; no test, since it measures times.
#include "Host/MessageLoop.h"
#include "Live/Session/ThreadTime.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Window/MixerWindow.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

namespace physvib::test {
namespace {

double seconds() { return 1e-3 * juce::Time::getMillisecondCounterHiRes(); }

/// One pixel that is painted whenever the window is.
class Painted final : public juce::Component, private juce::Timer {
public:
    Painted() {
        setSize(1, 1);
        setInterceptsMouseClicks(false, false);
        startTimerHz(60);
    }
    void paint(juce::Graphics&) override {
        const double now = seconds();
        if (count++ > 0) longest = std::max(longest, now - last_);
        last_ = now;
    }
    int count = 0;
    double longest = 0.0;

private:
    void timerCallback() override { repaint(); }
    double last_ = 0.0;
};

/// So many balls in one place: every step is late.
std::string heap(int bodies) {
    std::string text = R"({"physvib_scene": 1, "name": "heap", "field_m": [4, 2],
"gravity_m_per_s2": [0, -9.8], "materials": [{"name": "wood", "density_kg_per_m2": 850, "friction": 0.4,
"restitution": 0.6, "frequency_hz": 80, "decay_per_s": 30}], "bodies": [)";
    for (int k = 0; k < bodies; ++k) {
        text += (k == 0 ? "" : ",\n") + std::string{"{\"name\": \"b"} + std::to_string(k) + "\", ";
        text += R"("position_m": [2, 1], "fixtures": [{"shape": "circle", "radius_m": 0.2, )";
        text += R"("material": "wood", "camera": true}]})";
    }
    return text + "]}";
}

void measure(int bodies, const juce::File& folder) {
    const auto scene = folder.getChildFile("heap.json");
    scene.replaceWithText(heap(bodies));
    const double began = seconds(), beganThread = threadSeconds();
    std::optional<MixerWindow> window{std::in_place, onlyNoDevice(), "None:no device", scene,
                                      folder.getChildFile("config")};
    Painted painted;
    window->view().addAndMakeVisible(painted);
    runUntil([&] { return painted.count > 0 && !window->view().latest().poses.empty(); });
    std::printf("%d bodies\nfirst picture: %.2f s after it was opened, %.2f s of processor time of the "
                "window's thread\n",
                bodies, seconds() - began, threadSeconds() - beganThread);
    const bool isTold = runUntil([&] { return window->desk().trouble().contains("of real time"); });
    std::printf("message: %.2f s after it was opened, at %.2f s of the session: %s\n", seconds() - began,
                1e-9 * static_cast<double>(window->view().latest().session.sessionNs),
                isTold ? window->desk().trouble().toRawUTF8() : "none");
    painted.count = 0;
    painted.longest = 0.0;
    const double from = seconds(), fromThread = threadSeconds();
    runFor(5.0);
    std::printf("then in %.1f s: %d pictures, %.2f s of processor time of the window's thread; longest time "
                "without one %.2f s\n",
                seconds() - from, painted.count, threadSeconds() - fromThread, painted.longest);
    const double quit = seconds(), quitThread = threadSeconds();
    window.reset();
    std::printf("quit: %.2f s, %.2f s of processor time of the window's thread\n", seconds() - quit,
                threadSeconds() - quitThread);
}

} // namespace
} // namespace physvib::test

int main(int argc, char* argv[]) {
    juce::JUCEApplicationBase::createInstance = [] {
        return static_cast<juce::JUCEApplicationBase*>(nullptr); // as a program of its own, JUCE bears errors
                                                                 // of X
    };
    const juce::ScopedJuceInitialiser_GUI juce;
    const auto folder = juce::File::createTempFile("physvib-big-world");
    folder.createDirectory();
    physvib::test::measure(argc > 1 ? std::atoi(argv[1]) : 2000, folder);
    folder.deleteRecursively();
    return 0;
}
