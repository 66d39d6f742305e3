// SPDX-License-Identifier: GPL-3.0-or-later
// Files in, a folder out: all of it, or nothing.
#include "CommandLine/Command.h"
#include "CommandLine/Analyse/AnalyseCommand.h"
#include "CommandLine/Report/StudyReport.h"
#include "CommandLine/Report/ThesisReport.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Studies/StudyCalls.h"
#include "Files/BidsDataset.h"
#include "Files/Disk/FileClash.h"
#include <string>
#include <vector>

namespace physvib {
namespace {

/// As given on the command line.
struct ReportOptions {
    AnalyseOptions sources; ///< files and columns of it
    std::string folder, protocol;
    bool wantsBids = false;
};

/// The folders that were not there before, outermost first; they go again unless they are kept.
class MadeFolders {
public:
    std::string make(const std::filesystem::path& folder) {
        std::error_code fault;
        for (auto missing = std::filesystem::absolute(folder); !missing.empty() && !std::filesystem::exists(missing, fault); missing = missing.parent_path()) made_.insert(made_.begin(), missing);
        std::filesystem::create_directories(folder, fault);
        return fault || !std::filesystem::is_directory(folder) ? folder.string() + ": expected a folder that can be written" : "";
    }
    void keep() { made_.clear(); }
    MadeFolders() = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders() {
        std::error_code ignored;
        for (auto at = made_.rbegin(); at != made_.rend(); ++at) std::filesystem::remove(*at, ignored); // only if nothing is in it
    }

private:
    std::vector<std::filesystem::path> made_;
};

int write(const std::filesystem::path& folder, const std::map<std::string, std::string>& files, const std::vector<std::string>& inputs) {
    std::vector<StudyFile> outputs;
    std::vector<std::string> paths;
    for (const auto& [name, text] : files) {
        paths.push_back((folder / name).string());
        outputs.emplace_back(paths.back(), text);
    }
    MadeFolders folders;
    for (const std::string& path : paths)
        if (auto fault = folders.make(std::filesystem::path{path}.parent_path()); !fault.empty()) return leave(exitFailed, fault);
    if (const std::string clash = fileClash(paths, inputs); !clash.empty()) return leave(exitUsage, clash);
    if (const int code = writeStudyFiles(outputs); code != exitDone) return code;
    folders.keep();
    return exitDone;
}

void addBids(StudyReport& report, const ReportTrials& trials) {
    BidsWords words{trials.protocol ? trials.protocol->title : trials.files.front().name, trials.common("protocol"), PHYSVIB_VERSION, {}, trials.isSimulated};
    if (words.task.empty()) words.task = trials.files.front().name;
    for (const char* key : {"hash", "seed", "version"})
        if (const std::string value = trials.common(key); !value.empty()) words.source[key] = value;
    for (auto& [name, text] : bidsDataset(trials.all, words)) report.files["bids/" + name] = std::move(text);
}

Result<std::vector<std::pair<std::string, std::string>>> readTexts(const std::vector<std::string>& paths) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const std::string& path : paths) {
        auto text = readFile(path, limits::maxTableBytes);
        if (!text) return Failure{text.error};
        texts.emplace_back(path, std::move(text.value));
    }
    return texts;
}

int reportThesis(const ReportOptions& o) {
    if (o.wantsBids || !o.protocol.empty() || !o.sources.columnWords.empty()) return leave(exitUsage, "report thesis: expected no --bids, --protocol or --columns (a file of that name is ./thesis)");
    const auto files = thesisReport();
    if (const int code = write(o.folder, files, {}); code != exitDone) return code;
    tellIfSimulated(true);
    std::cout << (std::filesystem::path{o.folder} / "index.html").string() << "  " << files.size() << " files; rehearsals are simulated\n";
    return exitDone;
}

void declareReport(OptionTable& command, ReportOptions& o) {
    command.add("files", o.sources.files, "the trial files of one study; or `thesis`: what the thesis prints beside what follows from it, and its studies rehearsed").required().as("TRIALS.csv...|thesis");
    command.add("--out", o.folder, "the folder: index.html, tables, report.R").required().as("FOLDER");
    command.add("--protocol", o.protocol, "the study's protocol, if it is no built-in one").as("PROTOCOL.json");
    command.add("--bids", o.wantsBids, "also the trials as a BIDS dataset, in the folder bids");
    declareColumns(command, o.sources);
}

int runReport(const ReportOptions& o) {
    if (o.sources.files == std::vector<std::string>{"thesis"}) return reportThesis(o);
    const auto columns = parseColumnNames(o.sources.columnWords);
    if (!columns) return leave(exitUsage, "--columns: " + columns.error);
    std::optional<Protocol> protocol;
    if (!o.protocol.empty()) {
        auto found = protocolNamed(o.protocol);
        if (!found) return leave(exitFailed, found.error);
        protocol = std::move(found.value);
    }
    const auto texts = readTexts(o.sources.files);
    if (!texts) return leave(exitFailed, texts.error);
    const auto trials = readReportTrials(texts.value, columns.value, protocol);
    if (!trials) return leave(exitFailed, trials.error);
    StudyReport report = studyReport(trials.value);
    if (o.wantsBids) {
        if (!trials.value.all.column("participant")) return leave(exitFailed, o.sources.files.front() + ": --bids: expected a column participant, found none");
        addBids(report, trials.value);
    }
    std::vector<std::string> inputs = o.sources.files;
    if (!o.protocol.empty()) inputs.push_back(o.protocol);
    if (const int code = write(o.folder, report.files, inputs); code != exitDone) return code;
    for (const std::string& note : report.notes) warn(note);
    tellIfSimulated(trials.value.isSimulated);
    std::cout << (std::filesystem::path{o.folder} / "index.html").string() << "  " << report.files.size() << " files, " << report.tests.size() << " tests\n";
    return exitDone;
}

} // namespace

Command reportCommand() { return commandOf("report", "trial files as a page with pictures, tests and tables", declareReport, runReport); }

} // namespace physvib
