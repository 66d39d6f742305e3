// SPDX-License-Identifier: GPL-3.0-or-later
// Tests over participants as researchers call them: R's own example data, the tidy table, refusals.
#include "Calls.h"

namespace physvib {
namespace {

using AnalyseTests = test::CommandLine;

/// R's `sleep` (Student 1908): hours of sleep that ten people gained by two drugs.
const std::string sleep =
    "ID,drug,extra\n1,1,0.7\n2,1,-1.6\n3,1,-0.2\n4,1,-1.2\n5,1,-0.1\n6,1,3.4\n7,1,3.7\n8,1,0.8\n9,1,0\n10,1,"
    "2\n"
    "1,2,1.9\n2,2,0.8\n3,2,1.1\n4,2,0.1\n5,2,-0.1\n6,2,4.4\n7,2,5.5\n8,2,1.6\n9,2,4.6\n10,2,3.4\n";

TEST_F(AnalyseTests, StudentsSleepersAsInR) {
    write("s.csv", sleep);
    const std::string columns = "s.csv --measure extra --within drug --participant ID";
    EXPECT_EQ(call("analyse pairs " + columns).out,
              "drug: 1 - 2: t(9) = -4.062, p = 0.003, Holm p = 0.003, difference -1.58 (95 % interval -2.46 "
              "to -0.70), d = -1.285 (95 % interval -2.118 to -0.415), n = 10\n");
    EXPECT_EQ(call("analyse wilcoxon " + columns).out,
              "drug: V = 0.000, p = 0.009, rank-biserial r = -1.000, n = 10\n");
    EXPECT_EQ(call("analyse anova " + columns).out,
              "drug: F(1, 9) = 16.501, p = 0.003, generalised eta squared = 0.161 (95 % interval 0.020 to "
              "0.343), n = 10\n");
    EXPECT_EQ(call("analyse shapiro " + columns).out,
              "drug=1: W = 0.926, p = 0.408, n = 10\ndrug=2: W = 0.919, p = 0.351, n = 10\n");
    EXPECT_EQ(call("analyse mann-whitney s.csv --measure extra --between drug").err.find("participant ID"),
              std::string::npos);
}

TEST_F(AnalyseTests, TheTableIsTidy) {
    std::string text = "participant,law,device,group,observer,score\n";
    for (int p = 0; p < 8; ++p)
        for (const char* law : {"lin", "log", "sqrt"})
            for (const char* device : {"phone", "ring"})
                text += "P" + std::to_string(p) + "," + law + "," + device + "," + (p % 2 ? "old" : "new") +
                        ",simulated," +
                        std::to_string((p * 37 + law[1] * 11 + device[0] * 7) % 23 + law[1] % 5) + "\n";
    write("t.csv", text);
    const auto outcome =
        call("analyse anova t.csv --measure score --within law,device --between group --export e.csv");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("SIMULATED", 0), 0u);
    EXPECT_NE(outcome.out.find("\nType III sums of squares"), std::string::npos) << outcome.out;
    const std::string table = read("e.csv");
    EXPECT_NE(
        table.find("\neffect,df1,df2,statistic,p,p_corrected,epsilon,effect_size,n,effect_least,effect_most,"
                   "difference,difference_least,difference_most\n"),
        std::string::npos)
        << table;
    for (const char* effect : {"\ngroup,1,6,", "\nlaw,2,12,", "\ngroup:law,2,12,", "\ndevice,1,6,",
                               "\nlaw:device,2,12,", "\ngroup:law:device,2,12,"})
        EXPECT_NE(table.find(effect), std::string::npos) << table;
    EXPECT_EQ(call("analyse anova t.csv --measure score --within law --aligned-ranks").exitCode, 0);
    EXPECT_NE(call("analyse friedman t.csv --measure score --within law,device")
                  .out.find("\ndevice: chi-squared(1) = "),
              std::string::npos);
    EXPECT_NE(call("analyse kruskal-wallis t.csv --measure score --between group")
                  .err.find("warning: several rows of a participant are averaged"),
              std::string::npos);
}

TEST_F(AnalyseTests, RefusalsNameWhatIsWrong) {
    write("s.csv", sleep);
    refuses("analyse anova s.csv --measure extra --within drug", 1,
            "s.csv: expected a column participant, found none", 1);
    refuses("analyse anova s.csv --measure hours --within drug --participant ID", 1,
            "s.csv: expected a column hours, found none", 1);
    refuses("analyse anova s.csv --within drug", 2, "--measure", 1);
    refuses("analyse anova s.csv --measure extra --within a,b,c,d", 2, "--within", 1);
    refuses("analyse pairs s.csv --measure extra --within drug --correction fisher", 2, "--correction", 1);
    refuses("analyse friedman s.csv --measure extra --participant ID", 1, "s.csv: expected a within-factor",
            1);
    write("c.csv", "participant,a,y\nP,x,1\nP,z,1\nQ,x,1\nQ,z,1\n");
    refuses("analyse anova c.csv --measure y --within a", 1,
            "c.csv: effect a: expected participants who differ in it, found none", 2);
    refuses("analyse wilcoxon c.csv --measure y --within a", 1,
            "c.csv: column a: expected levels that differ for some participant, found none", 2);
}

TEST_F(AnalyseTests, FunctionsAreFittedToEachParticipant) {
    std::string choices = "participant,condition,level_db,correct\n",
                magnitudes = "participant,stimulus,value\n";
    const int right[] = {11, 12, 14, 17, 19, 20};
    for (int p = 0; p < 3; ++p)
        for (int level = 0; level < 6; ++level)
            for (int t = 0; t < 20; ++t)
                choices += "P" + std::to_string(p) + ",ring," + std::to_string(2 * level + p) + "," +
                           (t < right[level] ? "1\n" : "0\n");
    for (int level = 1; level <= 4; ++level)
        magnitudes += "P,level_g=" + std::to_string(level) + "," + std::to_string(3 * level * level) + "\n";
    write("c.csv", choices);
    const auto fitted = call("analyse psychometric c.csv --export f.csv");
    ASSERT_EQ(fitted.exitCode, 0) << fitted.err;
    EXPECT_EQ(fitted.out.rfind("ring: threshold ", 0), 0u) << fitted.out;
    EXPECT_NE(fitted.out.find(", 3 participants\n"), std::string::npos) << fitted.out;
    EXPECT_NE(
        read("f.csv").find(
            "\ncondition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood\nring,P0,120,"),
        std::string::npos)
        << read("f.csv");
    write("m.csv", magnitudes);
    EXPECT_EQ(call("analyse power-law m.csv --level level_g").out, "exponent 2.000, 1 participant\n");
    refuses("analyse power-law c.csv", 1, "c.csv: expected a column value, found none", 3);
    refuses(
        "analyse power-law m.csv", 1,
        "m.csv:2: column stimulus: expected a level that is a number from -1e6 to 1e6, found \"level_g=1\"",
        3);
    refuses("analyse psychometric c.csv --level participant", 1,
            "c.csv:2: column participant: expected a level that is a number", 3);
    refuses("analyse psychometric c.csv --shape square", 2, "--shape", 3);
    write("c.csv", "participant,level_db,correct\nP,1,1\nP,2,1\n");
    refuses("analyse psychometric c.csv", 1,
            "c.csv: nobody can be fitted; participant P left out: expected answers that change with the "
            "level, found the same share",
            3);
}

} // namespace
} // namespace physvib
