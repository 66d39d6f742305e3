// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the index row by row from the task files, so memory does not grow with the number of tasks.
#include "CommandLine/Sweep/SweepIndex.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Provenance.h"
#include "Io/Text/NumberText.h"
#include <algorithm>

namespace physvib {
namespace {

/// Distinct variables of all scenes.
std::vector<std::string> variableNames(const SweepDesign& design) {
    std::vector<std::string> names;
    for (const SweepScene& scene : design.scenes)
        for (const SweepFactor& variable : scene.variables)
            if (std::ranges::find(names, variable.name) == names.end()) names.push_back(variable.name);
    return names;
}

std::string columnOf(std::string option) {
    std::ranges::replace(option, '-', '_');
    return option;
}

/// Formats the header and the rows.
class IndexRows {
public:
    IndexRows(const SweepPlan& plan)
        : design_{plan.design()}
        , variables_{variableNames(design_)}
        , features_{SweepFeatures::names(plan.channels())} {}

    std::string head(std::uint64_t tasks) const {
        std::string text = provenanceComment({PHYSVIB_VERSION,
                                              {{"sweep", design_.name}, {"tasks", std::to_string(tasks)}}}) +
                           "task,scene";
        for (const std::string& name : variables_) appendCell(text += ',', "set_" + name);
        for (const SweepFactor& factor : design_.factors) appendCell(text += ',', columnOf(factor.name));
        text += ",seed";
        for (const std::string& name : features_) text += ',' + name;
        return text + ",warnings,hash,files,call\n";
    }

    void append(std::string& text, std::uint64_t number, const PlannedTask& planned,
                const CsvTable& table) const {
        appendNumber(text, number);
        appendCell(text += ',', planned.task.scene);
        appendVariables(text, planned.task);
        for (const std::string& option : planned.task.options) appendCell(text += ',', option);
        appendNumber(text += ',', planned.task.seed);
        const auto& cells = table.rows.front().cells;
        for (const std::string& name : features_) {
            const auto column = table.column(name);
            text.append(1, ',').append(column ? cells[*column] : "");
        }
        for (const std::string& words :
             {cells[*table.column("warnings")], planned.hash, planned.files, planned.task.call})
            appendCell(text += ',', words);
        text += '\n';
    }

private:
    void appendVariables(std::string& text, const SweepTask& task) const {
        const auto scene = std::ranges::find(design_.scenes, task.scene, &SweepScene::name);
        for (const std::string& name : variables_) {
            const auto own = std::ranges::find(scene->variables, name, &SweepFactor::name);
            appendCell(text += ',',
                       own == scene->variables.end()
                           ? std::string{}
                           : task.variables[static_cast<std::size_t>(own - scene->variables.begin())]);
        }
    }

    const SweepDesign& design_;
    std::vector<std::string> variables_, features_;
};

} // namespace

SweepGap findGap(const SweepPlan& plan, const SweepFolder& folder) {
    SweepGap gap;
    for (std::uint64_t i = 0; i < plan.size(); ++i) {
        const PlannedTask task = plan.at(i);
        if (!folder.has(task) && gap.tasks++ == 0) gap.first = task.task.call;
    }
    return gap;
}

std::string writeIndex(const SweepPlan& plan, const SweepFolder& folder) {
    constexpr std::size_t enough = 1'000'000; // buffer size in bytes
    AtomicFile file{folder.index()};
    const IndexRows rows{plan};
    std::string text = rows.head(plan.size());
    std::int64_t written = 0;
    for (std::uint64_t i = 0; i < plan.size(); ++i) {
        const PlannedTask task = plan.at(i);
        const auto table = folder.table(task);
        if (!table)
            return folder.result(task.hash).string() + ": expected the task " + task.task.call +
                   ", found none";
        rows.append(text, i + 1, task, *table);
        if (text.size() < enough && i + 1 < plan.size()) continue;
        if (!file.writeAt(written, text)) break;
        written += static_cast<std::int64_t>(text.size());
        text.clear();
    }
    return file.commit();
}

} // namespace physvib
