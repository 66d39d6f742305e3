// SPDX-License-Identifier: GPL-3.0-or-later
// Every protocol of Docs/protocol-examples from its check to its report by simulated participants; and a
// report with the times of a person's study.
#include "Calls.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ReportBuilder.h"
#include <gtest/gtest.h>

namespace physvib::protocol_examples_test {

class ProtocolExamples : public test::CommandLine {
protected:
    void SetUp() override {
        test::CommandLine::SetUp();
        for (const auto& entry :
             std::filesystem::directory_iterator{PHYSVIB_SOURCE_DIR "/Docs/protocol-examples"}) {
            std::filesystem::copy(entry, folder_ / entry.path().filename());
            if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
        }
    }
    std::vector<std::string> names;
};

TEST_F(ProtocolExamples, AreCheckedRunAndReported) {
    ASSERT_GE(names.size(), 10u);
    for (const std::string& name : names) {
        EXPECT_FALSE(has(runs("study check " + name + ".json").out, "error: ")) << name;
        runs("study run " + name + ".json --observer simulated --participants 3 --out " + name);
        runs("report " + name + "/*.csv --protocol " + name + ".json --out " + name + "-report");
        const std::string page = read(name + "-report/index.html");
        EXPECT_TRUE(hasNone(page, {"no analysis is known", "<td>not finished</td>"})) << name;
    }
}

TEST_F(ProtocolExamples, TheReportHasTheFieldsOfItsProtocol) {
    runs("study run decay-steps.json --observer simulated --participants 2 --out t");
    runs("report t/*.csv --protocol decay-steps.json --out r");
    const std::string page = read("r/index.html");
    EXPECT_TRUE(
        hasAll(page, {"variables (name decay_per_s; at_0_db 10)", "; interval_s 0.6; ", "; feedback yes; "}));
    EXPECT_TRUE(has(read("t/decay-steps-P01.csv"), "--decay 31.622777 --level-of energy"));
}

TEST_F(ProtocolExamples, TimesOfAPersonAreTold) {
    runs("study run strength-numbers.json --observer simulated --participant P01 --out t");
    std::string rows = read("t/strength-numbers-P01.csv");
    for (std::size_t at = 0; (at = rows.find("simulated", at)) != std::string::npos;)
        rows.replace(at, 9, "person");
    write("t/strength-numbers-P01.csv", rows);
    const std::string head = "time_utc,event,trials,language,outputs,noise_outputs\n";
    const std::string all = "2026-11-24T14:00:00Z,start,0,ko,1 2,5 6\n2026-11-24T14:10:00Z,break,9,,,\n"
                            "2026-11-24T14:13:00Z,go-on,9,,,\n2026-11-24T15:00:00Z,resume,9,ko,1 2,5 6\n"
                            "2026-11-24T15:20:00Z,end,18,,,\n";
    write("t/strength-numbers-P01.times.txt", head + all);
    const std::string report = "report t/*.csv --protocol strength-numbers.json --out ";
    runs(report + "r");
    EXPECT_TRUE(has(read("r/index.html"),
                    "<td>P01</td><td>2026-11-24T14:00:00Z</td><td>2026-11-24T15:20:00Z</td><td>yes</td><td "
                    "class=\"number\">2</td><td class=\"number\">47</td><td class=\"number\">1</td><td "
                    "class=\"number\">1</td><td class=\"number\">3</td><td "
                    "class=\"number\">0</td><td>ko</td><td>1 "
                    "2</td><td>5 6</td>"));
    // a window that was closed in a break: one break, which goes on
    write("t/strength-numbers-P01.times.txt",
          head + "2026-11-24T14:00:00Z,start,0,,1 2,\n2026-11-24T14:10:00Z,break,9,,,\n"
                 "2026-11-24T14:11:00Z,pause,9,,,\n2026-11-24T14:13:00Z,go-on,9,,,\n"
                 "2026-11-24T14:14:00Z,go-on,9,,,\n2026-11-24T14:20:00Z,end,18,,,\n");
    runs(report + "r0");
    EXPECT_TRUE(has(read("r0/index.html"),
                    "<td class=\"number\">1</td><td class=\"number\">4</td><td class=\"number\">1</td>"));
    // rows of which it must not be true
    write("t/strength-numbers-P01.times.txt", head + "2026-11-24T14:00:00Z,start,0,,1 2,\n");
    runs(report + "r2");
    const std::string page = read("r2/index.html");
    EXPECT_TRUE(has(page, "<td>2026-11-24T14:00:00Z</td><td>no</td><td class=\"number\">1</td>"));
    write("t/strength-numbers-P01.times.txt", head + "yesterday,start,0,,1 2,\n");
    const auto wrong = call(report + "r3");
    EXPECT_EQ(wrong.exitCode, 1);
    EXPECT_TRUE(has(wrong.err, "t/strength-numbers-P01.times.txt:2: column time_utc: expected a time like"));
    std::filesystem::remove(folder_ / "t/strength-numbers-P01.times.txt");
    runs(report + "r4");
    EXPECT_TRUE(has(read("r4/index.html"), "without a file of times"));
}

// A report's section on methods has every field of a protocol by its name, with its default, and none that
// says nothing.

Protocol read(const std::string& sessions, const std::string& condition, const std::string& more = {}) {
    const auto protocol = readProtocol(R"({"physvib_protocol": 1, "name": "p", )" + more +
                                           R"( "conditions": [{"name": "PHONE", )" + condition +
                                           R"(}], "sessions": [{"name": "main", )" + sessions + "}]}",
                                       "p");
    EXPECT_TRUE(protocol) << protocol.error;
    return protocol.value;
}

const char* const grid = R"("stimuli": "grid", "columns": 3, "rows": 2)";

TEST(ProtocolWords, FieldsOfAProtocolStandByTheirNames) {
    EXPECT_EQ(protocolText(read(R"("task": "identify")", grid)),
              "name p; exposure_limit_m_per_s2 2.5; condition_order given");
    EXPECT_EQ(
        protocolText(read(R"("task": "identify")", grid,
                          R"("title": "t", "seed": 4, "pink_noise": true, "condition_break_s": 77,
                                    "condition_order": "latin-square", "closing_question": "Why so?",)")),
        "name p; title t; pink_noise yes; pink_noise_db -40; exposure_limit_m_per_s2 2.5; condition_order "
        "latin-square; condition_break_s 77; closing_question \u201cWhy so?\u201d");
}

TEST(ProtocolWords, StimuliHaveTheFieldsOfTheirKind) {
    EXPECT_EQ(conditionText(
                  read(R"("task": "identify")", std::string{grid} + R"(, "level_g": 0.37)").conditions[0]),
              "PHONE: layout phone4; frequency_hz 205; level_g 0.37; stimuli grid; columns 3; rows 2; points "
              "corners; "
              "law linear; exponent 1; seconds 1");
    EXPECT_EQ(
        conditionText(read(R"("task": "identify")", R"("layout": "phone1", "stimuli": "calls",
        "factors": [{"name": "hz", "values": ["80", "120"]}],
        "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --frequency {hz}")")
                          .conditions[0]),
        "PHONE: layout phone1; stimuli calls; factors (name hz; values 80 | 120); call stimulus phantom --at "
        "0.5,0.5 --layout phone1 --frequency {hz}")
        << "without the frequency and level of grids";
}

TEST(ProtocolWords, SessionsHaveTheirMethodsWithDefaults) {
    EXPECT_EQ(sessionText(read(R"("task": "choose", "question": "Which?", "most_plays": 3,
        "alternatives": [{"name": "a"}, {"name": "b", "level_db": 2}], "staircase": {"alternative": "b"}})"
                               R"(, {"name": "after", "training": true, "task": "identify")",
                               grid)
                              .sessions[0]),
              "main: task choose; question \u201cWhich?\u201d; order random; repetitions 1; most_plays 3; "
              "alternatives "
              "(name a) | (name b; level_db 2); staircase (alternative b; start_db 6; step_db 2; "
              "least_step_db 0.5; "
              "least_db 0; most_db 40; up_ratio 1; down 2; reversals 8; most_trials 200)");
    EXPECT_EQ(sessionText(
                  read(R"("task": "rate", "scales": ["rough", "old"], "training": true)", grid).sessions[0]),
              "main: training yes; task rate; order random; repetitions 1; scales rough | old; anchors "
              "Strongly disagree "
              "| Strongly agree");
}

} // namespace physvib::protocol_examples_test
