// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib report`: reads trial files and writes a folder, completely or not at all.
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
    std::vector<std::string> columnWords; ///< as NAME=COLUMN, before parsing
    std::string protocol;                 ///< name or path; empty: look up a built-in one
};

/// Creates missing folders and removes them again unless they are kept. Outermost first.
class MadeFolders {
public:
    std::string make(const std::filesystem::path& folder) {
        std::error_code fault;
        for (auto missing = std::filesystem::absolute(folder);
             !missing.empty() && !std::filesystem::exists(missing, fault); missing = missing.parent_path())
            made_.insert(made_.begin(), missing);
        std::filesystem::create_directories(folder, fault);
        return fault || !std::filesystem::is_directory(folder)
                   ? folder.string() + ": expected a folder that can be written"
                   : "";
    }
    void keep() { made_.clear(); }
    MadeFolders() = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders() {
        std::error_code ignored;
        // only if empty
        for (auto at = made_.rbegin(); at != made_.rend(); ++at) std::filesystem::remove(*at, ignored);
    }

private:
    std::vector<std::filesystem::path> made_;
};

void declareReport(OptionTable& command, ReportOptions& o) {
    command.add("files", o.job.files, "the trial files of one study").required().as("TRIALS.csv...");
    command.add("--out", o.job.folder, "the folder: index.html, tables, analysis.R").required().as("FOLDER");
    command.add("--protocol", o.protocol, "the study's protocol, if it is no built-in one")
        .as("PROTOCOL.json");
    command.add("--bids", o.job.wantsBids, "also the trials as a BIDS dataset, in the folder bids");
    command.add("--notebook", o.job.wantsNotebook, "also analysis.qmd, a notebook of the tests' steps");
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
    declareColumns(command, o.columnWords);
    command.add("--guess", o.job.guess, "of psychometric functions in other programs' tables: as in analyse")
        .in(0.0, 0.9);
}

int runReport(ReportOptions& o) {
    auto columns = parseColumnNames(o.columnWords);
    if (!columns) return leave(exitUsage, "--columns: " + columns.error);
    o.job.columns = std::move(columns.value);
    std::optional<Protocol> protocol;
    if (!o.protocol.empty()) {
        auto found = protocolNamed(o.protocol);
        if (!found) return leave(exitFailed, found.error);
        protocol = std::move(found.value);
    }
    const auto report = makeReport(o.job, protocol, writtenWordFault, runAnalysisScript);
    if (!report) return leave(exitFailed, report.error);
    std::vector<std::string> inputs = o.job.files;
    if (!o.protocol.empty()) inputs.push_back(o.protocol);
    if (!o.job.peoplePath.empty()) inputs.push_back(o.job.peoplePath);
    if (!o.job.planPath.empty()) inputs.push_back(o.job.planPath);
    if (const int code = writeFolder(o.job.folder, report.value.files, inputs); code != exitDone) return code;
    for (const std::string& note : report.value.notes) warn(note);
    if (const std::string& fault = report.value.scriptFault; !fault.empty()) return leave(exitFailed, fault);
    tellIfSimulated(report.value.isSimulated);
    std::cout << (std::filesystem::path{o.job.folder} / "index.html").string() << "  "
              << report.value.files.size() << " files\n";
    if (const std::size_t tests = report.value.tests.size(); tests > 0)
        std::cout << (std::filesystem::path{o.job.folder} / testsTable).string() << "  "
                  << counted(tests, "test") << " by R\n";
    else if (report.value.files.contains(analysisScriptName) && !report.value.files.contains(testsTable))
        std::cout << "tests: run `Rscript "
                  << (std::filesystem::path{o.job.folder} / analysisScriptName).string()
                  << "` where R is (Debian: r-base-core)\n";
    return exitDone;
}

/// A folder that nobody else had, which goes with its contents; where its process was killed, with the next.
class OwnFolder {
public:
    OwnFolder() {
        std::random_device random;
        std::error_code fault, ignored;
        const auto root = std::filesystem::temp_directory_path(fault);
        const std::string before = "physvib-tests-";
        for (const auto& entry : std::filesystem::directory_iterator{root, ignored}) {
            if (!entry.path().filename().string().starts_with(before)) continue;
            const auto age = std::filesystem::file_time_type::clock::now() - entry.last_write_time(ignored);
            if (age > std::chrono::hours{1})
                std::filesystem::remove_all(entry.path(), ignored); // R has ten minutes
        }
        for (int tries = 0; tries < 10 && path.empty() && !fault; ++tries) {
            const auto named = root / (before + std::to_string(random()) + std::to_string(random()));
            if (std::filesystem::create_directory(named, fault)) path = named;
        }
        std::filesystem::permissions(path, std::filesystem::perms::owner_all, fault);
    }
    ~OwnFolder() {
        std::error_code ignored;
        if (!path.empty()) std::filesystem::remove_all(path, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
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
    MadeFolders folders;
    for (const std::string& path : paths)
        if (auto fault = folders.make(std::filesystem::path{path}.parent_path()); !fault.empty())
            return leave(exitFailed, fault);
    if (const std::string clash = fileClash(paths, inputs); !clash.empty()) return leave(exitUsage, clash);
    for (const char* const name : {analysisScriptName, notebookName})
        if (const std::string fault = files.contains(name) ? keptScriptFault(folder / name) : "";
            !fault.empty())
            return leave(exitFailed, fault);
    if (const int code = writeStudyFiles(outputs); code != exitDone) return code;
    folders.keep();
    return exitDone;
}

Result<StudyFiles> runAnalysisScript(const StudyFiles& files) {
    if (!hasProgram("Rscript")) return StudyFiles{};
    const OwnFolder folder;
    if (folder.path.empty()) return Failure{"no folder can be made for it"};
    for (const auto& [name, text] : files)
        if (AtomicFile file{folder.path / name}; !file.write(text).empty() || !file.commit().empty())
            return Failure{file.error()};
    const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes{10};
    const auto said = runWatched(
        "Rscript", {"--no-init-file", "--no-site-file", (folder.path / analysisScriptName).string(), "quiet"},
        [latest] { return std::chrono::steady_clock::now() < latest; });
    if (!said) return Failure{said.error};
    if (!said.value.empty()) return Failure{said.value};
    StudyFiles made;
    for (const char* name : {testsTable, pairsTable, mapTable}) {
        if (name != testsTable && !std::filesystem::exists(folder.path / name)) continue;
        auto text = readFile((folder.path / name).string(), limits::maxTableBytes);
        if (!text) return Failure{text.error};
        made[name] = std::move(text.value);
    }
    return made;
}

Command reportCommand() {
    return commandOf("report", "trial files as a page with pictures and tables, and a script of tests for R",
                     declareReport, runReport);
}

} // namespace physvib
