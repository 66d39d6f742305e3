// SPDX-License-Identifier: MIT
// Reads and writes event lists: header, rows and their order; EventColumns.h has the cells.
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
bool is(const EventColumn& column) {
    return std::holds_alternative<Cell>(column.cell);
}

bool isIn(OptionalColumns columns, const EventColumn& column) {
    if (is<DepthColumn>(column)) return columns.depths;
    if (is<PartColumn>(column)) return columns.parts;
    return is<KindColumn>(column) ? columns.kinds : is<MaterialColumn>(column) ? columns.materials : true;
}

constexpr OptionalColumns everyColumn{true, true, true, true};

std::string columnNames(OptionalColumns columns) {
    std::string names;
    for (const EventColumn& column : eventColumns) {
        if (!isIn(columns, column)) continue;
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
    /// `from`: a text, or a file.
    template <class From>
    Reader(From from, std::string_view name, std::size_t maxRows)
        : lines_(from)
        , name_(name)
        , maxRows_(maxRows) {}

    /// Counts the events without storing them.
    Result<std::size_t> count() {
        isKept_ = false;
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
        for (std::size_t left = cellsIn(header); left > 0; --left)
            if (!readName(unquoted(trimmed(takeUntil(',', header))))) return false;
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
        return field || fail("field_m: " + std::string(expectedField) + inQuotes(word));
    }

    bool readName(std::string_view name) {
        for (const EventColumn& column : eventColumns) {
            if (column.name != name) continue;
            if (has(column)) return fail("column " + std::string(name) + " appears twice");
            order_.push_back(&column);
            hasMaterials_ = hasMaterials_ || is<MaterialColumn>(column);
            return true;
        }
        return fail("unknown column " + inQuotes(name) + ", expected a header line " +
                    columnNames(everyColumn));
    }

    bool has(const EventColumn& column) const { return std::ranges::find(order_, &column) != order_.end(); }

    // Blank lines are allowed at the end only.
    bool readRows() {
        std::string_view line;
        std::size_t blank = 0;
        while (nextLine(line)) {
            if (!line.empty() && blank > 0) break;
            if (line.empty())
                ++blank;
            else if (!readRow(line))
                return false;
        }
        line_ -= blank;
        if (!line.empty() && blank > 0) return readRow({});
        return count_ == 0 ? failEnd("expected events after the header, found none")
                           : !lines_.isTooLong() || failEnd({});
    }

    bool readRow(std::string_view line) {
        if (count_ == maxRows_) return fail("expected at most " + std::to_string(maxRows_) + " events");
        const std::size_t cells = cellsIn(line);
        if (cells != order_.size())
            return fail("expected " + std::to_string(order_.size()) + " cells, found " +
                        std::to_string(cells));
        CollisionEvent event;
        std::string_view rest = line;
        for (const EventColumn* column : order_)
            if (!readCellOf(*column, unquoted(trimmed(takeUntil(',', rest))), event)) return false;
        if (!hasMaterials_) takeFormerClip(event);
        return accept(event);
    }

    bool readCellOf(const EventColumn& column, std::string_view cell, CollisionEvent& event) {
        const std::string expected =
            std::visit([&](const auto& kind) { return readCell(kind, cell, event); }, column.cell);
        if (is<MaterialColumn>(column) && isKept_ && !list_.names.has(event.sound)) list_.names.add(cell);
        if (is<PartColumn>(column) && isKept_) list_.names.parts.add(cell);
        return expected.empty() || fail("column " + std::string(column.name) + ": expected " + expected +
                                        ", found " + inQuotes(cell));
    }

    bool accept(const CollisionEvent& event) {
        if (event.decayPerSecond == 0.0 && event.durationNs == 0)
            return fail("column decay_per_s: expected a number > 0, or a duration_s > 0, found 0");
        if (isTooSlow(event)) return fail("column frequency_hz: " + tooSlowFault(event));
        if (count_ > 0 && event.timeNs < lastNs_) return failOrder(event.timeNs);
        ++count_;
        lastNs_ = event.timeNs;
        if (isKept_) list_.events.push_back(event);
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
        if (++line_ == 1) dropByteOrderMark(line);
        line = trimmed(line);
        return true;
    }

    bool failEnd(std::string_view message) {
        if (!lines_.isTooLong()) return fail(message);
        ++line_;
        return fail("expected lines of at most " + std::to_string(TextLines::mostBytes) + " bytes");
    }

    /// Always false.
    bool fail(std::string_view message) {
        const std::size_t line = std::max<std::size_t>(line_, 1); // also for an empty file
        error_.assign(name_).append(":").append(std::to_string(line)).append(": ").append(message);
        return false;
    }

    TextLines lines_;
    std::string_view name_;
    std::size_t maxRows_;
    std::size_t line_ = 0; // of the line last taken, from 1
    std::size_t count_ = 0;
    std::int64_t lastNs_ = 0; // of the event last accepted
    bool isKept_ = true, hasMaterials_ = false;
    std::vector<const EventColumn*> order_;
    EventList list_;
    std::string error_;
};

} // namespace

std::optional<FieldSize> parseField(std::string_view word) {
    const auto comma = std::min(word.find(','), word.size());
    const auto width = parseNumber<double>(word.substr(0, comma));
    const auto height = parseNumber<double>(word.substr(std::min(comma + 1, word.size())));
    const FieldSize field{width.value_or(0.0), height.value_or(0.0)};
    return isField(field) ? std::optional{field} : std::nullopt;
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
    const auto file = openRegular(path, limits::maxEventsFileBytes);
    if (!file) return Failure{file.error};
    std::FILE* const stream = file.value.stream.get();
    const auto reader = [&] { return Reader(stream, name, limits::maxEventRows); };
    const auto found = reader().count();
    if (std::ferror(stream)) return unreadable(path, errno);
    if (!found) return Failure{found.error};
    std::rewind(stream);
    return reader().read(found.value);
}

OptionalColumns columnsOf(std::span<const CollisionEvent> events) {
    const auto hasKind = [](const CollisionEvent& e) { return e.source.kind != ContactKind::hit; };
    const auto hasSound = [](const CollisionEvent& e) { return e.sound != 0; };
    const auto hasDepth = [](const CollisionEvent& e) { return e.z != 0.0; };
    const auto hasPart = [](const CollisionEvent& e) { return e.source.part != 0; };
    return {std::ranges::any_of(events, hasKind), std::ranges::any_of(events, hasSound),
            std::ranges::any_of(events, hasDepth), std::ranges::any_of(events, hasPart)};
}

std::string eventsCsvHead(Provenance provenance, FieldSize field, OptionalColumns columns) {
    if (isField(field)) provenance.entries.emplace_back("field_m", fieldText(field));
    return provenanceComment(provenance) + columnNames(columns) + "\n";
}

void appendEventRow(std::string& text, CollisionEvent event, OptionalColumns columns,
                    const SoundNames& names) {
    for (const EventColumn& column : eventColumns) {
        if (!isIn(columns, column)) continue;
        std::visit([&](const auto& cell) { writeCell(cell, event, names, text); }, column.cell);
        text += ',';
    }
    text.back() = '\n';
}

std::string eventsCsv(std::span<const CollisionEvent> events, FieldSize field, const Provenance& provenance,
                      const SoundNames& names) {
    const OptionalColumns columns = columnsOf(events);
    std::string text = eventsCsvHead(provenance, field, columns);
    constexpr std::size_t usualRowBytes = 160;
    text.reserve(text.size() + events.size() * usualRowBytes);
    for (const CollisionEvent& event : events) appendEventRow(text, event, columns, names);
    return text;
}

} // namespace physvib
