// SPDX-License-Identifier: GPL-3.0-or-later
// Functions fitted to each participant's trials, and what has gone to R.
#include "Calls.h"

namespace physvib {
namespace {

using AnalyseFits = test::CommandLine;

TEST_F(AnalyseFits, FunctionsAreFittedToEachParticipant) {
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
    EXPECT_NE(test::squeezed(fitted.out).find("\nring threshold 3 "), std::string::npos) << fitted.out;
    EXPECT_NE(
        read("f.csv").find(
            "\ncondition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood\nring,P0,120,"),
        std::string::npos)
        << read("f.csv");
    for (const auto& [from, to] :
         {std::pair{"correct\n", "choice\n"}, {",0\n", ",left\n"}, {",1\n", ",right\n"}})
        for (std::size_t at = 0; (at = choices.find(from, at)) != std::string::npos;)
            choices.replace(at, std::string_view{from}.size(), to);
    write("m.csv", choices);
    const auto left = call("analyse psychometric m.csv --measure choice=right --guess 0");
    EXPECT_NE(test::squeezed(left.out).find("\nring point of subjective equality 3 "), std::string::npos)
        << left.out;
    write("m.csv", magnitudes);
    const std::string law = call("analyse power-law m.csv --level level_g").out;
    EXPECT_NE(test::squeezed(law).find(" exponent 1 2\n"), std::string::npos) << law;
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

TEST_F(AnalyseFits, TestsThatWentToRSayWhereTheyAre) {
    write("t.csv", "participant,condition,y\nP,a,1\n");
    for (const char* test :
         {"anova", "friedman", "wilcoxon", "mann-whitney", "kruskal-wallis", "shapiro", "pairs"})
        refuses(std::string("analyse ") + test + " t.csv --measure y --within condition", 2,
                std::string("analyse ") + test +
                    ": tests are run in R: `physvib report TRIALS.csv... --out FOLDER`, then "
                    "`Rscript FOLDER/analysis.R`",
                1);
}

} // namespace
} // namespace physvib
