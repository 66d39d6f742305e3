// SPDX-License-Identifier: GPL-3.0-or-later
// Results are tables of one row: a person can open each.
#include "CommandLine/Sweep/SweepFolder.h"
#include "Files/Disk/AtomicFile.h"
#include "Files/Disk/FileLimits.h"
#include "Files/Disk/ReadFile.h"
#include "Files/Provenance.h"
#include "Files/Text/NumberText.h"
#include <algorithm>

namespace physvib {
namespace {

namespace fs = std::filesystem;

std::string headOf(const PlannedTask& task) { return provenanceComment({PHYSVIB_VERSION, {{"task", task.hash}, {"call", task.task.call}, {"files", task.files}}}); }

bool isThere(const std::string& path) {
    std::error_code none;
    return path.empty() || fs::exists(path, none);
}

} // namespace

std::string SweepFolder::prepare(const std::string& designText) const {
    std::error_code fault;
    fs::create_directories(folder_ / "tasks", fault);
    if (fault) return folder_.string() + ": cannot be made: " + fault.message();
    const auto kept = readFile(design(), limits::maxSweepFileBytes);
    return kept && kept.value == designText ? std::string{} : writeFile(design(), designText);
}

std::optional<std::string> SweepFolder::read(const PlannedTask& task) const {
    const auto text = readFile(result(task.hash), limits::maxSweepFileBytes);
    if (!text || !text.value.starts_with(headOf(task)) || std::ranges::count(text.value, '\n') != 3 || !text.value.ends_with('\n')) return std::nullopt; // a disk that was full, a machine that lost its power
    if (!isThere(wav(task.hash)) || !isThere(events(task.hash))) return std::nullopt;
    return text.value;
}

std::optional<CsvTable> SweepFolder::table(const PlannedTask& task) const {
    const auto text = read(task);
    if (!text) return std::nullopt;
    auto table = readCsvTable(*text, result(task.hash).string());
    if (!table || table.value.rows.size() != 1 || !table.value.column("warnings")) return std::nullopt;
    return std::move(table.value);
}

std::string SweepFolder::text(const PlannedTask& task, const std::vector<SweepFeature>& features, const std::string& warnings) {
    std::string text = headOf(task);
    for (const SweepFeature& feature : features) text += feature.name + ',';
    text += "warnings\n";
    for (const SweepFeature& feature : features) {
        if (feature.value) appendNumber(text, *feature.value);
        text += ',';
    }
    appendCell(text, warnings);
    return text + '\n';
}

} // namespace physvib
