// SPDX-License-Identifier: GPL-3.0-or-later
// A scripted participant takes shortened versions of the thesis' studies 5.2 and 5.3: sees the world move,
// drags, tilts, chooses, rates; the log of every trial renders to what came out of the device, bit for bit.
#include "Host/FakeAudioDevice.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Recordings/ReadRecording.h"
#include "Participant.h"
#include "Scene/SceneFile.h"
#include <cmath>
#include <span>
#include <sstream>
#include <thread>

namespace physvib::world_study_test {

/// A device that plays in real time, and keeps the first channel of what it plays.
class Hands {
public:
    Hands()
        : thread_{[this] { run(); }} {}
    ~Hands() {
        stop_ = true;
        thread_.join();
    }
    AudioDrivers drivers() { return test::fakeDrivers({&thing_}); }
    std::vector<float> felt() {
        const std::lock_guard lock{mutex_};
        return felt_;
    }

private:
    void run() {
        while (!stop_) {
            const auto block = thing_.play(thing_.block);
            if (const std::lock_guard lock{mutex_}; !block.empty())
                felt_.insert(felt_.end(), block[0].begin(), block[0].end());
            std::this_thread::sleep_for(std::chrono::microseconds{1'000'000 * thing_.block / 48'000});
        }
    }
    test::FakeInterface thing_;
    std::vector<float> felt_;
    std::mutex mutex_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

class AWorldInAStudy : public test::StudyTest {
protected:
    AWorldInAStudy() {
        p.model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
        p.model.setDisplayWidth(1440.0 / 4000.0); // of the test's display: 4 pixels per mm
    }
    void begin(const std::string& protocol) { StudyTest::begin(p, protocol); }
    /// Of each part of a trial, as the row tells them.
    std::vector<double> levels(std::size_t trial, const std::string& column) const {
        const auto table = rows();
        std::istringstream cell{table.rows.at(trial).cells[*table.column(column)]};
        std::vector<double> all;
        for (std::string level; std::getline(cell, level, '|');) all.push_back(std::stod(level));
        EXPECT_EQ(all.size(), 3u);
        return all;
    }
    /// The calls of every row, one by one.
    std::vector<std::string> calls() const {
        std::vector<std::string> all;
        const auto table = rows();
        for (const auto& row : table.rows) {
            std::string words = row.cells[*table.column("render")];
            for (std::size_t end; (end = words.find(" ; ")) != std::string::npos; words.erase(0, end + 3))
                all.push_back(words.substr(0, end));
            all.push_back(words);
        }
        return all;
    }
    /// What `physvib` makes of a call, in the folder of the trial file.
    std::vector<float> rendered(const std::string& call) const {
        this->call(call + " --out again.wav > /dev/null");
        const auto wav = readRecording(folder.getChildFile("again.wav").getFullPathName().toStdString());
        EXPECT_TRUE(wav) << wav.error;
        return wav.value.channels.empty() ? std::vector<float>{} : wav.value.channels[0];
    }
    /// The peak in g that rendering a call prints, "(1.50 g)".
    double printedG(const std::string& call) const {
        this->call(call + " --out again.wav > printed.txt");
        const auto words = folder.getChildFile("printed.txt")
                               .loadFileAsString()
                               .fromFirstOccurrenceOf("peak ", false, false);
        return words.fromFirstOccurrenceOf("(", false, false).getDoubleValue();
    }
    /// How far the two agree where they agree longest.
    static std::string agreement(std::span<const float> samples, std::span<const float> felt) {
        std::size_t most = 0, at = 0;
        for (std::size_t i = 0; i < felt.size(); ++i) {
            if (felt[i] != samples[0]) continue;
            const auto n = static_cast<std::size_t>(std::ranges::mismatch(samples, felt.subspan(i)).in1 -
                                                    samples.begin());
            if (n > most) most = n, at = i;
        }
        std::ostringstream words;
        words << most << " of " << samples.size() << " samples agree";
        if (most < samples.size() && at + most < felt.size())
            words << ", then " << felt[at + most] << " for " << samples[most];
        return words.str();
    }
    /// Each call renders to a stretch of what was felt, in their order, from its first sound to its end.
    void expectFelt(const std::vector<std::string>& all) {
        const auto felt = hands.felt();
        auto from = felt.begin();
        for (const auto& call : all) {
            auto samples = rendered(call);
            const auto sounds = std::ranges::find_if(samples, [](float s) { return s != 0.0f; });
            ASSERT_NE(sounds, samples.end()) << call << ": nothing was to be felt";
            const auto last =
                std::find_if(samples.rbegin(), samples.rend(), [](float s) { return s != 0.0f; }).base();
            const auto found = std::search(from, felt.end(), sounds, last);
            ASSERT_NE(found, felt.end()) << call << ": was not what came out of the device; "
                                         << agreement({sounds, last}, {from, felt.end()});
            from = found + (last - sounds);
        }
    }

    Hands hands;
    test::Participant p{hands.drivers(), "Fake:hands"};
};

constexpr const char* fallingObjects =
    R"({"physvib_protocol": 1, "name": "short", "seed": 7, "sounds": [{"frequency_hz": 80, "file": "synthetic-1"},
  {"frequency_hz": 349, "file": "synthetic-1"}, {"frequency_hz": 430, "file": "synthetic-1"}], "closing_question": "How did you choose?",
  "conditions": [{"name": "drop", "layout": "phone1", "stimuli": "world", "factors": [{"name": "pair", "values": ["wood-wood"]}, {"name": "height", "values": ["1"]}],
    "call": "render drop --set pair={pair} --set height={height} --set falls=once --seconds 0.8 --layout phone1 --method {alternative} --sound-match rms --level-db {level_db}"}],
  "sessions": [{"name": "matching", "training": true, "task": "adjust", "alternatives": [{"name": "AV-FV-DRV"}, {"name": "SV", "level_db": -12}],
                "adjustment": {"alternative": "AV-FV-DRV", "start_db": -12, "step_db": 2, "least_db": -30, "most_db": -6}},
               {"name": "main", "task": "choose", "both_orders": true, "alternatives": [{"name": "AV-FV-DRV"}, {"name": "SV", "level_db": -12}], "levels_from": "matching"}]})";

TEST_F(AWorldInAStudy, FallsIsFeltAndChosenAndEveryLogRendersWhatWasFelt) {
    begin(fallingObjects);
    p.click("Next");
    const auto fall = [&] {
        const int before = p.screen()->plays();
        p.space();
        ASSERT_TRUE(
            test::runUntil([&] { return p.screen()->plays() > before && p.screen()->isStimulusPlaying(); }));
        auto& view = p.world();
        const auto start = view.pixelOfBody("wood sphere");
        EXPECT_TRUE(test::runUntil([&] {
            return p.pump(), view.pixelOfBody("wood sphere").y > start.y + 20.0f;
        })) << "it falls";
        ASSERT_TRUE(test::runUntil([&] { return p.pump(), !p.screen()->isStimulusPlaying(); }));
        p.pump();
    };
    fall();
    fall();
    p.click("Softer");
    fall();
    p.click("Next");
    p.click("Next"); // the page between the sessions
    for (int n = 0; n < 2; ++n) {
        fall();
        EXPECT_FALSE(p.isAnswerOpen("Answer: number 1")) << "the second was not felt";
        fall();
        p.click("Answer: number 1");
        p.click("Next");
    }
    ASSERT_EQ(p.screen()->page(), StudyScreen::Page::comment);
    auto* comment = dynamic_cast<juce::TextEditor*>(p.find("Comment"));
    ASSERT_NE(comment, nullptr);
    comment->setText("The first one rang.");
    p.click("Next");
    EXPECT_EQ(p.screen()->page(), StudyScreen::Page::done);
    EXPECT_EQ(folder.getChildFile("short-P01.comment.txt").loadFileAsString(),
              "How did you choose?\n\nThe first one rang.\n");
    const auto all = calls();
    ASSERT_EQ(all.size(), 3u + 2u * 2u);
    EXPECT_EQ(all.front(), "render short-P01.felt/trial-0001-1.json");
    const auto softer =
        loadSession(folder.getChildFile("short-P01.felt/trial-0001-3.json").getFullPathName().toStdString());
    ASSERT_TRUE(softer) << softer.error;
    EXPECT_NEAR(softer.value.shaping.gain, std::pow(10.0, -14.0 / 20.0), 1e-12)
        << "at the level that was set";
    expectFelt(all);
}

constexpr const char* shakenBox = R"({"physvib_protocol": 1, "name": "short", "seed": 7,
  "conditions": [{"name": "box", "layout": "study1", "stimuli": "world", "hands": true, "factors": [{"name": "method", "values": ["AV-FV-DRV", "AF-FF-DRF"]}],
    "call": "render box-study --set pair={object} --layout study1 --method {method}"}],
  "sessions": [{"name": "main", "task": "rate", "order": "given", "least_s": 0.6, "scales": ["realism", "liking"], "definitions": ["The vibration felt realistic.", "I liked it."],
                "objects": ["rubber-concrete", "wood-wood", "steel-steel"]}]})";

TEST_F(AWorldInAStudy, IsDraggedTiltedAndRatedAndEveryLogRendersWhatWasFelt) {
    begin(shakenBox);
    p.click("Next");
    std::vector<std::string> methods;
    for (int trial = 0; trial < 2; ++trial) {
        methods.push_back(p.experiment().trial().stimulus);
        auto& view = p.world();
        for (int part = 1; part <= 3; ++part) {
            EXPECT_FALSE(p.isAnswerOpen("Pause")) << "not each was felt for long enough";
            if (part == 2)
                p.type("2");
            else
                p.click("Feel number " + juce::String{part});
            ASSERT_TRUE(test::runUntil([&] {
                return p.pump(), p.screen()->isStimulusPlaying() && p.screen()->world().world().isMoving() &&
                                     p.screen()->plays() == part;
            }));
            const auto start = view.pixelOfBody("large 1");
            EXPECT_TRUE(test::runUntil([&] {
                return p.pump(), view.pixelOfBody("large 1").y > start.y + 20.0f;
            })) << "the world moves";
            const auto ball = p.view.getLocalPoint(&view, view.pixelOfBody("large 2"));
            p.drag(ball, ball + juce::Point<float>{24.0f, -32.0f}); // 10 mm
            for (int k = 0; k < 6; ++k) p.key(juce::KeyPress::leftKey);
            const double before = p.screen()->world().world().playedSeconds();
            EXPECT_TRUE(test::runUntil(
                [&] { return p.pump(), p.screen()->world().world().playedSeconds() > before + 0.7; }));
            EXPECT_EQ(p.find("Realism"), nullptr) << "rated when the world stands still";
        }
        p.click("Pause");
        ASSERT_TRUE(p.canUse("Realism"));
        EXPECT_FALSE(p.isAnswerOpen("Next"));
        for (const char* scale : {"Realism", "Liking"}) p.click(scale, trial == 0 ? 120.0f : -120.0f);
        p.click("Next");
    }
    EXPECT_EQ(p.screen()->page(), StudyScreen::Page::done);
    const auto all = calls();
    ASSERT_EQ(all.size(), 6u);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto saved = loadSession((folder.getFullPathName().toStdString() + "/" + all[i].substr(7)));
        ASSERT_TRUE(saved) << saved.error;
        const auto name = nameOf(saved.value.shaping.method);
        EXPECT_EQ(std::string(name.begin(), name.end()), methods[i / 3]);
        const auto& inputs = saved.value.log.runs.at(0).inputs;
        const auto dragged = std::ranges::find_if(inputs, [](const LiveInput& input) {
            return std::holds_alternative<ImpulseAction>(input.action);
        });
        ASSERT_NE(dragged, inputs.end());
        const auto& push = std::get<ImpulseAction>(dragged->action).impulseNewtonSeconds;
        EXPECT_NEAR(std::hypot(push.x, push.y), 320.0, 0.1);
        ASSERT_TRUE(std::holds_alternative<TiltAction>(inputs.back().action));
        EXPECT_NEAR(std::get<TiltAction>(inputs.back().action).angleRadians, -juce::degreesToRadians(30.0),
                    1e-9);
    }
    expectFelt(all);
    for (const double peak : levels(1, "peak_g"))
        EXPECT_NEAR(peak, 1.5, 0.015) << "a fixed level, whatever hit what";
    for (std::size_t part = 0; part < 3; ++part)
        EXPECT_NEAR(printedG(all[3 + part]), levels(1, "peak_g")[part], 0.006) << "printed as in the row";
    EXPECT_NE(folder.getChildFile("short-P01.felt/trial-0001-1.json").loadFileAsString().indexOf("study1"),
              -1);
    for (const double rms : levels(1, "rms_g")) EXPECT_GT(rms, 0.0);
    for (const double peak : levels(0, "peak_g")) EXPECT_GT(peak, 0.0);
}

TEST_F(AWorldInAStudy, IsPlayedWithAndRatedByKeysAlone) {
    begin(shakenBox);
    p.enter();
    auto& world = p.screen()->world().world();
    for (int part = 1; part <= 3; ++part) {
        p.type(juce::String{part});
        ASSERT_TRUE(
            test::runUntil([&] { return p.pump(), world.isMoving() && p.screen()->plays() == part; }));
        p.key(juce::KeyPress::rightKey);
        EXPECT_TRUE(test::runUntil([&] { return p.pump(), world.playedSeconds() > 0.7; }));
    }
    p.space();
    ASSERT_TRUE(p.canUse("Realism"));
    EXPECT_TRUE(test::runUntil([&] { return p.pump(), p.find("Realism")->hasKeyboardFocus(true); }));
    for (const int code : {juce::KeyPress::rightKey, juce::KeyPress::tabKey, juce::KeyPress::leftKey,
                           juce::KeyPress::returnKey})
        p.key(code);
    EXPECT_EQ(p.experiment().answeredTrials(), 1);
    const auto table = rows();
    EXPECT_EQ(table.rows.at(0).cells[*table.column("realism")], "51");
    EXPECT_EQ(table.rows.at(0).cells[*table.column("liking")], "49");
}

TEST_F(AWorldInAStudy, ASceneAndWordsMayLieBesideTheProtocol) {
    folder.getChildFile("own.json").replaceWithText(utf8(sceneJson(findScene("drop").value)));
    folder.getChildFile("words.json")
        .replaceWithText(R"({"physvib_words": 1, "name": "xx", "language": "X", "texts": {"Begin": "Los"}})");
    begin(
        R"({"physvib_protocol": 1, "name": "short", "words": "words.json", "conditions": [{"name": "own", "layout": "phone1", "stimuli": "world",
  "factors": [{"name": "scene", "values": ["own"]}], "call": "render {scene}.json --seconds 0.2 --layout phone1"}], "sessions": [{"name": "main", "task": "estimate"}]})");
    EXPECT_EQ(p.screen()->texts()("Begin"), "Los");
    p.click("Next");
    p.feel();
    EXPECT_EQ(p.screen()->page(), StudyScreen::Page::trial) << p.words();
    EXPECT_TRUE(folder.getChildFile("short-P01.felt/trial-0001-1.json").existsAsFile());
}

/// The falling objects, with more in their world and at their top.
std::string fallingWith(const std::string& inWorld, const std::string& atTop = {}) {
    std::string text = fallingObjects;
    const std::string world = R"("stimuli": "world",)", top = R"("seed": 7,)";
    text.replace(text.find(world), world.size(), world + inWorld);
    return text.replace(text.find(top), top.size(), top + atTop);
}

TEST_F(AWorldInAStudy, IsSeenAtTheScaleOfTheProtocol) {
    begin(fallingWith(R"( "display_scale": 100,)"));
    p.click("Next");
    auto& view = p.world();
    EXPECT_NEAR(view.pixelsPerMetre(), 40.0f, 0.01f) << "4 pixels per mm, and 1 m is 10 mm";
    EXPECT_TRUE(view.fits());
    p.tab().end();
    folder.getChildFile("short-P01.csv").deleteFile();
    begin(fallingWith(R"( "display_scale": 10,)"));
    p.click("Next");
    p.space();
    EXPECT_TRUE(test::runUntil([&] { return p.pump(), p.screen()->page() == StudyScreen::Page::error; }));
    EXPECT_TRUE(p.words().contains("as the world is 800 x 450 mm at 1:10")) << p.words();
    p.tab().end();
    p.model.setDisplayWidth(0.0);
    EXPECT_NE(p.tab().begin().find("display_scale: expected the width of the display to be set"),
              std::string::npos);
    EXPECT_EQ(p.screen(), nullptr);
}

TEST_F(AWorldInAStudy, MaterialsMayHaveAPictureOfTheParticipantsOwn) {
    const auto file = folder.getChildFile("pictures/P01-wood.png");
    const auto protocol =
        fallingWith({}, R"( "pictures": [{"material": "wood", "file": "pictures/{participant}-wood.png"}],)");
    ASSERT_EQ(choose(p, protocol), "");
    EXPECT_NE(p.tab().begin().find("pictures[0].file: "), std::string::npos) << "there is none yet";
    file.create();
    file.replaceWithText("no picture");
    EXPECT_NE(p.tab().begin().find("P01-wood.png: expected a PNG picture of at most 4096 x 4096 pixels"),
              std::string::npos);
    juce::Image red{juce::Image::RGB, 40, 30, true};
    red.clear(red.getBounds(), juce::Colours::red);
    juce::MemoryOutputStream png;
    juce::PNGImageFormat{}.writeImageToStream(red, png);
    auto huge = png.getMemoryBlock();
    huge[16] = 1; // wider than anybody holds
    file.replaceWithData(huge.getData(), huge.getSize());
    EXPECT_NE(p.tab().begin().find("expected a PNG picture of at most"), std::string::npos);
    file.replaceWithData(png.getData(), png.getDataSize());
    goOn(p);
    p.click("Next");
    auto& view = p.world();
    const auto seen = view.createComponentSnapshot(view.getLocalBounds());
    int reds = 0; // neither the textures nor the screen have any
    for (int y = 0; y < seen.getHeight(); ++y)
        for (int x = 0; x < seen.getWidth(); ++x) {
            const auto colour = seen.getPixelAt(x, y);
            reds += colour.getRed() > 200 && colour.getGreen() < 40 && colour.getBlue() < 40;
        }
    EXPECT_GT(reds, 100) << "what is of wood is shown by the picture";
}

} // namespace physvib::world_study_test
