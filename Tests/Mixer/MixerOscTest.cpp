// SPDX-License-Identifier: GPL-3.0-or-later
// Messages by OSC at the model: from nobody unless told; they strike, tilt, and move what is shown.
#include "Live/Sockets/UdpSocket.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Window/MixerWindow.h"
#include "MixerTesting.h"
#include "Pads/VirtualPad.h"

namespace physvib::mixer_osc_test {

using namespace test;

struct OscOfMixer : testing::Test {
    MixerModel model{onlyNoDevice(), noDevice};

    void listen() { ASSERT_EQ(model.inputs().configure({OscAccess::thisComputer}), ""); }
    UdpSocket sender() {
        auto socket = UdpSocket::connectTo(model.inputs().status()->address);
        EXPECT_EQ(socket.error, "");
        return std::move(socket.value);
    }
    void send(const std::string& address, std::vector<NamedValue> values) {
        EXPECT_TRUE(sender().send(oscPacket(address, {"", std::move(values)})));
    }
    auto counts() { return model.inputs().status()->counts; }
    /// Whether such a gravity has come to the world.
    bool isTiltedTo(bool (*is)(double y)) {
        return runUntil([&] {
            const auto& takes = model.savedSession().log.runs;
            return !takes.empty() && std::ranges::any_of(takes.back().inputs, [&](const LiveInput& input) {
                const auto* gravity = std::get_if<GravityAction>(&input.action);
                return gravity != nullptr && is(gravity->gravityMetresPerSecond2.y);
            });
        });
    }
};

/// Of the page "Output", which shows what comes.
struct OscInTab : OscOfMixer {
    OutputTab tab{model};

    const StatusRow& messages() {
        tab.refresh(model.poll());
        const auto& facts = the<StatusTable>(tab, "What follows from it").rows();
        return *std::ranges::find(facts, juce::String{"Messages"}, &StatusRow::name);
    }
};

TEST_F(OscInTab, ListensToNobodyUntilItIsSwitchedThere) {
    auto& box = the<juce::ComboBox>(tab, "OSC");
    EXPECT_EQ(model.inputs().choice().access, OscAccess::off);
    EXPECT_FALSE(model.inputs().status().has_value());
    EXPECT_EQ(messages().value, "none");
    EXPECT_EQ(box.getText(), "nobody");
    box.setSelectedItemIndex(1, juce::sendNotificationSync);
    EXPECT_EQ(model.inputs().choice().access, OscAccess::thisComputer);
    EXPECT_TRUE(model.inputs().status()->address.starts_with("127.0.0.1:"));
    send("/physvib/strike", {{"frequency_hz", 200.0}, {"decay_per_s", 30.0}});
    send("/physvib/strike", {{"level", 2.0}});
    ASSERT_TRUE(runUntil([&] { return counts().messages == 2; }));
    const StatusRow& told = messages();
    EXPECT_TRUE(
        told.value.startsWith(utf8(model.inputs().status()->address) + ": 1 good, 1 bad, 0 late; 127.0.0.1:"))
        << told.value;
    EXPECT_EQ(told.shade, Shade::highlight);
    box.setSelectedItemIndex(0, juce::sendNotificationSync);
    EXPECT_EQ(model.inputs().choice().access, OscAccess::off);
    EXPECT_FALSE(model.inputs().status().has_value());
}

TEST_F(OscOfMixer, APhonesAddressIsShownAsTextAndAsACode) {
    MixerView view{model};
    view.tabs().choose("Output");
    the<juce::ComboBox>(view, "OSC").setSelectedItemIndex(2, juce::sendNotificationSync);
    ASSERT_NE(view.question(), nullptr) << model.messageText();
    EXPECT_TRUE(view.question()->message().contains(":9")) << view.question()->message();
    EXPECT_TRUE(view.question()->picture().isValid());
    view.keyPressed(KeyPress{KeyPress::escapeKey});
    EXPECT_TRUE(runUntil([&] { return view.question() == nullptr; }, 1.0));
}

TEST_F(OscOfMixer, WhatStrikesIsFeltAndSaved) {
    listen();
    model.poll();
    const auto edits = model.editCount();
    send("/physvib/strike", {{"frequency_hz", 123.0}, {"decay_per_s", 30.0}});
    EXPECT_TRUE(runUntil([&] {
        return std::ranges::any_of(model.poll().hits,
                                   [](const auto& hit) { return hit.frequencyHz == 123.0; });
    }));
    EXPECT_GT(model.editCount(), edits) << "the document has to be saved";
    ASSERT_EQ(model.savedSession().log.strikes.size(), 1U);
}

TEST_F(OscOfMixer, StripsAndSilenceAreMovedInTheMixer) {
    listen();
    send("/physvib/gain", {{"channel", 2.0}, {"value", 0.5}});
    send("/physvib/mute", {{"channel", 1.0}, {"on", 1.0}});
    send("/physvib/silence", {{"on", 1.0}});
    send("/phone/gravity", {{"", 0.0}});
    EXPECT_TRUE(runUntil([&] { return model.isSilent(); }));
    EXPECT_NEAR(model.mix().strips[1].gainDb, -6.02, 0.01);
    EXPECT_TRUE(model.mix().strips[0].isMuted);
    model.undoManager().undo();
    EXPECT_EQ(model.mix().strips[1].gainDb, 0.0);
    send("/physvib/delay", {{"channel", 1.0}, {"seconds", 0.01}});
    send("/physvib/mute", {{"channel", 9.0}, {"on", 1.0}});
    EXPECT_TRUE(runUntil([&] { return counts().refused == 3; }));
}

TEST_F(OscOfMixer, WhatComesDuringADragNeitherSplitsItsStepNorIsUndoneWithIt) {
    listen();
    MixerView view{model};
    auto& world = view.world().view();
    auto& history = model.undoManager();
    const auto layout = layoutJson(model.mix().layout);
    bool isMuted = false;
    const auto toggleMute = [&] {
        isMuted = !isMuted;
        send("/physvib/mute", {{"channel", 2.0}, {"on", isMuted ? 1.0 : 0.0}});
        return runUntil([&] { return model.mix().strips[1].isMuted == isMuted; });
    };
    for (const bool isEscaped : {false, true}) {
        juce::ModifierKeys::currentModifiers = juce::ModifierKeys::leftButtonModifier;
        world.onMove(0, {0.3, 0.5});
        ASSERT_TRUE(toggleMute());
        world.onMove(0, {0.4, 0.5});
        isEscaped ? view.world().cancelDrag() : (void)history.undo();
        juce::ModifierKeys::currentModifiers = {};
        EXPECT_EQ(layoutJson(model.mix().layout), layout) << isEscaped;
        EXPECT_EQ(model.mix().strips[1].isMuted, isMuted) << isEscaped;
        EXPECT_FALSE(history.canUndo()) << isEscaped;
        EXPECT_TRUE(history.redo() && history.undo());
        EXPECT_EQ(model.mix().strips[1].isMuted, isMuted) << isEscaped;
        view.world().mouseUp(mouseAt(world, {}));
    }
    for (const double x : {0.3, 0.4, 0.5}) world.onMove(0, {x, 0.5}), history.beginNewTransaction();
    history.undo();
    juce::ModifierKeys::currentModifiers = juce::ModifierKeys::leftButtonModifier;
    ASSERT_TRUE(toggleMute());
    juce::ModifierKeys::currentModifiers = {};
    while (history.undo()) EXPECT_EQ(model.mix().strips[1].isMuted, isMuted);
    while (history.redo()) EXPECT_EQ(model.mix().strips[1].isMuted, isMuted);
    view.world().mouseUp(mouseAt(world, {}));
    ASSERT_TRUE(toggleMute());
    world.onMove(0, {0.3, 0.5});
    history.undo();
    view.world().cancelDrag();
    EXPECT_EQ(history.getUndoDescription(), "Strips by message") << "of the drag nothing was left";
}

TEST_F(OscOfMixer, TheSignOfAGainIsTheStripsPolarityAndItsSizeTheFader) {
    listen();
    struct Gain {
        double value, faderDb;
        bool isInverted;
    };
    bool isMuted = false;
    for (const auto& [value, faderDb, isInverted] :
         {Gain{-1.0, 0.0, true}, Gain{0.5, -6.02, false}, Gain{-0.25, -12.04, true},
          Gain{0.0, minStripDb, false}}) {
        send("/physvib/gain", {{"channel", 2.0}, {"value", value}});
        isMuted = !isMuted; // comes behind the gain, and so tells that it has come
        send("/physvib/mute", {{"channel", 1.0}, {"on", isMuted ? 1.0 : 0.0}});
        ASSERT_TRUE(runUntil([&] { return model.mix().strips[0].isMuted == isMuted; }));
        EXPECT_NEAR(model.mix().strips[1].gainDb, faderDb, 0.01) << value;
        EXPECT_EQ(model.mix().strips[1].isInverted, isInverted) << value;
        EXPECT_FALSE(model.mix().strips[0].isInverted) << "another strip";
    }
    EXPECT_EQ(counts().refused, 0U);
}

// The window's thread does nothing here: what is for it waits, and is refused at last.
TEST_F(OscOfMixer, SilenceNeitherWaitsForTheWindowNorNeedsRoom) {
    listen();
    const auto comes = [&](auto isTrue) {
        for (int k = 0; k < 6000 && !isTrue(); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
        return isTrue();
    };
    auto socket = sender();
    const auto mute = oscPacket("/physvib/mute", {"", {{"channel", 1.0}, {"on", 1.0}}});
    for (std::uint64_t k = 0; k < 1200; k += 100) { // the system's buffer is small
        for (int one = 0; one < 100; ++one) socket.send(mute);
        ASSERT_TRUE(comes([&] { return counts().messages == k + 100; }));
    }
    ASSERT_EQ(counts().refused, 200U);
    EXPECT_EQ(counts().lastError.substr(counts().lastError.find(": ") + 2), "too many inputs at once");
    EXPECT_TRUE(socket.send(oscPacket("/physvib/silence", {"", {{"on", 1.0}}})));
    EXPECT_TRUE(comes([&] { return model.output().isSilent(); }));
    ASSERT_TRUE(comes([&] { return counts().messages == 1201; }));
    EXPECT_EQ(counts().refused, 200U) << "silence is never refused for want of room";
    EXPECT_FALSE(model.isSilent()) << "not yet shown";
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.isSilent(); }));
}

TEST_F(OscOfMixer, WhatTheMixerRefusesIsReportedToItsSender) {
    listen();
    auto socket = sender();
    using namespace std::string_literals;
    ASSERT_TRUE(socket.send(
        oscPacket("/physvib/impulse", {"", {{"body", "nobody"s}, {"impulse_ns", std::vector{0.0, 1.0}}}})));
    ASSERT_TRUE(runUntil([&] { return socket.wait(0); }));
    const auto error = readOscPacket(*socket.receive()).value.at(0);
    EXPECT_EQ(error.address, oscErrorAddress);
    EXPECT_EQ(std::get<std::string>(error.values.at(0)), "/physvib/impulse");
    EXPECT_NE(std::get<std::string>(error.values.at(1)).find("nobody"), std::string::npos);
}

TEST_F(OscOfMixer, WhatAPersonSilencedIsLiftedAtTheMachineAlone) {
    listen();
    model.setSilent(true);
    send("/physvib/silence", {{"on", 1.0}});
    ASSERT_TRUE(runUntil([&] { return counts().messages == 1; }));
    send("/physvib/silence", {{"on", 0.0}});
    EXPECT_TRUE(runUntil([&] { return counts().messages == 2 && counts().refused == 1; }))
        << "that it did not help is said";
    EXPECT_EQ(counts().lastError, "silence: still asked for at the machine");
    EXPECT_TRUE(model.isSilent());
    EXPECT_TRUE(model.output().isSilent());
    model.setSilent(false);
    EXPECT_FALSE(model.output().isSilent());
    send("/physvib/silence", {{"on", 1.0}});
    EXPECT_TRUE(runUntil([&] { return model.isSilent(); }));
    model.setSilent(false);
    EXPECT_FALSE(model.isSilent()) << "a person lifts what OSC asked for as well";
    EXPECT_FALSE(model.output().isSilent());
}

TEST_F(OscOfMixer, APhoneTiltsTheWorld) {
    listen();
    auto socket = sender();
    using namespace std::string_literals;
    const auto upsideDown = "/accelerometer\0\0,fff\0\0\0\0\0\0\0\0\xc1\x1c\xf5\xc3\0\0\0\0"s; // y: -9.81
    EXPECT_TRUE(socket.send({upsideDown.data(), upsideDown.size()}));
    EXPECT_TRUE(isTiltedTo([](double y) { return y > 9.8; }));
    EXPECT_EQ(counts().lastError, "");
}

TEST_F(OscInTab, HitsAreToldToWhomTheyAreWantedAsTheyAreFelt) {
    auto receiver = UdpSocket::listenAt("127.0.0.1", 0);
    ASSERT_EQ(receiver.error, "");
    auto& box = the<juce::ComboBox>(tab, "Hits by OSC");
    EXPECT_EQ(box.getText(), "nobody");
    tab.sendHitsTo("127.0.0.1:" + juce::String{receiver.value.port()});
    EXPECT_EQ(model.messageText(), "");
    EXPECT_EQ(model.inputs().choice().access, OscAccess::off) << "to tell is not to listen";
    std::vector<OscMessage> told;
    const auto hasTold = [&](const std::string& address) {
        while (const auto packet = receiver.value.receive())
            for (const OscMessage& message : readOscPacket(*packet).value) told.push_back(message);
        return std::ranges::find(told, address, &OscMessage::address) != told.end();
    };
    ASSERT_TRUE(runUntil([&] { return hasTold("/physvib/answer/status"); }))
        << "which says when a session time is";
    told.clear();
    ASSERT_TRUE(runUntil([&] { return hasTold("/physvib/hit"); })) << "without a window that looks";
    const auto hit = std::ranges::find(told, "/physvib/hit", &OscMessage::address);
    EXPECT_NE(hit->tag, oscNow) << "when hands feel it";
    EXPECT_EQ(std::get<std::string>(hit->values[2]), "frequency_hz");
    const auto hz = static_cast<float>(std::get<double>(hit->values[3]));
    EXPECT_TRUE(std::ranges::any_of(model.poll().hits, [hz](const CollisionEvent& e) {
        return static_cast<float>(e.frequencyHz) == hz;
    })) << "what was told is still shown";
    EXPECT_TRUE(messages().value.startsWith("to 127.0.0.1:")) << messages().value;
    box.setSelectedItemIndex(0, juce::sendNotificationSync);
    EXPECT_FALSE(model.inputs().status().has_value());
    box.setSelectedItemIndex(1, juce::sendNotificationSync);
    EXPECT_EQ(model.inputs().choice().receiver, "127.0.0.1:" + std::to_string(receiver.value.port()))
        << "it stays in the list";
}

TEST_F(OscInTab, AWrongReceiverIsRefusedAndAllIsAsBefore) {
    listen();
    auto& box = the<juce::ComboBox>(tab, "Hits by OSC");
    tab.sendHitsTo("my laptop");
    EXPECT_EQ(model.messageText(), "Hits by OSC: expected HOST:PORT, found \"my laptop\"");
    EXPECT_EQ(box.getText(), "nobody");
    EXPECT_EQ(model.inputs().choice(), OscChoice{OscAccess::thisComputer});
    send("/physvib/silence", {{"on", 1.0}});
    EXPECT_TRUE(runUntil([&] { return model.isSilent(); }));
}

TEST_F(OscInTab, APhoneMayBeHeldOnItsSide) {
    the<juce::ComboBox>(tab, "OSC").setSelectedItemIndex(1, juce::sendNotificationSync);
    the<juce::ComboBox>(tab, "Phone").setSelectedItemIndex(1, juce::sendNotificationSync);
    EXPECT_EQ(model.inputs().choice(), (OscChoice{OscAccess::thisComputer, {}, 90.0}));
    auto socket = sender();
    using namespace std::string_literals;
    const auto topToTheLeft = "/accelerometer\0\0,fff\0\0\0\0\x41\x1c\xf5\xc3\0\0\0\0\0\0\0\0"s; // x: 9.81
    EXPECT_TRUE(socket.send({topToTheLeft.data(), topToTheLeft.size()}));
    EXPECT_TRUE(isTiltedTo([](double y) { return y < -9.8; })) << "down is down";
}

// A game controller that is chosen in the mixer plays, is unplugged and plugged in again: each is seen.

TEST(MixerPad, IsChosenInTheOutputTabPlaysAndIsFollowedWhenItGoes) {
    GamePads pads; // before the virtual one
    ASSERT_EQ(pads.error(), "");
    VirtualPad pad{"mixed"};
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const double before = window.model().device().outputLatencySeconds();
    window.view().tabs().choose("Output");
    EXPECT_EQ(chooseIn(window.view(), "Device", "Game controller"), "Game controller: mixed");
    ASSERT_TRUE(runUntil([&] {
        return window.model().device().choice().sinks == std::vector<SinkName>{{"PAD", "mixed"}};
    }));
    ASSERT_TRUE(runUntil([&] {
        return std::abs(window.model().device().outputLatencySeconds() - before - 0.03) < 0.006;
    })) << "its lead, in the limiter's place";
    ASSERT_TRUE(runUntil([&] { return !pad.told().empty(); })) << "shake the box shakes it";
    window.model().setSilent(true);
    ASSERT_TRUE(runUntil([&] { return pad.isAtRest(); }));
    window.model().setSilent(false);

    pad.detach();
    ASSERT_TRUE(runUntil([&] {
        return window.model().messageText().contains("mixed is gone; it is looked for");
    })) << window.model().messageText();
    pad.attach();
    ASSERT_TRUE(runUntil([&] { return window.model().messageText().isEmpty(); }))
        << window.model().messageText();
}

TEST(MixerPad, OneThatIsNotPluggedInSaysSoAndDelaysNothingUntilItComes) {
    GamePads pads; // before the virtual one
    ASSERT_EQ(pads.error(), "");
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const auto latency = [&] { return window.model().device().outputLatencySeconds(); };
    const auto list = [&] { return dynamic_cast<juce::ComboBox*>(find(window.view(), "Device")); };
    const auto has = [&](const juce::String& words) {
        for (int k = 0; k < list()->getNumItems(); ++k)
            if (list()->getItemText(k) == words) return true;
        return false;
    };
    const double before = latency();
    window.view().tabs().choose("Output");
    chooseIn(window.view(), "Device", "Game controller: none is plugged in");
    auto& model = window.model();
    EXPECT_TRUE(model.messageText().contains("Its two motors follow all hits")) << model.messageText();
    ASSERT_EQ(model.messages().current().action.name, "Use it once it is there");
    EXPECT_TRUE(model.device().choice().sinks.empty());
    model.messages().current().action.run();
    ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.size() == 1; }));
    ASSERT_TRUE(runUntil([&] {
        return the(window.view(), "Board state").getDescription().contains("No controller");
    })) << the(window.view(), "Board state").getDescription();
    EXPECT_EQ(list()->getText(), "No device + Game controller");
    EXPECT_TRUE(has("Game controller: none there yet, in use"));
    EXPECT_DOUBLE_EQ(latency(), before);
    VirtualPad pad{"late"};
    ASSERT_TRUE(runUntil([&] { return latency() > before; })) << "it needs its events early";
    EXPECT_NEAR(latency(), before + 0.03, 0.006);
    ASSERT_TRUE(runUntil([&] { return has("Game controller: late, in use"); }));
    ASSERT_TRUE(runUntil([&] { return !pad.told().empty(); })) << "and plays";
    chooseIn(window.view(), "Device", "Game controller: late, in use");
    ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.empty(); })) << "and is left";
}

} // namespace physvib::mixer_osc_test
