// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-mixer-shots FILE.png STATE [WIDTHxHEIGHT [SCALE]]: a picture of the mixer's window in a state,
// without a display;
// --states lists the states; those that begin with "sheet" are for ../../figures/mixer-sheet.sh alone. They
// are reached as a person would reach them, with a clock instead of a device.
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Knock.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Shots/StudyShots.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include "Mixer/Window/MixerView.h"
#include "Scene/SceneFile.h"
#include <cmath>
#include <functional>
#include <iostream>

namespace physvib {

namespace {

struct State {
    const char* name;
    int width, height;
    double seconds; // until the picture is taken
    std::function<void(MixerModel&, MixerView&)> reach;
    std::vector<SinkName> sinks{}; // beside the device
};

juce::Component* find(juce::Component& root, const juce::String& title) {
    if (root.getTitle() == title) return &root;
    for (auto* child : root.getChildren())
        if (auto* found = find(*child, title)) return found;
    return nullptr;
}

void showScene(MixerModel& model, const char* name) {
    model.change("Scene", [name](Mix& m) {
        m.scene = std::make_shared<const Scene>(*findBuiltInScene(name)), m.levelDb = -3.0;
    });
}

void showSurface(MixerModel& model, MixerView& view, const std::string& material) {
    model.dispatchPendingMessages();
    view.tabs().choose("Materials");
    const auto& materials = model.world().scene().materials;
    if (auto* tab = view.tabs().find<MaterialsTab>())
        tab->choose(
            static_cast<int>(std::ranges::find(materials, material, &Material::name) - materials.begin()));
}

/// One material was measured, from a recording that is made for it.
void showMaterials(MixerModel& model, MixerView& view) {
    view.tabs().choose("Materials");
    auto* tab = view.tabs().find<MaterialsTab>();
    const auto folder = juce::File::createTempFile("physvib-knock");
    const auto file = folder.getChildFile("knock.wav");
    if (tab == nullptr || !folder.createDirectory() || !writeKnock(file)) return;
    tab->choose(4);
    tab->measure(file);
    tab->finishMeasuring();
    folder.deleteRecursively();
    model.dispatchPendingMessages();
    tab->playAt({0.3, 0.62});
}

// For so long, and then until something has been struck: a picture without a hit says little.
void runFor(double seconds, MixerView& view) {
    const auto end = juce::Time::getMillisecondCounterHiRes() + 1e3 * seconds;
    bool isStruck = false;
    while (juce::Time::getMillisecondCounterHiRes() < end ||
           (!isStruck && juce::Time::getMillisecondCounterHiRes() < end + 10e3)) {
        juce::Thread::sleep(33);
        view.refresh();
        isStruck = std::ranges::any_of(view.snapshot().hits,
                                       [](const CollisionEvent& e) { return std::abs(e.amplitude) > 0.15; });
    }
    for (int k = 0; k < 2; ++k) juce::Thread::sleep(33), view.refresh();
}

// Three of the last, while more come.
void chooseContacts(MixerView& view) {
    view.scope().choose("Events");
    runFor(2.0, view);
    if (auto* list = dynamic_cast<juce::ListBox*>(find(view, "List of played events")))
        for (const int row : {1, 2, 4}) list->selectRow(row, true, false);
}

void showFirstStart(MixerModel& model, MixerView& view) {
    const DeviceChoice none{std::string{nullDeviceType} + ":" + nullDeviceName};
    view.setFirstStart(std::make_unique<FirstStart>(
        model, std::vector<PlaybackChoice>{{"JACK:system, 8 outputs", none, 8},
                                           {"Headphones: ALSA:USB Headset", none, 2, false, true},
                                           {"Game controller: DualSense", none, 2, true},
                                           {"ALSA: USB Headset, 2 outputs: two actuators", none, 2},
                                           {"No device: seen, not felt", none, 0}}));
}

// Two hands; one of them and a strip rise and fall.
void showLanes(MixerModel& model, MixerView& view) {
    model.change("Groups", [](Mix& m) {
        for (const int hand : {0, 1}) {
            const int group = addGroup(m, freeGroupName(m));
            for (const int k : {0, 2}) m.strips[static_cast<std::size_t>(hand + k)].group = group;
        }
        m.groups[0].gainDb = -3.0;
        m.groups[1].lane = {{0.0, 0.0}, {2.5, 0.0}, {5.0, -18.0}, {7.0, -2.0}};
        m.strips[2].lane = {{0.8, -24.0}, {2.2, 0.0}, {3.6, -9.0}, {4.4, -1.0}, {6.0, -1.0}, {8.5, -60.0}};
        m.levelDb = -3.0;
    });
    model.dispatchPendingMessages();
    view.scope().choose("Gain lanes");
}

/// So many actuators on a grid, with names as people give them.
void showActuators(MixerModel& model, int count) {
    model.change("Many", [count](Mix& m) {
        ActuatorLayout many = m.layout.geometry;
        const int columns = static_cast<int>(std::ceil(std::sqrt(2.0 * count)));
        const int rows = (count + columns - 1) / columns;
        for (many.count = 0; many.count < count; ++many.count)
            many.places[static_cast<std::size_t>(many.count)] = {
                (many.count % columns + 0.5) / columns * many.extentWidthMetres,
                (many.count / columns + 0.5) / rows * many.extentHeightMetres};
        m.layout = describeLayout("many", many);
        m.layout.actuators.back().label = "Left hand, ring finger, second joint";
        m.resizeStrips();
        m.levelDb = -3.0;
    });
}

void showRain(MixerModel& model, MixerView& view) {
    model.dispatchPendingMessages();
    auto& pane = view.world().drawing();
    pane.setTool(DrawTool::rain);
    pane.addAt(DrawTool::rain, {3.2, 2.4});
    pane.setTool(DrawTool::select);
    pane.select({"rain 1"});
}

std::vector<State> sheetStates() {
    return {
        {"sheet-one", 1440, 900, 3.0, [](MixerModel& d, MixerView&) { showActuators(d, 1); }},
        {"sheet-16", 1440, 900, 3.0, [](MixerModel& d, MixerView&) { showActuators(d, 16); }},
        {"sheet-64", 1440, 900, 3.0,
         [](MixerModel& d, MixerView& v) { v.setTheme(Theme::light), showActuators(d, 64); }},
        {"sheet-show", 1440, 900, 3.0,
         [](MixerModel& d, MixerView& v) {
             v.setShowMode(true);
             d.messages().add(
                 {"A has no output: another actuator has it", false, {"Give a free output", [] {}}});
         }},
        {"sheet-rain", 1440, 900, 1.0, showRain},
        {"sheet-body", 1024, 700, 1.0,
         [](MixerModel& d, MixerView& v) {
             v.setMode(Mode::play);
             showRain(d, v);
             d.report("session.json: expected 0.01 to 100, found 0");
         }},
        {"sheet-body-light", 1024, 700, 1.0,
         [](MixerModel& d, MixerView& v) {
             v.setTheme(Theme::light), v.setMode(Mode::play);
             showRain(d, v);
         }},
        {"sheet-phone", 1280, 800, 0.5,
         [](MixerModel&, MixerView& v) {
             v.tabs().choose("Output");
             if (auto* list = dynamic_cast<juce::ComboBox*>(find(v, "OSC")))
                 list->setSelectedItemIndex(2, juce::sendNotificationSync);
         }},
        {"sheet-takes", 1440, 900, 1.0, [](MixerModel&, MixerView& v) { v.scope().choose("Takes"); }},
        {"sheet-card", 1440, 900, 1.0,
         [](MixerModel&, MixerView& v) {
             v.setCard(std::make_unique<FileCard>(FileCard::Choice{
                 "Save the session", ".json", juce::File::getSpecialLocation(juce::File::userHomeDirectory),
                 true, "session"}));
         }},
    };
}

std::vector<State> mixerStates() {
    return {
        {"first-start", 1440, 900, 2.0, [](MixerModel& d, MixerView& v) { showFirstStart(d, v); }},
        {"first-test", 1440, 900, 0.2,
         [](MixerModel& d, MixerView& v) {
             showFirstStart(d, v), v.firstStart()->test(4), v.firstStart()->confirmPulse();
         }},
        {"four-enchanters", 1440, 900, 4.0,
         [](MixerModel& d, MixerView&) { d.change("Level", [](Mix& m) { m.levelDb = -3.0; }); }},
        {"materials", 1440, 900, 0.2, showMaterials},
        {"materials-small", MixerView::minWidth, MixerView::minHeight, 0.2,
         [](MixerModel& d, MixerView& v) { v.setTheme(Theme::light), showMaterials(d, v); }},
        {"events", 1440, 900, 0.5, [](MixerModel&, MixerView& v) { chooseContacts(v); }},
        {"marbles", 1440, 900, 4.0,
         [](MixerModel& d, MixerView& v) { showScene(d, "marbles"), v.scope().choose("Events"); }},
        {"drawing", 1440, 900, 7.2,
         [](MixerModel& d, MixerView& v) { showScene(d, "drawing"), showSurface(d, v, "cloth"); }},
        {"telemetry", 1440, 900, 3.0, [](MixerModel&, MixerView& v) { v.scope().choose("Telemetry"); }},
        {"output", 1440, 900, 3.0,
         [](MixerModel& d, MixerView& v) {
             d.device().listening().setMonitor({4, 5}, defaultContactDb), d.device().listening().setMarker(7),
                 v.tabs().choose("Output");
         }},
        {"board",
         1440,
         900,
         4.5,
         [](MixerModel&, MixerView& v) { v.tabs().choose("Output"); },
         {{"BOARD", "/dev/ttyACM0"}}},
        {"play", 1280, 800, 4.0,
         [](MixerModel& d, MixerView& v) {
             v.setMode(Mode::play), d.change("Level", [](Mix& m) { m.levelDb = -3.0; });
         }},
        {"small", MixerView::minWidth, MixerView::minHeight, 3.0, [](MixerModel&, MixerView&) {}},
        {"lanes", 1440, 900, 6.0, showLanes},
        {"light", 1440, 900, 4.0, [](MixerModel&, MixerView& v) { v.setTheme(Theme::light); }},
        {"error", 1440, 900, 2.0,
         [](MixerModel& d, MixerView&) {
             d.report("session.json: takes[0].scene.bodies[4].fixtures[0].radius_m: expected 0.01 to 100, "
                      "found 0");
         }},
        {"six-enchanters", 1440, 900, 3.0,
         [](MixerModel& d, MixerView& v) {
             d.attach(0.5, 0.5);
             d.attach(0.5, 1.0);
             d.change("Mute", [](Mix& m) {
                 m.strips[2].isMuted = true, m.strips[3].isInverted = true, m.strips[1].delayMs = 5.0;
             });
             d.dispatchPendingMessages();
             v.tabs().choose("Actuators");
             if (auto* list = dynamic_cast<juce::ListBox*>(find(v, "List of actuators"))) list->selectRow(4);
             if (auto* maps = dynamic_cast<juce::Button*>(find(v, "Map of the chosen actuator")))
                 maps->setToggleState(true, juce::sendNotificationSync);
         }},
    };
}

const std::vector<State>& states() {
    static const std::vector<State> all = [] {
        auto states = mixerStates();
        for (State state : sheetStates()) states.push_back(std::move(state));
        for (const StudyShot& shot : studyShots()) states.push_back({shot.name, 1440, 900, 0.2, shot.reach});
        return states;
    }();
    return all;
}

juce::StringArray shotStates() {
    juce::StringArray names;
    for (const auto& state : states()) names.add(state.name);
    return names;
}

juce::String takeShot(const juce::File& file, const juce::String& name, const juce::String& size,
                      float scale) {
    constexpr int largestSide = 8192;
    const int wide = size.upToFirstOccurrenceOf("x", false, true).getIntValue();
    const int high = size.fromFirstOccurrenceOf("x", false, true).getIntValue();
    const auto isSide = [](int side, int least) { return side >= least && side <= largestSide; };
    if (size.isNotEmpty() && !(isSide(wide, MixerView::minWidth) && isSide(high, MixerView::minHeight)))
        return "expected WIDTHxHEIGHT of at least " + juce::String{MixerView::minWidth} + "x" +
               juce::String{MixerView::minHeight} + ", found \"" + size + "\"";
    const auto state = std::ranges::find_if(states(), [&](const State& s) { return name == s.name; });
    if (state == states().end())
        return "expected one of " + shotStates().joinIntoString(", ") + ", found \"" + name + "\"";
    MixerModel model{test::onlyNoDevice(),
                     {std::string{nullDeviceType} + ":" + nullDeviceName, 48000, 128, state->sinks}};
    MixerView view{model};
    view.setSize(size.isEmpty() ? state->width : wide, size.isEmpty() ? state->height : high);
    state->reach(model, view);
    model.dispatchPendingMessages();
    runFor(state->seconds, view);
    model.dispatchPendingMessages(); // what has been told meanwhile
    const auto image = view.createComponentSnapshot(view.getLocalBounds(), true, scale);
    juce::MemoryOutputStream png;
    juce::PNGImageFormat{}.writeImageToStream(image, png);
    return utf8(writeFile(file.getFullPathName().toStdString(),
                          {static_cast<const char*>(png.getData()), png.getDataSize()}));
}

} // namespace
} // namespace physvib

int main(int argc, char* argv[]) {
    const juce::ArgumentList arguments{argc, argv};
    const juce::ScopedJuceInitialiser_GUI juce;
    if (arguments.containsOption("--states")) {
        std::cout << physvib::shotStates().joinIntoString("\n") << '\n';
        return 0;
    }
    const auto file = juce::File::getCurrentWorkingDirectory().getChildFile(arguments[0].text);
    const float scale = arguments.size() > 3 ? arguments[3].text.getFloatValue() : 1.0f;
    const auto error = physvib::takeShot(file, arguments[1].text, arguments[2].text, scale);
    if (error.isEmpty()) return 0;
    std::cerr << "physvib-mixer-shots: " << error << '\n';
    return 1;
}
