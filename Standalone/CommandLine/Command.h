// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program: its options, and what it does. Main.cpp has the table of all.
#pragma once
#include "Options/OptionTable.h"
#include "System/ExitCode.h"
#include <functional>
#include <memory>
#include <type_traits>

namespace physvib {

struct Command {
    const char *name, *meaning;
    /// what it adds to the table; what runs, after parsing, for an exit code
    std::function<std::function<int()>(OptionTable&)> declare;
};

/// Of a structure of options that `declare` adds and `run` is given, with the parsed table before it if it
/// asks for one.
template <class Options, class Run>
Command commandOf(const char* name, const char* meaning, void (*declare)(OptionTable&, Options&), Run run) {
    return {name, meaning, [=](OptionTable& table) -> std::function<int()> {
                const auto options = std::make_shared<Options>();
                declare(table, *options);
                if constexpr (std::is_invocable_v<Run, Options&>)
                    return [=] { return run(*options); };
                else
                    return [=, &table] { return run(table, *options); };
            }};
}

} // namespace physvib
