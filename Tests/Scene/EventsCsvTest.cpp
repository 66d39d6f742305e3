// SPDX-License-Identifier: MIT
// Event lists survive writing and reading to the bit, and a bad one is named by line and column.
#include "Scene/EventsCsv.h"
#include "Io/Disk/AtomicFile.h"
#include "Support/FileTesting.h"
#include "Support/Has.h"
#include <algorithm>
#include <limits>

namespace physvib::events_csv_test {

using Events = std::vector<CollisionEvent>;
const Provenance provenance{"0.1.0", {{"seed", "1"}, {"scene", "shake-the-box"}}};
const FieldSize field{8.0, 4.5};
const std::string allColumns =
    "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m,duration_s,fixture,other,impulse_ns,mass_kg\n";
const std::string shortHeader = "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n";

double magnitudeUpTo(std::mt19937& random, double most) {
    for (;;)
        if (const double number = std::abs(anyDouble(random)); number > 0.0 && number <= most) return number;
}

Events randomEvents(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    Events events(count);
    for (CollisionEvent& e : events) {
        e.timeNs = static_cast<std::int64_t>(random()) * 200'000 + random() % 200'000;
        e.frequencyHz = magnitudeUpTo(random, limits::maxFrequencyHz);
        e.decayPerSecond = magnitudeUpTo(random, limits::maxDecayPerSecond);
        if (isTooSlow(e)) e.decayPerSecond += limits::slowDecayPerSecond;
        e.amplitude = magnitudeUpTo(random, limits::maxAmplitude) * (random() % 2 == 0 ? 1.0 : -1.0);
        e.x = anyDouble(random);
        e.y = anyDouble(random);
        e.durationNs = random() % 2 == 0 ? 0 : static_cast<std::int64_t>(random());
        e.source = {static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random()),
                    anyDouble(random), std::abs(anyDouble(random))};
    }
    std::ranges::stable_sort(events, {}, &CollisionEvent::timeNs);
    return events;
}

bool isOneLine(const std::string& text) {
    return std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

Events readGood(const std::string& text) {
    Result<EventList> read = readEventsCsv(text, "hits.csv");
    EXPECT_EQ(read.error, "");
    return std::move(read.value.events);
}

std::string errorOf(const std::string& text) {
    const Result<EventList> read = readEventsCsv(text, "hits.csv");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(read.value.events.empty());
    EXPECT_TRUE(isOneLine(read.error)) << read.error;
    return read.error;
}

/// Of a row below a good one; columns as in allColumns.
std::string errorOfRow(const std::string& row) {
    return errorOf(allColumns + "0.5,200,10,0.5,0.1,0.2,0,1,2,0.01,0.3\n" + row + "\n");
}

TEST(EventsCsv, WritesTheColumnsOfTheInterface) {
    const CollisionEvent hit{1'250'000'001, 205.0, 12.5, -0.1, 0.06, 1e-7, 20'000'000, {3, -1, 0.004, 2.0}};
    EXPECT_EQ(eventsCsv(std::span(&hit, 1), field, provenance),
              "# physvib 0.1.0 seed=1 scene=shake-the-box field_m=8,4.5\n" + allColumns +
                  "1.250000001,205,12.5,-0.1,0.06,1e-07,0.020000000,3,-1,0.004,2\n");
}

TEST(EventsCsv, WriteThenReadGivesTheSameBits) {
    const Events events = randomEvents(3, 20'000);
    EXPECT_TRUE(readGood(eventsCsv(events, field, provenance)) == events);
}

TEST(EventsCsv, KindsAreWrittenWhereThereAreAny) {
    Events events = randomEvents(5, 100);
    EXPECT_FALSE(has(eventsCsv(events, field, provenance), "kind"));
    events[7].source.kind = ContactKind::roll;
    events[50].source.kind = ContactKind::slide;
    const std::string text = eventsCsv(events, field, provenance);
    EXPECT_TRUE(has(text, "mass_kg,kind\n"));
    EXPECT_TRUE(readGood(text) == events);
    EXPECT_EQ(errorOf(allColumns.substr(0, allColumns.size() - 1) + ",kind\n1,200,10,1,0,0,0,1,2,0,1,fall\n"),
              "hits.csv:2: column kind: expected hit, roll or slide, found \"fall\"");
}

TEST(EventsCsv, MaterialsAreNamedWhereTheyAreKnown) {
    Events events = randomEvents(5, 5);
    events[0].sound = soundOfMaterial("wood");
    events[1].sound = soundOfMaterial("a, b"); // would be two cells: by its number
    events[2].sound = soundOfClip(6);
    events[3].sound = soundOfMaterial("clip-1"); // would be a clip
    SoundNames names;
    for (const char* name : {"wood", "a, b", "clip-1", " c", "never struck"}) names.add(name);
    const std::string text = eventsCsv(events, field, provenance, names);
    EXPECT_TRUE(has(text, "mass_kg,material\n"));
    EXPECT_TRUE(has(text, ",wood\n"));
    const auto read = readEventsCsv(text, "hits.csv");
    ASSERT_EQ(read.error, "");
    EXPECT_TRUE(read.value.events == events);
    EXPECT_EQ(read.value.names.nameOf(soundOfMaterial("wood")), "wood");
    EXPECT_EQ(read.value.names.nameOf(soundOfClip(6)), "clip-7");
    EXPECT_EQ(eventsCsv(read.value.events, field, provenance, read.value.names).size(), text.size());
    events.resize(1);
    EXPECT_TRUE(has(eventsCsv(events, field, provenance), ",sound-923368111\n"))
        << "whose name is not known here";
    EXPECT_EQ(readGood(eventsCsv(events, field, provenance)).front().sound, events[0].sound);
    events[0].sound = 0;
    EXPECT_FALSE(has(eventsCsv(events, field, provenance, names), "material"));
}

TEST(EventsCsv, DepthsAndPartsAreWrittenWhereThereAreAny) {
    Events events = randomEvents(4, 3);
    const std::string flat = eventsCsv(events, {}, provenance);
    EXPECT_TRUE(has(flat, "\n" + allColumns)) << "a list in a plane is as it was";
    events[1].z = -0.125;
    EXPECT_TRUE(has(eventsCsv(events, {}, provenance), "mass_kg,z_m\n"));
    events[2].source.part = partNamed("left elbow");
    events[0].source.part = partNamed("thumb");
    SoundNames names;
    names.parts.add("left elbow");
    const std::string text = eventsCsv(events, {}, provenance, names);
    EXPECT_TRUE(has(text, "mass_kg,z_m,part\n"));
    EXPECT_TRUE(has(text, ",0,thumb\n"));
    EXPECT_TRUE(has(text, ",-0.125,\n"));
    EXPECT_TRUE(has(text, ",0,left elbow\n"));
    EXPECT_EQ(readGood(text), events);
    const auto again = readEventsCsv(text, "again");
    EXPECT_EQ(eventsCsv(again.value.events, {}, provenance, again.value.names), text) << "names are kept";
    const std::string unnamed = eventsCsv(events, {}, provenance);
    EXPECT_TRUE(has(unnamed, ",part-" + std::to_string(partNamed("left elbow")) + "\n"));
    EXPECT_EQ(readGood(unnamed), events);
    EXPECT_EQ(errorOf("time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m,z_m\n0,100,1,1,0,0,up\n"),
              "hits.csv:2: column z_m: expected a number, found \"up\"");
}

TEST(EventsCsv, OlderListsNameClipsByTheirFrequency) {
    const auto of = [](const std::string& header, const std::string& row) {
        return readGood(header + row).front();
    };
    const std::string head = shortHeader.substr(0, shortHeader.size() - 1);
    const CollisionEvent clip = of(head + ",duration_s\n", "0.5,0.0029296875,0,0.5,0.1,0.2,1\n");
    EXPECT_EQ(clip.sound, soundOfClip(2));
    EXPECT_EQ(clip.frequencyHz, clipFrequencyHz);
    EXPECT_EQ(of(head + "\n", "0.5,0.003,10,0.5,0.1,0.2\n").sound, 0);
    EXPECT_EQ(of(head + ",material\n", "0.5,0.0029296875,10,0.5,0.1,0.2,\n").sound, 0);
}

TEST(EventsCsv, AListSaysTheFieldItSpans) {
    const std::string row = shortHeader + "0.5,200,10,0.5,0.1,0.2\n";
    const auto fieldOfText = [&](const std::string& comments) {
        const Result<EventList> read = readEventsCsv(comments + row, "hits.csv");
        EXPECT_EQ(read.error, "") << comments;
        EXPECT_EQ(read.value.events.size(), 1u);
        return read.value.field;
    };
    EXPECT_EQ(fieldOfText(""), FieldSize{}) << "lists of old";
    EXPECT_EQ(fieldOfText("# physvib 0.1.0 scene=drop seed=1\n"), FieldSize{});
    EXPECT_EQ(fieldOfText("# physvib 0.1.0 scene=drop field_m=8,4.5\n"), (FieldSize{8.0, 4.5}));
    EXPECT_EQ(fieldOfText("#field_m=8,4.5\r\n"), (FieldSize{8.0, 4.5}));
    EXPECT_EQ(fieldOfText("# scene=a field_m=8,4.5,,,,,,,,,\n"), (FieldSize{8.0, 4.5}))
        << "as spreadsheets save it";
    EXPECT_EQ(fieldOfText("# a\n\n# field_m=1e-3,0.1 metres\n# b\n"), (FieldSize{1e-3, 0.1}));
    EXPECT_EQ(fieldOfText("# music=my field_m=x.wav field_m=2,1\n"), (FieldSize{2.0, 1.0}))
        << "the last word is ours";
    EXPECT_EQ(fieldOfText("# my_field_m=nothing\n"), FieldSize{}) << "another word";
    for (const std::string wrong : {"", "8", "8,", "8x4", "0,1", "8,-1", "8,1,2", "nan,1", "1e7,1"})
        EXPECT_EQ(errorOf("\n# a field_m=" + wrong + "\n" + row),
                  "hits.csv:2: field_m: expected W,H in metres (0.001 to 1e6), found \"" +
                      (wrong == "8," ? "8" : wrong) + "\"");
    const double odd = 0.1 + 0.2;
    EXPECT_EQ(
        readEventsCsv(eventsCsv(randomEvents(5, 3), {odd, 1.0 / 3.0}, provenance), "hits.csv").value.field,
        (FieldSize{odd, 1.0 / 3.0}));
    EXPECT_FALSE(has(eventsCsv(randomEvents(5, 3), {}, provenance), "field_m")) << "one that nobody knows";
}

TEST(EventsCsv, NegativeZeroKeepsItsSign) {
    const Events events = readGood(shortHeader + "0,1,1,-0,-0.0,0\n");
    EXPECT_TRUE(std::signbit(events[0].amplitude) && std::signbit(events[0].x));
    EXPECT_FALSE(std::signbit(events[0].y));
    const Events again = readGood(eventsCsv(events, field, provenance));
    EXPECT_TRUE(std::signbit(again[0].amplitude));
}

TEST(EventsCsv, MissingLaterColumnsTakeTheDefaults) {
    const Events events = readGood(shortHeader + "1,2,3,4,5,6\n");
    EXPECT_TRUE((events == Events{{1'000'000'000, 2.0, 3.0, 4.0, 5.0, 6.0, 0, {}}}));
}

TEST(EventsCsv, ColumnsAreFoundByNameInAnyOrder) {
    const Events events =
        readGood("\"mass_kg\",y_m,x_m,amplitude,decay_per_s,frequency_hz,time_s\n\"7\",6,5,4,3,2,1\n");
    EXPECT_TRUE((events == Events{{1'000'000'000, 2.0, 3.0, 4.0, 5.0, 6.0, 0, {-1, -1, 0.0, 7.0}}}));
}

TEST(EventsCsv, ToleratesMarksCommentsLineEndsAndSpaces) {
    const Events plain = readGood(shortHeader + "1,2,3,4,5,6\n2,2,3,4,5,6\n");
    for (const std::string& text :
         {"\xEF\xBB\xBF" + shortHeader + "1,2,3,4,5,6\n2,2,3,4,5,6\n",
          shortHeader + "1,2,3,4,5,6\n2,2,3,4,5,6", shortHeader + "1,2,3,4,5,6\n2,2,3,4,5,6\n\n \t\n\r\n",
          "# physvib 9\n#\n\n" + shortHeader + "1,2,3,4,5,6\n2,2,3,4,5,6",
          std::string(
              "# x\r\ntime_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\r\n1,2,3,4,5,6\r\n2,2,3,4,5,6\r\n"),
          std::string(
              "time_s, frequency_hz, decay_per_s, amplitude, x_m, y_m\n1, 2,3 ,\t4,5,6 \n2,2,3,4,5,6\n")})
        EXPECT_TRUE(readGood(text) == plain) << text;
}

TEST(EventsCsv, ADecayOfZeroNeedsADuration) {
    EXPECT_EQ(errorOfRow("1,200,0,0.5,0.1,0.2,0,1,2,0,1"),
              "hits.csv:3: column decay_per_s: expected a number > 0, or a duration_s > 0, found 0");
    EXPECT_EQ(errorOf(shortHeader + "0,4.5,0.5,1,0,0\n"),
              "hits.csv:2: column frequency_hz: expected at least 5 Hz, or a decay of at least 1 per second, "
              "found 4.5 Hz");
    EXPECT_EQ(readGood(allColumns + "1,200,0,0.5,0.1,0.2,1e-3,1,2,0,1\n")[0].durationNs, 1'000'000);
}

TEST(EventsCsv, NamesLineColumnAndWhatWasExpected) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"x,200,10,1,0,0,0,1,2,0,1", R"(time_s: expected seconds from 0 to 100000000, found "x")"},
        {"-1,200,10,1,0,0,0,1,2,0,1", R"(time_s: expected seconds from 0 to 100000000, found "-1")"},
        {"100000000.1,200,10,1,0,0,0,1,2,0,1",
         R"(time_s: expected seconds from 0 to 100000000, found "100000000.1")"},
        {"0.4,200,10,1,0,0,0,1,2,0,1",
         "time_s: expected a time >= 0.500000000 of the row above, found 0.400000000"},
        {"1,0,10,1,0,0,0,1,2,0,1", R"(frequency_hz: expected a number > 0, found "0")"},
        {"1,-0,10,1,0,0,0,1,2,0,1", R"(frequency_hz: expected a number > 0, found "-0")"},
        {"1,20001,10,1,0,0,0,1,2,0,1", R"(frequency_hz: expected a number <= 20000, found "20001")"},
        {"1,200,-3,1,0,0,0,1,2,0,1", R"(decay_per_s: expected a number >= 0, found "-3")"},
        {"1,200,2000.1,1,0,0,0,1,2,0,1", R"(decay_per_s: expected a number <= 2000, found "2000.1")"},
        {"1,200,10,1000001,0,0,0,1,2,0,1", R"(amplitude: expected a number <= 1000000, found "1000001")"},
        {"1,200,10,-2e6,0,0,0,1,2,0,1", R"(amplitude: expected a number >= -1000000, found "-2e6")"},
        {"1,200,10,1,inf,0,0,1,2,0,1", R"(x_m: expected a number, found "inf")"},
        {"1,200,10,1,0,nan,0,1,2,0,1", R"(y_m: expected a number, found "nan")"},
        {"1,200,10,1,0,1e999,0,1,2,0,1", R"(y_m: expected a number, found "1e999")"},
        {"1,200,10,1,0,,0,1,2,0,1", R"(y_m: expected a number, found "")"},
        {"1,200,10,1,0,0.5m,0,1,2,0,1", R"(y_m: expected a number, found "0.5m")"},
        {"1,200,10,1,0,\"0.5m\",0,1,2,0,1", R"(y_m: expected a number, found "0.5m")"},
        {"1,200,10,1,0,0,-0.1,1,2,0,1", R"(duration_s: expected seconds from 0 to 100000000, found "-0.1")"},
        {"1,200,10,1,0,0,0,1.5,2,0,1", R"(fixture: expected a whole number, found "1.5")"},
        {"1,200,10,1,0,0,0,1,2147483648,0,1", R"(other: expected a whole number, found "2147483648")"},
        {"1,200,10,1,0,0,0,1,2,1e,1", R"(impulse_ns: expected a number, found "1e")"},
        {"1,200,10,1,0,0,0,1,2,0,-1", R"(mass_kg: expected a number >= 0, found "-1")"},
    };
    for (const auto& [row, message] : cases) EXPECT_EQ(errorOfRow(row), "hits.csv:3: column " + message);
}

TEST(EventsCsv, WrongNumberOfCellsIsNamed) {
    EXPECT_EQ(errorOfRow("1,2,3"), "hits.csv:3: expected 11 cells, found 3");
    EXPECT_EQ(errorOfRow("1,200,10,1,0,0,0,1,2,0,1,"), "hits.csv:3: expected 11 cells, found 12");
    EXPECT_EQ(errorOfRow("\n1,200,10,1,0,0,0,1,2,0,1"), "hits.csv:3: expected 11 cells, found 0");
}

TEST(EventsCsv, LinesAreCountedFromTheTopOfTheFile) {
    EXPECT_EQ(errorOf("# a\r\n\r\n" + shortHeader + "1,2,3,4,5,6\r\n1,2,3,4,5,?\r\n"),
              "hits.csv:5: column y_m: expected a number, found \"?\"");
}

TEST(EventsCsv, HeaderIsChecked) {
    const std::string names = allColumns.substr(0, allColumns.size() - 1) + ",kind,material,z_m,part";
    EXPECT_EQ(errorOf(""), "hits.csv:1: expected a header line " + names + ", found the end of the file");
    EXPECT_EQ(errorOf("# only\n\n"),
              "hits.csv:2: expected a header line " + names + ", found the end of the file");
    EXPECT_EQ(errorOf("1,2,3,4,5,6\n"), "hits.csv:1: unknown column \"1\", expected a header line " + names);
    EXPECT_EQ(errorOf("time_s,time_s\n"), "hits.csv:1: column time_s appears twice");
    for (const std::string missing : {"frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m"}) {
        std::string header = shortHeader;
        header.erase(header.find("," + missing), missing.size() + 1);
        EXPECT_EQ(errorOf(header), "hits.csv:1: column " + missing + " is missing");
    }
    EXPECT_EQ(errorOf("Time_s\n"), "hits.csv:1: unknown column \"Time_s\", expected a header line " + names);
    for (const std::string header : {"time_s,,x_m\n", ",time_s\n", "time_s,\n"})
        EXPECT_TRUE(errorOf(header).starts_with("hits.csv:1: unknown column \"\"")) << header;
}

TEST(EventsCsv, AListWithoutEventsIsAMistake) {
    EXPECT_EQ(errorOf(shortHeader), "hits.csv:1: expected events after the header, found none");
    EXPECT_EQ(errorOf(shortHeader + "\n\n"), "hits.csv:1: expected events after the header, found none");
    EXPECT_EQ(errorOf(eventsCsv({}, field, provenance)),
              "hits.csv:2: expected events after the header, found none");
}

TEST(EventsCsv, MoreRowsThanTheLimitAreRefused) {
    const std::string three = shortHeader + "1,2,3,4,5,6\n1,2,3,4,5,6\n1,2,3,4,5,6\n\n";
    EXPECT_TRUE(readEventsCsv(three, "hits.csv", 3));
    const Result<EventList> read = readEventsCsv(three, "hits.csv", 2);
    EXPECT_EQ(read.error, "hits.csv:4: expected at most 2 events");
    EXPECT_TRUE(read.value.events.empty());
}

TEST(EventsCsv, WhatIsFoundIsShownShortAndHarmless) {
    EXPECT_EQ(errorOfRow("1,200,10,1,0,\x1b[31m\xc3\xa4,0,1,2,0,1"),
              R"(hits.csv:3: column y_m: expected a number, found "\x1b[31m\xc3\xa4")");
    EXPECT_LT(errorOfRow("1,200,10,1,0," + std::string(100'000, 'z') + ",0,1,2,0,1").size(), 120u);
}

TEST(EventsCsv, ProvenanceStaysOnOneLine) {
    const Events events = randomEvents(5, 1);
    const std::string text = eventsCsv(events, {}, {"0.1.0", {{"scene", "a\nb\r\nc"}}});
    EXPECT_TRUE(text.starts_with("# physvib 0.1.0 scene=a b  c\n")) << text;
    EXPECT_TRUE(readGood(text) == events);
}

TEST(EventsCsv, AcceptsExactlyWhatIsPlayable) {
    constexpr double inf = std::numeric_limits<double>::infinity(), nan = NAN;
    constexpr double pool[] = {0.0,    -0.0,    1.0,     -1.0,   1e6,     -1e6, 1000001.0, 2000.0,
                               2000.5, 20000.0, 20000.5, 5e-324, 1.0e308, inf,  nan};
    constexpr std::int64_t times[] = {0, 1, -1, limits::maxTimeNs, limits::maxTimeNs + 1};
    std::mt19937 random(6);
    const auto number = [&] { return pool[anyIndex(random, std::size(pool))]; };
    const auto time = [&] { return times[anyIndex(random, std::size(times))]; };
    int accepted = 0;
    for (int i = 0; i < 50'000; ++i) {
        const CollisionEvent e{time(), number(), number(), number(), number(), number(), time(), {}};
        const Result<EventList> read =
            readEventsCsv(eventsCsv(std::span(&e, 1), field, provenance), "hits.csv");
        ASSERT_EQ(bool(read), isPlayable(e)) << read.error << eventsCsv(std::span(&e, 1), field, provenance);
        accepted += read ? 1 : 0;
    }
    EXPECT_GT(accepted, 100);
}

TEST(EventsCsv, NoMutationCrashesOrHalfLoads) {
    const std::string good = eventsCsv(randomEvents(7, 8), field, provenance);
    std::mt19937 random(8);
    int accepted = 0;
    for (int i = 0; i < 20'000; ++i) {
        const std::string text = mutated(good, "0123456789,.-+eE\n\r# \"\xEF", random);
        const Result<EventList> read = readEventsCsv(text, "hits.csv");
        ASSERT_EQ(bool(read), !read.value.events.empty());
        ASSERT_TRUE(isOneLine(read.error)) << read.error;
        ASSERT_TRUE(read || read.error.starts_with("hits.csv:")) << read.error;
        ASSERT_TRUE(std::ranges::all_of(read.value.events, isPlayable));
        ASSERT_TRUE(std::ranges::is_sorted(read.value.events, {}, &CollisionEvent::timeNs));
        if (!read) continue;
        ++accepted;
        ASSERT_TRUE(
            readEventsCsv(eventsCsv(read.value.events, read.value.field, provenance), "again").value ==
            read.value);
    }
    EXPECT_GT(accepted, 1'000);
    EXPECT_LT(accepted, 19'000);
}

TEST(EventsCsv, NoTruncationCrashesOrHalfLoads) {
    const std::string good = eventsCsv(randomEvents(9, 4), field, provenance);
    for (std::size_t length = 0; length < good.size(); ++length) {
        const Result<EventList> read = readEventsCsv(std::string_view(good).substr(0, length), "hits.csv");
        EXPECT_EQ(bool(read), !read.value.events.empty()) << length;
    }
}

TEST(EventsCsv, ACommaLocaleChangesNothing) {
    const Events events = randomEvents(10, 200);
    const std::string text = eventsCsv(events, field, provenance);
    const CommaLocale comma;
    EXPECT_TRUE(eventsCsv(events, field, provenance) == text);
    EXPECT_TRUE(readGood(text) == events);
    EXPECT_TRUE(has(errorOf(shortHeader + "1,20000.5,3,4,5,6\n"), "<= 20000, found \"20000.5\""));
    if (!comma.hasCLocale)
        GTEST_SKIP() << "no C locale with a decimal comma here; tried with C++ streams only";
}

using EventsCsvFileTest = FolderTest;

// A file is read in blocks, a text at once.
TEST_F(EventsCsvFileTest, AFileIsReadAsItsText) {
    const std::string row = "1,2,3,0.4,5,6\n", many = shortHeader + [&] {
        std::string rows;
        for (int i = 0; i < 20'000; ++i) rows += row;
        return rows;
    }();
    const std::string name = (folder / "hits.csv").string();
    for (const std::string& text :
         {std::string{}, std::string{"\n"}, "\xEF\xBB\xBF# a\r\n\n" + shortHeader + row, shortHeader,
          shortHeader + "\n \n", shortHeader + row + "\n\n" + row, shortHeader + row + "\n\n", many,
          many + "1,2", many + "0.5,2,3,0.4,5,6", many + "\n\n" + row,
          "# " + std::string(200'000, 'a') + "\n" + many}) {
        ASSERT_EQ(writeFile(name, text), "");
        const auto fromFile = loadEventsCsv(name), fromText = readEventsCsv(text, name);
        EXPECT_EQ(fromFile.error, fromText.error);
        EXPECT_TRUE(fromFile.value == fromText.value);
    }
    ASSERT_EQ(writeFile(name, many + std::string(2'000'000, '1')), "");
    EXPECT_EQ(loadEventsCsv(name).error, name + ":20002: expected lines of at most 1000000 bytes");
    EXPECT_EQ(loadEventsCsv(folder / "none.csv").error,
              (folder / "none.csv").string() + ": cannot be read: No such file or directory");
}

} // namespace physvib::events_csv_test
