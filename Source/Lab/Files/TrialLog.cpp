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

void appendPart(std::string& text, const std::string& part) {
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
    const Apparatus& with = *answer.apparatus;
    cells[columns::limiterDb] = levelText(answer.limiterDb);
    cells[columns::masterDb] = levelText(with.masterDb);
    cells[columns::noiseDb] = with.noiseDb ? levelText(*with.noiseDb) : std::string{columns::noNoise};
    cells[columns::device] = with.device;
    cells[columns::version] = with.version;
}

Cells cellsOf(const Protocol& protocol, const Participant& participant, const TrialRecord& record) {
    const auto& [trial, answer] = record;
    const SessionPlan& session = protocol.sessions[trial.session];
    Cells cells{{"participant", participant.code},
                {"observer", participant.observer},
                {"condition", protocol.conditions[trial.condition].name},
                {"session", session.name}};
    cells["phase"] = session.isTraining ? columns::training : "main";
    cells["trial"] = std::to_string(trial.number);
    cells["task"] = describe(trial.task).name;
    cells["stimulus"] = trial.stimulus;
    cells["parts"] = joined(trial.parts, "|");
    cells[session.answer() == AnswerKind::choice ? "choice" : "response"] = answer.response;
    if (const auto target = targetOf(protocol.conditions[trial.condition], trial)) {
        cells["target_column"] = std::to_string(target->column);
        cells["target_row"] = std::to_string(target->row);
    }
    if (answer.place) addPlace(cells, *answer.place);
    if ((session.answer() == AnswerKind::level || session.answer() == AnswerKind::number) && !answer.ranOut)
        cells["value"] = numberText(answer.value);
    if (const auto correct = isCorrect(protocol, record)) cells["correct"] = *correct ? "1" : "0";
    cells["replays"] = std::to_string(answer.plays - 1);
    cells["response_s"] = numberText(answer.seconds);
    // no level is moved where the protocol says what is right: empty tells these rows from adaptive ones
    if (session.correct.empty()) cells["level_db"] = numberText(trial.levelDb);
    cells["render"] = callsOf(protocol, record);
    if (session.quest) cells[columns::quest] = questWords(*session.quest, session.guessRate());
    if (trial.staircase > 0) cells[columns::staircase] = std::to_string(trial.staircase);
    if (session.answerSeconds > 0.0) cells[columns::ranOut] = answer.ranOut ? "1" : "0";
    for (const FeltLevel& felt : answer.felt) {
        appendPart(cells[columns::peakG], levelText(felt.peakG));
        appendPart(cells[columns::rmsG], levelText(felt.rmsG));
    }
    if (answer.exposure) cells[columns::exposure] = levelText(*answer.exposure);
    if (answer.apparatus) addApparatus(cells, answer);
    if (answer.left) cells[columns::left] = *answer.left ? "1" : "0";
    if (answer.left) cells[columns::again] = std::to_string(answer.again);
    for (std::size_t s = 0; s < answer.scores.size(); ++s)
        cells[session.scores()[s]] = numberText(answer.scores[s]);
    return cells;
}

/// Columns of the header `line` (with its line end): all of `names`, or those of older versions; else empty.
std::vector<std::string> columnsIn(std::string_view line, std::vector<std::string> names) {
    for (const auto isNewer : {columns::isReceipt, columns::isApparatus, columns::isMeasured}) {
        if (line == csvLine(names)) return names;
        std::erase_if(names, isNewer);
    }
    return line == csvLine(names) ? names : std::vector<std::string>{};
}

/// Reads the rows of a table back into records. Throws StudyFault.
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
        answer.response = rows_.cell(row, session.answer() == AnswerKind::choice ? "choice" : "response");
        answer.plays = 1 + rows_.wholeNumber(row, "replays", 0, 1'000'000);
        answer.seconds = rows_.number(row, "response_s", 0.0, 1e9);
        if (!rows_.cell(row, "x").empty())
            answer.place = FieldPlace{rows_.number(row, "x", 0.0, 1.0), rows_.number(row, "y", 0.0, 1.0)};
        if (!rows_.cell(row, "value").empty())
            answer.value = rows_.number(row, "value", -mostEstimate, mostEstimate);
        if (!rows_.named(row, columns::exposure).empty())
            answer.exposure = rows_.number(row, columns::exposure, 0.0, 1e6);
        readApparatus(row, answer);
        if (!rows_.named(row, columns::left).empty()) {
            answer.left = rows_.wholeNumber(row, columns::left, 0, 1) == 1;
            answer.again = rows_.wholeNumber(row, columns::again, 0, 1'000'000);
        }
        if (session.answerSeconds > 0.0) answer.ranOut = rows_.wholeNumber(row, columns::ranOut, 0, 1) == 1;
        for (const auto& scale : session.scores())
            if (!answer.ranOut) answer.scores.push_back(rows_.number(row, scale, 0.0, 100.0));
        return record;
    }

private:
    void readApparatus(const CsvRow& row, Answer& answer) const {
        if (rows_.named(row, columns::version).empty()) return;
        Apparatus& with = answer.apparatus.emplace();
        with.version = rows_.cell(row, columns::version);
        with.device = rows_.cell(row, columns::device);
        with.masterDb = rows_.number(row, columns::masterDb, -1000.0, 1000.0);
        if (rows_.cell(row, columns::noiseDb) != columns::noNoise)
            with.noiseDb = rows_.number(row, columns::noiseDb, -1000.0, 0.0);
        answer.limiterDb = rows_.number(row, columns::limiterDb, 0.0, 1000.0);
    }
    template <class Item>
    std::size_t indexOf(const CsvRow& row, std::string_view column, const std::vector<Item>& items) const {
        const auto at = rows_.required(column);
        const auto found = std::ranges::find(items, row.cells[at], &Item::name);
        if (found == items.end())
            throw detail::StudyFault{
                rows_.table().fault(row, at, std::string("a ") + std::string(column) + " of the protocol")};
        return static_cast<std::size_t>(found - items.begin());
    }
    const detail::StudyRows& rows_;
    const Protocol& protocol_;
};

/// The first line from the protocol on, without the program version, which may have changed.
std::string_view withoutVersion(std::string_view header) {
    const auto line = header.substr(0, header.find('\n'));
    return line.substr(std::min(line.find(" protocol="), line.size()));
}

/// The first key whose value differs.
std::string headFault(std::string_view found, std::string_view expected) {
    const auto headOf = [](std::string_view text) {
        return trialHeadOf({std::string{text.substr(1, text.find('\n') - 1)}});
    };
    TrialHead own = headOf(found), wanted = headOf(expected);
    for (const std::string key : {"protocol", "participant", "number", "observer", "seed"})
        if (own[key] != wanted[key])
            return "expected trials of " + key + " " + cleanLine(wanted[key]) + ", found " +
                   cleanLine(own[key]);
    if (own["hash"] == wanted["hash"])
        return "expected the columns of a trial file of this protocol, found others";
    return "was begun with another version of the protocol " + wanted["protocol"] + " (hash " +
           cleanLine(own["hash"]) + ", now " + wanted["hash"] +
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
    return text + csvLine(trialColumnsOf(protocol));
}

std::vector<std::string> trialColumnsOf(const Protocol& protocol) {
    std::vector<std::string> all(columns::names.begin(), columns::names.end());
    for (const auto& scale : scalesOf(protocol)) all.push_back(scale);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) { return s.quest.has_value(); }))
        all.emplace_back(columns::quest);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) {
            return s.staircase && s.staircase->starts().size() > 1;
        }))
        all.emplace_back(columns::staircase);
    if (std::ranges::any_of(protocol.sessions, [](const SessionPlan& s) { return s.answerSeconds > 0.0; }))
        all.emplace_back(columns::ranOut);
    all.insert(all.end(), columns::measured.begin(), columns::measured.end());
    all.insert(all.end(), columns::apparatus.begin(), columns::apparatus.end());
    all.insert(all.end(), columns::receipts.begin(), columns::receipts.end());
    return all;
}

std::string trialRow(const Protocol& protocol, const Participant& participant, const TrialRecord& record,
                     std::span<const std::string> names) {
    Cells cells = cellsOf(protocol, participant, record);
    return csvLine(std::views::transform(names, [&](const auto& name) { return cells[name]; }));
}

Result<TrialLog> readTrialLog(std::string_view text, std::string_view name, const Protocol& protocol,
                              const Participant& participant) {
    const std::string header = trialHeader(protocol, participant, "0"); // of any version
    TrialLog log;
    log.columns = trialColumnsOf(protocol);
    const std::size_t end = text.rfind('\n');
    const std::string_view whole = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
    constexpr std::string_view ours = "# physvib ";
    const bool isOurs = text.starts_with(ours) || ours.starts_with(text);
    if (isOurs && std::ranges::count(whole, '\n') < 2) return log; // incomplete header: start a new file
    const std::size_t names = whole.find('\n') + 1, rows = whole.find('\n', names) + 1;
    if (isOurs) log.columns = columnsIn(whole.substr(names, rows - names), log.columns);
    if (!isOurs || withoutVersion(whole) != withoutVersion(header) || log.columns.empty())
        return Failure{
            std::string(name) + ":1: " +
            (isOurs ? headFault(whole, header) : "expected a trial file of physvib, found something else")};
    log.wholeBytes = whole.size();
    if (rows == whole.size()) return log;
    try {
        const detail::StudyRows table{whole, name, {}, detail::StudyRows::Kept::all};
        const RecordReader reader{table, protocol};
        for (const CsvRow& row : table.table().rows) log.records.push_back(reader.read(row));
    } catch (const detail::StudyFault& fault) {
        return Failure{fault.message};
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
    file_ = SystemFile::grow(path_);
    if (!file_.isOpen()) return failToWrite();
    if (file_.lock() == SystemFile::Lock::others)
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
    const std::size_t kept = log.value.wholeBytes;
    if (kept < text.value.size() && !file_.resize(static_cast<std::int64_t>(kept))) return failToWrite();
    std::error_code ignored;
    if (kept == 0 && !(write(trialHeader(protocol_, participant_, version)) && sync()))
        std::filesystem::remove(path_, ignored);
    else if (const int code = SystemFile::syncFolder(folderOf(path_)); code != 0)
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

StudyMoment momentOf(const detail::StudyRows& rows, const CsvRow& row) {
    if (!(secondsOf(rows.cell(row, "time_utc")) >= 0.0))
        throw detail::StudyFault{
            rows.table().fault(row, rows.required("time_utc"), "a time like 2026-11-24T14:02:31Z")};
    return {rows.cell(row, "time_utc"),
            rows.text(row, "event"),
            rows.wholeNumber(row, "trials", 0, std::numeric_limits<int>::max()),
            rows.cell(row, "language"),
            rows.cell(row, "outputs"),
            rows.cell(row, "noise_outputs")};
}

} // namespace

void StudyRests::take(const StudyMoment& m) noexcept {
    namespace events = studyEvents;
    if (m.event == events::rest) isResting = true;
    if (m.event == events::end || (m.event == events::goOn && !isPaused)) isResting = false;
    isPaused = m.event == events::pause; // which go-on and resume end
}

std::filesystem::path timesPathOf(const std::filesystem::path& trialFile) {
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

double secondsOf(std::string_view t) noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (t.size() != 20 || t[4] != '-' || t[7] != '-' || t[10] != 'T' || t[13] != ':' || t[16] != ':' ||
        t[19] != 'Z')
        return none;
    const auto part = [&](std::size_t at, std::size_t size) {
        return parseNumber<unsigned>(t.substr(at, size)).value_or(99);
    };
    using namespace std::chrono;
    const year_month_day date{year{static_cast<int>(part(0, 4))}, month{part(5, 2)}, day{part(8, 2)}};
    if (!date.ok() || part(0, 4) < 1970 || part(11, 2) > 23 || part(14, 2) > 59 || part(17, 2) > 60)
        return none;
    return 86400.0 * static_cast<double>(sys_days{date}.time_since_epoch().count()) + 3600.0 * part(11, 2) +
           60.0 * part(14, 2) + part(17, 2);
}

Result<std::vector<StudyMoment>> loadStudyTimes(const std::filesystem::path& path) {
    std::error_code none;
    std::vector<StudyMoment> moments;
    if (!std::filesystem::exists(path, none)) return moments;
    const auto text = readFile(path, limits::maxTableBytes);
    if (!text) return Failure{text.error};
    try {
        const detail::StudyRows rows{text.value, path.string()};
        for (const CsvRow& row : rows.table().rows) moments.push_back(momentOf(rows, row));
    } catch (const detail::StudyFault& fault) {
        return Failure{fault.message};
    }
    return moments;
}

std::string writeStudyTimes(const std::filesystem::path& path, const std::vector<StudyMoment>& moments) {
    std::string text{"time_utc,event,trials,language,outputs,noise_outputs\n"};
    for (const StudyMoment& m : moments)
        text += csvLine(
            std::array{m.timeUtc, m.event, std::to_string(m.trials), m.language, m.outputs, m.noiseOutputs});
    AtomicFile file{path};
    if (const std::string& fault = file.write(text); !fault.empty()) return fault;
    return file.commit();
}

} // namespace physvib
