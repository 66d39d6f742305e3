// SPDX-License-Identifier: MIT
// Header, rows and order of an event list; the cells are in EventColumns.h.
#include "Files/EventsCsv.h"
#include "Files/CsvText.h"
#include "Files/EventColumns.h"
#include "Files/ReadFile.h"
#include <algorithm>

namespace physvib {
namespace {

std::string columnNames() {
    std::string names;
    for (const EventColumn& column : eventColumns) {
        if (!names.empty()) names += ',';
        names += column.name;
    }
    return names;
}

std::size_t cellsIn(std::string_view line) {
    return line.empty() ? 0 : static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
}

class Reader {
public:
    Reader(std::string_view text, std::string_view name, std::size_t maxRows)
        : rest_(text)
        , name_(name)
        , maxRows_(maxRows) {
        dropByteOrderMark(rest_);
    }

    Result<std::vector<CollisionEvent>> read() {
        const bool isRead = readHeader() && readRows();
        if (!isRead) return Failure{std::move(error_)};
        return std::move(events_);
    }

private:
    bool readHeader() {
        std::string_view header;
        while (header.empty() || header.starts_with('#')) {
            if (rest_.empty())
                return fail("expected a header line " + columnNames() + ", found the end of the file");
            header = nextLine();
        }
        for (std::size_t left = cellsIn(header); left > 0; --left)
            if (!readName(trimmed(takeUntil(',', header)))) return false;
        for (std::size_t i = 0; i < requiredEventColumns; ++i)
            if (!has(eventColumns[i]))
                return fail("column " + std::string(eventColumns[i].name) + " is missing");
        return true;
    }

    bool readName(std::string_view name) {
        for (const EventColumn& column : eventColumns) {
            if (column.name != name) continue;
            if (has(column)) return fail("column " + std::string(name) + " appears twice");
            order_.push_back(&column);
            return true;
        }
        return fail("unknown column " + inQuotes(name) + ", expected a header line " + columnNames());
    }

    bool has(const EventColumn& column) const { return std::ranges::find(order_, &column) != order_.end(); }

    bool readRows() {
        const auto lines = static_cast<std::size_t>(std::ranges::count(rest_, '\n')) + 1;
        events_.reserve(std::min(lines, maxRows_));
        while (rest_.find_first_not_of(" \t\r\n") != std::string_view::npos)
            if (!readRow(nextLine())) return false;
        return !events_.empty() || fail("expected events after the header, found none");
    }

    bool readRow(std::string_view line) {
        if (events_.size() == maxRows_)
            return fail("expected at most " + std::to_string(maxRows_) + " events");
        const std::size_t cells = cellsIn(line);
        if (cells != order_.size())
            return fail("expected " + std::to_string(order_.size()) + " cells, found " +
                        std::to_string(cells));
        CollisionEvent event;
        std::string_view rest = line;
        for (const EventColumn* column : order_)
            if (!readCellOf(*column, trimmed(takeUntil(',', rest)), event)) return false;
        return accept(event);
    }

    bool readCellOf(const EventColumn& column, std::string_view cell, CollisionEvent& event) {
        const std::string expected =
            std::visit([&](const auto& kind) { return readCell(kind, cell, event); }, column.cell);
        return expected.empty() || fail("column " + std::string(column.name) + ": expected " + expected +
                                        ", found " + inQuotes(cell));
    }

    bool accept(const CollisionEvent& event) {
        if (event.decayPerSecond == 0.0 && event.durationNs == 0)
            return fail("column decay_per_s: expected a number > 0, or a duration_s > 0, found 0");
        if (!events_.empty() && event.timeNs < events_.back().timeNs) return failOrder(event.timeNs);
        events_.push_back(event);
        return true;
    }

    bool failOrder(std::int64_t timeNs) {
        std::string message = "column time_s: expected a time >= ";
        appendSeconds(message, events_.back().timeNs);
        message += " of the row above, found ";
        appendSeconds(message, timeNs);
        return fail(message);
    }

    std::string_view nextLine() {
        ++line_;
        return trimmed(takeUntil('\n', rest_));
    }

    /// Always false.
    bool fail(std::string_view message) {
        const std::size_t line = std::max<std::size_t>(line_, 1); // of an empty file, too
        error_.assign(name_).append(":").append(std::to_string(line)).append(": ").append(message);
        return false;
    }

    std::string_view rest_;
    std::string_view name_;
    std::size_t maxRows_;
    std::size_t line_ = 0; // of the line last taken, from 1
    std::vector<const EventColumn*> order_;
    std::vector<CollisionEvent> events_;
    std::string error_;
};

} // namespace

Result<std::vector<CollisionEvent>> readEventsCsv(std::string_view text, std::string_view name,
                                                  std::size_t maxRows) {
    return Reader(text, name, maxRows).read();
}

Result<std::vector<CollisionEvent>> loadEventsCsv(const std::filesystem::path& path) {
    const Result<std::string> text = readFile(path, limits::maxEventsFileBytes);
    if (!text) return Failure{text.error};
    return readEventsCsv(text.value, path.string());
}

std::string eventsCsvHead(const Provenance& provenance) { return provenanceComment(provenance) + columnNames() + "\n"; }

void appendEventRow(std::string& text, CollisionEvent event) {
    for (const EventColumn& column : eventColumns) {
        std::visit([&](const auto& kind) { writeCell(kind, event, text); }, column.cell);
        text += &column == &eventColumns.back() ? '\n' : ',';
    }
}

std::string eventsCsv(std::span<const CollisionEvent> events, const Provenance& provenance) {
    std::string text = eventsCsvHead(provenance);
    constexpr std::size_t usualRowBytes = 160;
    text.reserve(text.size() + events.size() * usualRowBytes);
    for (const CollisionEvent& event : events) appendEventRow(text, event);
    return text;
}

} // namespace physvib
