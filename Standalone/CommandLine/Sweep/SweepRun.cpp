// SPDX-License-Identifier: GPL-3.0-or-later
// The temporary file of a result is the claim to its task: who has it renders, who is killed loses it.
#include "CommandLine/Sweep/SweepRun.h"
#include "CommandLine/Render/RenderCommand.h"
#include "CommandLine/Sweep/HeardWords.h"
#include "CommandLine/Sweep/ProgressBar.h"
#include "CommandLine/Sweep/Workers.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/GrowingFile.h"
#include "System/ExitCode.h"
#include "System/Process.h"
#include <chrono>
#include <juce_core/juce_core.h>
#include <memory>
#include <thread>
#include <vector>

namespace physvib {
namespace {

using Kind = WorkEnd::Kind;

/// Who began and ended what, in a file of this process.
class WorkerLog {
public:
    explicit WorkerLog(const SweepFolder& folder) {
        const auto path = folder.log(juce::SystemStats::getComputerName().toStdString() + '-' +
                                     std::to_string(processNumber()));
        // without one, the sweep is done all the same
        if (folder.makeFolderOf(path).empty()) file_.open(path);
    }
    void add(const std::string& line) { file_.append(line + '\n'); }

private:
    GrowingFile file_;
};

/// Renders a task that nobody else is at; empty and `text`, or one line.
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

/// A part, or of it what others were rendering when it was their turn.
struct TaskNumbers {
    std::uint64_t size() const {
        return isAll ? (sweep + part.parts - part.number) / part.parts : chosen.size();
    }
    std::uint64_t at(std::uint64_t index) const {
        return isAll ? part.number - 1 + index * part.parts : chosen[index];
    }
    std::uint64_t sweep = 0;
    SweepPart part;
    bool isAll = true;
    std::vector<std::uint64_t> chosen{};
};

WorkEnd endOf(std::uint64_t index, Kind kind) { return {index, kind, {}}; }

WorkEnd doTask(const SweepPlan& plan, const SweepFolder& folder, const TaskNumbers& numbers,
               std::uint64_t index, std::unique_ptr<WorkerLog>& log) {
    const PlannedTask task = plan.at(numbers.at(index));
    if (folder.has(task)) return endOf(index, Kind::wasDone);
    const auto path = folder.result(task.hash);
    if (const auto fault = folder.makeFolderOf(path); !fault.empty()) return WorkEnd::failedAt(index, fault);
    AtomicFile claim{path};
    if (claim.isTaken()) return endOf(index, Kind::isDoneElsewhere);
    if (!claim.error().empty()) return WorkEnd::failedAt(index, claim.error());
    if (folder.has(task)) return endOf(index, Kind::wasDone); // by another, just before the claim
    if (!log) log = std::make_unique<WorkerLog>(folder);
    log->add("begun " + task.hash);
    const auto begin = std::chrono::steady_clock::now();
    std::string text;
    if (auto fault = renderTask(plan, folder, task, text); !fault.empty())
        return WorkEnd::failedAt(index, fault);
    claim.write(text);
    if (const auto& fault = claim.commit(); !fault.empty()) return WorkEnd::failedAt(index, fault);
    log->add("finished " + task.hash + ' ' +
             fixedNumber(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 4) +
             " s");
    return endOf(index, Kind::done);
}

} // namespace

SweepTally runSweepTasks(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part, int jobs) {
    constexpr auto pause = std::chrono::milliseconds{200}; // somebody else's render takes about as long
    SweepTally tally;
    TaskNumbers numbers{plan.size(), part};
    if (numbers.size() == 0) return tally;
    ProgressBar bar{numbers.size()};
    for (;;) {
        std::vector<std::uint64_t> elsewhere;
        std::unique_ptr<WorkerLog> log; // of each worker, once it has something to tell
        const auto work = [&](std::uint64_t i) { return doTask(plan, folder, numbers, i, log); };
        shareWork(jobs, numbers.size(), work, [&](const WorkEnd& end) {
            if (end.kind == Kind::isDoneElsewhere) return elsewhere.push_back(numbers.at(end.index));
            tally.rendered += end.kind == Kind::done ? 1 : 0;
            bar.add(end.kind == Kind::done);
            if (end.kind != Kind::failed || tally.failed++ > 0) return;
            tally.fault = plan.at(numbers.at(end.index)).task.call + ": " + std::string(end.reason());
        });
        if (elsewhere.empty()) return tally;
        numbers.isAll = false;
        numbers.chosen = std::move(elsewhere);
        std::this_thread::sleep_for(pause);
    }
}

} // namespace physvib
