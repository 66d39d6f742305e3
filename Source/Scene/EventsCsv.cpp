// SPDX-License-Identifier: MIT
// Reads and writes event lists: comments, header, rows and their order; cells by EventColumns.h.
#include "Scene/EventsCsv.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/TextLines.h"
#include "Scene/EventColumns.h"
#include <algorithm>
#include <cerrno>

namespace physvib {
namespace {

constexpr std::string_view fieldKey = "field_m=";

template <class Cell>
bool isKind(const EventColumn& column) {
    return std::holds_alternative<Cell>(column.cell);
}

bool isIncluded(OptionalColumns columns, const EventColumn& column) {
    if (isKind<DepthColumn>(column)) return columns.depths;
    if (isKind<PartColumn>(column)) return columns.parts;
    return isKind<KindColumn>(column)       ? columns.kinds
           : isKind<MaterialColumn>(column) ? columns.materials
                                            : true;
}

std::string columnNames(OptionalColumns columns) {
    std::string names;
    for (const EventColumn& column : eventColumns) {
        if (!isIncluded(columns, column)) continue;
        if (!names.empty()) names += ',';
        names += column.name;
    }
    return names;
}

/// Without the quotes that R and others put around cells.
std::string_view unquoted(std::string_view cell) {
    const bool isQuoted = cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"');
    return isQuoted ? cell.substr(1, cell.size() - 2) : cell;
}
std::size_t cellsIn(std::string_view line) {
    return line.empty() ? 0 : static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
}

class Reader {
public:
    /// `input`: a std::string_view or std::FILE*; `name`: for error lines.
    template <class Input>
    Reader(Input input, std::string_view name, std::size_t maxRows)
        : lines_(input)
        , name_(name)
        , maxRows_(maxRows) {}

    /// Counts the events without storing them.
    Result<std::size_t> count() {
        storesEvents_ = false;
        if (!readAll()) return Failure{std::move(error_)};
        return count_;
    }

    /// Reserves memory for `expected` events.
    Result<EventList> read(std::size_t expected) {
        list_.events.reserve(std::min(expected, maxRows_));
        if (!readAll()) return Failure{std::move(error_)};
        return std::move(list_);
    }

private:
    bool readAll() { return readHeader() && readRows(); }

    bool readHeader() {
        std::string_view header;
        while (header.empty() || header.starts_with('#')) {
            if (!readComment(header)) return false;
            if (!nextLine(header))
                return failEnd("expected a header line " + columnNames(everyColumn) +
                               ", found the end of the file");
        }
        for (std::size_t remaining = cellsIn(header); remaining > 0; --remaining)
            if (!readColumnName(unquoted(trimmed(takeUntil(',', header))))) return false;
        for (std::size_t i = 0; i < requiredEventColumns; ++i)
            if (!has(eventColumns[i]))
                return fail("column " + std::string(eventColumns[i].name) + " is missing");
        return true;
    }

    // Reads the last field_m word of a comment; spreadsheets pad the line with commas.
    bool readComment(std::string_view comment) {
        const std::size_t key = comment.rfind(fieldKey);
        if (key == comment.npos || (key > 0 && comment[key - 1] != ' ' && comment[key - 1] != '#'))
            return true;
        std::string_view word = comment.substr(key + fieldKey.size());
        word = word.substr(0, word.find(' '));
        while (word.ends_with(',')) word.remove_suffix(1);
        const auto field = parseField(word);
        if (field) list_.field = *field;
        return field || fail("field_m: " + std::string(expectedFieldText) + inQuotes(word));
    }

    bool readColumnName(std::string_view name) {
        for (const EventColumn& column : eventColumns) {
            if (column.name != name) continue;
            if (has(column)) return fail("column " + std::string(name) + " appears twice");
            columns_.push_back(&column);
            hasMaterials_ = hasMaterials_ || isKind<MaterialColumn>(column);
            return true;
        }
        return fail("unknown column " + inQuotes(name) + ", expected a header line " +
                    columnNames(everyColumn));
    }

    bool has(const EventColumn& column) const {
        return std::ranges::find(columns_, &column) != columns_.end();
    }

    // Blank lines are allowed at the end only.
    bool readRows() {
        std::string_view line;
        std::size_t blankLines = 0;
        while (nextLine(line)) {
            if (!line.empty() && blankLines > 0) break;
            if (line.empty())
                ++blankLines;
            else if (!readRow(line))
                return false;
        }
        lineNumber_ -= blankLines;
        if (!line.empty() && blankLines > 0) return readRow({});
        return count_ == 0 ? failEnd("expected events after the header, found none")
                           : !lines_.isTooLong() || failEnd({});
    }

    bool readRow(std::string_view line) {
        if (count_ == maxRows_) return fail("expected at most " + std::to_string(maxRows_) + " events");
        const std::size_t cells = cellsIn(line);
        if (cells != columns_.size())
            return fail("expected " + std::to_string(columns_.size()) + " cells, found " +
                        std::to_string(cells));
        CollisionEvent event;
        std::string_view unread = line;
        for (const EventColumn* column : columns_)
            if (!readColumnCell(*column, unquoted(trimmed(takeUntil(',', unread))), event)) return false;
        if (!hasMaterials_) convertLegacyClip(event);
        return addEvent(event);
    }

    bool readColumnCell(const EventColumn& column, std::string_view cell, CollisionEvent& event) {
        const std::string expected =
            std::visit([&](const auto& kind) { return readCell(kind, cell, event); }, column.cell);
        if (isKind<MaterialColumn>(column) && storesEvents_ && !list_.names.has(event.sound))
            list_.names.add(cell);
        if (isKind<PartColumn>(column) && storesEvents_) list_.names.parts.add(cell);
        return expected.empty() || fail("column " + std::string(column.name) + ": expected " + expected +
                                        ", found " + inQuotes(cell));
    }

    bool addEvent(const CollisionEvent& event) {
        if (event.decayPerSecond == 0.0 && event.durationNs == 0)
            return fail("column decay_per_s: expected a number > 0, or a duration_s > 0, found 0");
        if (isTooSlow(event)) return fail("column frequency_hz: " + tooSlowError(event));
        if (count_ > 0 && event.timeNs < lastNs_) return failOrder(event.timeNs);
        ++count_;
        lastNs_ = event.timeNs;
        if (storesEvents_) list_.events.push_back(event);
        return true;
    }

    bool failOrder(std::int64_t timeNs) {
        std::string message = "column time_s: expected a time >= ";
        appendSeconds(message, lastNs_);
        message += " of the row above, found ";
        appendSeconds(message, timeNs);
        return fail(message);
    }

    bool nextLine(std::string_view& line) {
        if (!lines_.next(line)) return false;
        if (++lineNumber_ == 1) dropByteOrderMark(line);
        line = trimmed(line);
        return true;
    }

    bool failEnd(std::string_view message) {
        if (!lines_.isTooLong()) return fail(message);
        ++lineNumber_;
        return fail("expected lines of at most " + std::to_string(TextLines::maxLineBytes) + " bytes");
    }

    /// Always false.
    bool fail(std::string_view message) {
        const std::size_t line = std::max<std::size_t>(lineNumber_, 1); // also for an empty file
        error_.assign(name_).append(":").append(std::to_string(line)).append(": ").append(message);
        return false;
    }

    TextLines lines_;
    std::string_view name_;
    std::size_t maxRows_;
    std::size_t lineNumber_ = 0; // number of the last line read, from 1
    std::size_t count_ = 0;
    std::int64_t lastNs_ = 0; // time of the last event
    bool storesEvents_ = true, hasMaterials_ = false;
    std::vector<const EventColumn*> columns_;
    EventList list_;
    std::string error_;
};

} // namespace

std::optional<FieldSize> parseField(std::string_view word) {
    const auto comma = std::min(word.find(','), word.size());
    const auto width = parseNumber<double>(word.substr(0, comma));
    const auto height = parseNumber<double>(word.substr(std::min(comma + 1, word.size())));
    const FieldSize field{width.value_or(0.0), height.value_or(0.0)};
    return isValidField(field) ? std::optional{field} : std::nullopt;
}

Result<EventList> readEventsCsv(std::string_view text, std::string_view name, std::size_t maxRows) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
    return Reader(text, name, maxRows).read(lines);
}

// Reads the file twice, line by line, so that a refused file needs no memory, whatever its length.
Result<EventList> loadEventsCsv(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) { // a pipe can be read only once
        const Result<std::string> text = readFile(path, limits::maxEventsFileBytes);
        if (!text) return Failure{text.error};
        return readEventsCsv(text.value, name);
    }
    const auto file = openRegularFile(path, limits::maxEventsFileBytes);
    if (!file) return Failure{file.error};
    std::FILE* const stream = file.value.stream.get();
    const auto reader = [&] { return Reader(stream, name, limits::maxEventRows); };
    const auto found = reader().count();
    if (std::ferror(stream)) return readFailure(path, errno);
    if (!found) return Failure{found.error};
    std::rewind(stream);
    return reader().read(found.value);
}

static OptionalColumns neededColumns(std::span<const CollisionEvent> events) {
    const auto hasKind = [](const CollisionEvent& e) { return e.source.kind != ContactKind::hit; };
    const auto hasSound = [](const CollisionEvent& e) { return e.sound != 0; };
    const auto hasDepth = [](const CollisionEvent& e) { return e.z != 0.0; };
    const auto hasPart = [](const CollisionEvent& e) { return e.source.part != 0; };
    return {std::ranges::any_of(events, hasKind), std::ranges::any_of(events, hasSound),
            std::ranges::any_of(events, hasDepth), std::ranges::any_of(events, hasPart)};
}

std::string eventsCsvHead(Provenance provenance, FieldSize field, OptionalColumns columns) {
    if (isValidField(field)) provenance.entries.emplace_back("field_m", fieldText(field));
    return provenanceComment(provenance) + columnNames(columns) + "\n";
}

void appendEventRow(std::string& text, CollisionEvent event, OptionalColumns columns,
                    const SoundNames& names) {
    for (const EventColumn& column : eventColumns) {
        if (!isIncluded(columns, column)) continue;
        std::visit([&](const auto& cell) { writeCell(cell, event, names, text); }, column.cell);
        text += ',';
    }
    text.back() = '\n';
}

std::string eventsCsv(std::span<const CollisionEvent> events, FieldSize field, const Provenance& provenance,
                      const SoundNames& names) {
    const OptionalColumns columns = neededColumns(events);
    std::string text = eventsCsvHead(provenance, field, columns);
    constexpr std::size_t typicalRowBytes = 160;
    text.reserve(text.size() + events.size() * typicalRowBytes);
    for (const CollisionEvent& event : events) appendEventRow(text, event, columns, names);
    return text;
}

} // namespace physvib
