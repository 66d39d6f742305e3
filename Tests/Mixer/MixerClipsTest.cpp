// SPDX-License-Identifier: GPL-3.0-or-later
// A file dropped on the field, a badge, a strip: felt there, saved with the session, or refused in one line.
#include "Core/NameNumbers.h"
#include "Live/Recordings/LoadRecordings.h"
#include "MixerTesting.h"

namespace physvib::mixer_clips_test {

using namespace test;

constexpr const char* knock =
    R"({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [{"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": [
    {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100}, {"relative_position": 100, "amplitude_modulation": 0}]}]}]}]}]})";

struct MixerClipsTest : testing::Test {
    TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    WorldView& field = view.world().view();
    juce::StringArray knocks{folder("knock.hjif").getFullPathName()};

    void SetUp() override {
        view.setSize(1440, 900);
        folder("knock.hjif").replaceWithText(knock);
        model.setSlowness(0); // nothing else is to be felt
    }
    void drop(juce::FileDragAndDropTarget& target, const juce::StringArray& files,
              juce::Point<float> at = {}) {
        const auto place = at.toInt();
        ASSERT_TRUE(target.isInterestedInFileDrag(files));
        target.fileDragEnter(files, place.x, place.y);
        target.fileDragMove(files, place.x, place.y);
        target.filesDropped(files, place.x, place.y);
    }
    juce::FileDragAndDropTarget& strip(const char* title) {
        return the<juce::FileDragAndDropTarget>(view, title);
    }
    /// The clip that is felt next, whoever has looked: the view does by itself.
    CollisionEvent felt() {
        std::vector<CollisionEvent> clips;
        EXPECT_TRUE(runUntil([&] {
            model.poll();
            clips.clear();
            for (const RecentContact& contact : model.recentContacts().newestFirst())
                if (isClip(contact.event.sound)) clips.push_back(contact.event);
            return clips.size() > felt_;
        }));
        felt_ = clips.size();
        return clips.empty() ? CollisionEvent{} : clips.front();
    }
    juce::String refused() {
        EXPECT_TRUE(runUntil([&] { return model.messageText().isNotEmpty(); }));
        const auto trouble = model.messageText();
        model.report({});
        return trouble;
    }

private:
    std::size_t felt_ = 0;
};

TEST_F(MixerClipsTest, InTheFieldAClipIsFeltAtThatPlace) {
    const auto edits = model.editCount();
    drop(field, knocks, field.pixelOfShare({0.3, 0.6}));
    const auto clip = felt();
    EXPECT_NEAR(clip.x, 0.3 * model.world().scene().fieldWidthMetres, 0.02);
    EXPECT_NEAR(clip.y, 0.6 * model.world().scene().fieldHeightMetres, 0.02);
    EXPECT_EQ(clip.spread, Spread::layout);
    EXPECT_TRUE(runUntil([&] { return model.editCount() > edits; })) << "the document has to be saved";
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(MixerClipsTest, OnABadgeOrAStripItIsFeltOnThatEnchanterAlone) {
    const double width = model.world().scene().fieldWidthMetres,
                 height = model.world().scene().fieldHeightMetres;
    drop(field, knocks, field.actuatorPixel(1) + juce::Point<float>{5.0f, 5.0f});
    const auto onB = felt();
    EXPECT_EQ(onB.spread, Spread::nearest);
    EXPECT_EQ(onB.x, width);
    EXPECT_EQ(onB.y, height);
    drop(strip("Strip C"), knocks);
    const auto onC = felt();
    EXPECT_EQ(onC.spread, Spread::nearest);
    EXPECT_EQ(onC.x, 0.0);
    EXPECT_EQ(onC.y, 0.0);
}

TEST_F(MixerClipsTest, RefusalsAreOneLine) {
    folder("broken.wav").replaceWithText("no sound");
    drop(field, {folder("broken.wav").getFullPathName()}, field.pixelOfShare({0.5, 0.5}));
    EXPECT_TRUE(refused().endsWith("broken.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file"));
    drop(strip("Strip A"), {"a.wav", "b.wav"});
    EXPECT_EQ(refused(), "Expected one clip, found 2 files");
    drop(strip("Strip A"), {folder("gone.ahap").getFullPathName()});
    EXPECT_TRUE(refused().contains("gone.ahap"));
    for (juce::FileDragAndDropTarget* target :
         {static_cast<juce::FileDragAndDropTarget*>(&field), &strip("Strip A")})
        EXPECT_FALSE(target->isInterestedInFileDrag({"session.json"})) << "documents are the window's";
    EXPECT_TRUE(model.savedSession().log.clips.empty());
    SessionSetup setup;
    setup.scene = model.world().scene();
    setup.panner = model.mix().panner();
    Session study{setup};
    ASSERT_TRUE(model.output().playInstead(&study));
    drop(strip("Strip A"), knocks);
    EXPECT_EQ(refused(), "clip: file: a study is running");
    model.output().playInstead(nullptr);
}

TEST_F(MixerClipsTest, ASavedSessionHasThem) {
    drop(field, knocks, field.pixelOfShare({0.5, 0.5}));
    felt();
    folder("session.json").replaceWithText(sessionJson(model.savedSession(), pathOf(folder.folder)));
    const auto read = loadSession(pathOf(folder("session.json")));
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(read.value.log.strikes.size(), 1u);
    const auto again = loadRecordings(read.value.log);
    ASSERT_EQ(again.error, "");
    EXPECT_EQ(again.value.clips.size(), 1u);
    folder("knock.hjif").appendText(" ");
    EXPECT_NE(loadRecordings(read.value.log).error.find("it has changed since"), std::string::npos);
}

TEST_F(MixerClipsTest, WhereItWouldBeFeltIsShownWhileItIsDragged) {
    const auto pixel = [&](juce::Component& c, juce::Point<float> at) {
        return c.createComponentSnapshot(c.getLocalBounds(), true, 1.0f)
            .getPixelAt(juce::roundToInt(at.x), juce::roundToInt(at.y));
    };
    const auto shown = [&](juce::FileDragAndDropTarget& target, juce::Point<float> mouse,
                           juce::Point<float> seen) {
        auto& component = dynamic_cast<juce::Component&>(target);
        const auto before = pixel(component, seen);
        target.fileDragEnter(knocks, juce::roundToInt(mouse.x), juce::roundToInt(mouse.y));
        target.fileDragMove(knocks, juce::roundToInt(mouse.x), juce::roundToInt(mouse.y));
        const auto during = pixel(component, seen);
        target.fileDragExit(knocks);
        EXPECT_EQ(pixel(component, seen), before);
        return during != before;
    };
    const auto middle = field.pixelOfShare({0.5, 0.5}), badge = field.actuatorPixel(0);
    EXPECT_TRUE(shown(field, middle, middle.translated(13.0f, 0.0f)));
    EXPECT_TRUE(shown(field, badge, badge.translated(20.0f, 0.0f)));
    EXPECT_FALSE(shown(field, badge.translated(60.0f, 60.0f), badge.translated(20.0f, 0.0f)));
    EXPECT_TRUE(shown(strip("Strip D"), {20.0f, 100.0f}, {1.0f, 100.0f}));
}

} // namespace physvib::mixer_clips_test
