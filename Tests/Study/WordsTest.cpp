// SPDX-License-Identifier: MIT
// Words of a language: what is wrong with a file of them, and what the Korean ones have to hold.
#include "Lab/Files/Words.h"
#include "Lab/Files/ProtocolFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

const std::string head = R"({"physvib_words": 1, "name": "xx", "language": "X", "texts": )";

TEST(Words, ATextThatIsNotThereStaysEnglish) {
    const auto words = readWords(head + R"({"Begin": "Los", "trial {n}": "{n}. Versuch"}})", "x.json");
    ASSERT_TRUE(words) << words.error;
    EXPECT_EQ(words.value.of("Begin"), "Los");
    EXPECT_EQ(words.value.of("Close"), "Close");
    EXPECT_TRUE(findWords("en").value.texts.empty());
    std::string names = "en";
    for (const Words& one : builtInWords()) names += ", " + one.name;
    EXPECT_EQ(findWords("xx").error, "no words \"xx\"; expected " + names + " or a file");
}

TEST(Words, FaultsAreNamedByTheirText) {
    const auto fault = [](const std::string& texts) { return readWords(head + texts + "}", "x.json").error; };
    EXPECT_EQ(fault(R"({"trial {n}": "Versuch"})"),
              "x.json: texts.trial {n}: expected the same names in braces as in the English text");
    EXPECT_EQ(fault(R"({"Begin": 1})"), "x.json: texts.Begin: expected a string, found a number");
    EXPECT_EQ(fault("[]"), "x.json: texts: expected an object, found an array");
}

TEST(Words, EachLanguageHasAllThatBuiltInProtocolsAsk) {
    ASSERT_FALSE(builtInWords().empty());
    for (const Words& words : builtInWords()) {
        const auto expect = [&](const std::string& text) {
            EXPECT_TRUE(text.empty() || words.texts.contains(text)) << words.name << ": " << text;
        };
        for (const Protocol& protocol : builtInProtocols()) {
            expect(protocol.closingQuestion);
            for (const SessionPlan& session : protocol.sessions) {
                expect(session.question);
                for (const auto* list :
                     {&session.scales, &session.definitions, &session.anchors, &session.objects})
                    for (const std::string& text : *list) expect(text);
            }
        }
    }
}

} // namespace
} // namespace physvib
