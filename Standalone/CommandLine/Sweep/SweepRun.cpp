// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the tasks of a sweep; several processes can share one folder without a server.
// Claim: the locked temporary file of a result reserves its task. If the process is killed, the lock ends.
// Steps: 1. Skip tasks whose result is complete. 2. Claim, check again, render, and rename the temporary
// file. 3. Put off tasks that other processes have claimed, and visit them again until every result exists.
#include "CommandLine/Sweep/SweepRun.h"
#include "CommandLine/Render/RenderCommand.h"
#include "CommandLine/Sweep/HeardWords.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/SessionJournal.h"
#include "System/ExitCode.h"
#include "System/Process.h"
#include <chrono>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace physvib {
namespace {

/// Log of started and finished tasks, one file per process.
class WorkerLog {
public:
    explicit WorkerLog(const SweepFolder& folder) {
        const auto path = folder.log(computerName() + '-' + std::to_string(processNumber()));
        // the log is optional
        if (folder.makeFolderOf(path).empty()) file_.open(path);
    }
    void add(const std::string& line) { file_.append(line + '\n'); }

private:
    GrowingFile file_;
};

/// Renders a claimed task; empty with the result in `text`, or one error line.
std::string renderTask(const SweepPlan& plan, const SweepFolder& folder, const PlannedTask& task,
                       std::string& text) {
    auto options = renderOptionsOf(task.task.call);
    if (!options) return options.error;
    options.value.wavPath = folder.wav(task.hash);
    options.value.eventsPath = folder.events(task.hash);
    SweepFeatures features;
    const HeardWords heard;
    if (runRender(options.value, &features) != exitDone) return heard.reason();
    if (!plan.isUnchanged(task))
        return "expected its files to stay as they are, found others than when the sweep began";
    text = SweepFolder::text(task, features.finish(), heard.warnings());
    return {};
}

/// One process' pass through its tasks.
class SweepWay {
public:
    SweepWay(const SweepPlan& plan, const SweepFolder& folder)
        : plan_{plan}
        , folder_{folder} {}

    /// Runs a task, or puts it off if another process has claimed it.
    void visit(std::uint64_t number) {
        const PlannedTask task = plan_.at(number);
        std::string fault;
        try {
            fault = faultOf(number, task);
        } catch (const std::exception& thrown) { // out of memory for this task; others may need less
            fault = thrown.what();
        }
        if (!fault.empty() && tally.failed++ == 0) tally.fault = task.task.call + ": " + fault;
    }
    /// Tasks that other processes had claimed.
    std::vector<std::uint64_t> takeElsewhere() { return std::exchange(elsewhere_, {}); }

    SweepTally tally;

private:
    std::string faultOf(std::uint64_t number, const PlannedTask& task) {
        if (folder_.has(task)) return {};
        const auto path = folder_.result(task.hash);
        if (auto fault = folder_.makeFolderOf(path); !fault.empty()) return fault;
        AtomicFile claim{path};
        if (claim.isTaken()) {
            elsewhere_.push_back(number);
            return {};
        }
        if (!claim.error().empty()) return claim.error();
        if (folder_.has(task)) return {}; // done by another process just before the claim
        return render(task, claim);
    }
    std::string render(const PlannedTask& task, AtomicFile& claim) {
        if (!log_) log_.emplace(folder_);
        log_->add("begun " + task.hash);
        const auto begin = std::chrono::steady_clock::now();
        std::string text;
        if (auto fault = renderTask(plan_, folder_, task, text); !fault.empty()) return fault;
        claim.write(text);
        if (const auto& fault = claim.commit(); !fault.empty()) return fault;
        log_->add(
            "finished " + task.hash + ' ' +
            fixedNumber(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 4) +
            " s");
        ++tally.rendered;
        return {};
    }

    const SweepPlan& plan_;
    const SweepFolder& folder_;
    std::optional<WorkerLog> log_; // created with the first entry
    std::vector<std::uint64_t> elsewhere_;
};

} // namespace

SweepTally runSweepTasks(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part) {
    constexpr auto pause = std::chrono::milliseconds{200}; // about the duration of another process' render
    SweepWay way{plan, folder};
    for (std::uint64_t number = part.number - 1; number < plan.size(); number += part.parts)
        way.visit(number);
    for (auto numbers = way.takeElsewhere(); !numbers.empty(); numbers = way.takeElsewhere()) {
        std::this_thread::sleep_for(pause);
        for (const std::uint64_t number : numbers) way.visit(number);
    }
    return way.tally;
}

} // namespace physvib
