// SPDX-License-Identifier: MIT
// Reads and writes coupling files, checking every number, because the file drives actuators that people hold.
#include "Lab/Files/CouplingFile.h"
#include "Core/Limits.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include "Scene/SceneLimits.h"
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

constexpr const char* couplingVersionField = "physvib_coupling";
constexpr double mostShare = 4.0; // in full scales; larger values indicate a wrong unit
constexpr std::size_t mostFrequencies = 256;

std::size_t sizeOf(const JsonField& rows, std::size_t least, std::size_t most) {
    const std::size_t size = rows.arraySize();
    if (size < least || size > most)
        rows.fail(
            "expected " +
            (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most)) +
            " items, found " + std::to_string(size));
    return size;
}

/// Calls `take(i, j, number)` for each entry of a square matrix of `size`.
template <class Take>
void readSquare(const JsonField& rows, std::size_t size, double least, double most, Take take) {
    sizeOf(rows, size, size);
    for (std::size_t i = 0; i < size; ++i) {
        const JsonField row = rows.item(i);
        sizeOf(row, size, size);
        for (std::size_t j = 0; j < size; ++j) take(i, j, row.item(j).numberWithin(least, most));
    }
}

CouplingMatrix readMatrix(const JsonField& json) {
    const JsonField magnitudes = json["magnitude"];
    CouplingMatrix matrix(sizeOf(magnitudes, 1, limits::maxEnchanters));
    readSquare(magnitudes, matrix.size, 0.0, mostShare,
               [&](std::size_t i, std::size_t j, double share) { matrix.at(i, j) = share; });
    readSquare(json["phase_deg"], matrix.size, -360.0, 360.0,
               [&](std::size_t i, std::size_t j, double degrees) {
                   matrix.at(i, j) *= std::polar(1.0, degrees * std::numbers::pi / 180.0);
               });
    for (std::size_t i = 0; i < matrix.size; ++i)
        if (!(std::abs(matrix.at(i, i)) > 0.0))
            magnitudes.item(i).item(i).fail("expected an enchanter that moves by its own drive, found 0");
    return matrix;
}

MeasuredCoupling readCouplingRoot(const JsonField& root) {
    checkVersion(root, couplingVersionField, couplingFormatVersion);
    root.expectObject({couplingVersionField, "name", "source", "measured"});
    root["name"].text();
    root["source"].text();
    const JsonField measured = root["measured"];
    MeasuredCoupling coupling;
    for (std::size_t k = 0, count = sizeOf(measured, 1, mostFrequencies); k < count; ++k) {
        const JsonField json = measured.item(k);
        json.expectObject({"frequency_hz", "magnitude", "phase_deg"});
        const double hz = json["frequency_hz"].numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz);
        if (k > 0 && !(hz > coupling.frequenciesHz.back()))
            json["frequency_hz"].fail("expected frequencies that rise, found " + numberText(hz) + " after " +
                                      numberText(coupling.frequenciesHz.back()));
        coupling.frequenciesHz.push_back(hz);
        coupling.matrices.push_back(readMatrix(json));
        if (const std::size_t size = coupling.matrices.back().size; size != coupling.enchanters())
            json["magnitude"].fail("expected as many enchanters as at the first frequency, " +
                                   std::to_string(coupling.enchanters()) + ", found " + std::to_string(size));
    }
    return coupling;
}

} // namespace

Result<MeasuredCoupling> readCoupling(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxCouplingFileBytes,
                    [](const Json& root) { return readCouplingRoot(JsonField(root, {})); });
}

std::string couplingJson(const MeasuredCoupling& coupling, const std::string& name,
                         const std::string& source) {
    OrderedJson root = {{couplingVersionField, couplingFormatVersion},
                        {"name", name},
                        {"source", source},
                        {"measured", OrderedJson::array()}};
    for (std::size_t k = 0; k < coupling.matrices.size(); ++k) {
        const auto squareOf = [&matrix = coupling.matrices[k]](auto number) {
            OrderedJson rows = OrderedJson::array();
            for (std::size_t i = 0; i < matrix.size; ++i) {
                OrderedJson row = OrderedJson::array();
                for (std::size_t j = 0; j < matrix.size; ++j) row.push_back(number(matrix.at(i, j)));
                rows.push_back(std::move(row));
            }
            return rows;
        };
        root["measured"].push_back(
            {{"frequency_hz", coupling.frequenciesHz[k]},
             {"magnitude", squareOf([](std::complex<double> c) { return std::abs(c); })},
             {"phase_deg",
              squareOf([](std::complex<double> c) { return std::arg(c) * 180.0 / std::numbers::pi; })}});
    }
    return jsonLines(root);
}

Result<MeasuredCoupling> loadCoupling(const std::filesystem::path& path) {
    return loadText(path, limits::maxCouplingFileBytes, readCoupling);
}

} // namespace physvib
