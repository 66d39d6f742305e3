// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the analyses, and which of them was asked for.
#include "CommandLine/AnalyseCommand.h"
#include "CommandLine/AnalyseGrids.h"
#include "CommandLine/AnalyseLabels.h"
#include "CommandLine/AnalyseVotes.h"
#include "CommandLine/ExitCode.h"
#include <CLI/CLI.hpp>

namespace physvib {
namespace {

struct Analysis {
    const char* name;
    const char* purpose;
    int (*run)(const AnalyseOptions&);
};

constexpr Analysis analyses[] = {
    {"confusion", "stimulus,response per trial: percent correct and information transfer", analyseConfusion},
    {"resolution", "pointing responses: normals, likelihood map, percent counts, perceptual resolution", analyseResolution},
    {"percent-counts", "percent counts: the largest grid that merging makes of them", analysePercentCounts},
    {"choices", "forced choices: shares of the alternatives", analyseChoices},
    {"ratings", "slider ratings: means by condition", analyseRatings},
    {"levels", "staircases, adjustments and magnitude estimations: thresholds and means", analyseLevels},
    {"icons", "stimulus,response per trial: the patterns that are confused least", analyseIcons},
};

void declareOwn(CLI::App& command, std::string_view name, AnalyseOptions& o) {
    const bool isGrid = name == "resolution" || name == "percent-counts";
    if (name == "confusion" || name == "icons")
        command.add_option("--tolerance", o.tolerance, "grid steps (rows + columns) that still count as correct")
            ->check(CLI::Range(0, 1000))->capture_default_str();
    if (isGrid)
        command.add_option("--threshold", o.thresholdPercent, "percent count that a cell must reach, inclusive")
            ->check(CLI::Range(0.0, 100.0))->capture_default_str();
    if (name == "resolution") command.add_option("--counts", o.countsPath, "the percent counts")->type_name("FILE.csv");
    if (name == "icons")
        command.add_option("--meanings", o.meanings, "how many meanings the icons shall have")
            ->check(CLI::Range(std::size_t{2}, std::size_t{1000}))->capture_default_str();
}

} // namespace

void declareAnalyse(CLI::App& command, AnalyseOptions& o) {
    command.require_subcommand(1);
    for (const Analysis& analysis : analyses) {
        CLI::App* const own = command.add_subcommand(analysis.name, analysis.purpose);
        own->add_option("files", o.files, "trials, or what the analysis is about; several are taken together")->required()->type_name("FILE.csv");
        own->add_option("--picture", o.picturePath, "the result to look at")->type_name("FILE.png");
        own->add_option("--export", o.exportPath, "the result as a table for a statistics package")->type_name("FILE.csv");
        declareOwn(*own, analysis.name, o);
    }
}

int runAnalyse(const CLI::App& command, const AnalyseOptions& options) {
    for (const Analysis& analysis : analyses)
        if (command.got_subcommand(analysis.name)) return analysis.run(options);
    return leave(exitUsage, "analyse: expected a kind of analysis (see physvib analyse --help)");
}

} // namespace physvib
