// SPDX-License-Identifier: MIT
// Whatever comes to a session in whatever order: its controls are in time order, what is kept of a file is
// what stood in it, and every argument of every message counts for itself alone.
#include "FakeHost.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Messages/MessageValues.h"
#include "Scene/SceneFile.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace physvib::order_of_inputs_test {

using namespace test;
using Kind = RenderControl::Kind;

TEST(OrderOfInputs, ControlsAndStopsAreInTimeOrderHoweverTheyCame) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        Random random{seed};
        SessionSetup setup = shakeTheBoxSetup(0.02);
        if (seed % 2 == 0) setup.direct = Direct::inputs; // what is told acts before what the world does
        Session session{setup};
        session.prepare(hostRate, 480);
        Block block;
        SessionLog log;
        std::int64_t last = 0;
        std::size_t seen = 0;
        for (int i = 0; i < 60; ++i) {
            for (int n = random.below(4); n > 0; --n) {
                if (random.below(2) == 0) {
                    Input stop{Stop{}};
                    stop.timeNs = session.status().sessionNs + (random.below(220) - 20) * 1'000'000LL;
                    const auto at = session.submit(std::move(stop));
                    const Timeline& time = session.timeline();
                    EXPECT_GE(at.value, std::max<std::int64_t>(0, time.presentNs() - time.inputLeadNs()))
                        << "not in what was felt";
                } else {
                    RenderControl gain{.kind = Kind::gain, .channel = random.below(hostChannels)};
                    gain.value = 0.01f * static_cast<float>(random.below(100));
                    EXPECT_EQ(session.submit({gain}).error, "");
                }
            }
            session.advance();
            session.render(block.at.data(), 480, RenderMode::realtime);
            drain(session);
            session.readLog(log);
            for (; seen < log.channels.size(); ++seen) {
                EXPECT_GE(log.channels[seen].timeNs, last) << "seed " << seed << ", " << seen;
                last = log.channels[seen].timeNs;
            }
        }
        EXPECT_GT(seen, 40U);
    }
}

/// A file that changed on the disk has another hash, and is another file.
TEST(OrderOfInputs, AClipIsKnownByWhatIsInItAndWhereItStands) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(hostRate, 480);
    const auto keep = [&](const char* path, const char* hash) {
        const std::array clip{ContactRecording{0.0, hostRate, {0.1f, 0.2f}, {.path = path, .hash = hash}}};
        return session.addClip(clip);
    };
    const std::vector<std::pair<const char*, const char*>> files{
        {"a.wav", "00"}, {"a.wav", "01"}, {"b.wav", "00"}, {"a.wav", "10"}, {"b.wav", "01"}};
    std::set<int> numbers;
    std::vector<std::optional<int>> first;
    for (const auto& [path, hash] : files) {
        first.push_back(keep(path, hash));
        ASSERT_TRUE(first.back());
        EXPECT_TRUE(numbers.insert(*first.back()).second) << path << ' ' << hash;
    }
    for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(keep(files[i].first, files[i].second), first[i]);
}

/// Six actuators in space, on a field of other proportions than their own.
SessionSetup inSpace() {
    SessionSetup setup = emptyBoxSetup(0.05);
    setup.scene.materials.push_back(
        {.name = "bell", .densityKgPerSquareMetre = 850, .frequencyHz = 220, .decayPerSecond = 12});
    ActuatorLayout layout{0.2, 0.1, 6, {}};
    for (int j = 0; j < 6; ++j)
        layout.places[static_cast<std::size_t>(j)] = {0.04 * j, 0.02 * j, 0.01 * (j + 1)};
    setup.panner = {layout, PanningLaw::distance, 1.0, 3.0, 0.7};
    return setup;
}

std::vector<CollisionEvent> strikesOf(const std::string& line, const SessionSetup& setup) {
    const auto read = readInputLine(line, {}, setup.panner.layout().count);
    EXPECT_EQ(read.error, "") << line;
    const auto* message = std::get_if<PlainMessage>(&read.value);
    if (message == nullptr) return {};
    const auto found = std::ranges::find(messageTable, message->name, &MessageDescription::name);
    return std::get<MessageDescription::Strikes*>(found->action)({*message, *found, setup.panner},
                                                                 setup.scene.materials, setup.shaping);
}

/// Each axis of a place by letter is scaled as the panner scales the layout: x and depth by the widths, y by
/// the heights.
TEST(MessageArguments, APlaceByLetterIsThatActuatorOnEachAxis) {
    const SessionSetup setup = inSpace();
    for (int j = 0; j < 6; ++j) {
        const std::string letter(1, static_cast<char>('A' + j));
        const ActuatorPlace at = setup.panner.layout().places[static_cast<std::size_t>(j)];
        const auto events = strikesOf(R"({"message": "phantom", "place": ")" + letter + "\"}", setup);
        ASSERT_EQ(events.size(), 1U);
        EXPECT_NEAR(events[0].x, at.xMetres * 3.0 / 0.2, 1e-12) << letter;
        EXPECT_NEAR(events[0].y, at.yMetres * 0.7 / 0.1, 1e-12) << letter;
        EXPECT_NEAR(events[0].z, at.zMetres * 3.0 / 0.2, 1e-12) << letter;
    }
    const auto path = strikesOf(R"({"message": "path", "places": "BF"})", setup);
    ASSERT_FALSE(path.empty());
    EXPECT_NEAR(path.front().z, 0.02 * 3.0 / 0.2, 1e-12);
    EXPECT_NEAR(path.back().course.toX, 0.2 * 3.0 / 0.2, 1e-12);
    EXPECT_NEAR(path.back().course.toY, 0.1 * 0.7 / 0.1, 1e-12);
    EXPECT_NEAR(path.back().course.toZ, 0.06 * 3.0 / 0.2, 1e-12);
}

TEST(MessageArguments, EachCountsForItselfAlone) {
    const SessionSetup setup = inSpace();
    using Changes = std::vector<std::pair<std::string, std::string>>; // argument, other value
    struct Row {
        std::string message, base;
        Changes changes;
    };
    const std::vector<Row> rows{
        {"strike",
         R"("frequency_hz": 180, "decay_per_s": 20, "seconds": 0.5, "place": [1, 0.25, 0.1], "level": 0.5)",
         {{"frequency_hz", "190"},
          {"decay_per_s", "21"},
          {"seconds", "0.75"},
          {"place", "[1.5, 0.25, 0.1]"},
          {"place", "[1, 0.5, 0.1]"},
          {"place", "[1, 0.25, 0.2]"},
          {"level", "0.25"},
          {"law", "\"alone\""},
          {"part", "\"thumb\""}}},
        {"strike",
         R"("material": "bell", "place": "A", "level": 0.5)",
         {{"place", "\"B\""}, {"level", "0.25"}, {"seconds", "0.25"}}},
        {"pattern",
         R"("enchanters": "ABC", "pulse_s": 0.1, "gap_s": 0.1, "frequency_hz": 205, "level": 0.5)",
         {{"enchanters", "\"ABD\""},
          {"pulse_s", "0.2"},
          {"gap_s", "0.2"},
          {"frequency_hz", "210"},
          {"level", "0.25"}}},
        {"pattern", R"("pattern": "ABA-250")", {{"pattern", "\"ABA-500\""}, {"pattern", "\"ABC-250\""}}},
        {"phantom",
         R"("place": [1, 0.25, 0.1], "seconds": 1, "frequency_hz": 205, "level": 0.5)",
         {{"place", "[1, 0.25, 0.2]"},
          {"place", "[1, 0.5, 0.1]"},
          {"place", "[2, 0.25, 0.1]"},
          {"seconds", "2"},
          {"law", "\"alone\""},
          {"frequency_hz", "210"},
          {"level", "0.25"},
          {"part", "\"thumb\""}}},
        {"path",
         R"("places": [0, 0, 1, 0.5], "seconds": 1, "frequency_hz": 205, "level": 0.5)",
         {{"places", "[0, 0, 2, 0.5]"},
          {"places", "[0, 0, 1, 0.25]"},
          {"places", "[0.5, 0, 1, 0.5]"},
          {"places", "[0, 0.1, 1, 0.5]"},
          {"seconds", "2"},
          {"strokes", "3"},
          {"law", "\"alone\""},
          {"frequency_hz", "210"},
          {"level", "0.25"},
          {"part", "\"thumb\""}}},
        {"path", R"("places": "ABD", "speed_m_per_s": 1)", {{"speed_m_per_s", "2"}, {"places", "\"ABC\""}}},
        {"path",
         R"("places": "ABD", "times_s": [0, 0.5, 1])",
         {{"times_s", "[0, 0.25, 1]"}, {"times_s", "[0, 0.5, 2]"}}}};
    std::map<std::string, std::set<std::string>> seen;
    for (const Row& row : rows) {
        const auto before = strikesOf("{\"message\": \"" + row.message + "\", " + row.base + "}", setup);
        EXPECT_FALSE(before.empty()) << row.base;
        for (std::size_t at = 0; (at = row.base.find("\": ", at)) != std::string::npos; ++at)
            seen[row.message].insert(
                row.base.substr(row.base.rfind('"', at - 1) + 1, at - row.base.rfind('"', at - 1) - 1));
        for (const auto& [argument, value] : row.changes) {
            seen[row.message].insert(argument);
            std::string line = row.base;
            const std::string key = "\"" + argument + "\": ";
            if (const std::size_t begin = line.find(key); begin != std::string::npos) {
                std::size_t end = begin + key.size();
                for (int depth = 0; end < line.size() && (depth > 0 || line[end] != ','); ++end)
                    depth += line[end] == '[' ? 1 : line[end] == ']' ? -1 : 0;
                line.replace(begin, end - begin, key + value);
            } else {
                line += ", " + key + value;
            }
            EXPECT_NE(strikesOf("{\"message\": \"" + row.message + "\", " + line + "}", setup), before)
                << row.message << ' ' << argument << ": changes nothing";
        }
    }
    for (const MessageDescription& message : messageTable)
        for (const MessageArgument& argument : message.arguments)
            EXPECT_TRUE(!std::holds_alternative<MessageDescription::Strikes*>(message.action) ||
                        seen[std::string(message.name)].contains(std::string(argument.name)))
                << message.name << ' ' << argument.name << ": in no row of this test";
}

/// A level is a share of full scale, whatever a scene's gain is; a scene's own hits have it.
TEST(MessageArguments, ALevelIsThatOfTheStrikeWhateverTheScenesGain) {
    for (const double gain : {0.25, 1.0, 4.0})
        for (const double level : {0.125, 0.5}) {
            SessionSetup setup = inSpace();
            setup.channels = 6;
            setup.shaping.gain = gain;
            Session session{setup};
            session.prepare(hostRate, 480);
            MessageRouter router{session};
            const auto read = readInputLine(
                R"({"message": "phantom", "seconds": 0.1, "level": )" + std::to_string(level) + "}", {}, 6);
            ASSERT_EQ(read.error, "");
            EXPECT_EQ(router.handle(std::get<PlainMessage>(read.value)).error, "");
            std::vector<std::vector<float>> samples(6, std::vector<float>(480));
            std::vector<float*> at;
            for (auto& channel : samples) at.push_back(channel.data());
            std::vector<CollisionEvent> felt;
            for (int i = 0; i < 30; ++i) {
                session.advance();
                session.render(at.data(), 480, RenderMode::realtime);
                for (const CollisionEvent& event : drain(session)) felt.push_back(event);
            }
            ASSERT_EQ(felt.size(), 1U);
            EXPECT_NEAR(felt[0].amplitude, level, 1e-9) << "gain " << gain;
        }
}

// Docs/messages.md says what the table of messages says, and its lines are taken as they stand there.

std::string page() {
    const auto text = readFile(PHYSVIB_SOURCE_DIR "/Docs/messages.md", 1'000'000);
    EXPECT_EQ(text.error, "");
    return text.value;
}

std::string rangeOf(const MessageArgument& argument) {
    using Type = MessageArgument::Type;
    const std::string range = numberText(argument.minimum) + " to " + plainNumber(argument.maximum);
    switch (argument.type) {
    case Type::number: return range;
    case Type::text: return "word";
    case Type::place: return "place";
    case Type::places: return "places";
    default: return "list, " + range;
    }
}

std::string rowsOf(std::span<const MessageArgument> arguments) {
    std::string text = "| value | is | usual | meaning |\n| --- | --- | --- | --- |\n";
    for (const auto& a : arguments)
        text += "| `" + std::string(a.name) + "` | " + rangeOf(a) + " | " + std::string(a.defaultText) +
                " | " + std::string(a.meaning) + " |\n";
    return text;
}

TEST(MessagesPage, HasTheTable) {
    std::string table;
    for (const auto& message : messageTable) {
        table += "### `" + std::string(message.name) + "`: " + std::string(message.meaning) + "\n\n";
        if (!message.arguments.empty()) table += rowsOf(message.arguments) + "\n";
    }
    const std::string text = page();
    EXPECT_NE(text.find(table), std::string::npos) << "expected in Docs/messages.md:\n\n" << table;
    EXPECT_NE(text.find(rowsOf(messages::timeArguments)), std::string::npos)
        << "expected in Docs/messages.md:\n\n"
        << rowsOf(messages::timeArguments);
}

Result<LoadedClip> anyClip(const std::string& name) {
    LoadedClip clip;
    clip.channels.push_back(
        {0.0, 48000, std::vector<float>(4800, 0.1f), {.path = name, .hash = "0123456789abcdef"}});
    return clip;
}

TEST(MessagesPage, ItsLinesAreTaken) {
    const auto quiet = loadScene(PHYSVIB_SOURCE_DIR "/Standalone/Examples/quiet.json");
    ASSERT_EQ(quiet.error, "");
    auto setup = test::shakeTheBoxSetup(0.05);
    setup.scene = quiet.value;
    Session session{setup};
    session.prepare(48000, 512);
    MessageRouter router{session};
    const std::string text = page();
    int lines = 0;
    for (std::size_t at = text.find("{\"message\""); at != std::string::npos;
         at = text.find("{\"message\"", at + 1), ++lines) {
        const std::string line = text.substr(at, text.find('\n', at) - at);
        const auto read = readInputLine(line, {}, 4);
        ASSERT_EQ(read.error, "") << line;
        EXPECT_EQ(router.handle(std::get<PlainMessage>(read.value), nullptr, anyClip).error, "") << line;
    }
    EXPECT_GE(lines, 8);
}

} // namespace physvib::order_of_inputs_test
