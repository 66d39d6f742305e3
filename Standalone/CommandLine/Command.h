// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program: its options and its function. Main.cpp lists all commands.
#pragma once
#include "Options/OptionTable.h"
#include "System/Process.h"
#include <functional>
#include <memory>
#include <type_traits>

namespace physvib {

struct Command {
    const char *name, *description;
    /// Adds options to the table; returns the function to run after parsing, which returns an exit code.
    std::function<std::function<int()>(OptionTable&)> declare;
};

/// Creates a command from a structure of options: `declare` adds them to the table, and `run` receives them
/// (and the parsed table, if it has that parameter) and returns an exit code.
template <class Options, class Run>
Command makeCommand(const char* name, const char* description, void (*declare)(OptionTable&, Options&),
                    Run run) {
    return {name, description, [=](OptionTable& table) -> std::function<int()> {
                const auto options = std::make_shared<Options>();
                declare(table, *options);
                if constexpr (std::is_invocable_v<Run, Options&>)
                    return [=] { return run(*options); };
                else
                    return [=, &table] { return run(table, *options); };
            }};
}

} // namespace physvib
