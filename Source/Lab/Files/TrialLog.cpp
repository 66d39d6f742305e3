// SPDX-License-Identifier: MIT
// Writes and reads the rows of trial files, and the files of times beside them.
#include "Lab/Files/TrialLog.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Files/ProtocolFields.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/StudyTables.h"
#include <chrono>
#include <limits>
#include <ranges>
#include <utility>

namespace physvib {
namespace {

namespace columns = trialColumns;

void appendValue(std::string& text, const std::string& part) {
    text.append(text.empty() ? "" : "|").append(part);
}

/// With six digits, the precision of the measurement.
std::string levelText(double level) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, level, std::chars_format::general, 6).ptr};
}

/// Cells by column name; a column without a cell stays empty.
using Cells = std::map<std::string_view, std::string>;

void addPlace(Cells& cells, const FieldPlace& place) {
    cells["x"] = numberText(place.x);
    cells["y"] = numberText(place.y);
}

void addApparatus(Cells& cells, const Answer& answer) {
    const Apparatus& apparatus = *answer.apparatus;
    cells[columns::limiterDb] = levelText(answer.limiterDb);
    cells[columns::masterDb] = levelText(apparatus.masterDb);
    cells[columns::noiseDb] =
        apparatus.noiseDb ? levelText(*apparatus.noiseDb) : std::string{columns::noNoise};
    cells[columns::device] = apparatus.device;
    cells[columns::version] = apparatus.version;
}

Cells makeCells(const Protocol& protocol, const Participant& participant, const TrialRecord& record) {
    const auto& [trial, answer] = record;
    const SessionPlan& session = protocol.sessions[trial.session];
    Cells cells{{"participant", participant.code},
                {"observer", participant.observer},
                {"condition", protocol.conditions[trial.condition].name},
                {"session", session.name}};
    cells["phase"] = session.isTraining ? columns::training : "main";
    cells["trial"] = std::to_string(trial.number);
    cells["task"] = taskDescription(trial.task).name;
    cells["stimulus"] = trial.stimulus;
    cells["parts"] = joinNames(trial.parts, "|");
    cells[session.answerKind() == AnswerKind::choice ? "choice" : "response"] = answer.response;
    if (const auto target = targetCell(protocol.conditions[trial.condition], trial)) {
        cells["target_column"] = std::to_string(target->column);
        cells["target_row"] = std::to_string(target->row);
    }
    if (answer.place) addPlace(cells, *answer.place);
    if ((session.answerKind() == AnswerKind::level || session.answerKind() == AnswerKind::number) &&
        !answer.timedOut)
        cells["value"] = numberText(answer.value);
    if (const auto correct = isCorrect(protocol, record)) cells["correct"] = *correct ? "1" : "0";
    cells["replays"] = std::to_string(answer.plays - 1);
    cells["response_s"] = numberText(answer.seconds);
    // with a correct alternative no level adapts; the empty cell distinguishes these rows from adaptive ones
    if (session.correct.empty()) cells["level_db"] = numberText(trial.levelDb);
    cells["render"] = resolvedCalls(protocol, record);
    if (session.quest) cells[columns::quest] = questText(*session.quest, session.guessRate());
    if (trial.staircase > 0) cells[columns::staircase] = std::to_string(trial.staircase);
    if (session.answerSeconds > 0.0) cells[columns::timedOut] = answer.timedOut ? "1" : "0";
    for (const PlayedLevel& played : answer.playedLevels) {
        appendValue(cells[columns::peakG], levelText(played.peakG));
        appendValue(cells[columns::rmsG], levelText(played.rmsG));
    }
    if (answer.exposure) cells[columns::exposure] = levelText(*answer.exposure);
    if (answer.apparatus) addApparatus(cells, answer);
    if (answer.wasDelivered) cells[columns::delivered] = *answer.wasDelivered ? "1" : "0";
    if (answer.wasDelivered) cells[columns::revoked] = std::to_string(answer.revokedPlays);
    for (std::size_t s = 0; s < answer.scores.size(); ++s)
        cells[session.scores()[s]] = numberText(answer.scores[s]);
    return cells;
}

/// Columns of the header `line` (with its line end): all of `names`, or those of older versions; else empty.
std::vector<std::string> matchColumns(std::string_view line, std::vector<std::string> names) {
    for (const auto isNewer : {columns::isDelivery, columns::isApparatus, columns::isMeasured}) {
        if (line == csvLine(names)) return names;
        std::erase_if(names, isNewer);
    }
    return line == csvLine(names) ? names : std::vector<std::string>{};
}

/// Reads the rows of a table back into records. Throws StudyTableError.
class RecordReader {
public:
    RecordReader(const detail::StudyRows& rows, const Protocol& protocol)
        : rows_{rows}
        , protocol_{protocol} {}

    TrialRecord read(const CsvRow& row) const {
        TrialRecord record;
        auto& [trial, answer] = record;
        trial.condition = indexOf(row, "condition", protocol_.conditions);
        trial.session = indexOf(row, "session", protocol_.sessions);
        const SessionPlan& session = protocol_.sessions[trial.session];
        trial.task = session.task;
        trial.number = rows_.wholeNumber(row, "trial", 1, std::numeric_limits<int>::max());
        trial.stimulus = rows_.cell(row, "stimulus");
        if (session.correct.empty()) trial.levelDb = rows_.number(row, "level_db", -1000.0, 1000.0);
        answer.response = rows_.cell(row, session.answerKind() == AnswerKind::choice ? "choice" : "response");
        answer.plays = 1 + rows_.wholeNumber(row, "replays", 0, 1'000'000);
        answer.seconds = rows_.number(row, "response_s", 0.0, 1e9);
        if (!rows_.cell(row, "x").empty())
            answer.place = FieldPlace{rows_.number(row, "x", 0.0, 1.0), rows_.number(row, "y", 0.0, 1.0)};
        if (!rows_.cell(row, "value").empty())
            answer.value = rows_.number(row, "value", -maxEstimate, maxEstimate);
        if (!rows_.cellOrEmpty(row, columns::exposure).empty())
            answer.exposure = rows_.number(row, columns::exposure, 0.0, 1e6);
        readApparatus(row, answer);
        if (!rows_.cellOrEmpty(row, columns::delivered).empty()) {
            answer.wasDelivered = rows_.wholeNumber(row, columns::delivered, 0, 1) == 1;
            answer.revokedPlays = rows_.wholeNumber(row, columns::revoked, 0, 1'000'000);
        }
        if (session.answerSeconds > 0.0)
            answer.timedOut = rows_.wholeNumber(row, columns::timedOut, 0, 1) == 1;
        for (const auto& scale : session.scores())
            if (!answer.timedOut) answer.scores.push_back(rows_.number(row, scale, 0.0, 100.0));
        return record;
    }

private:
    void readApparatus(const CsvRow& row, Answer& answer) const {
        if (rows_.cellOrEmpty(row, columns::version).empty()) return;
        Apparatus& apparatus = answer.apparatus.emplace();
        apparatus.version = rows_.cell(row, columns::version);
        apparatus.device = rows_.cell(row, columns::device);
        apparatus.masterDb = rows_.number(row, columns::masterDb, -1000.0, 1000.0);
        if (rows_.cell(row, columns::noiseDb) != columns::noNoise)
            apparatus.noiseDb = rows_.number(row, columns::noiseDb, -1000.0, 0.0);
        answer.limiterDb = rows_.number(row, columns::limiterDb, 0.0, 1000.0);
    }
    template <class Item>
    std::size_t indexOf(const CsvRow& row, std::string_view column, const std::vector<Item>& items) const {
        const auto at = rows_.requireColumn(column);
        const auto found = std::ranges::find(items, row.cells[at], &Item::name);
        if (found == items.end())
            throw detail::StudyTableError{rows_.table().cellError(
                row, at, std::string("a ") + std::string(column) + " of the protocol")};
        return static_cast<std::size_t>(found - items.begin());
    }
    const detail::StudyRows& rows_;
    const Protocol& protocol_;
};

/// The first line from the protocol on, without the program version, which may have changed.
std::string_view dropVersion(std::string_view header) {
    const auto line = header.substr(0, header.find('\n'));
    return line.substr(std::min(line.find(" protocol="), line.size()));
}

/// The first key whose value differs.
std::string headError(std::string_view found, std::string_view expected) {
    const auto parseHead = [](std::string_view text) {
        return parseTrialHead({std::string{text.substr(1, text.find('\n') - 1)}});
    };
    TrialHead foundHead = parseHead(found), expectedHead = parseHead(expected);
    for (const std::string key : {"protocol", "participant", "number", "observer", "seed"})
        if (foundHead[key] != expectedHead[key])
            return "expected trials of " + key + " " + cleanLine(expectedHead[key]) + ", found " +
                   cleanLine(foundHead[key]);
    if (foundHead["hash"] == expectedHead["hash"])
        return "expected the columns of a trial file of this protocol, found others";
    return "was begun with another version of the protocol " + expectedHead["protocol"] + " (hash " +
           cleanLine(foundHead["hash"]) + ", now " + expectedHead["hash"] +
           "), so it does not go on: keep it, and begin anew in another folder";
}

} // namespace

std::string trialHeader(const Protocol& protocol, const Participant& participant, std::string_view version) {
    std::string text = provenanceComment({std::string(version),
                                          {{"protocol", protocol.name},
                                           {"hash", protocolHash(protocol)},
                                           {"seed", std::to_string(protocol.seed)},
                                           {"participant", participant.code},
                                           {"number", std::to_string(participant.number)},
                                           {"observer", participant.observer}}});
    return text + csvLine(makeTrialColumns(protocol));
}

std::vector<std::string> makeTrialColumns(const Protocol& protocol) {
    std::vector<std::string> all(columns::names.begin(), columns::names.end());
    for (const auto& scale : protocolScales(protocol)) all.push_back(scale);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) { return s.quest.has_value(); }))
        all.emplace_back(columns::quest);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) {
            return s.staircase && s.staircase->starts().size() > 1;
        }))
        all.emplace_back(columns::staircase);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) { return s.answerSeconds > 0.0; }))
        all.emplace_back(columns::timedOut);
    all.insert(all.end(), columns::measured.begin(), columns::measured.end());
    all.insert(all.end(), columns::apparatus.begin(), columns::apparatus.end());
    all.insert(all.end(), columns::delivery.begin(), columns::delivery.end());
    return all;
}

std::string trialRow(const Protocol& protocol, const Participant& participant, const TrialRecord& record,
                     std::span<const std::string> names) {
    Cells cells = makeCells(protocol, participant, record);
    return csvLine(std::views::transform(names, [&](const auto& name) { return cells[name]; }));
}

Result<TrialLog> readTrialLog(std::string_view text, std::string_view name, const Protocol& protocol,
                              const Participant& participant) {
    const std::string header = trialHeader(protocol, participant, "0"); // the version is not compared
    TrialLog log;
    log.columns = makeTrialColumns(protocol);
    const std::size_t end = text.rfind('\n');
    const std::string_view complete = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
    constexpr std::string_view prefix = "# physvib ";
    const bool isOurs = text.starts_with(prefix) || prefix.starts_with(text);
    if (isOurs && std::ranges::count(complete, '\n') < 2) return log; // incomplete header: start a new file
    const std::size_t namesAt = complete.find('\n') + 1, rowsAt = complete.find('\n', namesAt) + 1;
    if (isOurs) log.columns = matchColumns(complete.substr(namesAt, rowsAt - namesAt), log.columns);
    if (!isOurs || dropVersion(complete) != dropVersion(header) || log.columns.empty())
        return Failure{std::string(name) + ":1: " +
                       (isOurs ? headError(complete, header)
                               : "expected a trial file of physvib, found something else")};
    log.completeBytes = complete.size();
    if (rowsAt == complete.size()) return log;
    try {
        const detail::StudyRows table{complete, name, {}, detail::StudyRows::RowFilter::all};
        const RecordReader reader{table, protocol};
        for (const CsvRow& row : table.table().rows) log.records.push_back(reader.read(row));
    } catch (const detail::StudyTableError& error) {
        return Failure{error.message};
    }
    return log;
}

TrialLogFile::TrialLogFile(std::filesystem::path path, const Protocol& protocol, Participant participant,
                           std::string_view version)
    : path_{std::move(path)}
    , protocol_{protocol}
    , participant_{std::move(participant)} {
    open(version);
}

void TrialLogFile::open(std::string_view version) {
    file_ = SystemFile::openForAppending(path_);
    if (!file_.isOpen()) return failToWrite();
    if (file_.lock() == SystemFile::Lock::heldByOthers)
        return fail("another program is writing it: the participant's study runs already");
    const auto text = readFile(path_, limits::maxTableBytes);
    auto log = text ? readTrialLog(text.value, path_.string(), protocol_, participant_)
                    : Result<TrialLog>{Failure{text.error}};
    if (!log) {
        error_ = log.error;
        return;
    }
    records_ = std::move(log.value.records);
    columns_ = std::move(log.value.columns);
    const std::size_t completeBytes = log.value.completeBytes;
    if (completeBytes < text.value.size() && !file_.resize(static_cast<std::int64_t>(completeBytes)))
        return failToWrite();
    std::error_code ignored;
    if (completeBytes == 0 && !(write(trialHeader(protocol_, participant_, version)) && sync()))
        std::filesystem::remove(path_, ignored);
    else if (const int code = SystemFile::syncFolder(parentFolder(path_)); code != 0)
        fail("its folder: " + std::generic_category().message(code));
}

bool TrialLogFile::append(const TrialRecord& record) {
    const bool isPerson = participant_.observer == Participant{}.observer;
    return write(trialRow(protocol_, participant_, record, columns_)) && (!isPerson || sync());
}

// Reads and writes the times of a participant's study as a table.

namespace {

std::string twoDigits(auto number) {
    const std::string digits = std::to_string(number);
    return digits.size() < 2 ? "0" + digits : digits;
}

StudyEvent readEvent(const detail::StudyRows& rows, const CsvRow& row) {
    if (!(unixSeconds(rows.cell(row, "time_utc")) >= 0.0))
        throw detail::StudyTableError{
            rows.table().cellError(row, rows.requireColumn("time_utc"), "a time like 2026-11-24T14:02:31Z")};
    return {rows.cell(row, "time_utc"),
            rows.text(row, "event"),
            rows.wholeNumber(row, "trials", 0, std::numeric_limits<int>::max()),
            rows.cell(row, "language"),
            rows.cell(row, "outputs"),
            rows.cell(row, "noise_outputs")};
}

} // namespace

void StudyBreakState::apply(const StudyEvent& entry) noexcept {
    namespace events = studyEvents;
    if (entry.event == events::breakStart) isOnBreak = true;
    if (entry.event == events::end || (entry.event == events::goOn && !isPaused)) isOnBreak = false;
    isPaused = entry.event == events::pause; // a pause ends by go-on or resume
}

std::filesystem::path timesPath(const std::filesystem::path& trialFile) {
    return std::filesystem::path{trialFile}.replace_extension(".times.txt");
}

std::string utcNow() {
    using namespace std::chrono;
    const auto now = floor<seconds>(system_clock::now());
    const auto day = floor<days>(now);
    const year_month_day date{day};
    const hh_mm_ss time{now - day};
    return std::to_string(static_cast<int>(date.year())) + "-" +
           twoDigits(static_cast<unsigned>(date.month())) + "-" +
           twoDigits(static_cast<unsigned>(date.day())) + "T" + twoDigits(time.hours().count()) + ":" +
           twoDigits(time.minutes().count()) + ":" + twoDigits(time.seconds().count()) + "Z";
}

double unixSeconds(std::string_view t) noexcept {
    constexpr double invalid = std::numeric_limits<double>::quiet_NaN();
    if (t.size() != 20 || t[4] != '-' || t[7] != '-' || t[10] != 'T' || t[13] != ':' || t[16] != ':' ||
        t[19] != 'Z')
        return invalid;
    const auto part = [&](std::size_t at, std::size_t size) {
        return parseNumber<unsigned>(t.substr(at, size)).value_or(99);
    };
    using namespace std::chrono;
    const year_month_day date{year{static_cast<int>(part(0, 4))}, month{part(5, 2)}, day{part(8, 2)}};
    if (!date.ok() || part(0, 4) < 1970 || part(11, 2) > 23 || part(14, 2) > 59 || part(17, 2) > 60)
        return invalid;
    return 86400.0 * static_cast<double>(sys_days{date}.time_since_epoch().count()) + 3600.0 * part(11, 2) +
           60.0 * part(14, 2) + part(17, 2);
}

Result<std::vector<StudyEvent>> loadStudyTimes(const std::filesystem::path& path) {
    std::error_code ignored;
    std::vector<StudyEvent> entries;
    if (!std::filesystem::exists(path, ignored)) return entries;
    const auto text = readFile(path, limits::maxTableBytes);
    if (!text) return Failure{text.error};
    try {
        const detail::StudyRows rows{text.value, path.string()};
        for (const CsvRow& row : rows.table().rows) entries.push_back(readEvent(rows, row));
    } catch (const detail::StudyTableError& error) {
        return Failure{error.message};
    }
    return entries;
}

std::string writeStudyTimes(const std::filesystem::path& path, const std::vector<StudyEvent>& entries) {
    std::string text{"time_utc,event,trials,language,outputs,noise_outputs\n"};
    for (const StudyEvent& entry : entries)
        text += csvLine(std::array{entry.timeUtc, entry.event, std::to_string(entry.trials), entry.language,
                                   entry.outputs, entry.noiseOutputs});
    AtomicFile file{path};
    if (const std::string& error = file.write(text); !error.empty()) return error;
    return file.commit();
}

} // namespace physvib
