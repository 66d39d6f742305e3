// SPDX-License-Identifier: GPL-3.0-or-later
// Stores task results as one-row tables that can be opened individually.
#include "CommandLine/Sweep/SweepFolder.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Provenance.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include "Live/Recordings/SoundHead.h"
#include "Scene/SceneFileLimits.h"
#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace physvib {
namespace {

namespace fs = std::filesystem;

std::string headOf(const PlannedTask& task) {
    return provenanceComment(
        {PHYSVIB_VERSION, {{"task", task.hash}, {"call", task.task.call}, {"files", task.files}}});
}

/// True if the file has as many samples as its header says. After a power failure, a file may exist but be
/// empty or truncated.
bool isWavWhole(const std::string& path) {
    if (path.empty()) return true;
    const auto file = openRegular(path, std::numeric_limits<std::size_t>::max());
    return file && readSoundHead(*file.value.stream, static_cast<std::int64_t>(file.value.bytes));
}

} // namespace

// Calls that begin together all find no design. One of them writes it, and the others wait for it.
std::string SweepFolder::prepare(const std::string& designText) const {
    if (auto fault = makeFolderOf(folder_ / "tasks" / "of all"); !fault.empty()) return fault;
    constexpr int mostTries = 500; // five seconds
    for (int tries = 1;; ++tries) {
        const auto kept = readFile(design(), limits::maxSweepFileBytes);
        if (kept && kept.value == designText) return {};
        AtomicFile file{design()};
        if (!file.isTaken() || tries == mostTries) return file.write(designText), file.commit();
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
}

std::string SweepFolder::makeFolderOf(const fs::path& file) const {
    const fs::path folder = file.parent_path();
    std::error_code fault;
    fs::create_directories(folder, fault);
    if (fault) return folder.string() + ": cannot be made: " + fault.message();
    return isWithin(folder_, folder) ? std::string{} : folder.string() + ": " + leadsElsewhere;
}

std::optional<CsvTable> SweepFolder::table(const PlannedTask& task) const {
    const auto text = readFile(result(task.hash), limits::maxSweepFileBytes);
    // truncated by a full disk, or of another task
    if (!text || !text.value.starts_with(headOf(task)) || std::ranges::count(text.value, '\n') != 3 ||
        !text.value.ends_with('\n'))
        return std::nullopt;
    auto table = readCsvTable(text.value, result(task.hash).string());
    if (!table || table.value.rows.size() != 1 || !table.value.column("warnings")) return std::nullopt;
    if (!isWavWhole(wav(task.hash)) || !isEventListWhole(task, table.value)) return std::nullopt;
    return std::move(table.value);
}

// True if it has at least as many rows as events were measured.
bool SweepFolder::isEventListWhole(const PlannedTask& task, const CsvTable& table) const {
    const std::string path = events(task.hash);
    if (path.empty()) return true;
    const auto text = readFile(path, limits::maxEventsFileBytes);
    double lines = 2.0; // provenance and header
    for (const char* const counted : {"hits", "grains"}) {
        const auto column = table.column(counted);
        lines += column ? parseNumber<double>(table.rows.front().cells[*column]).value_or(0.0) : 0.0;
    }
    return text && text.value.ends_with('\n') &&
           static_cast<double>(std::ranges::count(text.value, '\n')) >= lines;
}

std::string SweepFolder::text(const PlannedTask& task, const std::vector<SweepFeature>& features,
                              const std::string& warnings) {
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
