// SPDX-License-Identifier: GPL-3.0-or-later
// Trials as a BIDS dataset: the files that its validator wants, nothing lost, nothing that breaks a row.
#include "Lab/Report/AnalysisScript.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace physvib {
namespace {

CsvTable trials() {
    return {"t.csv",
            {},
            {"participant", "observer", "condition", "trial", "response", "response_s", "realism"},
            {{2, {"P-1", "person", "box", "1", "a\tb", "1.5", "70"}},
             {3, {"P1", "person", "box", "1", "", "2", "60"}},
             {4, {"P-1", "person", "box", "2", "c", "0.5", "50"}}}};
}

TEST(BidsDataset, HasTheFilesThatBidsAsksFor) {
    const auto files = bidsDataset(trials(), {"A study", "eight-methods", "0.1", {{"seed", "1"}}, false});
    std::vector<std::string> names;
    for (const auto& [name, text] : files) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{
                         "README", "dataset_description.json", "participants.json", "participants.tsv",
                         "sub-P1/beh/sub-P1_task-eightmethods_beh.tsv",
                         "sub-P1x2/beh/sub-P1x2_task-eightmethods_beh.tsv", "task-eightmethods_beh.json"}));
    EXPECT_EQ(files.at("participants.tsv"),
              "participant_id\tcode\tobserver\nsub-P1\tP-1\tperson\nsub-P1x2\tP1\tperson\n");
    EXPECT_EQ(files.at("sub-P1/beh/sub-P1_task-eightmethods_beh.tsv"),
              "observer\tcondition\ttrial\tresponse\tresponse_time\trealism\nperson\tbox\t1\ta\\x09b\t1."
              "5\t70\nperson\tbox\t2\tc\t0.5\t50\n");
    EXPECT_NE(files.at("sub-P1x2/beh/sub-P1x2_task-eightmethods_beh.tsv").find("\tn/a\t2\t60\n"),
              std::string::npos);
}

TEST(BidsDataset, EveryColumnIsDescribed) {
    const auto files = bidsDataset(trials(), {"A study", "t", "0.1", {}, true});
    const auto sidecar = nlohmann::json::parse(files.at("task-t_beh.json"));
    for (const char* column : {"observer", "condition", "trial", "response", "response_time", "realism"})
        EXPECT_TRUE(sidecar.at(column).contains("Description")) << column;
    EXPECT_EQ(sidecar.at("response_time").at("Units"), "s");
    EXPECT_EQ(sidecar.at("realism").at("Description"), "Column realism of the tables that were read");
    const auto told = bidsDataset(trials(), {"s", "t", "0", {}, false, {{"realism", "Rating from 1 to 7"}}});
    EXPECT_NE(told.at("task-t_beh.json").find("\"Rating from 1 to 7\""), std::string::npos);
    const auto description = nlohmann::json::parse(files.at("dataset_description.json"));
    EXPECT_EQ(description.at("BIDSVersion"), "1.8.0");
    EXPECT_NE(description.at("Name").get<std::string>().find("SIMULATED"), std::string::npos);
    EXPECT_NE(files.at("README").find("SIMULATED"), std::string::npos);
}

TEST(BidsDataset, WithoutParticipantsThereIsNone) {
    EXPECT_TRUE(bidsDataset({"t", {}, {"a"}, {{2, {"1"}}}}, {"s", "t", "0", {}, false}).empty());
}

} // namespace
} // namespace physvib
