// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer's window does with a world that is too much: prints how long the first picture, the message,
// other pictures and the end took, and what processor time of the window's own thread. With --spread: a world
// that can be played, its pictures a second, share of a processor, and time from a click to the picture of
// the body that it draws. With --paint: processor time of a picture of that world, without a display. With
// --empty: a window that shows nothing, which ../cpu.sh compares.
// ../big-world.sh runs it; no test, since it measures times.
#include "Host/MessageLoop.h"
#include "Live/Session/System.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Window/MixerWindow.h"
#include "Scene/SceneFile.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

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
    void setAsking(bool asks) { asks ? startTimerHz(60) : stopTimer(); }
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

/// So many balls that fall in a box, in rows; every tenth is felt.
std::string shower(int bodies) {
    constexpr double width = 8.0, height = 4.5;
    const int columns = std::max(1, static_cast<int>(std::sqrt(bodies * width / height)));
    const double apart = width / (columns + 1), radius = 0.3 * apart;
    std::string text = R"({"physvib_scene": 1, "name": "shower", "field_m": [8, 4.5],
"gravity_m_per_s2": [0, -9.8], "materials": [{"name": "wood", "density_kg_per_m2": 850, "friction": 0.4,
"restitution": 0.6, "frequency_hz": 80, "decay_per_s": 30}], "bodies": [)";
    const auto wall = [&text](const char* name, double x, double y, double w, double h) {
        text += std::string{"{\"name\": \""} + name + "\", \"type\": \"static\", \"position_m\": [" +
                std::to_string(x) + ", " + std::to_string(y) +
                "], \"fixtures\": [{\"shape\": \"box\", \"size_m\": [" + std::to_string(w) + ", " +
                std::to_string(h) + "], \"material\": \"wood\"}]},\n";
    };
    wall("floor", 4.0, -0.1, 8.4, 0.2);
    wall("left", -0.1, 2.25, 0.2, 9.0);
    wall("right", 8.1, 2.25, 0.2, 9.0);
    for (int k = 0; k < bodies; ++k)
        text += (k == 0 ? "" : ",\n") + std::string{"{\"name\": \"b"} + std::to_string(k) +
                "\", \"position_m\": [" + std::to_string((k % columns + 1) * apart) + ", " +
                std::to_string((k / columns + 0.5) * apart) +
                "], \"fixtures\": [{\"shape\": \"circle\", \"radius_m\": " + std::to_string(radius) +
                ", \"material\": \"wood\", \"camera\": " + (k % 10 == 0 ? "true" : "false") + "}]}";
    return text + "]}";
}

double processSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void click(MixerWindow& window, juce::Point<float> at) {
    for (const int buttons : {0, static_cast<int>(juce::ModifierKeys::leftButtonModifier), 0})
        window.getPeer()->handleMouseEvent(juce::MouseInputSource::InputSourceType::mouse, at,
                                           juce::ModifierKeys{buttons}, 0.0f, 0.0f,
                                           juce::Time::currentTimeMillis());
}

void share(const char* what, Painted& painted) {
    painted.count = 0;
    const double from = seconds(), fromThread = threadCpuSeconds(), fromProcess = processSeconds();
    runFor(5.0);
    const double passed = seconds() - from;
    std::printf("%s: %.0f pictures a second, %.1f %% of a core by the window's thread, %.1f %% by all\n",
                what, painted.count / passed, 100.0 * (threadCpuSeconds() - fromThread) / passed,
                100.0 * (processSeconds() - fromProcess) / passed);
}

void measureSpread(int bodies, const juce::File& folder) {
    const auto scene = folder.getChildFile("shower.json");
    scene.replaceWithText(shower(bodies));
    MixerWindow window{onlyNoDevice(), "None:no device", scene, folder.getChildFile("config")};
    auto& view = window.view();
    auto& world = view.world();
    Painted painted;
    view.addAndMakeVisible(painted);
    runUntil([&] { return painted.count > 0 && !view.snapshot().poses.empty(); });
    runFor(3.0);
    std::printf("%d bodies\n", bodies);
    share("moving", painted);
    world.drawing().setTool(DrawTool::ball);
    std::vector<double> times;
    for (int k = 1; k <= 9; ++k) {
        const double from = seconds();
        const auto at = world.view().pixelOfShare({0.1 * k, 0.9});
        click(window, window.getLocalPoint(&world.view(), at));
        const auto name = "ball " + std::to_string(k);
        runUntil([&] { return world.view().poseOfBody(name).has_value(); });
        painted.count = 0;
        runUntil([&] { return painted.count > 0; });
        times.push_back(seconds() - from);
    }
    std::ranges::sort(times);
    std::printf("click to paint: %.0f ms (median of 9), %.0f ms at most\n", 1e3 * times[4], 1e3 * times[8]);
    window.model().setSlowness(0);
    painted.setAsking(false); // it would be most of what is measured
    runFor(2.0);
    share("paused", painted);
}

/// Bodies that sway and turn about where they begin: what is measured is the picture alone.
void measurePaint(int bodies) {
    constexpr int pictures = 40;
    const Scene scene = readScene(shower(bodies), "shower").value;
    WorldView view;
    view.setSize(1000, 562);
    view.show(scene);
    const juce::Image image{juce::Image::RGB, view.getWidth(), view.getHeight(), true,
                            juce::SoftwareImageType{}};
    double spent = 0.0;
    for (int k = -1; k < pictures; ++k) {
        std::vector<BodyPose> poses;
        for (const auto& body : scene.bodies) {
            const double at = body.type == BodyType::dynamicBody ? 0.3 * k + body.positionMetres.x : 0.0;
            poses.push_back({body.positionMetres.x + 0.02 * std::sin(at),
                             body.positionMetres.y + 0.02 * std::sin(1.7 * at), at, true});
        }
        const double from = threadCpuSeconds();
        view.update({std::move(poses), 20'000'000LL * (k + 2), 0, {}, {}});
        {
            juce::Graphics g{image};
            view.paintEntireComponent(g, true);
        }
        if (k >= 0) spent += threadCpuSeconds() - from; // the first fills what is kept
    }
    std::printf("%d bodies: %.2f ms of a core for a picture\n", bodies, 1e3 * spent / pictures);
}

void measure(int bodies, const juce::File& folder) {
    const auto scene = folder.getChildFile("heap.json");
    scene.replaceWithText(heap(bodies));
    const double began = seconds(), beganThread = threadCpuSeconds();
    std::optional<MixerWindow> window{std::in_place, onlyNoDevice(), "None:no device", scene,
                                      folder.getChildFile("config")};
    Painted painted;
    window->view().addAndMakeVisible(painted);
    runUntil([&] { return painted.count > 0 && !window->view().snapshot().poses.empty(); });
    std::printf("%d bodies\nfirst picture: %.2f s after it was opened, %.2f s of processor time of the "
                "window's thread\n",
                bodies, seconds() - began, threadCpuSeconds() - beganThread);
    const bool isTold = runUntil([&] { return window->model().messageText().contains("of real time"); });
    std::printf("message: %.2f s after it was opened, at %.2f s of the session: %s\n", seconds() - began,
                1e-9 * static_cast<double>(window->view().snapshot().session.sessionNs),
                isTold ? window->model().messageText().toRawUTF8() : "none");
    painted.count = 0;
    painted.longest = 0.0;
    const double from = seconds(), fromThread = threadCpuSeconds();
    runFor(5.0);
    std::printf("then in %.1f s: %d pictures, %.2f s of processor time of the window's thread; longest time "
                "without one %.2f s\n",
                seconds() - from, painted.count, threadCpuSeconds() - fromThread, painted.longest);
    const double quit = seconds(), quitThread = threadCpuSeconds();
    window.reset();
    std::printf("quit: %.2f s, %.2f s of processor time of the window's thread\n", seconds() - quit,
                threadCpuSeconds() - quitThread);
}

} // namespace
} // namespace physvib::test

int main(int argc, char* argv[]) {
    juce::JUCEApplicationBase::createInstance = [] {
        return static_cast<juce::JUCEApplicationBase*>(nullptr); // of a program JUCE bears errors of X
    };
    const juce::ScopedJuceInitialiser_GUI juce;
    const std::string how = argc > 2 ? argv[2] : "";
    if (how == "--empty") {
        juce::DocumentWindow window{"empty", juce::Colours::black, 0};
        window.setBounds(0, 0, 1440, 900);
        window.setVisible(true);
        juce::MessageManager::getInstance()->runDispatchLoop(); // until it is killed
    }
    const auto folder = juce::File::createTempFile("physvib-big-world");
    folder.createDirectory();
    const int bodies = argc > 1 ? std::atoi(argv[1]) : 2000;
    if (how == "--spread")
        physvib::test::measureSpread(bodies, folder);
    else if (how == "--paint")
        physvib::test::measurePaint(bodies);
    else
        physvib::test::measure(bodies, folder);
    folder.deleteRecursively();
    return 0;
}
