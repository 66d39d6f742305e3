// SPDX-License-Identifier: GPL-3.0-or-later
// Work shared among processes: Box2D counts in variables of its process, and a task that breaks its process
// breaks no other. How, is another matter on each system: WorkersPosix.cpp, WorkersWindows.cpp.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace physvib {

struct WorkEnd;
using Work = std::function<WorkEnd(std::uint64_t index)>;

/// What became of one piece of work, as its process tells it.
struct WorkEnd {
    enum class Kind : std::uint32_t { done, wasDone, isDoneElsewhere, failed };
    std::uint64_t index = 0;
    Kind kind = Kind::done;
    std::array<char, 484> words{}; ///< why it failed, cut where it is long

    static WorkEnd failedAt(std::uint64_t index, std::string_view reason);
    /// Of one piece that is done now; what it throws is a failure.
    static WorkEnd of(const Work& work, std::uint64_t index);
    std::string_view reason() const { return words.data(); }
};

/// Does `work` of 0 to `count` - 1, each once, in `jobs` processes that end with this one (on Windows in this
/// one alone); `hear` is told here. Of work that ended its process, it is told as failed, and the others go
/// on. M only, with no other thread and no file of ours open for writing.
void shareWork(int jobs, std::uint64_t count, const Work& work,
               const std::function<void(const WorkEnd&)>& hear);

} // namespace physvib
