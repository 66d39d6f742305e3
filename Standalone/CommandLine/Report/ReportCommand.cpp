// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib report`, with writeFolder() and with runAnalysisScript(), which runs R.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/StudyReport.h"
#include "Studies/StudyCalls.h"
#include "System/Process.h"
#include <chrono>
#include <random>
#include <string>
#include <vector>

namespace physvib {
namespace {

struct ReportOptions {
    ReportJob job;
    std::vector<std::string> columnNames; ///< as NAME=COLUMN, before parsing
    std::string protocol;                 ///< name or path; empty: look up a built-in one
};

/// Creates missing folders; its destructor removes them again, innermost first, unless they are kept.
class CreatedFolders {
public:
    std::string make(const std::filesystem::path& folder) {
        std::error_code error;
        for (auto missing = std::filesystem::absolute(folder);
             !missing.empty() && !std::filesystem::exists(missing, error); missing = missing.parent_path())
            folders_.insert(folders_.begin(), missing);
        std::filesystem::create_directories(folder, error);
        return error || !std::filesystem::is_directory(folder)
                   ? folder.string() + ": expected a folder that can be written"
                   : "";
    }
    void keep() { folders_.clear(); }
    CreatedFolders() = default;
    CreatedFolders(const CreatedFolders&) = delete;
    CreatedFolders& operator=(const CreatedFolders&) = delete;
    ~CreatedFolders() {
        std::error_code ignored;
        // a folder with files in it stays
        for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
            std::filesystem::remove(*folder, ignored);
    }

private:
    std::vector<std::filesystem::path> folders_;
};

void declareReport(OptionTable& command, ReportOptions& o) {
    command.add("files", o.job.files, "the trial files of one study").required().as("TRIALS.csv...");
    command.add("--out", o.job.folder, "the folder: index.html, tables, analysis.R").required().as("FOLDER");
    command.add("--protocol", o.protocol, "the study's protocol, if it is no built-in one")
        .as("PROTOCOL.json");
    command.add("--bids", o.job.exportsBids, "also the trials as a BIDS dataset, in the folder bids");
    command.add("--notebook", o.job.exportsNotebook, "also analysis.qmd, a notebook of the tests' steps");
    command
        .add("--people", o.job.peoplePath,
             "who took part: participant and any of age, sex, handedness, group, excluded (why all trials "
             "of a participant are left out)")
        .as("PEOPLE.csv");
    command.add("--ethics", o.job.ethics, "sentence on the approval by an ethics board").as("WORDS");
    command.add("--consent", o.job.consent, "sentence on the participants' consent").as("WORDS");
    command
        .add("--noise", o.job.noise,
             "sentence on the noise as the participants heard it, e.g. its level in dB(A)")
        .as("WORDS");
    command
        .add("--plan", o.job.planPath, "what `study plan` wrote before the study: the page says what differs")
        .as("PLAN.txt");
    declareColumns(command, o.columnNames);
    command.add("--guess", o.job.guess, "of psychometric functions in other programs' tables: as in analyse")
        .in(0.0, 0.9);
}

int runReport(ReportOptions& o) {
    auto columns = parseColumnNames(o.columnNames);
    if (!columns) return reportExit(exitUsage, "--columns: " + columns.error);
    o.job.columns = std::move(columns.value);
    std::optional<Protocol> protocol;
    if (!o.protocol.empty()) {
        auto foundProtocol = loadCheckedProtocol(o.protocol);
        if (!foundProtocol) return reportExit(exitFailed, foundProtocol.error);
        protocol = std::move(foundProtocol.value);
    }
    const auto report = makeReport(o.job, protocol, outputOptionError, runAnalysisScript);
    if (!report) return reportExit(exitFailed, report.error);
    std::vector<std::string> inputs = o.job.files;
    if (!o.protocol.empty()) inputs.push_back(o.protocol);
    if (!o.job.peoplePath.empty()) inputs.push_back(o.job.peoplePath);
    if (!o.job.planPath.empty()) inputs.push_back(o.job.planPath);
    if (const int code = writeFolder(o.job.folder, report.value.files, inputs); code != exitDone) return code;
    for (const std::string& note : report.value.notes) printWarning(note);
    if (const std::string& error = report.value.scriptError; !error.empty())
        return reportExit(exitFailed, error);
    printIfSimulated(report.value.isSimulated);
    std::cout << (std::filesystem::path{o.job.folder} / "index.html").string() << "  "
              << report.value.files.size() << " files\n";
    if (const std::size_t tests = report.value.tests.size(); tests > 0)
        std::cout << (std::filesystem::path{o.job.folder} / testsTable).string() << "  "
                  << plural(tests, "test") << " by R\n";
    else if (report.value.files.contains(analysisScriptName) && !report.value.files.contains(testsTable))
        std::cout << "tests: run `Rscript "
                  << (std::filesystem::path{o.job.folder} / analysisScriptName).string()
                  << "` where R is (Debian: r-base-core)\n";
    return exitDone;
}

/// A new temporary folder, removed at the end. Also removes old ones that killed processes have left.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::random_device random;
        std::error_code error, ignored;
        const auto root = std::filesystem::temp_directory_path(error);
        const std::string prefix = "physvib-tests-";
        for (const auto& entry : std::filesystem::directory_iterator{root, ignored}) {
            if (!entry.path().filename().string().starts_with(prefix)) continue;
            const auto age = std::filesystem::file_time_type::clock::now() - entry.last_write_time(ignored);
            if (age > std::chrono::hours{1})
                std::filesystem::remove_all(entry.path(), ignored); // R is stopped after ten minutes
        }
        for (int attempt = 0; attempt < 10 && path.empty() && !error; ++attempt) {
            const auto newPath = root / (prefix + std::to_string(random()) + std::to_string(random()));
            if (std::filesystem::create_directory(newPath, error)) path = newPath;
        }
        std::filesystem::permissions(path, std::filesystem::perms::owner_all, error);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path.empty()) std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path path; ///< empty: it could not be made
};

} // namespace

int writeFolder(const std::filesystem::path& folder, const StudyFiles& files,
                const std::vector<std::string>& inputs) {
    std::vector<StudyFile> outputs;
    std::vector<std::string> paths;
    for (const auto& [name, text] : files) {
        paths.push_back((folder / name).string());
        outputs.emplace_back(paths.back(), text);
    }
    CreatedFolders folders;
    for (const std::string& path : paths)
        if (auto error = folders.make(std::filesystem::path{path}.parent_path()); !error.empty())
            return reportExit(exitFailed, error);
    if (const std::string clash = fileClashError(paths, inputs); !clash.empty())
        return reportExit(exitUsage, clash);
    for (const char* const name : {analysisScriptName, notebookName})
        if (const std::string error = files.contains(name) ? scriptOverwriteError(folder / name) : "";
            !error.empty())
            return reportExit(exitFailed, error);
    if (const int code = writeStudyFiles(outputs); code != exitDone) return code;
    folders.keep();
    return exitDone;
}

Result<StudyFiles> runAnalysisScript(const StudyFiles& files) {
    if (!hasProgram("Rscript")) return StudyFiles{};
    const TemporaryFolder folder;
    if (folder.path.empty()) return Failure{"no folder can be made for it"};
    for (const auto& [name, text] : files)
        if (AtomicFile file{folder.path / name}; !file.write(text).empty() || !file.commit().empty())
            return Failure{file.error()};
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes{10};
    const auto output = runWatched(
        "Rscript", {"--no-init-file", "--no-site-file", (folder.path / analysisScriptName).string(), "quiet"},
        [deadline] { return std::chrono::steady_clock::now() < deadline; });
    if (!output) return Failure{output.error};
    if (!output.value.empty()) return Failure{output.value};
    StudyFiles tables;
    for (const char* name : {testsTable, pairsTable, mapTable}) {
        if (name != testsTable && !std::filesystem::exists(folder.path / name)) continue;
        auto text = readFile((folder.path / name).string(), limits::maxTableBytes);
        if (!text) return Failure{text.error};
        tables[name] = std::move(text.value);
    }
    return tables;
}

Command reportCommand() {
    return makeCommand("report",
                       "trial files as a page with pictures and tables, and a script of tests for R",
                       declareReport, runReport);
}

} // namespace physvib
