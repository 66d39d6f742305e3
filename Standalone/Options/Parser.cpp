// SPDX-License-Identifier: GPL-3.0-or-later
// Declares a table's options in CLI11 and copies the results back.
#include "Io/Disk/FileClash.h"
#include "Io/Text/NameList.h"
#include "Options/OptionTable.h"
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <list>
#include <map>
#include <sstream>

namespace physvib {
namespace {

/// Range check that rejects "nan", which CLI11's own checks accept, and whose message has the expected range.
template <class T, class IsValid>
CLI::Validator numberCheck(IsValid isValid, const std::string& expected, const std::string& rangeText) {
    return {[=](std::string& text) {
                T value{};
                return CLI::detail::lexical_cast(text, value) && isValid(value)
                           ? std::string{}
                           : "expected " + expected + ", found \"" + text + "\"";
            },
            rangeText};
}

template <class T>
CLI::Validator rangeCheck(const Option& row) {
    return numberCheck<T>(
        [minValue = row.minValue, maxValue = row.maxValue](T value) {
            return static_cast<double>(value) >= minValue && static_cast<double>(value) <= maxValue;
        },
        row.range, row.range);
}

CLI::Validator rangeCheck(const Option& row) {
    if (std::holds_alternative<int*>(row.target) || std::holds_alternative<std::optional<int>*>(row.target))
        return rangeCheck<int>(row);
    if (std::holds_alternative<std::uint32_t*>(row.target)) return rangeCheck<std::uint32_t>(row);
    return std::holds_alternative<std::size_t*>(row.target) ? rangeCheck<std::size_t>(row)
                                                            : rangeCheck<double>(row);
}

std::function<std::string(const std::string&)> endingCheck(const Option& row) {
    return [ending = row.type.substr(row.type.rfind('.'))](const std::string& path) {
        return fileExtensionError(path, {ending});
    };
}

void check(CLI::Option& option, const Option& row) {
    switch (row.check) {
    case Option::Check::none: return;
    case Option::Check::range: option.check(rangeCheck(row)); return;
    case Option::Check::positive:
        option.check(numberCheck<double>([](double value) { return value > 0.0 && std::isfinite(value); },
                                         "more than 0", row.range));
        return;
    case Option::Check::choice: option.check(CLI::IsMember(row.choices)); return;
    case Option::Check::number:
        option.transform(
            CLI::CheckedTransformer(std::map<std::string, int>(row.numbers.begin(), row.numbers.end())));
        return;
    case Option::Check::folder: option.check(CLI::ExistingDirectory); return;
    case Option::Check::ending: option.check(endingCheck(row), ""); return;
    }
}

template <class Words, class Reader>
CLI::Option* declareReader(CLI::App& app, const Option& row, const Reader& read) {
    const auto readWords = [name = row.spellings.front(), read](const Words& words) {
        if (const std::string error = read(words); !error.empty()) throw CLI::ValidationError(name, error);
    };
    return app.add_option_function<Words>(joinNames(row.spellings, ","), readWords, row.meaning);
}

/// Declares the option; null for options that CLI11 provides itself.
CLI::Option* declare(CLI::App& app, const Option& row) {
    const auto declareAs = [&](const auto& target) -> CLI::Option* {
        using Target = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<Target, std::monostate>)
            return nullptr;
        else if constexpr (std::is_same_v<Target, bool*>)
            return app.add_flag(joinNames(row.spellings, ","), *target, row.meaning);
        else if constexpr (std::is_same_v<Target, std::function<void(int)>>)
            return app.add_option_function<int>(joinNames(row.spellings, ","), target, row.meaning);
        else if constexpr (std::is_same_v<Target, WordReader>)
            return declareReader<std::string>(app, row, target);
        else if constexpr (std::is_same_v<Target, WordsReader>)
            return declareReader<std::vector<std::string>>(app, row, target);
        else
            return app.add_option(joinNames(row.spellings, ","), *target, row.meaning);
    };
    CLI::Option* const option = std::visit(declareAs, row.target);
    if (!option) return nullptr;
    check(*option, row);
    if (!std::holds_alternative<bool*>(row.target)) option->type_name(row.type)->default_str(row.initial);
    if (row.isRequired) option->required();
    if (row.isSingle) option->allow_extra_args(false);
    if (row.maxValues > 0) option->delimiter(',')->expected(1, row.maxValues);
    if (!row.group.empty()) option->group(row.group);
    return option;
}

/// Declares a table and its commands in CLI11, parses a call, and stores the arguments in the table.
class Parser {
public:
    Parser(CLI::App& app, OptionTable& table)
        : app_{app}
        , table_{table} {
        if (!table.version.empty()) app.set_version_flag("--version", table.version);
        for (Option& row : table.options)
            if (CLI::Option* const option = declare(app, row)) options_.emplace_back(option, &row);
        if (!table.commands.empty()) app.require_subcommand(1);
        for (OptionTable& inner : table.commands) {
            CLI::App* const command = app.add_subcommand(inner.name(), inner.meaning);
            if (!inner.alias.empty()) command->alias(inner.alias);
            commands_.emplace_back(*command, inner);
        }
    }

    template <class... Words>
    ParseResult parse(Words... words) {
        try {
            app_.parse(words...);
        } catch (const CLI::ParseError& error) {
            std::ostringstream output;
            if (error.get_exit_code() == 0) app_.exit(error, output, output); // --help, --version
            const auto unknown = app_.remaining();
            return {error.what(), unknown.empty() ? std::string{} : unknown.front(), output.str()};
        }
        storeArguments();
        return {};
    }
    void warn() const {
        for (const auto& [option, row] : options_)
            if (!row->arguments.empty() && !row->replacement.empty())
                std::cerr << row->spellings.front() << " is deprecated: " << row->replacement << '\n';
        for (const Parser& inner : commands_) inner.warn();
    }

private:
    void storeArguments() {
        for (const auto& [option, row] : options_) row->arguments = option->results();
        for (Parser& inner : commands_) inner.storeArguments();
        table_.calls.clear();
        for (const CLI::App* called : app_.get_subcommands())
            for (const Parser& inner : commands_)
                if (&inner.app_ == called) table_.calls.push_back(&inner.table_);
    }

    CLI::App& app_;
    OptionTable& table_;
    std::list<std::pair<CLI::Option*, Option*>> options_;
    std::list<Parser> commands_;
};

} // namespace

ParseResult parseArguments(OptionTable& table, int argc, char** argv) {
    CLI::App app{table.meaning};
    Parser parser{app, table};
    const ParseResult parsed = parser.parse(argc, argv);
    parser.warn();
    return parsed;
}

ParseResult parseText(OptionTable& table, const std::string& call) {
    CLI::App app;
    return Parser{app, table}.parse(call, false);
}

} // namespace physvib
