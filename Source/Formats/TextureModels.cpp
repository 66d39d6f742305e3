// SPDX-License-Identifier: MIT
// Reads texture models from XML leaf by leaf; a model is checked when it ends.
#include "Formats/TextureModels.h"
#include "Formats/ClipLimits.h"
#include "Formats/XmlLeaves.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace physvib {
namespace {

constexpr double mostValue = 1.0e9; // upper bound of all values, beyond any physical speed, force or
                                    // acceleration

/// An incomplete model; missing parts are reported when it ends.
struct Draft {
    std::optional<double> millimetresPerSecond, newtons, variance;
    std::vector<double> coefficients;
};

class Reader {
public:
    Reader(std::string_view text, std::string_view name)
        : leaves_{text}
        , name_{name} {}

    Result<TextureModels> read() {
        for (;;) {
            const XmlLeaves::Next next = leaves_.next();
            if (next == XmlLeaves::Next::fault) return at(leaves_.fault());
            if (next == XmlLeaves::Next::end) return whole();
            if (const std::string fault = next == XmlLeaves::Next::leaf ? leaf() : closed(); !fault.empty())
                return at(fault);
        }
    }

private:
    Failure at(const std::string& fault) const {
        return {std::string{name_} + ": line " + std::to_string(leaves_.line()) + ": " + fault};
    }

    Result<TextureModels> whole() {
        if (!(found_.sampleRateHz > 0.0))
            return Failure{std::string{name_} + ": expected a modelSet with a SampleRate, found none"};
        if (found_.models.empty()) return Failure{std::string{name_} + ": expected a model, found none"};
        return std::move(found_);
    }

    bool isIn(std::initializer_list<std::string_view> path) const {
        return std::ranges::equal(leaves_.path(), path);
    }

    /// Sets the number and returns empty, or returns the error.
    template <class Number>
    std::string number(Number& value, double least) const {
        const auto parsed = parseNumber<double>(leaves_.text());
        if (!parsed || *parsed < least || *parsed > mostValue)
            return std::string{leaves_.path().back()} + ": expected a number from " + plainNumber(least) +
                   " to " + plainNumber(mostValue) + ", found " + inQuotes(leaves_.text());
        value = *parsed;
        return {};
    }
    std::string unit(std::initializer_list<std::string_view> expected) const {
        if (std::ranges::find(expected, leaves_.text()) != expected.end()) return {};
        return std::string{leaves_.path().back()} + ": expected " + std::string{*expected.begin()} +
               ", found " + inQuotes(leaves_.text());
    }

    std::string leaf() {
        if (leaves_.path().front() != "modelSet")
            return "expected a modelSet, found " + inQuotes(leaves_.path().front());
        if (isIn({"modelSet", "SampleRate"})) return number(found_.sampleRateHz, 100.0);
        if (isIn({"modelSet", "SpeedUnits"})) return unit({"mm/s"});
        if (isIn({"modelSet", "ForceUnits"})) return unit({"N"});
        if (isIn({"modelSet", "AccelUnits"})) return unit({"m/s^2", "m/s2", "m/s\xc2\xb2"});
        if (isIn({"modelSet", "numMACoeff"}))
            return leaves_.text() == "0"
                       ? ""
                       : "numMACoeff: expected 0, the models at 10 kHz, found " + inQuotes(leaves_.text());
        if (isIn({"modelSet", "model", "speedMod"})) return number(draft_.millimetresPerSecond, 0.0);
        if (isIn({"modelSet", "model", "forceMod"})) return number(draft_.newtons, 0.0);
        if (isIn({"modelSet", "model", "var"})) return number(draft_.variance, 0.0);
        return isIn({"modelSet", "model", "ARcoeff", "value"}) ? coefficient() : "";
    }

    std::string coefficient() {
        if (draft_.coefficients.size() > limits::maxTextureCoefficients)
            return "ARcoeff: expected at most " + std::to_string(limits::maxTextureCoefficients + 1) +
                   " values";
        return number(draft_.coefficients.emplace_back(), -mostValue);
    }

    std::string closed() {
        if (leaves_.path().front() != "modelSet")
            return "expected a modelSet, found " + inQuotes(leaves_.path().front());
        if (!isIn({"modelSet", "model"})) return {};
        Draft draft = std::exchange(draft_, {});
        if (!draft.millimetresPerSecond || !draft.newtons || !draft.variance)
            return "model: expected speedMod, forceMod and var";
        if (draft.coefficients.size() < 2 || draft.coefficients.front() != 1.0)
            return "ARcoeff: expected 1 and at least one coefficient more";
        if (found_.models.size() == limits::maxTextureModels)
            return "expected at most " + std::to_string(limits::maxTextureModels) + " models";
        draft.coefficients.erase(draft.coefficients.begin());
        found_.models.push_back({1e-3 * *draft.millimetresPerSecond, *draft.newtons, *draft.variance,
                                 std::move(draft.coefficients)});
        return {};
    }

    XmlLeaves leaves_;
    std::string_view name_;
    TextureModels found_;
    Draft draft_;
};

} // namespace

const TextureModel& TextureModels::nearest(double metresPerSecond, double newtons) const {
    const double fastest =
        std::max(1e-9, std::ranges::max(models, {}, &TextureModel::metresPerSecond).metresPerSecond);
    const double strongest = std::max(1e-9, std::ranges::max(models, {}, &TextureModel::newtons).newtons);
    return *std::ranges::min_element(models, {}, [&](const TextureModel& m) {
        return std::hypot((m.metresPerSecond - metresPerSecond) / fastest, (m.newtons - newtons) / strongest);
    });
}

bool isTextureModels(std::string_view path) noexcept {
    constexpr std::string_view ending = ".xml";
    const auto isSame = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    return path.size() >= ending.size() &&
           std::ranges::equal(path.substr(path.size() - ending.size()), ending, isSame);
}

Result<TextureModels> readTextureModels(std::string_view text, std::string_view name) {
    return Reader{text, name}.read();
}

Result<TextureModels> loadTextureModels(const std::filesystem::path& path) {
    return loadText(path, limits::maxTextureFileBytes, readTextureModels);
}

} // namespace physvib
