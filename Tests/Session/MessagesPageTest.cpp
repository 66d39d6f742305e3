// SPDX-License-Identifier: MIT
// Docs/messages.md says what the table of messages says, and its lines are taken as they stand there.
#include "FakeHost.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Scene/SceneFile.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::string page() {
    const auto text = readFile(PHYSVIB_SOURCE_DIR "/Docs/messages.md", 1'000'000);
    EXPECT_EQ(text.error, "");
    return text.value;
}

std::string rangeOf(const MessageArgument& argument) {
    using Type = MessageArgument::Type;
    const std::string range = numberText(argument.least) + " to " + plainNumber(argument.most);
    switch (argument.type) {
    case Type::number: return range;
    case Type::word: return "word";
    case Type::place: return "place";
    case Type::places: return "places";
    default: return "list, " + range;
    }
}

std::string rowsOf(std::span<const MessageArgument> arguments) {
    std::string text = "| value | is | usual | meaning |\n| --- | --- | --- | --- |\n";
    for (const auto& a : arguments)
        text += "| `" + std::string(a.name) + "` | " + rangeOf(a) + " | " + std::string(a.usual) + " | " +
                std::string(a.meaning) + " |\n";
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
    EXPECT_NE(text.find(rowsOf(messages::when)), std::string::npos) << "expected in Docs/messages.md:\n\n"
                                                                    << rowsOf(messages::when);
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
        EXPECT_EQ(router.take(std::get<PlainMessage>(read.value), nullptr, anyClip).error, "") << line;
    }
    EXPECT_GE(lines, 8);
}

} // namespace
} // namespace physvib
