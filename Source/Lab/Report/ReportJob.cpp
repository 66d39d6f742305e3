// SPDX-License-Identifier: MIT
// Reads the input files of a report job and creates the report.
#include "Lab/Report/ReportJob.h"
#include "Io/Disk/FileLimits.h"
#include "Io/Disk/ReadFile.h"
#include "Lab/Files/BidsDataset.h"
#include "Lab/Report/StudyPlanned.h"

namespace physvib {
namespace {

void addBids(StudyReport& report, const ReportTrials& trials) {
    BidsWords words{trials.protocol ? trials.protocol->title : trials.files.front().name,
                    trials.common("protocol"),
                    PHYSVIB_VERSION,
                    {},
                    trials.isSimulated};
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

} // namespace

Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callFault) {
    const auto texts = readTexts(job.files);
    if (!texts) return Failure{texts.error};
    auto trials = readReportTrials(texts.value, job.columns, protocol, callFault);
    if (!trials) return Failure{trials.error};
    for (std::size_t i = 0; i < job.files.size(); ++i) {
        auto times = loadStudyTimes(timesPathOf(job.files[i]));
        if (!times) return Failure{times.error};
        trials.value.files[i].times = std::move(times.value);
    }
    trials.value.columns = job.columns;
    trials.value.guess = job.guess;
    if (trials.value.all.column("target_x") && !trials.value.all.column("target_column")) // need one unit
        if (std::string fault = unitFault(job.columns); !fault.empty()) return Failure{std::move(fault)};
    StudyFacts facts{{}, job.ethics, job.consent, job.noise};
    if (!job.planPath.empty()) {
        auto plan = readFile(job.planPath, limits::maxTableBytes);
        if (!plan) return Failure{plan.error};
        if (const auto read = comparedWithPlan(plan.value, job.planPath, trials.value, {}); !read)
            return Failure{read.error};
        facts.plan = std::move(plan.value);
    }
    if (!job.peoplePath.empty()) {
        const auto text = readFile(job.peoplePath, limits::maxTableBytes);
        auto people = text ? readPeople(text.value, job.peoplePath)
                           : Result<std::vector<PersonFacts>>{Failure{text.error}};
        if (!people) return Failure{people.error};
        facts.people = std::move(people.value);
    }
    if (std::string fault = takeFacts(trials.value, std::move(facts)); !fault.empty())
        return Failure{std::move(fault)};
    StudyReport report = studyReport(trials.value);
    report.isSimulated = trials.value.isSimulated;
    if (!job.wantsBids) return report;
    if (!trials.value.all.column("participant"))
        return Failure{job.files.front() + ": --bids: expected a column participant, found none"};
    addBids(report, trials.value);
    return report;
}

} // namespace physvib
