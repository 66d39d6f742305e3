// SPDX-License-Identifier: GPL-3.0-or-later
// A board chosen in the mixer's window plays, loses its power and gets it back: each is seen, none is silent.
#include "Mixer/MixerTesting.h"
#include "Mixer/Window/MixerWindow.h"
#include "VirtualBoard.h"

namespace physvib::mixer_board_test {

using namespace test;
/// Of the one sink that is wanted; not ready while there is none.
SinkState beside(MixerModel& model) {
    const auto states = model.rig().sinkStates();
    return states.empty() ? SinkState{} : states.front();
}

juce::Button* buttonOf(juce::Component& window, const juce::String& words) {
    for (auto* child : window.getChildren())
        if (auto* button = dynamic_cast<juce::Button*>(child);
            button != nullptr && button->getButtonText() == words)
            return button;
    return nullptr;
}

TEST(MixerBoard, IsChosenPlaysIsUnpluggedAndPluggedInAgain) {
    VirtualBoard board;
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const auto boardText = [&] { return find(window.view(), "Board state")->getDescription(); };
    EXPECT_TRUE(runUntil([&] { return boardText().contains("Board: none"); }));
    window.view().tabs().choose("Output");
    chooseIn(window.view(), "Device", "Four-channel board: another serial port");
    ASSERT_TRUE(runUntil([&] { return window.view().question() != nullptr; }));
    auto* connect = buttonOf(*window.view().question(), "Connect");
    ASSERT_NE(connect, nullptr);
    window.view().question()->setValue("Serial port", board.port());
    connect->triggerClick();

    ASSERT_TRUE(runUntil([&] { return beside(window.model()).isReady; }));
    ASSERT_TRUE(runUntil([&] { return beside(window.model()).sent > 5 && board.last("sound") > 0; }));
    ASSERT_TRUE(runUntil([&] { return boardText().contains("ready"); }));
    ASSERT_TRUE(runUntil([&] { return window.model().messageText().isEmpty(); }))
        << window.model().messageText();

    board.stop();
    ASSERT_TRUE(runUntil([&] {
        return window.model().messageText().contains(board.port()) &&
               window.model().messageText().contains("is gone");
    })) << window.model().messageText();
    ASSERT_TRUE(runUntil([&] { return boardText().contains("No board"); }));
    EXPECT_FALSE(beside(window.model()).isReady);
    auto& outputs = dynamic_cast<juce::ComboBox&>(*find(window.view(), "Device"));
    EXPECT_TRUE(outputs.isShowing()) << "the tab in which it was chosen";
    EXPECT_EQ(outputs.getText(), "No device + Four-channel board")
        << "what is wanted, though it is not there";
    juce::StringArray rows;
    for (int k = 0; k < outputs.getNumItems(); ++k) rows.add(outputs.getItemText(k));
    EXPECT_TRUE(
        rows.contains("Four-channel board: " + juce::String{board.port()} + " is not there yet, in use"))
        << rows.joinIntoString("; ");

    board.start();
    ASSERT_TRUE(runUntil([&] { return beside(window.model()).isReady; }));
    const auto sent = beside(window.model()).sent;
    ASSERT_TRUE(runUntil([&] {
        return beside(window.model()).sent > sent + 3 && window.model().messageText().isEmpty();
    })) << window.model().messageText();
    ASSERT_TRUE(runUntil([&] { return boardText().contains("ready"); }));
}

TEST(MixerBoard, OneThatIsNotThereDelaysNothingUntilItComes) {
    VirtualBoard board;
    board.stop();
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const auto latency = [&] { return window.model().device().outputLatencySeconds(); };
    const double before = latency();
    DeviceChoice choice = window.model().device().choice();
    choice.sinks = {{"BOARD", board.port()}};
    window.model().device().onSinksRequested(choice);
    ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.size() == 1; }));
    runFor(0.5);
    EXPECT_DOUBLE_EQ(latency(), before);
    board.start();
    ASSERT_TRUE(runUntil([&] { return latency() > before; })) << "it needs its events early";
    EXPECT_NEAR(latency(), before + 0.05, 0.006);
    ASSERT_TRUE(runUntil([&] { return beside(window.model()).sent > 3; })) << "and plays";
}

TEST(MixerBoard, IsChosenAtTheFirstStartAndTestedWhenItAnswers) {
    VirtualBoard board;
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    DeviceChoice choice = noDevice;
    choice.sinks = {{"BOARD", board.port()}};
    window.view().setFirstStart(std::make_unique<FirstStart>(
        window.model(), std::vector<PlaybackChoice>{{"Four-channel board", choice, 4, true}}));
    window.view().firstStart()->onSink = [&](const DeviceChoice& chosen) {
        window.model().device().onSinksRequested(chosen);
    };
    ASSERT_TRUE(window.view().keyPressed(juce::KeyPress{juce::KeyPress::returnKey})) << "one key";
    ASSERT_TRUE(runUntil(
        [&] { return window.view().firstStart() != nullptr && window.view().firstStart()->tested() == 0; }));
    EXPECT_EQ(window.model().mix().count(), 4);
    EXPECT_EQ(window.model().mix().levelDb, FirstStart::startDb) << "quiet";
    ASSERT_TRUE(runUntil([&] { return board.last("sound") > 0; })) << "the pulse waited for the board";
    window.view().keyPressed(juce::KeyPress{juce::KeyPress::returnKey});
    EXPECT_EQ(window.view().firstStart()->tested(), 1);
}

TEST(MixerBoard, ThatDoesNotAnswerIsTold) {
    MixerModel model{onlyNoDevice(), {noDevice.name, 48000, 128, {{"BOARD", "/nowhere/port"}}}};
    EXPECT_TRUE(runUntil([&] {
        return model.poll(),
               model.messageText().startsWith(
                   "The board at /nowhere/port does not answer; it is looked for twice a second (");
    })) << model.messageText();
    EXPECT_TRUE(model.poll().device.isRunning) << "the device plays on";
}

} // namespace physvib::mixer_board_test
