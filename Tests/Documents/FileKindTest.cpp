// SPDX-License-Identifier: MIT
// A file says what it is, wherever it says so.
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/DocumentJson.h"
#include "Live/Documents/PluginState.h"
#include "Scene/SceneFile.h"
#include "Support/FileTesting.h"
#include <gtest/gtest.h>

namespace physvib::file_kind_test {

class FileKindTest : public FolderTest {
protected:
    FileKind kindOf(const std::string& text) const {
        EXPECT_EQ(writeFile(folder / "file.json", text), "");
        return fileKind(folder / "file.json");
    }
};

TEST_F(FileKindTest, IsToldByWhatWeWrite) {
    SavedSession session;
    session.channels = 1;
    session.log.runs.push_back({0, 0, 1, std::make_shared<const Scene>(*findBuiltInScene("drop")), {}, {}});
    session.mix = mixAtEnd(session);
    EXPECT_EQ(kindOf(sessionJson(session)), FileKind::session) << "though its desk has a layout";
    EXPECT_EQ(kindOf(sceneJson(*findBuiltInScene("drop"))), FileKind::scene);
    ActuatorLayout ring;
    layoutPreset("ring3", ring);
    EXPECT_EQ(kindOf(layoutJson(describeLayout("ring", ring))), FileKind::layout);
}

TEST_F(FileKindTest, OfAnythingElseIsUnknown) {
    EXPECT_EQ(kindOf(""), FileKind::unknown);
    EXPECT_EQ(kindOf("RIFF physvib_session"), FileKind::unknown);
    EXPECT_EQ(fileKind(folder / "nowhere.json"), FileKind::unknown);
    EXPECT_EQ(fileKind(folder), FileKind::unknown);
}

// A field that older files lack makes a new version of its format.

/// Finds the newest field of a table.
template <class T>
struct NewestField {
    const T object{};
    int since = 1;

    void version(std::string_view, int) {}
    void field(std::string_view, const auto&, const auto&, Need need = Need::required) { see(need); }
    void legacyField(std::string_view, const auto&, const auto&) {}
    void part(std::string_view, Need need = Need::required) { see(need); }
    bool has(std::string_view, const auto&) { return true; }
    void see(Need need) { since = std::max(since, need.since); }
};

template <class... Tables>
int newestOf() {
    const auto newest = []<class T>(FieldsOf<T> table) {
        NewestField<T> fields;
        visitFields(fields, table);
        return fields.since;
    };
    return std::max({newest(FieldsOf<Tables>{})...});
}

TEST(FieldVersions, TheNewestFieldOfASessionIsOfTheVersionThatIsWritten) {
    EXPECT_EQ((newestOf<SavedSession, SceneRun, WorldStall, CollisionEvent, RecordingsChange, RecordingFile,
                        ClipFile, EventShaping, Mix, StripGroup, Strip>()),
              sessionFormatVersion);
}

TEST(FieldVersions, TheNewestFieldOfAPluginStateIsOfTheVersionThatIsWritten) {
    EXPECT_EQ((newestOf<PluginState, NoteVoice, ControllerRule>()), pluginStateVersion);
}

// JSON from anywhere: what is refused while it is parsed, and the words for it.

TEST(StrictJson, IsBoundedInValuesHoweverFewBytesTheyHave) {
    std::string lists = "{\"physvib_session\": 1, \"takes\": [[]";
    for (int i = 0; i < 4'000'000; ++i) lists += ",[]";
    EXPECT_EQ(readSession(lists + "]}", "s.json").error,
              "s.json: expected at most 2500004 values and fields in so many bytes, found more");
}

TEST(StrictJson, ALongSessionIsWithinTheBound) {
    std::string inputs = "{\"physvib_session\": 200000000, \"inputs\": [0";
    for (int i = 0; i < 400'000; ++i)
        inputs += ",{\"time_s\": 1234.567891, \"input\": \"tilt\", \"angle_rad\": 0.3456}";
    // at once: no list is looked through for each of its items
    const auto error = readSession(inputs + "]}", "s.json").error;
    EXPECT_NE(error.find("made for a newer PhysVib"), std::string::npos) << error;
}

TEST(StrictJson, QuotesBytesOfAFileInCleanWords) {
    const std::string error = readLayout("{\"name\": \"\xff\x1b[2J\n\xe2\x80\xae\", }", "l.json").error;
    EXPECT_EQ(error, cleanLine(error));
    EXPECT_NE(error.find("\\x"), std::string::npos) << error;
}

TEST(CleanText, LeavesWordsAndShowsEverythingElse) {
    EXPECT_EQ(cleanLine("K\u00fcche \u2192 \U0001F600"), "K\u00fcche \u2192 \U0001F600");
    EXPECT_EQ(cleanLine("a\nb\x1b[31m\x7f"), "a\\x0ab\\x1b[31m\\x7f");
    EXPECT_EQ(cleanLine("\xff\xc3"), "\\xff\\xc3") << "no UTF-8, and half a character";
    EXPECT_EQ(cleanLine("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80")
        << "longer than need be; half of a pair";
    EXPECT_EQ(cleanLine("\u009b\u202e\u2028"), "\\xc2\\x9b\\xe2\\x80\\xae\\xe2\\x80\\xa8")
        << "controls that UTF-8 can spell";
}

// Lines of what hands do: the fields of a scene's script, without a time.

const std::vector<Material> materials{{"wood", 850.0, 0.4, 0.6, 349.0, 107.0}};

Action read(const std::string& line) {
    const auto input = readInputLine(line, materials, 4);
    EXPECT_TRUE(input) << input.error;
    return input && std::holds_alternative<Action>(input.value) ? std::get<Action>(input.value) : Action{};
}
std::string faultOf(const std::string& line) { return readInputLine(line, materials, 4).error; }

TEST(InputLine, AHandHoldsABodyAndLetsItGo) {
    EXPECT_EQ(
        read(R"({"input": "grip", "body": "pen", "to_m": [2, 1.5], "point_m": [0, 0.1], "over_s": 0.02})"),
        (Action{GripAction{"pen", Vector{2.0, 1.5}, Vector{0.0, 0.1}, 0.02}}));
    EXPECT_EQ(read(R"({"input": "grip", "body": "pen"})"), (Action{GripAction{"pen", {}, {}}}));
    EXPECT_EQ(faultOf(R"({"input": "grip", "to_m": [2, 1]})"), "field \"body\" is missing");
    EXPECT_EQ(faultOf(R"({"input": "grip", "body": "pen", "to_m": [2]})"),
              "to_m: expected 2 numbers, found 1 items");
}

TEST(InputLine, ALayoutIsAPresetByItsNameOrWhole) {
    const std::string after = R"(, "law": "linear", "exponent": 1, "field_m": [6.4, 3.6]}})";
    const auto read =
        readInputLine(R"({"control": "layout", "panning": {"layout": "phone2")" + after, materials, 4);
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(std::get<OwnedControl>(read.value).panner->channels(), 2);
    EXPECT_NE(faultOf(R"({"control": "layout", "panning": {"layout": "phone9")" + after)
                  .find("panning.layout: expected one of phone1, "),
              std::string::npos);
    EXPECT_EQ(faultOf(R"({"control": "layout", "layout": "phone2"})"),
              "unknown field \"layout\": expected panning, control");
}

TEST(InputLine, ASurfaceBecomesRough) {
    EXPECT_EQ(
        read(R"({"input": "texture", "material": "wood", "grain_m": 0.008, "grain_pattern": "regular"})"),
        (Action{TextureAction{0, 0.008, 1.0, GrainPattern::regular}}));
    EXPECT_EQ(read(R"({"input": "texture", "material": "wood"})"), (Action{TextureAction{0}})) << "smooth";
    EXPECT_NE(faultOf(R"({"input": "texture", "material": "glass"})"), "");
}

TEST(InputLine, ItsNumberIsReadFromAnyLineWhereItStands) {
    const auto idOf = [](const std::string& line) { return readInputLine(line, materials, 4).id; };
    for (const char* taken :
         {R"({"message": "status", "id": 7})", R"({"id": 7, "input": "tilt", "angle_rad": 0.1})",
          R"({"control": "silence", "on": true, "id":7})",
          R"({"control": "gain", "channel": 1, "value": 1, "id": 7.0})"}) {
        EXPECT_EQ(faultOf(taken), "") << taken;
        EXPECT_EQ(idOf(taken), 7.0) << taken;
    }
    for (const char* refused :
         {R"({"control": "gain", "channel": 9, "value": 1, "id": 7})", R"({"message": "strike", "id": 7)",
          R"("id" :	7, and more)", R"({"id": 7, "id": 8})", R"({"message": "status", "id": 7}})",
          R"({"nothing": 1, "id": 7})"}) {
        EXPECT_NE(faultOf(refused), "") << refused;
        EXPECT_EQ(idOf(refused), 7.0) << refused;
    }
    for (const char* none :
         {R"({"message": "status"})", R"({"message": "status", "id": 1.5})",
          R"({"message": "status", "id": "7"})", R"({"message": "status", "id": null})",
          R"({"message": "status", "id": 1e300})", R"({"message": "status", "id)", R"({"id")", R"("id": )",
          R"({"input": "spawn", "body": {"id": 7}})", R"({"message": "clip", "file": "\"id\": 7"})", ""})
        EXPECT_FALSE(idOf(none)) << none;
    EXPECT_EQ(faultOf(R"({"message": "status", "id": 1.5})"),
              "id: expected a whole number from -9007199254740991 to 9007199254740991");
    EXPECT_EQ(std::get<PlainMessage>(readInputLine(R"({"message": "status", "id": 7})", materials, 4).value),
              (PlainMessage{"status", {}}))
        << "it is none of its values";
}

TEST(InputLine, WhatNamesSilenceAndIsNoOffInItsRightFormAsksForIt) {
    for (const char* asks :
         {R"({"control": "silence", "on": true})", R"({"control": "silence", "on": true, "id": 7})",
          R"({"control": "silence"})", R"({"control": "silence", "on": "true"})",
          R"({"control": "silence", "on": 0})", R"({"control": "silence", "on": false, "why": 1})",
          R"({"control": "silence", "on": false, "on": false})",
          R"({"control": "silence", "on": false, "id": "a"})", R"({"control": "Silence", "on": false})",
          R"({"control": "\u0073ilence"})", R"({"control": ["silence"]})", R"({"message": "silence"})",
          R"({"message": "stop", "control": "silence"})", R"({"control": "silence", "on": fal)", "SILENCE",
          R"("silence")"})
        EXPECT_TRUE(requestsSilence(asks)) << asks;
    for (const char* other :
         {R"({"control": "silence", "on": false})", R"({"id": 7, "control": "silence", "on": false})",
          R"({"message": "clip", "file": "silence.wav"})",
          R"({"input": "impulse", "body": "silence", "impulse_ns": [0, 1]})",
          R"({"input": "remove", "body": "silence"})", R"({"input": "spawn", "body": {"name": "silence"}})",
          R"({"control": "gain", "channel": 3, "silence": 1})", R"({"control": "sil)", ""})
        EXPECT_FALSE(requestsSilence(other)) << other;
}

} // namespace physvib::file_kind_test
