// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib analyse` as researchers and scripts hold on to it: lines, warnings, refusals.
#include "Calls.h"

namespace physvib::analyse_command_test {

using Analyse = test::CommandLine;

const std::string publishedCounts = "condition,row,c1,c2,c3,c4,c5,c6,c7\n" // thesis Fig. 4.9 (a)
                                    "PHONE-LINEAR,1,2.87,3.18,3.39,3.46,3.22,2.62,3.45\n"
                                    "PHONE-LINEAR,2,0.01,1.60,3.26,1.42,2.77,0.76,1.20\n"
                                    "PHONE-LINEAR,3,6.51,1.22,3.14,4.20,3.64,1.74,3.11\n"
                                    "PHONE-LINEAR,4,3.45,1.17,1.95,3.77,3.57,1.03,3.53\n"
                                    "PHONE-LINEAR,5,2.84,2.56,3.99,5.41,4.15,2.42,3.35\n"
                                    "RING-LOGARITHM,1,3.69,4.93,3.10,2.22,1.44,3.63,3.60\n"
                                    "RING-LOGARITHM,2,2.09,2.20,1.34,0.87,2.53,1.06,1.56\n"
                                    "RING-LOGARITHM,3,3.25,2.52,3.16,6.54,2.93,3.05,2.90\n"
                                    "RING-LOGARITHM,4,1.65,1.78,3.04,3.44,3.12,2.29,2.97\n"
                                    "RING-LOGARITHM,5,2.62,3.56,2.29,3.90,3.24,4.05,3.45\n";

TEST_F(Analyse, AStaircaseWithoutReversalsHasNoThreshold) {
    // An observer that always feels 0.25 g and never silence does not err.
    std::string protocol = call("study show level-steps").out;
    const std::string standard = "{ \"name\": \"standard\" }";
    ASSERT_TRUE(has(protocol, standard));
    protocol.replace(protocol.find(standard), standard.size(),
                     "{ \"name\": \"standard\", \"level_db\": -80 }");
    write("mine.json", protocol);
    runs("study run mine.json --observer simulated");
    const auto flat = call("analyse levels level-steps-P01.csv");
    EXPECT_TRUE(hasAll(flat.err, {"PHONE: participant P01 left out: a staircase has fewer than two reversals",
                                  "P01.csv: of no built-in protocol: unfinished"}));
    runs("study run level-steps --observer simulated --participant P02");
    EXPECT_FALSE(has(call("analyse levels level-steps-P02.csv").err, "fewer than two"));
    std::string cut = read("level-steps-P02.csv"); // the last staircase lacks its end
    for (int line = 0; line < 4; ++line) cut.erase(cut.rfind('\n', cut.size() - 2) + 1);
    write("level-steps-P02.csv", cut);
    EXPECT_TRUE(
        has(call("analyse levels level-steps-P02.csv").err, "P02 left out: main in PHONE: not finished"));
}

TEST_F(Analyse, MagnitudesWithoutAStimulusAreReadByTheirLevels) {
    write("m.csv", "participant,value,level_db\n01,2,0\n02,8,0\n01,3,6\n");
    EXPECT_TRUE(has(call("analyse levels m.csv --export l.csv").err,
                    "no column stimulus: level_db (dB) stands for it"));
    EXPECT_TRUE(has(read("l.csv"), "\ngeometric mean magnitude (SD of log10),,0,2,2,4,"));
}

TEST_F(Analyse, TrialsOfAnotherKindAreNamedWithTheCallThatReadsThem) {
    const auto expects = [&](const std::string& protocol, const std::string& asked,
                             const std::string& words) {
        runs("study run " + protocol + " --observer simulated");
        const auto outcome = call("analyse " + asked + " " + protocol + "-P01.csv");
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_TRUE(has(outcome.err, words));
    };
    expects("phantom-places", "confusion",
            "expected trials of this kind, found none; the file has trials that "
            "`physvib analyse resolution` reads");
    expects("phantom-places", "psychometric",
            "; the file has trials that `physvib analyse resolution` reads");
    expects("magnitudes", "resolution", "; the file has trials that `physvib analyse levels` reads");
    expects("model-or-sound", "ratings",
            "; the file has trials that `physvib analyse choices`, `analyse levels` reads");
    write("cells.csv", "target_column,target_row,x,y\n1,1,0.5,0.5\n");
    const auto cells = call("analyse places cells.csv").err;
    EXPECT_TRUE(has(cells, "cells.csv: expected a column target_x, found none; the file has trials "
                           "that `physvib analyse resolution` reads"));
    const auto places = runs("analyse places phantom-places-P01.csv --export places.csv");
    // our own rows
    EXPECT_TRUE(has(test::squeezed(places.out), "\nPHONE-LINEAR distance from the target 175 1 0."));
    std::filesystem::remove(folder_ / "places.csv");
    std::filesystem::remove(folder_ / "cells.csv");
    write("c.csv", "choice,participant\na,1\nb,1\n");
    refuses("analyse confusion c.csv", 1,
            "c.csv: expected a column stimulus, found none; the file has trials that "
            "`physvib analyse choices` reads",
            4);
    write("d.csv", "stimulus,participant,response\n,1,a\n");
    const auto own = call("analyse confusion d.csv").err;
    EXPECT_FALSE(has(own, "the file has")) << "its own kind, with another fault";
}

TEST_F(Analyse, PublishedPercentCountsGiveThePublishedResolutions) {
    write("p.csv", publishedCounts);
    const auto outcome = runs("analyse percent-counts p.csv --picture p.svg --export merged.csv");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(test::squeezed(outcome.out),
              "condition resolution columns rows sum_percent standard_deviation\n"
              "PHONE-LINEAR 5 x 5 1+2 | 3 | 4 | 5 | 6+7 1 | 2 | 3 | 4 | 5 99.96 1.321\n"
              "RING-LOGARITHM 7 x 4 1 | 2 | 3 | 4 | 5 | 6 | 7 1 | 2+3 | 4 | 5 100 1.113\n"
              "RING-LOGARITHM 7 x 4 1 | 2 | 3 | 4 | 5 | 6 | 7 1+2 | 3 | 4 | 5 100 1.113\n");
    EXPECT_TRUE(read("p.svg").starts_with("<svg "));
    EXPECT_TRUE(has(read("p.svg"), "<title>PHONE-LINEAR: 5 x 5</title>")) << "the merged grid";
    EXPECT_TRUE(has(read("merged.csv"), "\nRING-LOGARITHM,4,7,"));
    EXPECT_TRUE(has(test::squeezed(call("analyse percent-counts p.csv --threshold 1.4286").out),
                    "PHONE-LINEAR 7 x 3 "));
}

TEST_F(Analyse, ToleranceCountsNeighboursAsTheStimulus) {
    std::string text = "stimulus,response\n";
    for (int i = 0; i < 20; ++i) text += "\"1,1\",\"1,2\"\n\"3,3\",\"3,3\"\n";
    write("g.csv", text);
    const std::string exact = test::squeezed(call("analyse confusion g.csv").out);
    EXPECT_TRUE(has(exact, " 2 40 50 50 "));
    const auto outcome = call("analyse confusion g.csv --tolerance 1 --picture g.svg --export g-matrix.csv");
    EXPECT_TRUE(has(test::squeezed(outcome.out), " 2 40 50 100 1 91.24 100 over trials, Wilson's 1 1 1 1\n"))
        << "percent correct, IT, also corrected";
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(has(read("g-matrix.csv"), "\n,,\"1,1\",\"1,1\",20\n"));
    write("s.csv", "stimulus,response\ns0,s0\ns1,s1\n");
    refuses("analyse confusion s.csv --tolerance 1", 1,
            "s.csv: --tolerance: expected grid labels r,c, found \"s0\"", 4);
}

TEST_F(Analyse, ParticipantsTransferForThemselves) {
    write("c.csv",
          "participant,condition,stimulus,response\nP1,PHONE,a,a\nP1,PHONE,b,b\nP2,PHONE,a,a\nP2,PHONE,b,a\n"
          "P3,PHONE,a,a\n");
    const auto outcome = runs("analyse confusion c.csv --export m.csv --participants each.csv");
    EXPECT_TRUE(has(outcome.err, "stimuli are lacking of P3, left out of means of participants"));
    EXPECT_TRUE(has(test::squeezed(outcome.out), "\nPHONE 2 5 50 80 2 75 "))
        << "not of whom had the easier stimulus alone";
    EXPECT_TRUE(has(read("each.csv"), "\nPHONE,P3,1,,0,\n"));
    write("c.csv", "participant,stimulus,response\nP1,a,a\nP1,b,b\nP2,a,a\nP3,b,a\n");
    EXPECT_TRUE(has(call("analyse confusion c.csv").err, "stimuli are lacking of P2, P3\n"));
    write(
        "c.csv",
        "participant,condition,stimulus,response\nP1,PHONE,a,a\nP1,PHONE,b,b\nP2,PHONE,a,a\nP2,PHONE,b,a\n");
    EXPECT_FALSE(has(call("analyse confusion c.csv --participants each.csv").err, "are lacking"));
    EXPECT_TRUE(has(read("m.csv"), "\nPHONE,P2,b,a,1\n"));
    EXPECT_TRUE(has(read("each.csv"), "\nPHONE,P1,2,100,1,\nPHONE,P2,2,50,0,\n"));
}

TEST_F(Analyse, BadTrialsAreNamedAndHandled) {
    write("c.csv", "stimulus,response\na,a\nb,x\nb,\na,a\n");
    const auto outcome = runs("analyse confusion c.csv");
    EXPECT_TRUE(hasAll(outcome.err, {"c.csv: 1 trial without a response left out",
                                     "unequal numbers of answers: b 1, others up to 2",
                                     "responses that are no stimulus count as wrong: x"}));
    EXPECT_FALSE(has(outcome.out, "nan"));
    write("c.csv", "stimulus\na\n");
    refuses("analyse confusion c.csv", 1, "c.csv: expected a column response, found none", 1);
    write("c.csv", "stimulus,response\n1,2,1,2\n");
    refuses("analyse confusion c.csv", 1, "c.csv:2: expected 2 cells, found 4", 1);
    refuses("analyse confusion none.csv", 1, "none.csv: cannot be read", 1);
    refuses("analyse confusion", 2, "files", 1);
    refuses("analyse", 2, "", 1);
    write("p.csv", "condition,row,c1\nA,1,90\nA,2,5\n");
    EXPECT_TRUE(has(call("analyse percent-counts p.csv").err,
                    "A: percent counts sum to 95.00, expected 100 within 0.01"));
}

/// Five responses around each of 3 x 2 targets.
std::string responses() {
    std::string text = "condition,target_column,target_row,x,y\n";
    for (int c = 1; c <= 3; ++c)
        for (int r = 1; r <= 2; ++r)
            for (const auto& [dx, dy] :
                 {std::pair{0.0, 0.0}, {0.05, 0.01}, {-0.05, 0.02}, {0.01, 0.06}, {0.02, -0.05}})
                text += "WIDE," + std::to_string(c) + "," + std::to_string(r) + "," +
                        std::to_string((c - 0.5) / 3 + dx) + "," + std::to_string((r - 0.5) / 2 + dy) + "\n";
    return text;
}

TEST_F(Analyse, ResponsesGiveAResolutionAndItsCountsGiveItAgain) {
    write("r.csv", responses());
    const auto outcome =
        runs("analyse resolution r.csv --picture r.svg --counts counts.csv --export normals.csv");
    EXPECT_TRUE(has(test::squeezed(outcome.out), "\nWIDE 3 x 2 "));
    EXPECT_EQ(call("analyse percent-counts counts.csv").out, outcome.out);
    EXPECT_EQ(files().size(), 4u);
    const std::string picture = read("r.svg");
    runs("analyse resolution r.csv --picture r.svg");
    EXPECT_EQ(read("r.svg"), picture) << "the same bytes again";
}

TEST_F(Analyse, ResponsesThatAllowNoNormalAreNamedAndLeaveNothing) {
    write("r.csv", "condition,target_column,target_row,x,y\nA,1,1,0.5,0.5\n");
    refuses("analyse resolution r.csv --picture r.svg --counts c.csv", 1,
            "r.csv: A: column 1, row 1: expected three or more responses", 1);
    write("r.csv", responses() + "WIDE,4,1,0.99,0.2\n");
    const auto outcome = runs("analyse resolution r.csv");
    EXPECT_TRUE(
        hasAll(outcome.err, {"column 4, row 1: 1 responses, the condition's pooled covariance is taken",
                             "column 4, row 2: no responses"}));
    EXPECT_FALSE(has(outcome.out, "nan"));
}

TEST_F(Analyse, ChoicesAndRatings) {
    write("c.csv", "participant,condition,choice\nP1,pair=wood,RM\nP1,pair=steel,SV\nP2,pair=wood,RM\nP2,"
                   "pair=steel,RM\n");
    runs("analyse choices c.csv --picture c.svg --export c-out.csv");
    EXPECT_TRUE(has(read("c-out.csv"), "\nall,RM,3,4,2,75,75,,,\nall,SV,1,4,2,25,25,,,\n"));
    write("r.csv",
          "participant,condition,realism,harmony,liking\nP1,AV-FV-DRV,76,68,71\nP2,AF-FF-DRF,36,42,36\n");
    EXPECT_TRUE(has(test::squeezed(runs("analyse ratings r.csv --picture r.svg --export r-out.csv").out),
                    "\nAV-FV-DRV realism 1 1 76 76\n"));
    EXPECT_TRUE(has(read("r-out.csv"), "\nAF-FF-DRF,liking,1,1,36,36,,\n"));
}

TEST_F(Analyse, IconsAreThePatternsThatAreConfusedLeast) {
    std::string text = "stimulus,response\n";
    for (int i = 0; i < 100; ++i) {
        for (const std::string same : {"A-100", "B-100", "AB-100"}) text += same + "," + same + "\n";
        text += i % 3 ? "AA-100,AA-100\n" : "AA-100,A-100\n";
    }
    write("c.csv", text);
    EXPECT_EQ(runs("analyse icons c.csv --meanings 3 --picture i.svg").out,
              "3 meanings need 1.58 bit\nall trials: 4 patterns on 2 actuators, 1.73 bit: "
              "enough\n  A-100  100.0 % correct\n"
              "  AB-100  100.0 % correct\n  B-100  100.0 % correct\n");
    refuses("analyse icons c.csv --meanings 1", 2, "--meanings", 2);
}

TEST_F(Analyse, SimulatedDataIsMarkedWhereverItGoes) {
    write("c.csv", "observer,stimulus,response\nsimulated-PHONE,a,a\nsimulated-PHONE,b,b\n");
    EXPECT_TRUE(
        call("analyse confusion c.csv --export matrix.csv --picture s.svg").out.starts_with("SIMULATED"));
    EXPECT_TRUE(read("matrix.csv")
                    .starts_with("# physvib " PHYSVIB_VERSION " analysis=confusion observer=simulated\n"));
    write("c.csv", "observer,stimulus,response\nperson,a,a\nperson,b,b\n");
    runs("analyse confusion c.csv --picture p.svg");
    EXPECT_TRUE(has(read("s.svg"), ">SIMULATED<"));
    EXPECT_FALSE(has(read("p.svg"), ">SIMULATED<"));
}

// Functions fitted to each participant's trials, and what has gone to R.

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
    const auto fitted = runs("analyse psychometric c.csv --export f.csv");
    EXPECT_TRUE(has(test::squeezed(fitted.out), "\nring threshold 3 "));
    EXPECT_TRUE(
        has(read("f.csv"),
            "\ncondition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood\nring,P0,120,"));
    for (const auto& [from, to] :
         {std::pair{"correct\n", "choice\n"}, {",0\n", ",left\n"}, {",1\n", ",right\n"}})
        for (std::size_t at = 0; (at = choices.find(from, at)) != std::string::npos;)
            choices.replace(at, std::string_view{from}.size(), to);
    write("m.csv", choices);
    const auto left = call("analyse psychometric m.csv --measure choice=right --guess 0");
    EXPECT_TRUE(has(test::squeezed(left.out), "\nring point of subjective equality 3 "));
    write("m.csv", magnitudes);
    const std::string law = call("analyse power-law m.csv --level level_g").out;
    EXPECT_TRUE(has(test::squeezed(law), " exponent 1 2\n"));
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

TEST_F(AnalyseFits, AConditionOfOneLevelLeavesTheOthersTheirFits) {
    write("m.csv", "participant,condition,level,value\nP,flat,1,3\nP,steep,1,2\nP,steep,2,4\n");
    const auto law = runs("analyse power-law m.csv --level level");
    EXPECT_TRUE(has(test::squeezed(law.out), "\nsteep exponent 1 1\n"));
    EXPECT_TRUE(has(law.err, "flat: participant P left out: expected magnitudes of two or more levels"));
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

} // namespace physvib::analyse_command_test
