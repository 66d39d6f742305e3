// SPDX-License-Identifier: MIT
// Reads and writes the times of a participant's study as a table.
#include "Lab/Files/StudyTimes.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Lab/Files/StudyTables.h"
#include <chrono>
#include <limits>

namespace physvib {
namespace {

constexpr std::string_view header = "time_utc,event,trials,language,outputs,noise_outputs";

std::string twoDigits(auto number) {
    const std::string digits = std::to_string(number);
    return digits.size() < 2 ? "0" + digits : digits;
}

StudyMoment momentOf(const detail::StudyRows& rows, const CsvRow& row) {
    const auto cell = [&](std::string_view column) { return row.cells[rows.required(column)]; };
    if (!(secondsOf(cell("time_utc")) >= 0.0))
        throw detail::StudyFault{
            rows.table().fault(row, rows.required("time_utc"), "a time like 2026-11-24T14:02:31Z")};
    return {cell("time_utc"),
            rows.text(row, rows.required("event")),
            rows.wholeNumber(row, rows.required("trials"), 0, std::numeric_limits<int>::max()),
            cell("language"),
            cell("outputs"),
            cell("noise_outputs")};
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
    std::string text{header};
    for (const StudyMoment& m : moments) {
        text += '\n' + m.timeUtc;
        for (const std::string& cell :
             {m.event, std::to_string(m.trials), m.language, m.outputs, m.noiseOutputs}) {
            text += ',';
            appendCell(text, cell);
        }
    }
    AtomicFile file{path};
    if (const std::string& fault = file.write(text + "\n"); !fault.empty()) return fault;
    return file.commit();
}

} // namespace physvib
