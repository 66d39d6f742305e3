// SPDX-License-Identifier: GPL-3.0-or-later
// Cards that ask for files and values: names are kept, nothing is replaced by one press, Esc cancels.
#include "Mixer/Widgets/Cards.h"
#include "Mixer/Model/MixerRecording.h"
#include "MixerTesting.h"
#include <cstdlib>

namespace physvib::cards_test {

using namespace test;

struct Asked {
    TestFolder folder;
    juce::File taken;
    int cancelled = 0;
    std::unique_ptr<FileCard> card;

    explicit Asked(bool isSaving, const juce::String& name = {}) {
        folder("inner").createDirectory();
        folder("there.json").replaceWithText("{}");
        folder("picture.png").replaceWithText("x");
        card = std::make_unique<FileCard>(FileCard::Choice{"A file", ".json", folder.folder, isSaving, name});
        card->onFiles = [this](const juce::Array<juce::File>& files) { taken = files[0]; };
        card->onCancel = [this] { ++cancelled; };
    }
    juce::ListBox& list() { return the<juce::ListBox>(*card, "Files of the folder"); }
};

TEST(FileCard, ATypedNameStaysInAnotherFolderAndGetsItsEnding) {
    Asked asked{true, "session"};
    EXPECT_EQ(asked.card->name(), "session");
    asked.card->setName("my hands");
    asked.list().selectRow(0);
    asked.card->accept();
    EXPECT_EQ(asked.card->folder(), asked.folder("inner"));
    EXPECT_EQ(asked.card->name(), "my hands");
    asked.card->keyPressed(KeyPress{KeyPress::returnKey});
    EXPECT_EQ(asked.taken, asked.folder("inner").getChildFile("my hands.json"));
}

TEST(FileCard, WhatIsSaidBeforeItIsShownHasTheColoursOfTheWindow) {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};
    Asked asked{true};
    asked.card->openFolder(asked.folder("inner"));
    EXPECT_TRUE(asked.card->error().startsWith("No folders")) << asked.card->error();
    const auto& words = *find(*asked.card, "What is wrong");
    view.setCard(std::move(asked.card));
    EXPECT_EQ(words.findColour(juce::Label::textColourId), shade(view, Shade::muted));
    view.setTheme(Theme::light);
    EXPECT_EQ(words.findColour(juce::Label::textColourId), shade(view, Shade::muted));
}

TEST(FileCard, AFileIsReplacedAtTheSecondPressOnly) {
    Asked asked{true, "there"};
    asked.card->accept();
    EXPECT_EQ(asked.taken, juce::File{});
    EXPECT_TRUE(asked.card->error().contains("there.json exists")) << asked.card->error();
    asked.card->setName("there"); // typed again: asked again
    asked.card->setName("other");
    asked.card->setName("there");
    the<juce::TextEditor>(*asked.card, "Name of the file").onTextChange();
    asked.card->accept();
    EXPECT_EQ(asked.taken, juce::File{});
    asked.card->accept();
    EXPECT_EQ(asked.taken, asked.folder("there.json"));
}

TEST(FileCard, ListsFoldersAndFilesOfTheEndingAndOpensOnlyWhatIsThere) {
    Asked asked{false};
    EXPECT_EQ(asked.list().getModel()->getNumRows(), 2);
    EXPECT_EQ(asked.list().getModel()->getNameForRow(1), "there.json");
    asked.card->accept();
    EXPECT_EQ(asked.card->error(), "Expected a name");
    asked.card->setName("gone");
    asked.card->accept();
    EXPECT_TRUE(asked.card->error().contains("gone.json: expected")) << asked.card->error();
    EXPECT_EQ(asked.taken, juce::File{});
    asked.list().selectRow(1);
    EXPECT_EQ(asked.card->name(), "there");
    asked.card->accept();
    EXPECT_EQ(asked.taken, asked.folder("there.json"));
    asked.card->keyPressed(KeyPress{KeyPress::escapeKey});
    EXPECT_EQ(asked.cancelled, 1);
    Asked saved{true};
    for (const auto& [name, taken, error] :
         {std::tuple{"missing/mine", juce::File{}, "expected a folder"},
          {"inner/mine.json", saved.folder("inner").getChildFile("mine.json"), ""}}) {
        saved.card->setName(name);
        saved.card->accept();
        EXPECT_EQ(saved.taken, taken);
        EXPECT_TRUE(saved.card->error().contains(error)) << saved.card->error();
    }
}

TEST(QuestionCard, FieldsAreReadAndEscIsTheAnswerThatHasIt) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    juce::String taken;
    bool isCancelled = false;
    view.setQuestion(std::make_unique<QuestionCard>(
        "Render", "How long?",
        std::vector<QuestionCard::Answer>{
            {"Take", [&] { taken = view.question()->value("Seconds"); }},
            {"Cancel", [&] { isCancelled = true; }, true, KeyPress{KeyPress::escapeKey}}},
        std::vector<QuestionCard::Field>{{"Seconds", "2.5"}}));
    auto* editor = dynamic_cast<juce::TextEditor*>(find(view, "Seconds"));
    ASSERT_NE(editor, nullptr);
    EXPECT_GE(editor->getHeight(), 24);
    EXPECT_TRUE(view.question()->getLocalBounds().contains(
        view.question()->getLocalArea(editor, editor->getLocalBounds())));
    editor->setText("7.5", false);
    editor->onReturnKey();
    EXPECT_TRUE(runUntil([&] { return taken == "7.5"; }, 1.0)) << taken;
    editor->onEscapeKey();
    EXPECT_TRUE(runUntil([&] { return isCancelled; }, 1.0));
}

TEST(QuestionCard, APictureStandsBesideTheWordsAndFollowsWhatIsTyped) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    view.setSize(MixerView::minWidth, MixerView::minHeight);
    const auto pictureFor = [](QuestionCard& card, const juce::String& words) {
        card.setPicture(juce::Image{juce::Image::RGB, 10 * words.length(), 10 * words.length(), true});
    };
    view.setQuestion(std::make_unique<QuestionCard>(
        "Share", "Words", std::vector<QuestionCard::Answer>{{"Copy", [] {}}},
        std::vector<QuestionCard::Field>{{"Address", "short", {}, {}, pictureFor}}));
    auto* card = view.question();
    auto* editor = dynamic_cast<juce::TextEditor*>(find(view, "Address"));
    const auto middle = card->getBounds().getCentre();
    const int wide = editor->getWidth();
    for (const juce::String words : {"a little longer", "an address of thirty-seven characters"}) {
        editor->setText(words, false);
        editor->onTextChange();
        EXPECT_EQ(card->picture().getWidth(), 10 * words.length());
        EXPECT_TRUE(view.getLocalBounds().contains(card->getBounds())) << card->getBounds().toString();
        EXPECT_LE(card->getBounds().getCentre().getDistanceFrom(middle), 1);
        EXPECT_EQ(editor->getWidth(), wide) << "the picture takes nothing from the fields";
        EXPECT_GE(card->getLocalArea(editor, editor->getLocalBounds()).getX(),
                  card->picture().getWidth() + 24);
    }
    card->setPicture({});
    EXPECT_EQ(card->getWidth(), QuestionCard::cardWidth);
}

// Where recordings and documents go, in homes with and without documents.

TEST(UserFolder, IsInTheDocumentsOrTheHomeAndCreatedWhenItIsNeeded) {
    TestFolder home;
    const Home here{home.folder};
    const UserFolder folder;
    const auto documents = home("Documents/PhysVib");
    EXPECT_EQ(folder.location(), documents);
    EXPECT_FALSE(documents.exists()) << "asked for, not used";
    EXPECT_EQ(folder.create().value, documents);
    EXPECT_TRUE(documents.isDirectory());
    documents.getParentDirectory().deleteRecursively();
    home("Documents").replaceWithText("a file");
    EXPECT_EQ(folder.create().value, home("PhysVib"));
    EXPECT_TRUE(home("PhysVib").isDirectory());
}

TEST(UserFolder, WhereNothingCanBeWrittenItSaysSo) {
    TestFolder home;
    home("no").replaceWithText("a file");
    const Home here{home("no")};
    UserFolder folder;
    EXPECT_EQ(folder.location(), juce::File{});
    EXPECT_NE(folder.create().error.find("no/Documents/PhysVib: expected a folder that can be written"),
              std::string::npos)
        << folder.create().error;
    folder.choose(home("chosen"));
    EXPECT_EQ(folder.create().value, home("chosen"));
    folder.choose(home("no/such"));
    EXPECT_FALSE(folder.newFile("take", {".wav"}));
}

TEST(UserFolder, NothingIsOverwritten) {
    TestFolder home;
    UserFolder folder;
    folder.choose(home.folder);
    const juce::StringArray endings{".wav", ".csv"};
    EXPECT_EQ(folder.newFile("take", endings).value, home("take.wav"));
    home("take.csv").replaceWithText("events of another take");
    EXPECT_EQ(folder.newFile("take", endings).value, home("take-2.wav"));
    home("take-2.wav").replaceWithText("a take");
    EXPECT_EQ(folder.newFile("take", endings).value, home("take-3.wav"));
}

TEST(RenderTask, EndsWhenItIsCancelledAndSaysSoOnlyOfWhatWasNotMade) {
    for (const std::string error : {"", "cancelled", "the disk is full"}) {
        std::string told;
        const auto work = [error](const auto& progress) {
            for (int k = 0; k < 5000 && progress(0.5); ++k) juce::Thread::sleep(1);
            return error;
        };
        RenderTask task{{}, work, [&](const std::string& line, bool isCancelled) {
                            told = line + (isCancelled ? ", nothing made" : ", told");
                        }};
        the<juce::Button>(task, "Cancel the making of the file").onClick();
        EXPECT_TRUE(runUntil([&] { return !told.empty(); }, 2.0));
        EXPECT_EQ(told, error + (error == "cancelled" ? ", nothing made" : ", told"));
    }
}

} // namespace physvib::cards_test
