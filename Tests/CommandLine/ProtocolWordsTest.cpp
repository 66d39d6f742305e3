// SPDX-License-Identifier: GPL-3.0-or-later
// A report's section on methods has every field of a protocol by its name, with its default, and none that
// says nothing.
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ReportBuilder.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

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
    EXPECT_EQ(protocolWords(read(R"("task": "identify")", grid)),
              "name p; exposure_limit_m_per_s2 2.5; condition_order given");
    EXPECT_EQ(
        protocolWords(read(R"("task": "identify")", grid,
                           R"("title": "t", "seed": 4, "pink_noise": true, "condition_break_s": 77,
                                    "condition_order": "latin-square", "closing_question": "Why so?",)")),
        "name p; title t; pink_noise yes; pink_noise_db -40; exposure_limit_m_per_s2 2.5; condition_order "
        "latin-square; condition_break_s 77; closing_question \u201cWhy so?\u201d");
}

TEST(ProtocolWords, StimuliHaveTheFieldsOfTheirKind) {
    EXPECT_EQ(conditionWords(
                  read(R"("task": "identify")", std::string{grid} + R"(, "level_g": 0.37)").conditions[0]),
              "PHONE: layout phone4; frequency_hz 205; level_g 0.37; stimuli grid; columns 3; rows 2; points "
              "corners; "
              "law linear; exponent 1; seconds 1");
    EXPECT_EQ(
        conditionWords(read(R"("task": "identify")", R"("layout": "phone1", "stimuli": "calls",
        "factors": [{"name": "hz", "values": ["80", "120"]}],
        "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --frequency {hz}")")
                           .conditions[0]),
        "PHONE: layout phone1; stimuli calls; factors (name hz; values 80 | 120); call stimulus phantom --at "
        "0.5,0.5 --layout phone1 --frequency {hz}")
        << "without the frequency and level of grids";
}

TEST(ProtocolWords, SessionsHaveTheirMethodsWithDefaults) {
    EXPECT_EQ(sessionWords(read(R"("task": "choose", "question": "Which?", "most_plays": 3,
        "alternatives": [{"name": "a"}, {"name": "b", "level_db": 2}], "staircase": {"alternative": "b"}})"
                                R"(, {"name": "after", "training": true, "task": "identify")",
                                grid)
                               .sessions[0]),
              "main: task choose; question \u201cWhich?\u201d; order random; repetitions 1; most_plays 3; "
              "alternatives "
              "(name a) | (name b; level_db 2); staircase (alternative b; start_db 6; step_db 2; "
              "least_step_db 0.5; "
              "least_db 0; most_db 40; up_ratio 1; down 2; reversals 8; most_trials 200)");
    EXPECT_EQ(sessionWords(
                  read(R"("task": "rate", "scales": ["rough", "old"], "training": true)", grid).sessions[0]),
              "main: training yes; task rate; order random; repetitions 1; scales rough | old; anchors "
              "Strongly disagree "
              "| Strongly agree");
}

} // namespace
} // namespace physvib
